// Streams of any length, and filters.
#include "exact_comparison.h"
#include "support/adversaries.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace peregrine::test {
namespace {

using math::Ray;

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
