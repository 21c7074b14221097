#include "exact_comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <thread>

namespace peregrine::test {

using math::Ray;

namespace {

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

// The others would say the same four times, and the kd-tree takes its time over extreme rays.
bool looks_at_hints(trace::Structure structure, base::Isa isa) {
    return structure == trace::Structure::bvh && isa != base::Isa::scalar;
}

} // namespace

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

namespace {

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

} // namespace

void compare_all(const World& world, const std::vector<RaySet>& sets, const trace::Filter& filter) {
    const std::vector<Answers> expected = ask_brute_force(world, sets, filter);
    for (const NamedStructure& structure : kStructures)
        if (is_wanted(structure) && (takes_all_rays(structure) || !filter.trivial()))
            compare_structure(structure, world.target(structure.structure, structure.compact), sets,
                              expected, filter);
}

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

} // namespace peregrine::test
