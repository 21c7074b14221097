// Promise 1 of docs/design.md for shapes: sweeps, overlaps and nearest points give the bits of
// brute force, through every structure, on every instruction set, in worlds that move.
//
//     PEREGRINE_RAYS=N build/release/bin/shape_test       # N cases of each kind in a world
//
// Ten million over four real levels, through the BVH on every instruction set; other structures and
// counted queries get the first kFew of each kind (F is 'Files/*:-*teapots:*dragon*:*hall'):
//     PEREGRINE_RAYS=850000 build/release/bin/shape_test --gtest_filter=F
#include "shape_comparison.h"
#include "support/adversaries.h"

namespace peregrine::test {
namespace {

using scene::MeshKind;

class ShapeFileTest : public testing::TestWithParam<std::string> {};

TEST_P(ShapeFileTest, EqualsBruteForce) {
    std::vector<MeshToAdd> meshes;
    for (const geometry::Triangle& triangle : load_scene(GetParam()).triangles) {
        if (meshes.size() <= triangle.mesh) meshes.resize(triangle.mesh + 1);
        meshes[triangle.mesh].triangles.push_back(triangle);
    }
    ASSERT_FALSE(meshes.empty());
    compare_all(meshes, rays_per_set(20));
}

std::vector<std::string> files() {
    std::vector<std::string> names = scene_names();
    names.push_back("hall");
    return names;
}

INSTANTIATE_TEST_SUITE_P(Files, ShapeFileTest, testing::ValuesIn(files()),
                         [](const auto& info) { return info.param; });

TEST(ShapeFiles, AreThere) {
    if (scene_names().empty())
        GTEST_SKIP() << "no scenes of others: set PEREGRINE_SCENES to a folder of .glb files";
}

// What brute force leaves out for being far away changes nothing.
TEST(ShapeBruteForce, EqualsAllTriangles) {
    for (const float scale : {1e-30f, 1.0f, 1e20f}) {
        ShapeWorld world(base::Isa::best, trace::Structure::bvh);
        const std::vector<geometry::Triangle> triangles = soup(8, 3000, 0.02f, scale);
        world.add(triangles, MeshKind::fixed);
        std::vector<ShapeMesh> all = world.meshes();
        for (ShapeMesh& mesh : all) mesh.boxes = {};
        Asked asked = make_cases(triangles, rays_per_set(300), 22);
        const Expected near = ask_brute_force(world.meshes(), asked, {});
        const Expected expected = ask_brute_force(all, asked, {});
        expect_same(asked.sweeps, expected.sweeps, near.sweeps, "sweeps");
        expect_same(asked.shapes, expected.counts, near.counts, "counts");
        expect_same(expected.lists, expected.lists, near.lists, "lists");
        expect_same(asked.points, expected.nearest, near.nearest, "nearest points");
    }
}

void expect_exact(std::vector<geometry::Triangle> triangles, size_t count = 200) {
    compare_all({{std::move(triangles)}}, rays_per_set(count));
}

TEST(ShapeAdversary, Soup) {
    expect_exact(soup(1, 2000, 0.1f));
}
TEST(ShapeAdversary, LargeTriangles) {
    expect_exact(soup(2, 200, 2));
}
TEST(ShapeAdversary, OneTriangle) {
    expect_exact(soup(3, 1, 1));
}

TEST(ShapeAdversary, Scales) {
    for (const float scale : {1e-30f, 1e-20f, 1e-6f, 1e-4f, 1e6f, 1e15f, 1e20f})
        expect_exact(soup(5, 200, 0.3f, scale), 100);
}

TEST(ShapeAdversary, MixedScales) {
    std::vector<geometry::Triangle> triangles = soup(6, 200, 0.3f, 1e6f);
    for (const geometry::Triangle& triangle : soup(7, 200, 0.3f, 1e-6f))
        triangles.push_back(triangle);
    expect_exact(triangles);
}

TEST(ShapeAdversary, Lattice) {
    expect_exact(lattice());
}

TEST(ShapeAdversary, CoincidentTriangles) {
    expect_exact(coincident(2500), 20);
}

TEST(ShapeAdversary, Needles) {
    expect_exact(needles(300));
}

} // namespace
} // namespace peregrine::test
