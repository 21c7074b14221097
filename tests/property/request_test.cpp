// Which triangles count: meshes to ignore, layers, faces, holes, the host's own word on each hit;
// and what changes no answer: counters, threads, the order in which large batches are traced.
// Answers are those of brute force, by bits.
#include "query/ray_order.h"
#include "request_fixture.h"

#include <thread>

namespace peregrine::test {
namespace {

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
