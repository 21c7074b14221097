// Promise 1 of docs/design.md: every kernel gives the bits of brute force.
#include "support/adversaries.h"
#include "support/brute_force.h"
#include "support/world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstdlib>
#include <string_view>
#include <thread>

namespace peregrine::test {
namespace {

using math::Ray;
using math::Vec3;

struct Named {
    base::Isa isa;
    const char* name;
};
constexpr Named kIsas[] = {{base::Isa::scalar, "scalar"},
                           {base::Isa::sse4, "sse4"},
                           {base::Isa::avx2, "avx2"},
                           {base::Isa::avx512, "avx512"},
                           {base::Isa::neon, "neon"}};

struct NamedStructure {
    trace::Structure structure;
    const char* name;
    bool compact = false;
};
constexpr NamedStructure kStructures[] = {{trace::Structure::bvh, "bvh"},
                                          {trace::Structure::bvh, "compact", true},
                                          {trace::Structure::kdtree, "kdtree"},
                                          {trace::Structure::bih, "bih"}};

// $PEREGRINE_STRUCTURE names the one to look at, for long runs; otherwise all.
bool is_wanted(const NamedStructure& structure) {
    const char* const wanted = std::getenv("PEREGRINE_STRUCTURE");
    return !wanted || std::string_view(wanted) == structure.name;
}

// The compact BVH goes the ways of the full one: a quarter of the rays, unless it is asked for.
bool takes_all_rays(const NamedStructure& structure) {
    return !structure.compact || std::getenv("PEREGRINE_STRUCTURE");
}

TEST(Structures, AreKnown) {
    EXPECT_TRUE(std::ranges::any_of(kStructures, is_wanted))
        << "PEREGRINE_STRUCTURE must be bvh, compact, kdtree or bih";
}

struct NamedHint {
    trace::Coherence hint;
    const char* name;
};
constexpr NamedHint kHints[] = {{trace::Coherence::automatic, "no hint"},
                                {trace::Coherence::coherent, "coherent"},
                                {trace::Coherence::common_origin, "common origin"},
                                {trace::Coherence::incoherent, "incoherent"}};

struct Answers {
    explicit Answers(size_t count) : hits(count), occluded(count) {}
    std::vector<trace::Hit> hits;
    std::vector<uint8_t> occluded;
};

bool same_bits(float a, float b) {
    return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b);
}

bool same(const trace::Hit& a, const trace::Hit& b) {
    if (a.triangle != b.triangle || !same_bits(a.t, b.t)) return false;
    return a.triangle == geometry::kNoTriangle
           || (same_bits(a.u, b.u) && same_bits(a.v, b.v) && a.back_face == b.back_face);
}

// Calls work(i) for every i < count, on all of the machine's threads.
template <class Work>
void in_parallel(size_t count, Work&& work) {
    std::atomic<size_t> next{0};
    const auto run = [&] {
        for (size_t i; (i = next.fetch_add(1)) < count;) work(i);
    };
    std::vector<std::jthread> threads;
    for (unsigned t = 1; t < std::thread::hardware_concurrency(); ++t) threads.emplace_back(run);
    run();
}

Answers ask_brute_force(const BruteForce& oracle, const std::vector<Ray>& rays,
                        const trace::Filter& filter) {
    Answers answers(rays.size());
    constexpr size_t kBatch = 64;
    in_parallel((rays.size() + kBatch - 1) / kBatch, [&](size_t batch) {
        const size_t first = batch * kBatch, count = std::min(kBatch, rays.size() - first);
        oracle.closest({rays.data() + first, count}, filter, answers.hits.data() + first);
        for (size_t i = first; i < first + count; ++i)
            answers.occluded[i] = answers.hits[i].triangle != geometry::kNoTriangle;
    });
    return answers;
}

Answers ask_singles(const trace::Target& target, const std::vector<Ray>& rays,
                    const trace::Filter& filter, const trace::Kernels& kernels) {
    Answers answers(rays.size());
    for (size_t i = 0; i < rays.size(); ++i) {
        answers.hits[i] = kernels.closest(target, rays[i], filter);
        answers.occluded[i] = kernels.occluded(target, rays[i], filter);
    }
    return answers;
}

// Rays and hits as separate arrays, with a line more than there must be. What nobody writes keeps
// its mark: a NaN where rays are read.
struct Streams {
    static constexpr uint32_t kMark = 0x7fc12345;
    struct alignas(64) Line {
        uint32_t values[16];
    };
    explicit Streams(size_t count) : count(count), occluded(padded() + 16, uint8_t(kMark)) {
        Line marks;
        std::fill_n(marks.values, 16, kMark);
        for (auto& column : columns) column.resize(padded() / 16 + 1, marks);
    }
    float* column(int i) { return reinterpret_cast<float*>(integers(i)); }
    uint32_t* integers(int i) { return columns[i].data()->values; }
    size_t padded() const { return (count + 15) / 16 * 16; }
    bool marks_stand() const {
        bool stand = std::all_of(occluded.end() - 16, occluded.end(),
                                 [](uint8_t byte) { return byte == uint8_t(kMark); });
        for (const auto& column : columns)
            for (const uint32_t value : column.back().values) stand &= value == kMark;
        return stand;
    }

