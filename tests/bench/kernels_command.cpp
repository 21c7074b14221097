// The small pieces that tracing is made of, on this machine, for each of its instruction sets.
#include "commands.h"
#include "timing.h"

#include "geometry/intersect.h"
#include "support/world.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

namespace peregrine::bench {
namespace {

using math::Vec3;

constexpr uint32_t kRays = 512; // of a beam
constexpr uint32_t kRounds = 200;
constexpr trace::Coherence kBeam = trace::Coherence::common_origin;
constexpr trace::Coherence kWave = trace::Coherence::incoherent;
volatile float sink;

// Nanoseconds for each of `count` that one call of `work` does.
template <class Work>
double time_one(const Options& options, uint32_t count, Work&& work) {
    std::vector<double> ns;
    for (uint32_t pass = 0; pass < options.passes + 1; ++pass) {
        const double start = thread_seconds();
        for (uint32_t i = 0; i < kRounds; ++i) work();
        if (pass > 0) ns.push_back(1e9 * (thread_seconds() - start) / kRounds / count);
    }
    return median(ns);
}

// Rays from one point, 32 by 16, each at its place in a window before z = 1.
struct alignas(64) Rays {
    float lane[8][kRays], t[kRays], u[kRays], v[kRays];
    uint32_t triangle[kRays], back_face[kRays];

    explicit Rays(float right) {
        for (uint32_t i = 0; i < kRays; ++i) {
            const float x = float(i % 32) / 64, y = float(i / 32) / 64;
            const float values[] = {0, 0, 0, 0, x + right, y, 1, 10};
            for (int k = 0; k < 8; ++k) lane[k][i] = values[k];
        }
    }
    trace::RayStream stream(trace::Coherence coherence) const {
        const auto& l = lane;
        return {{l[0], l[1], l[2]}, {l[4], l[5], l[6]}, l[3], l[7], kRays, coherence};
    }
    trace::HitStream hits() { return {t, u, v, triangle, back_face, nullptr}; }
};

} // namespace

std::string run_kernels(const Options& options) {
    nlohmann::json rows = nlohmann::json::array();
    const auto report = [&](const char* isa, const char* piece, double ns) {
        std::printf("%-8s %-58s %8.2f ns\n", isa, piece, ns);
        rows.push_back({{"isa", isa}, {"piece", piece}, {"ns", ns}});
    };
    const auto time_reciprocals = [&](auto x) {
        return time_one(options, kRays, [&] {
            for (uint32_t i = 0; i < kRays; ++i) asm volatile("" : "+x"(x = 1 / x));
        });
    };
    report("any", "reciprocal, float, latency", time_reciprocals(1.1f));
    report("any", "reciprocal, double, latency", time_reciprocals(1.1));

    test::TriangleList list; // two layers of a wall before z = 4, x and y from -1 to 3
    for (const float z : {4.0f, 5.0f}) {
        list.add({-1, -1, z}, {3, -1, z}, {-1, 8, z});
        list.add({3, -1, z}, {3, 8, z}, {-1, 8, z});
    }
    const test::World world(list.triangles, 1);
    const auto time_test = [&](const math::Ray& ray) {
        geometry::ShearedRay sheared = geometry::shear(ray);
        const geometry::Triangle& triangle = world.triangles[0];
        return time_one(options, kRays, [&] {
            geometry::TriangleHit hit{};
            for (uint32_t i = 0; i < kRays; ++i) {
                asm volatile("" : "+m"(sheared));
                geometry::intersect(sheared, triangle.v0, triangle.v1, triangle.v2, hit);
                sink = hit.t;
            }
        });
    };
    const math::Ray hitting{{0, 0, 0}, 0, {0.1f, 0.1f, 1}, 10};
    const math::Ray missing{{0, 0, 0}, 0, {5, 0.1f, 1}, 10};
    report("any", "canonical test, hit", time_test(hitting));
    report("any", "canonical test, rejected in float", time_test(missing));

    constexpr const char* kNames[] = {"scalar", "sse4", "avx2", "avx512", "neon"};
    constexpr base::Isa kIsas[] = {base::Isa::scalar, base::Isa::sse4, base::Isa::avx2,
                                   base::Isa::avx512, base::Isa::neon};
    for (size_t i = 0; i < std::size(kIsas); ++i) {
        const char* const name = kNames[i];
        const auto* const kernels = trace::select_kernels(trace::Structure::bvh, kIsas[i]);
        if (!kernels) continue;
        const auto time_ray = [&](const math::Ray& ray) {
            const trace::Target target = world.target();
            return time_one(options, 1, [&] { sink = kernels->closest(target, ray, {}).t; });
        };
        report(name, "one ray, one node", time_ray(missing));
        report(name, "one ray, one node and a leaf of 4 triangles", time_ray(hitting));
        const auto time_rays = [&](float right, trace::Coherence coherence) {
            Rays rays(right);
            return time_one(options, kRays, [&] {
                kernels->closest_stream(world.target(), rays.stream(coherence), {}, rays.hits());
            });
        };
        report(name, "beam of 512, one node, a ray", time_rays(5, kBeam));
        report(name, "beam of 512, one node and a wall, a ray", time_rays(0, kBeam));
        report(name, "wave of 512, one node and a wall, a ray", time_rays(0, kWave));
    }
    return rows.dump(2);
}

} // namespace peregrine::bench
