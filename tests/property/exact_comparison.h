#pragma once

#include "support/brute_force.h"
#include "support/world.h"

#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

// Every kernel beside brute force, bit for bit: promise 1 of docs/design.md.
namespace peregrine::test {

struct Named {
    base::Isa isa;
    const char* name;
};
inline constexpr Named kIsas[] = {{base::Isa::scalar, "scalar"},
                                  {base::Isa::sse4, "sse4"},
                                  {base::Isa::avx2, "avx2"},
                                  {base::Isa::avx512, "avx512"},
                                  {base::Isa::neon, "neon"}};

struct NamedStructure {
    trace::Structure structure;
    const char* name;
    bool compact = false;
};
inline constexpr NamedStructure kStructures[] = {{trace::Structure::bvh, "bvh"},
                                                 {trace::Structure::bvh, "compact", true},
                                                 {trace::Structure::kdtree, "kdtree"},
                                                 {trace::Structure::bih, "bih"}};

// $PEREGRINE_STRUCTURE names the one to look at, for long runs; otherwise all.
inline bool is_wanted(const NamedStructure& structure) {
    const char* const wanted = std::getenv("PEREGRINE_STRUCTURE");
    return !wanted || std::string_view(wanted) == structure.name;
}

// The compact BVH goes the ways of the full one: a quarter of the rays, unless it is asked for.
inline bool takes_all_rays(const NamedStructure& structure) {
    return !structure.compact || std::getenv("PEREGRINE_STRUCTURE");
}

struct NamedHint {
    trace::Coherence hint;
    const char* name;
};
inline constexpr NamedHint kHints[] = {{trace::Coherence::automatic, "no hint"},
                                       {trace::Coherence::coherent, "coherent"},
                                       {trace::Coherence::common_origin, "common origin"},
                                       {trace::Coherence::incoherent, "incoherent"}};

struct Answers {
    explicit Answers(size_t count) : hits(count), occluded(count) {}
    std::vector<trace::Hit> hits;
    std::vector<uint8_t> occluded;
};

Answers ask_brute_force(const BruteForce& oracle, const std::vector<math::Ray>& rays,
                        const trace::Filter& filter);
Answers ask_streams(const trace::Target& target, const std::vector<math::Ray>& rays,
                    const trace::Filter& filter, const trace::Kernels& kernels,
                    trace::Coherence hint);

void expect_same(const Answers& expected, const Answers& got, const std::vector<math::Ray>& rays,
                 const std::string& what);

// Every structure that is wanted, every instruction set, ray by ray and as streams with every hint.
void compare_all(const World& world, const std::vector<RaySet>& sets,
                 const trace::Filter& filter = {});

// The BVH's other shape and build qualities.
void compare_qualities(World& world, const std::vector<RaySet>& sets);

} // namespace peregrine::test