    size_t count;
    std::vector<uint8_t> occluded;
    std::vector<Line> columns[14];
};

Answers ask_streams(const trace::Target& target, const std::vector<Ray>& rays,
                    const trace::Filter& filter, const trace::Kernels& kernels,
                    trace::Coherence hint) {
    Answers answers(rays.size());
    Streams s(rays.size());
    for (size_t i = 0; i < rays.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            s.column(k)[i] = rays[i].origin[k];
            s.column(3 + k)[i] = rays[i].direction[k];
        }
        s.column(6)[i] = rays[i].t_min;
        s.column(7)[i] = rays[i].t_max;
    }
    const trace::RayStream stream{{s.column(0), s.column(1), s.column(2)},
                                  {s.column(3), s.column(4), s.column(5)},
                                  s.column(6),
                                  s.column(7),
                                  uint32_t(rays.size()),
                                  hint};
    kernels.closest_stream(
        target, stream, filter,
        {s.column(8), s.column(9), s.column(10), s.integers(11), s.integers(12), s.integers(13)});
    kernels.occluded_stream(target, stream, filter, s.occluded.data());
    EXPECT_TRUE(s.marks_stand()) << "written beyond the end: " << rays.size() << " rays";
    for (size_t i = 0; i < rays.size(); ++i) {
        answers.hits[i] = {s.column(8)[i],    s.column(9)[i],         s.column(10)[i],
                           s.integers(11)[i], s.integers(12)[i] != 0, s.integers(13)[i]};
        answers.occluded[i] = s.occluded[i];
    }
    return answers;
}

void expect_same(const Answers& expected, const Answers& got, const std::vector<Ray>& rays,
                 const std::string& what) {
    size_t wrong = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        if (same(expected.hits[i], got.hits[i]) && expected.occluded[i] == got.occluded[i])
            continue;
        if (++wrong > 1) continue;
        const auto& ray = rays[i];
        ADD_FAILURE() << what << ", ray " << i << ": t " << got.hits[i].t << " triangle "
                      << got.hits[i].triangle << " occluded " << int(got.occluded[i])
                      << ", brute force: t " << expected.hits[i].t << " triangle "
                      << expected.hits[i].triangle << " occluded " << int(expected.occluded[i])
                      << std::hexfloat << "\n  origin " << ray.origin.x << ' ' << ray.origin.y
                      << ' ' << ray.origin.z << " direction " << ray.direction.x << ' '
                      << ray.direction.y << ' ' << ray.direction.z << " t " << ray.t_min << " to "
                      << ray.t_max;
    }
    EXPECT_EQ(wrong, 0u) << what << ": of " << rays.size() << " rays";
}

// The others would say the same four times, and the kd-tree takes its time over extreme rays.
bool looks_at_hints(trace::Structure structure, base::Isa isa) {
    return structure == trace::Structure::bvh && isa != base::Isa::scalar;
}

// Every instruction set, ray by ray and as streams with every hint.
void compare_structure(const NamedStructure& structure, const trace::Target& target,
                       const std::vector<RaySet>& sets, const std::vector<Answers>& expected,
                       const trace::Filter& filter) {
    in_parallel(std::size(kIsas) * sets.size(), [&](size_t k) {
        const Named& isa = kIsas[k / sets.size()];
        const auto* kernels =
            trace::select_kernels(structure.structure, isa.isa, structure.compact);
        if (!kernels) return;
        const RaySet& set = sets[k % sets.size()];
        const Answers& answers = expected[k % sets.size()];
        const std::string what = set.name + ", " + structure.name + ", " + isa.name;
        expect_same(answers, ask_singles(target, set.rays, filter, *kernels), set.rays,
                    what + ", single");
        for (const NamedHint& hint : kHints) {
            expect_same(answers, ask_streams(target, set.rays, filter, *kernels, hint.hint),
                        set.rays, what + ", stream, " + hint.name);
            if (!looks_at_hints(structure.structure, isa.isa)) break;
        }
    });
}

