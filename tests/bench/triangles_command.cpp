// Ray/triangle tests: what they miss, what they hit beside, how far off they are, how long they
// take.
#include "commands.h"
#include "timing.h"
#include "triangle_tests.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <vector>

namespace peregrine::bench {
namespace {

using math::Vec3d;

constexpr uint32_t kCases = 400'000;
constexpr uint32_t kTimed = 512; // rays, each with ...
constexpr uint32_t kOfEach = 8;  // ... so many triangles
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Two triangles that share an edge, and a ray to a point of it, as near as floats allow: it passes
// through one of them.
struct Seam {
    math::Ray ray;
    Vec3 triangle[2][3];
};

class Cases {
public:
    explicit Cases(uint32_t seed) : random_(seed) {}

    Seam seam() {
        Seam seam;
        const Vec3 a = place(1), b = place(1), left = place(1), right = a + b - left;
        const Vec3 corners[2][3] = {{a, b, left}, {b, a, right}};
        for (int i = 0; i < 2; ++i) std::copy_n(corners[i], 3, seam.triangle[i]);
        const double part = 0.05 + 0.9 * unit();
        seam.ray = to(Vec3d(a) * (1 - part) + Vec3d(b) * part);
        return seam;
    }
    // To a point well within.
    math::Ray into(const Vec3 (&v)[3]) {
        const double u = 0.1 + 0.4 * unit(), w = 0.1 + 0.4 * unit();
        return to(Vec3d(v[0]) * (1 - u - w) + Vec3d(v[1]) * u + Vec3d(v[2]) * w);
    }
    // To any point near it.
    math::Ray toward(const Vec3 (&v)[3]) { return to(Vec3d(v[0]) + Vec3d(place(0.7f))); }
    void triangle(Vec3 (&v)[3]) {
        for (Vec3& corner : v) corner = place(1);
    }

private:
    double unit() { return double(random_() >> 8) * 0x1p-24; }
    Vec3 place(float size) {
        const auto along = [&] { return size * float(2 * unit() - 1); };
        return {along(), along(), along()};
    }
    math::Ray to(const Vec3d& target) {
        const Vec3 origin = 10.0f * place(1);
        return {origin, 0, Vec3(target - Vec3d(origin)), kInfinity};
    }

    std::mt19937 random_;
};

struct Verdict {
    double missed_per_million, beside_per_million, median_ulps, worst_ulps, ns;
};

template <class Test>
double missed() {
    Cases cases(1);
    uint32_t count = 0;
    for (uint32_t i = 0; i < kCases; ++i) {
        const Seam seam = cases.seam();
        count += !cross<Test>(seam.ray, seam.triangle[0]).hit
                 && !cross<Test>(seam.ray, seam.triangle[1]).hit;
    }
    return 1e6 * count / kCases;
}

// Against double precision, at edges.
template <class Test>
double beside() {
    Cases cases(2);
    uint32_t count = 0;
    for (uint32_t i = 0; i < kCases; ++i) {
        const Seam seam = cases.seam();
        for (const auto& triangle : seam.triangle)
            count += cross<Test>(seam.ray, triangle).hit
                     && !cross<MoellerTrumbore<double>>(seam.ray, triangle).hit;
    }
    return 1e6 * count / (2.0 * kCases);
}

template <class Test>
void find_ulps(Verdict& out) {
    Cases cases(3);
    std::vector<double> ulps;
    for (uint32_t i = 0; i < kCases; ++i) {
        Vec3 v[3];
        cases.triangle(v);
        const math::Ray ray = cases.into(v);
        const Crossing truth = cross<MoellerTrumbore<long double>>(ray, v);
        const Crossing found = cross<Test>(ray, v);
        if (!truth.hit || !found.hit) continue;
        const float near = float(truth.t);
        ulps.push_back(std::fabs(found.t - truth.t)
                       / double(std::nextafter(near, kInfinity) - near));
    }
    out.worst_ulps = *std::max_element(ulps.begin(), ulps.end());
    out.median_ulps = median(ulps);
}

template <class Test>
double time_of(uint32_t passes) {
    Cases cases(4);
    struct Fan {
        math::Ray ray;
        Vec3 triangles[kOfEach][3];
    };
    std::vector<Fan> fans(kTimed);
    for (Fan& fan : fans) {
        for (auto& triangle : fan.triangles) cases.triangle(triangle);
        fan.ray = cases.toward(fan.triangles[0]);
    }
    constexpr int kRounds = 50;
    std::vector<double> ns;
    volatile double sink = 0;
    for (uint32_t pass = 0; pass <= passes; ++pass) {
        const double start = thread_seconds();
        double sum = 0;
        for (int round = 0; round < kRounds; ++round)
            for (const Fan& fan : fans) {
                const auto ray = Test::prepare(fan.ray);
                for (const auto& triangle : fan.triangles) {
                    const Crossing found = Test::cross(ray, triangle);
                    sum += found.hit ? found.t : 1.0;
                }
            }
        sink = sum;
        if (pass > 0) ns.push_back(1e9 * (thread_seconds() - start) / (kRounds * kTimed * kOfEach));
    }
    (void)sink;
    return median(ns);
}

template <class Test>
Verdict judge(uint32_t passes) {
    Verdict verdict{missed<Test>(), beside<Test>(), 0, 0, time_of<Test>(passes)};
    find_ulps<Test>(verdict);
    return verdict;
}

} // namespace

std::string run_triangles(const Options& options) {
    nlohmann::json rows = nlohmann::json::array();
    std::printf(
        "%u rays at shared edges, and as many into triangles; one ray at a time, 8 triangles each\n"
        "%-26s %12s %12s %12s %12s %8s\n",
        kCases, "test", "missed /10^6", "beside /10^6", "median ulps", "worst ulps", "ns");
    const auto report = [&](const char* name, const Verdict& v) {
        std::printf("%-26s %12.1f %12.1f %12.3f %12.1f %8.2f\n", name, v.missed_per_million,
                    v.beside_per_million, v.median_ulps, v.worst_ulps, v.ns);
        rows.push_back({{"test", name},
                        {"missed_per_million", v.missed_per_million},
                        {"beside_per_million", v.beside_per_million},
                        {"median_ulps", v.median_ulps},
                        {"worst_ulps", v.worst_ulps},
                        {"ns", v.ns}});
    };
    report("ours", judge<Canonical>(options.passes));
    report("watertight, float", judge<Watertight>(options.passes));
    report("Moeller-Trumbore, float", judge<MoellerTrumbore<float>>(options.passes));
    report("Moeller-Trumbore, double", judge<MoellerTrumbore<double>>(options.passes));
    return rows.dump(2);
}

} // namespace peregrine::bench
