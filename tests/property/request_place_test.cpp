// What lies at a hit, and where rays are: surfaces beside hits, origins in double.
#include "request_fixture.h"

namespace peregrine::test {
namespace {

// ------------------------------------------------------------------------------------ surfaces

TEST_P(RequestTest, SurfacesAreThoseOfTheHits) {
    for (const bool counted : {false, true})
        for (const size_t size : {rays_.size(), size_t(3)})
            for (const uint32_t fields : {63u, 0u, 1u, 2u, 4u, 8u, 16u, 32u, 21u}) {
                const std::vector<Ray> rays(rays_.begin(), rays_.begin() + long(size));
                Answers answers(size), expected(size);
                Request request;
                request.counters = counted ? answers.counters : nullptr;
                answers.ask(snapshot(), rays_of(rays), request, fields);
                query::resolve(snapshot(), {bytes(answers.closest), size, sizeof(Hit)},
                               {bytes(expected.closest_surfaces), sizeof(Surface), fields});
                EXPECT_TRUE(same(answers.closest_surfaces, expected.closest_surfaces)) << fields;
                for (size_t i = 0; i < size; ++i)
                    query::resolve(snapshot(),
                                   {bytes(answers.all) + i * kMost * sizeof(Hit), answers.stored[i],
                                    sizeof(Hit)},
                                   {bytes(expected.all_surfaces) + i * kMost * sizeof(Surface),
                                    sizeof(Surface), fields});
                EXPECT_TRUE(same(answers.all_surfaces, expected.all_surfaces)) << fields;
            }
}

TEST_P(RequestTest, FieldsThatAreNotWantedAreZero) {
    const Surface zero;
    size_t with_normals = 0;
    for (const Ray& ray : rays_) {
        Hit hit;
        Surface all, some;
        query::closest_hits(snapshot(), rays_of({ray}), {},
                            {reinterpret_cast<std::byte*>(&hit), sizeof hit, {}},
                            {reinterpret_cast<std::byte*>(&all), sizeof all});
        const query::Strided<Hit> hits{reinterpret_cast<std::byte*>(&hit), 1, sizeof hit};
        for (const uint32_t fields : {1u, 2u, 4u, 8u, 16u, 32u}) {
            query::resolve(snapshot(), hits,
                           {reinterpret_cast<std::byte*>(&some), sizeof some, fields});
            const auto expect = [&](uint32_t field, const auto Surface::*member) {
                EXPECT_EQ(some.*member, fields == field ? all.*member : zero.*member);
            };
            expect(query::kPosition, &Surface::position);
            expect(query::kGeometricNormal, &Surface::geometric_normal);
            expect(query::kShadingNormal, &Surface::shading_normal);
            expect(query::kTexcoord, &Surface::texcoord);
            expect(query::kMaterial, &Surface::material);
            expect(query::kUserData, &Surface::material_user_data);
            expect(query::kUserData, &Surface::mesh_user_data);
        }
        with_normals += all.geometric_normal != Vec3(0) && all.mesh_user_data >= 1000;
    }
    EXPECT_GT(with_normals, rays_.size() / 4);
}

// Into arrays, hits go from the kernels straight to the host.
TEST_P(RequestTest, SurfacesBesideArrays) {
    struct alignas(64) Line {
        float values[16];
    };
    const size_t count = rays_.size() / 16 * 16;
    std::vector<Line> lines(count / 16 * 2);
    float* const lanes = lines[0].values;
    Answers records(count), arrays(count);
    std::vector<Ray> rays(rays_.begin(), rays_.begin() + long(count));
    records.ask(snapshot(), rays_of(rays), {});
    query::closest_hits(snapshot(), rays_of(rays), {},
                        {nullptr, 0, {lanes, lanes + count, nullptr, nullptr, nullptr, nullptr}},
                        {bytes(arrays.closest_surfaces), sizeof(Surface)});
    EXPECT_TRUE(same(records.closest_surfaces, arrays.closest_surfaces));
    for (size_t i = 0; i < count; ++i) EXPECT_EQ(lanes[i], records.closest[i].t);
}

// ------------------------------------------------------------------------------------- origins

// Rigid meshes see rays in double, others in float.
TEST_P(RequestTest, OriginsInDouble) {
    const std::vector<Ray> rays = rays_;
    for (const math::Vec3d origin :
         {math::Vec3d(0.123456789, -3.25, 0x1p-30), math::Vec3d(1e7 + 0.123456789, -3.25e6, 1)}) {
        rays_ = rays;
        for (Ray& ray : rays_)
            for (int k = 0; k < 3; ++k) ray.origin[k] = float(double(ray.origin[k]) - origin[k]);
        for (const bool counted : {false, true}) {
            trace::Counters counters;
            Request request;
            request.counters = counted ? &counters : nullptr;
            compare(
                request, [](size_t, const Hit&) { return true; }, origin);
            query::Rays records = rays_of(rays_);
            records.shift.by = origin;
            const RayLanes lanes(rays_);
            Answers of_records(rays_.size()), of_arrays(rays_.size());
            of_records.ask(snapshot(), records, request);
            of_arrays.ask(snapshot(), {rays_.size(), nullptr, 0, lanes.arrays, {origin}}, request);
            EXPECT_TRUE(same(of_records, of_arrays));
        }
    }
}

TEST_P(RequestTest, OriginsDecideWhatIsARay) {
    std::vector<Ray> rays(rays_.begin(), rays_.begin() + 60);
    query::Rays moved = rays_of(rays);
    Answers answers(rays.size());
    rays[50].origin = Vec3(9e29f, 0, 0);
    moved.shift.by = {2e29, 0, 0};
    const std::string error = error_of([&] { answers.ask(snapshot(), moved, {}); });
    EXPECT_NE(error.find("ray 50: origin x"), std::string::npos) << error;
    rays[50].origin = Vec3(1.1e30f, 0, 0);
    moved.shift.by = {-2e29, 0, 0};
    EXPECT_EQ(error_of([&] { answers.ask(snapshot(), moved, {}); }), "");
}

} // namespace
} // namespace peregrine::test