std::vector<Answers> ask_brute_force(const World& world, const std::vector<RaySet>& sets,
                                     const trace::Filter& filter) {
    const BruteForce oracle(world.triangles);
    std::vector<Answers> answers;
    for (const RaySet& set : sets) answers.push_back(ask_brute_force(oracle, set.rays, filter));
    return answers;
}

void compare_all(const World& world, const std::vector<RaySet>& sets,
                 const trace::Filter& filter = {}) {
    const std::vector<Answers> expected = ask_brute_force(world, sets, filter);
    for (const NamedStructure& structure : kStructures)
        if (is_wanted(structure) && (takes_all_rays(structure) || !filter.trivial()))
            compare_structure(structure, world.target(structure.structure, structure.compact), sets,
                              expected, filter);
}

// The BVH's other shape and build qualities.
void compare_qualities(World& world, const std::vector<RaySet>& sets) {
    if (!is_wanted(kStructures[0])) return;
    const std::vector<Answers> expected = ask_brute_force(world, sets, {});
    if (!takes_all_rays(kStructures[1]))
        compare_structure(kStructures[1], world.target(trace::Structure::bvh, true), sets, expected,
                          {});
    base::Scheduler scheduler(2, {}, &world.memory);
    for (const auto& [quality, name] : {std::pair(accel::bvh::Quality::fast, "fast bvh"),
                                        std::pair(accel::bvh::Quality::best, "best bvh")}) {
        world.bvh =
            accel::bvh::build(world.triangles, {.quality = quality}, scheduler, {}, &world.memory);
        compare_structure({trace::Structure::bvh, name}, world.target(), sets, expected, {});
    }
}

// ---------------------------------------------------------------------------- files of others

class SceneTest : public testing::TestWithParam<std::string> {};

TEST_P(SceneTest, EqualsBruteForce) {
    const SceneFile scene = load_scene(GetParam());
    ASSERT_FALSE(scene.triangles.empty());
    World world(scene.triangles);
    const auto make_sets = [&](size_t rays, uint32_t seed) {
        return make_ray_sets(world.triangles, scene.eyes, scene.lights, rays, seed);
    };
    compare_all(world, make_sets(rays_per_set(500), 7));
    compare_qualities(world, make_sets((rays_per_set(500) + 3) / 4, 8));
}

std::vector<std::string> files() {
    std::vector<std::string> names = scene_names();
    names.push_back("hall");
    return names;
}

INSTANTIATE_TEST_SUITE_P(Files, SceneTest, testing::ValuesIn(files()),
                         [](const auto& info) { return info.param; });

TEST(SceneFiles, AreThere) {
    if (scene_names().empty())
        GTEST_SKIP() << "no scenes of others: set PEREGRINE_SCENES to a folder of .glb files";
}

// --------------------------------------------------------------------------------- adversaries

void expect_exact(std::vector<geometry::Triangle> triangles, size_t rays = 2000) {
    World world(std::move(triangles));
    compare_all(world, make_ray_sets(world.triangles, {}, {}, rays_per_set(rays), 11));
    compare_qualities(world, make_ray_sets(world.triangles, {}, {}, rays_per_set(rays) / 4, 12));
}

TEST(Adversary, Soup) {
    expect_exact(soup(1, 3000, 0.1f, 1));
}
TEST(Adversary, LargeTriangles) {
    expect_exact(soup(2, 300, 2, 1));
}
TEST(Adversary, OneTriangle) {
    expect_exact(soup(3, 1, 1, 1));
}
TEST(Adversary, TwoTriangles) {
    expect_exact(soup(4, 2, 1, 1));
}

TEST(Adversary, Scales) {
    for (const float scale : {1e-38f, 1e-30f, 1e-20f, 1e-6f, 1e6f, 1e15f, 1e20f, 4e29f})
        expect_exact(soup(5, 200, 0.3f, scale), 500);
}

TEST(Adversary, MixedScales) {
    std::vector<geometry::Triangle> triangles = soup(6, 300, 0.3f, 1e6f);
    for (geometry::Triangle triangle : soup(7, 300, 0.3f, 1e-6f)) {
        triangle.mesh = 1;
        triangles.push_back(triangle);
    }
    expect_exact(triangles);
}

