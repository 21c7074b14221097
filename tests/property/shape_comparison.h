#pragma once

#include "query/shapes.h"
#include "shape_world.h"

#include <gtest/gtest.h>

#include <cstring>
#include <sstream>
#include <string>
#include <vector>

// Sweeps, overlaps and nearest points beside brute force, bit for bit: promise 1 of docs/design.md.
namespace peregrine::test {

template <class Record>
bool same(const Record& a, const Record& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

template <class In, class Out>
void expect_same(const std::vector<In>& asked, const std::vector<Out>& expected,
                 const std::vector<Out>& got, const std::string& what) {
    size_t wrong = 0;
    for (size_t i = 0; i < asked.size(); ++i) {
        if (same(expected[i], got[i]) || ++wrong > 1) continue;
        std::ostringstream words;
        words << std::hexfloat;
        for (size_t k = 0; k < sizeof(In) / 4; ++k) {
            float f;
            std::memcpy(&f, reinterpret_cast<const char*>(&asked[i]) + 4 * k, 4);
            words << ' ' << f;
        }
        words << std::dec << std::defaultfloat;
        for (const auto& [name, hit] :
             {std::pair("\n  expected", expected[i]), std::pair("\n  got", got[i])}) {
            words << name;
            for (size_t k = 0; k < sizeof(Out) / 4; ++k) {
                float f;
                uint32_t bits;
                std::memcpy(&f, reinterpret_cast<const char*>(&hit) + 4 * k, 4);
                std::memcpy(&bits, &f, 4);
                words << ' ' << f << '/' << bits;
            }
        }
        ADD_FAILURE() << what << ", case " << i << ':' << words.str();
    }
    EXPECT_EQ(wrong, 0u) << what << ": of " << asked.size();
}

struct Asked {
    std::vector<query::Sweep> sweeps;
    std::vector<query::Shape> shapes;
    std::vector<query::Point> points;
    math::Vec3d base{0}; // that they are relative to
};

inline constexpr uint32_t kMost = 5;

struct Expected {
    std::vector<query::SweepHit> sweeps;
    std::vector<uint8_t> overlaps;
    std::vector<uint32_t> counts;
    std::vector<query::OverlapHit> lists; // kMost each
    std::vector<query::NearestPoint> nearest;
};

struct MeshToAdd {
    std::vector<geometry::Triangle> triangles;
    scene::MeshKind kind = scene::MeshKind::fixed;
    uint32_t layer_mask = ~0u;
    math::Affine to_world = {};
};

// Which triangles count; `ignored` is a place in the list of meshes.
struct Choice {
    query::Selection selection = {};
    int ignored = -1;
};

Asked make_cases(const std::vector<geometry::Triangle>& triangles, size_t count, uint32_t seed);
Expected ask_brute_force(const std::vector<ShapeMesh>& meshes, const Asked& asked,
                         const query::Selection& selection);

// Everything, and what slides.
std::vector<Choice> usual_choices();

// Through every structure, on every instruction set.
void compare_all(const std::vector<MeshToAdd>& meshes, size_t count,
                 const std::vector<Choice>& choices = usual_choices(),
                 const math::Vec3d& base = math::Vec3d(0));

} // namespace peregrine::test
