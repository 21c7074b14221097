// Shapes in worlds that move, and choices of what counts.
#include "geometry/area.h"
#include "shape_comparison.h"
#include "support/adversaries.h"

#include <cmath>
#include <random>

namespace peregrine::test {
namespace {

using math::Vec3;
using scene::MeshKind;

math::Affine any_placement(std::mt19937& random, double spread) {
    std::uniform_real_distribution<double> unit(-1, 1);
    math::Affine map;
    const double scale = std::exp2(2 * unit(random));
    do
        for (int row = 0; row < 3; ++row) {
            for (int k = 0; k < 3; ++k) map.column[k][row] = scale * unit(random);
            map.offset[row] = spread * unit(random);
        }
    while (std::abs(math::determinant(map)) < 0.1 * scale * scale * scale);
    return map;
}

std::vector<MeshToAdd> moving_world(uint32_t seed, double spread) {
    std::mt19937 random(seed);
    std::vector<MeshToAdd> meshes;
    const std::vector<geometry::Triangle> same = soup(seed, 40, 0.3f);
    for (uint32_t i = 0; i < 3; ++i) {
        meshes.push_back(
            {soup(seed + i, 60, 0.2f), MeshKind::rigid, 1u << i, any_placement(random, spread)});
        meshes.push_back({soup(seed + i, 100, 0.3f), MeshKind::deforming, 2u << i});
        meshes.push_back({soup(seed + i, 150, 0.3f), MeshKind::fixed, 4u << i});
        // The same triangles in the same place: the smallest mesh must win.
        meshes.push_back({same, MeshKind(i), ~0u});
    }
    return meshes;
}

TEST(ShapeWorlds, ThatMove) {
    for (const double spread : {1.0, 30.0, 1e6})
        compare_all(moving_world(uint32_t(spread) + 1, spread), rays_per_set(100));
}

TEST(ShapeWorlds, Choices) {
    std::vector<Choice> choices;
    for (const trace::Faces faces : {trace::Faces::both, trace::Faces::front, trace::Faces::back})
        for (const bool skips : {false, true}) {
            query::Selection selection;
            selection.faces = faces;
            selection.skip_separating = skips;
            choices.push_back({selection});
            selection.layer_mask = skips ? 5 : 2;
            choices.push_back({selection, skips ? 1 : 0});
        }
    compare_all(moving_world(50, 1), rays_per_set(60), choices);
}

// Records relative to a point far away: rigid meshes keep their precision, others what float has.
TEST(ShapeWorlds, ThatMoveFarAway) {
    for (const double far : {0.3, 1e4 + 0.1, 1e7 + 1 / 3.0, 1e9, 1e12}) {
        const math::Vec3d base(far, -far, 0.3 * far);
        const float size = std::max(1.0f, float(far) * 0x1p-22f);
        std::vector<MeshToAdd> meshes = moving_world(3, 3);
        for (MeshToAdd& mesh : meshes)
            if (mesh.kind == MeshKind::rigid)
                mesh.to_world.offset += base;
            else
                std::erase_if(mesh.triangles, [&](geometry::Triangle& t) {
                    for (Vec3* v : {&t.v0, &t.v1, &t.v2}) *v = Vec3(math::Vec3d(size * *v) + base);
                    return !geometry::has_area(t.v0, t.v1, t.v2);
                });
        compare_all(meshes, rays_per_set(60), {{}}, base);
    }
}

// More than the buffer of a pass holds.
TEST(ShapeLists, OfAnyLength) {
    ShapeWorld world(base::Isa::best, trace::Structure::bvh);
    world.add(soup(4, 5000, 0.05f), MeshKind::fixed);
    world.add(soup(5, 3000, 0.05f), MeshKind::rigid);
    world.commit();
    std::vector<query::Shape> shapes{{Vec3(0), 10, Vec3(0), 0, {}}, {Vec3(20), 1, Vec3(0), 0, {}}};
    std::vector<uint32_t> counts(2);
    std::vector<query::OverlapHit> hits(8000);
    query::overlap_all(
        world.snapshot(), placed(shapes), {},
        {reinterpret_cast<std::byte*>(hits.data()), sizeof hits[0], 4000, strided(counts)});
    EXPECT_EQ(counts, (std::vector<uint32_t>{8000, 0}));
    for (uint32_t i = 0; i < 4000; ++i) EXPECT_EQ(hits[i].triangle, i);
    query::overlap_all(world.snapshot(), placed(shapes), {}, {nullptr, 16, 0, strided(counts)});
    EXPECT_EQ(counts[0], 8000u);
}

} // namespace
} // namespace peregrine::test