TEST(Adversary, Lattice) {
    expect_exact(lattice(), 4000);
}

TEST(Adversary, CoincidentTriangles) {
    expect_exact(coincident(500), 500);
}

TEST(Adversary, TwoSidedTriangles) {
    expect_exact(two_sided(400), 1000);
}

TEST(Adversary, Needles) {
    expect_exact(needles(500));
}

// Sizes in a geometric series towards one corner, which asks for a deep tree.
TEST(Adversary, GeometricSeries) {
    TriangleList list;
    for (float size = 1; size > 1e-30f; size *= 0.7f)
        list.add({size, 0, 0}, {0, size, 0}, {size, size, size});
    expect_exact(list.triangles);
}

// The tessellated diagonal wall whose fans grow ever more slender.
TEST(Adversary, Fan) {
    TriangleList list;
    for (int i = 0; i < 1000; ++i) {
        const float a = float(i) * 1e-3f, b = float(i + 1) * 1e-3f;
        list.add({0, 0, 0}, {1, a * a, a}, {1, b * b, b});
    }
    expect_exact(list.triangles);
}

// -------------------------------------------------------------------------------------- streams

// Beginnings, ends and middles of sets, so that beams come in all sizes and beside other rays.
TEST(Streams, OfAnyLength) {
    const World world(soup(10, 2000, 0.2f, 1));
    RaySet all{"any length", {}};
    for (const RaySet& set : make_ray_sets(world.triangles, {}, {}, 1000, 5))
        all.rays.insert(all.rays.end(), set.rays.begin(), set.rays.end());
    const Answers answers = ask_brute_force(BruteForce(world.triangles), all.rays, {});
    std::mt19937 random(12);
    for (int i = 0; i < 60; ++i) {
        const auto count = std::ptrdiff_t(1 + random() % 1500);
        const auto first = std::ptrdiff_t(random() % (all.rays.size() - size_t(count)));
        const auto part = [&](const auto& list) {
            return std::vector(list.begin() + first, list.begin() + first + count);
        };
        const std::vector<Ray> rays = part(all.rays);
        Answers expected(0);
        expected.hits = part(answers.hits);
        expected.occluded = part(answers.occluded);
        for (const NamedStructure& structure : kStructures)
            for (const Named& isa : kIsas) {
                const auto* kernels =
                    trace::select_kernels(structure.structure, isa.isa, structure.compact);
                if (!kernels) continue;
                const NamedHint& hint = kHints[random() % std::size(kHints)];
                expect_same(expected,
                            ask_streams(world.target(structure.structure, structure.compact), rays,
                                        {}, *kernels, hint.hint),
                            rays,
                            std::to_string(first) + " + " + std::to_string(count) + ", "
                                + structure.name + ", " + isa.name + ", " + hint.name);
            }
    }
}

// -------------------------------------------------------------------------------------- filters

void expect_filtered(std::vector<geometry::Triangle> triangles) {
    for (size_t i = 0; i < triangles.size(); ++i) {
        triangles[i].mesh = uint32_t(i % 4);
        triangles[i].flags = (i % 3 == 0 ? uint32_t(geometry::kSingleSided) : 0)
                             | (i % 5 == 0 ? uint32_t(geometry::kMasked) : 0);
    }
    const World world(std::move(triangles));
    const size_t rays = std::clamp<size_t>(rays_per_set(1000), 512, 1000); // whole beams
    const std::vector<RaySet> sets = make_ray_sets(world.triangles, {}, {}, rays, 3);
    const uint32_t layers[] = {1, 2, 4, 3};
    trace::Filter filter;
    filter.layer_masks = layers;
    filter.faces = trace::Faces::front;
    compare_all(world, sets, filter);
    filter.faces = trace::Faces::back;
    filter.ignore_mesh = 2;
    compare_all(world, sets, filter);
    filter.faces = trace::Faces::both;
    filter.cull_single_sided = true;
    filter.layer_mask = 5;
    compare_all(world, sets, filter);
    filter.alpha.present = [](const void*, const geometry::TriangleInfo&, float u, float v) {
        return u > v;
    };
    compare_all(world, sets, filter);
}

TEST(Filters, EqualBruteForce) {
    expect_filtered(soup(9, 2000, 0.2f, 1));
}
TEST(Filters, OfTwoSidedTriangles) {
    expect_filtered(two_sided(600));
}

} // namespace
} // namespace peregrine::test
