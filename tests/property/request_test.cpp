// What may be asked for beside rays: meshes to ignore, the host's own word on each hit, counters,
// threads, surfaces, and an origin in double. Answers are those of brute force, by bits.
#include "base/error.h"
#include "query/ray_order.h"
#include "query/valid_ray.h"
#include "scene/alpha_test.h"
#include "support/query_world.h"
#include "support/world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <thread>

namespace peregrine::test {
namespace {

using math::Ray;
using math::Vec3;
using query::Hit;
using query::Request;
using query::Surface;
using scene::MeshKind;

constexpr uint32_t kMost = 4;

std::byte* bytes(auto& vector) {
    return reinterpret_cast<std::byte*>(vector.data());
}

// All four kinds of answers, with surfaces.
struct Answers {
    std::vector<Hit> closest, all;
    std::vector<uint8_t> occluded;
    std::vector<uint32_t> stored, counts;
    std::vector<Surface> closest_surfaces, all_surfaces;
    trace::Counters counters[4];

    explicit Answers(size_t rays)
        : closest(rays), all(rays * kMost), occluded(rays), stored(rays), counts(rays),
          closest_surfaces(rays), all_surfaces(rays * kMost) {}

    void ask(const scene::Snapshot& snapshot, const query::Rays& rays, Request request,
             uint32_t fields = query::kAllFields) {
        const bool counted = request.counters;
        const auto next = [&](int kind) {
            request.counters = counted ? &counters[kind] : nullptr;
            return request;
        };
        query::closest_hits(snapshot, rays, next(0), {bytes(closest), sizeof(Hit), {}},
                            {bytes(closest_surfaces), sizeof(Surface), fields});
        query::occlusion(snapshot, rays, next(1), {bytes(occluded), rays.count, 1});
        query::all_hits(snapshot, rays, next(2),
                        {bytes(all),
                         sizeof(Hit),
                         kMost,
                         {bytes(stored), rays.count, 4},
                         {bytes(all_surfaces), sizeof(Surface), fields}});
        query::count_hits(snapshot, rays, next(3), {bytes(counts), rays.count, 4});
    }
};

bool same(const auto& a, const auto& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

bool same(const Answers& a, const Answers& b) {
    return same(a.closest, b.closest) && same(a.all, b.all) && same(a.occluded, b.occluded)
           && same(a.stored, b.stored) && same(a.counts, b.counts)
           && same(a.closest_surfaces, b.closest_surfaces) && same(a.all_surfaces, b.all_surfaces);
}

// The same rays as separate arrays.
struct RayLanes {
    std::vector<float> lanes[8];
    query::RayArrays arrays;

    explicit RayLanes(const std::vector<Ray>& rays) {
        for (uint32_t k = 0; k < 8; ++k) {
            for (const Ray& ray : rays) {
                float values[8];
                std::memcpy(values, &ray, sizeof values);
                lanes[k].push_back(values[k]);
            }
            arrays.array[k] = lanes[k].data();
        }
    }
    RayLanes(const RayLanes&) = delete;
    RayLanes& operator=(const RayLanes&) = delete;
};

struct Build {
    const char* name;
    trace::Structure structure;
    bool compact = false;
};

// Static, deforming and rigid meshes; the last have a material with holes.
class RequestTest : public testing::TestWithParam<std::tuple<Build, base::Isa>> {
protected:
    void SetUp() override {
        if (!base::machine_has(std::get<1>(GetParam())))
            GTEST_SKIP() << "this machine lacks the instruction set";
        world_ = std::make_unique<QueryWorld>(std::get<1>(GetParam()), 4);
        QueryWorld& world = *world_;
        std::mt19937 random(3);
        const base::Handle holes = add_holes();
        world.add(soup(1, 200, 0.5f), MeshKind::fixed, 1, holes);
        world.add(soup(2, 200, 0.5f), MeshKind::fixed, 2);
        world.add(soup(3, 150, 0.3f), MeshKind::deforming, 4);
        world.add(soup(4, 80, 0.5f), MeshKind::rigid, 8, holes);
        for (int i = 0; i < 4; ++i) world.add_instance(3);
        for (size_t i = 3; i < world.parts.size(); ++i) world.place(i, random_placement(random, 1));
        const Build& build = std::get<0>(GetParam());
        world.commit(build.structure, accel::bvh::Quality::balanced, build.compact);
        pin_.emplace(world.scene.snapshots);
        const size_t rays = std::max<size_t>(25, rays_per_set(25)); // of each of eleven sets
        for (const RaySet& set : make_ray_sets(world.triangles(), {}, {}, rays, 5))
            for (const Ray& ray : set.rays)
                if (query::is_valid(ray)) rays_.push_back(ray);
    }

    const scene::Snapshot& snapshot() const { return *pin_->get(); }

    // Batches of several sizes must agree with the oracle, which takes what `takes` does of ray i.
    template <class Takes>
    void compare(const Request& request, Takes&& takes) {
        for (const size_t size : {rays_.size(), size_t(1), size_t(5), size_t(130)}) {
            const size_t first = size == rays_.size() ? 0 : size;
            const std::vector<Ray> rays(rays_.begin() + long(first),
                                        rays_.begin() + long(first + size));
            Answers answers(size);
            answers.ask(snapshot(), rays_of(rays), request);
            size_t wrong = 0;
            for (size_t i = 0; i < size; ++i) {
                const auto take = [&](const Hit& hit) { return takes(i, hit); };
                wrong += !right(answers, i, world_->hits(rays[i], take),
                                world_->crossings(rays[i], take));
            }
            EXPECT_EQ(wrong, 0u) << "of " << size;
        }
    }

    uint32_t layer_of(const Hit& hit) const {
        for (const QueryWorld::Part& part : world_->parts)
            if (part.mesh == hit.mesh) return part.layer_mask;
        return 0;
    }

    bool is_present(const Hit& hit) const {
        const scene::Snapshot::Mesh& mesh = snapshot().meshes[hit.mesh.index];
        const scene::InstanceAlpha instance{&snapshot(), hit.mesh.index};
        const trace::AlphaTest alpha = scene::alpha_test(instance);
        return !snapshot().material_of(mesh, hit.triangle).masked
               || alpha.present(alpha.context, {hit.mesh.index, hit.triangle & 0x3fffffff, 0},
                                hit.u, hit.v);
    }

    std::unique_ptr<QueryWorld> world_;
    std::optional<scene::SnapshotStore::Pin> pin_;
    std::vector<Ray> rays_;

private:
    static bool right(const Answers& answers, size_t i, const std::vector<Hit>& hits,
                      const std::vector<Hit>& crossings) {
        const size_t count = std::min<size_t>(kMost, crossings.size());
        const Hit& closest = answers.closest[i];
        return answers.occluded[i] == !hits.empty()
               && (hits.empty() ? closest.triangle == geometry::kNoTriangle
                                : same_hits(&closest, &hits[0], 1))
               && answers.counts[i] == crossings.size() && answers.stored[i] == count
               && same_hits(&answers.all[i * kMost], crossings.data(), count);
    }

    base::Handle add_holes() {
        auto texture = std::make_shared<scene::Texture>(&world_->scene.memory);
        texture->width = texture->height = 2;
        texture->storage = scene::Texture::Storage::float32;
        texture->sampling = scene::Sampling::nearest;
        const float texels[16] = {1, 1, 1, 1, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 1};
        texture->texels.resize(sizeof texels);
        std::memcpy(texture->texels.data(), texels, sizeof texels);
        scene::Material material;
        material.masked = true;
        return world_->scene.materials.insert(
            {material, world_->scene.textures.insert(texture), {}, {}});
    }
};

// ------------------------------------------------------------------------------------- filters

TEST_P(RequestTest, IgnoresMeshes) {
    std::mt19937 random(6);
    for (const size_t length : {1u, 2u, 5u, 40u, 1000u}) {
        std::vector<base::Handle> ignored;
        for (size_t i = 0; i < length; ++i) {
            base::Handle mesh = world_->parts[random() % world_->parts.size()].mesh;
            if (i % 3 == 1) ++mesh.generation;                            // stale
            if (i % 3 == 2) mesh = {uint32_t(random()), mesh.generation}; // of no slot
            if (i > 6 && length > 40) mesh = {};
            ignored.push_back(mesh);
        }
        Request request;
        request.selection.ignore_meshes = ignored;
        if (length % 2) request.selection.ignore_mesh = world_->parts[4].mesh;
        compare(request, [&](size_t, const Hit& hit) {
            return hit.mesh != request.selection.ignore_mesh
                   && std::find(ignored.begin(), ignored.end(), hit.mesh) == ignored.end();
        });
    }
}

TEST_P(RequestTest, FacesLayersAndAlpha) {
    for (const trace::Faces faces : {trace::Faces::both, trace::Faces::front, trace::Faces::back})
        for (const uint32_t mask : {~0u, 10u, 5u})
            for (const bool alpha_test : {false, true}) {
                Request request;
                request.selection.faces = faces;
                request.selection.layer_mask = mask;
                request.selection.alpha_test = alpha_test;
                compare(request, [&](size_t, const Hit& hit) {
                    return faces != (hit.back_face ? trace::Faces::front : trace::Faces::back)
                           && (layer_of(hit) & mask) && (!alpha_test || is_present(hit));
                });
            }
}

// What the host says may depend on all of the hit and on the ray.
struct Host {
    std::thread::id thread = std::this_thread::get_id();
    uint64_t rays = 0; // how many there are
    uint64_t calls = 0;
    uint64_t strange = 0; // calls that must not be

    static bool likes(uint64_t ray, const Hit& hit) {
        return (hit.triangle + hit.mesh.index + ray) % 3 != 0 && hit.u < 0.7f;
    }
    static bool ask(void* user, uint64_t ray, const Hit& hit) {
        Host& self = *static_cast<Host*>(user);
        ++self.calls;
        self.strange += self.thread != std::this_thread::get_id() || ray >= self.rays
                        || hit.triangle == geometry::kNoTriangle || hit.t == HUGE_VALF;
        return likes(ray, hit);
    }
};

TEST_P(RequestTest, AsksTheHost) {
    Host host;
    host.rays = rays_.size();
    Request request;
    request.selection.accept = {Host::ask, &host};
    request.scheduler = &world_->scene.scheduler;
    compare(request, Host::likes);
    request.selection.layer_mask = 9;
    request.selection.alpha_test = true;
    request.selection.ignore_mesh = world_->parts[5].mesh;
    compare(request, [&](size_t ray, const Hit& hit) {
        return (layer_of(hit) & 9) && hit.mesh != world_->parts[5].mesh && is_present(hit)
               && Host::likes(ray, hit);
    });
    EXPECT_GT(host.calls, 0u);
    EXPECT_EQ(host.strange, 0u);
}

// ------------------------------------------------------------------------- counters and threads

TEST_P(RequestTest, CountersChangeNoAnswer) {
    Answers plain(rays_.size()), counted(rays_.size());
    plain.ask(snapshot(), rays_of(rays_), {});
    Request request;
    request.counters = counted.counters;
    counted.ask(snapshot(), rays_of(rays_), request);
    EXPECT_TRUE(same(plain, counted));
    for (const trace::Counters& counters : counted.counters) {
        EXPECT_GE(counters.nodes, rays_.size() / 2);
        EXPECT_GT(counters.triangles, 0u);
        EXPECT_GT(counters.instances, 0u);
    }
    // All hits takes in at least what the first one does.
    EXPECT_GE(counted.counters[3].triangles, counted.counters[0].triangles);
}

TEST_P(RequestTest, ThreadsChangeNothing) {
    std::vector<Ray> many;
    while (many.size() < 13000) many.insert(many.end(), rays_.begin(), rays_.end());
    Answers alone(many.size()), spread(many.size());
    Request request;
    for (const bool counted : {false, true}) {
        request.scheduler = nullptr;
        request.counters = counted ? alone.counters : nullptr;
        alone.ask(snapshot(), rays_of(many), request);
        request.scheduler = &world_->scene.scheduler;
        request.counters = counted ? spread.counters : nullptr;
        spread.ask(snapshot(), rays_of(many), request);
        EXPECT_TRUE(same(alone, spread));
    }
    EXPECT_EQ(std::memcmp(alone.counters, spread.counters, sizeof alone.counters), 0);
}

// The message of the error that ask() throws; empty: none.
template <class Ask>
std::string error_of(Ask&& ask) {
    try {
        ask();
    } catch (const base::Error& error) {
        return error.text;
    }
    return {};
}

TEST_P(RequestTest, TheFirstBadRayIsNamed) {
    std::vector<Ray> many;
    while (many.size() < 13000) many.insert(many.end(), rays_.begin(), rays_.end());
    many[12000].direction = Vec3(0);
    many[9001].origin.y = 2e30f;
    Answers answers(many.size());
    const Answers untouched = answers;
    Host host;
    for (const bool counted : {false, true})
        for (const bool asked : {false, true}) {
            Request request;
            request.scheduler = &world_->scene.scheduler;
            request.counters = counted ? answers.counters : nullptr;
            if (asked) request.selection.accept = {Host::ask, &host};
            const std::string error =
                error_of([&] { answers.ask(snapshot(), rays_of(many), request); });
            EXPECT_NE(error.find("ray 9001: origin y"), std::string::npos) << error;
            EXPECT_TRUE(same(answers, untouched));
            EXPECT_EQ(answers.counters[0].nodes, 0u);
        }
    EXPECT_EQ(host.calls, 0u);
}

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

// ------------------------------------------------------------------------------- large batches

// Large batches of rays without order are traced in another one; small ones never are.
TEST_P(RequestTest, ScatteredRaysOfLargeBatches) {
    std::mt19937 random(8);
    std::vector<Ray> rays;
    while (rays.size() < 20001) rays.push_back(rays_[random() % rays_.size()]);
    ASSERT_TRUE(query::are_scattered(rays_of(rays), 0, rays.size()));
    const size_t count = rays.size();
    const RayLanes lanes(rays);
    const math::Vec3d origin(0.1, -1e3, 7);
    for (const query::Rays& all : {rays_of(rays), query::Rays{count, nullptr, 0, lanes.arrays, {}},
                                   query::Rays{count, bytes(rays), sizeof(Ray), {}, {origin}},
                                   query::Rays{count, nullptr, 0, lanes.arrays, {origin}}}) {
        Request request;
        Answers expected(count), got(count);
        for (size_t first = 0; first < count; first += 100) {
            query::Rays few = all.part(first, std::min(first + 100, count));
            query::closest_hits(snapshot(), few, request,
                                {bytes(expected.closest) + first * sizeof(Hit), sizeof(Hit), {}},
                                {bytes(expected.closest_surfaces) + first * sizeof(Surface),
                                 sizeof(Surface), query::kAllFields});
            query::occlusion(snapshot(), few, request,
                             {bytes(expected.occluded) + first, few.count, 1});
        }
        for (base::Scheduler* scheduler :
             {static_cast<base::Scheduler*>(nullptr), &world_->scene.scheduler}) {
            request.scheduler = scheduler;
            got = Answers(count);
            query::closest_hits(snapshot(), all, request, {bytes(got.closest), sizeof(Hit), {}},
                                {bytes(got.closest_surfaces), sizeof(Surface), query::kAllFields});
            query::occlusion(snapshot(), all, request, {bytes(got.occluded), count, 1});
            EXPECT_TRUE(same(expected, got));
        }
        std::vector<float> t(count);
        std::vector<uint32_t> triangle(count);
        query::closest_hits(
            snapshot(), all, request,
            {nullptr, 0, {t.data(), nullptr, nullptr, triangle.data(), nullptr, nullptr}});
        for (size_t i = 0; i < count; ++i) {
            ASSERT_EQ(t[i], expected.closest[i].t) << i;
            ASSERT_EQ(triangle[i], expected.closest[i].triangle) << i;
        }
    }
}

TEST(RayOrder, TakesEachRayOnceAndLikeOnesTogether) {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> unit(-1, 1);
    std::vector<Ray> rays(query::RayOrder::kWindow + 5);
    for (Ray& ray : rays)
        ray = {{unit(random), 10 * unit(random), 0}, 0, {unit(random), unit(random), 1}, 1};
    rays[7].origin.x = 1e30f; // beyond what is sampled
    const query::Rays all = rays_of(rays);
    EXPECT_TRUE(query::are_scattered(all, 0, rays.size()));
    EXPECT_FALSE(query::are_scattered(all, 0, 1000));
    const auto order = std::make_unique<query::RayOrder>();
    order->sort(all, 5, query::RayOrder::kWindow);
    std::vector<Ray> sorted;
    std::vector<bool> seen(query::RayOrder::kWindow);
    for (uint32_t i = 0; i < query::RayOrder::kWindow; ++i) {
        ASSERT_FALSE(seen[(*order)[i]]);
        seen[(*order)[i]] = true;
        sorted.push_back(rays[5 + (*order)[i]]);
    }
    size_t turns = 0;
    for (size_t i = 1; i < sorted.size(); ++i)
        turns += (sorted[i].direction.x < 0) != (sorted[i - 1].direction.x < 0);
    EXPECT_LE(turns, 7u);
    for (Ray& ray : sorted) ray.origin = Vec3(1); // of one place
    EXPECT_FALSE(query::are_scattered(rays_of(sorted), 0, sorted.size()));
}

// ------------------------------------------------------------------------------------- origins

TEST_P(RequestTest, OriginsInDouble) {
    const math::Vec3d origin(1e7 + 0.123456789, -3.25e6, 0x1p-30);
    std::vector<Ray> relative = rays_, moved = rays_;
    for (size_t i = 0; i < rays_.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            relative[i].origin[k] = float(double(rays_[i].origin[k]) - origin[k]);
            moved[i].origin[k] = float(double(relative[i].origin[k]) + origin[k]);
        }
    const RayLanes lanes(relative);
    for (const size_t size : {rays_.size(), size_t(1), size_t(5), size_t(100)})
        for (const bool counted : {false, true}) {
            Answers expected(size), got(size), of_arrays(size);
            Request request;
            request.counters = counted ? expected.counters : nullptr;
            query::Rays rays = rays_of(moved);
            rays.count = size;
            expected.ask(snapshot(), rays, request);
            rays = rays_of(relative);
            rays.count = size;
            rays.shift.by = origin;
            got.ask(snapshot(), rays, request);
            EXPECT_TRUE(same(expected, got)) << size;
            of_arrays.ask(snapshot(), {size, nullptr, 0, lanes.arrays, {origin}}, request);
            EXPECT_TRUE(same(expected, of_arrays)) << size;
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

constexpr const char* kIsaNames[] = {"best", "sse4", "avx2", "avx512", "scalar", "neon"};

INSTANTIATE_TEST_SUITE_P(
    Kernels, RequestTest,
    testing::Combine(testing::Values(Build{"bvh", trace::Structure::bvh},
                                     Build{"compact", trace::Structure::bvh, true},
                                     Build{"kdtree", trace::Structure::kdtree},
                                     Build{"bih", trace::Structure::bih}),
                     testing::Values(base::Isa::scalar, base::Isa::sse4, base::Isa::avx2,
                                     base::Isa::avx512, base::Isa::neon)),
    [](const auto& info) {
        return std::string(std::get<0>(info.param).name) + "_"
               + kIsaNames[uint32_t(std::get<1>(info.param))];
    });

} // namespace
} // namespace peregrine::test
