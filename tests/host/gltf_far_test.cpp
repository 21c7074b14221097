#include <gtest/gtest.h>

#include "animated_gltf.h"
#include "animation/pose.h"
#include "animation/skinning.h"
#include "gltf/import.h"

// Scenes that lie far from the origin: their vertices keep what precision the file gives them.
namespace host::test {
namespace {

const glm::dvec3 far_away(4000000.25, 300.125, -2700000.5);

// Puts all roots of a scene below nodes that add up to a place.
GltfBuilder move_to(GltfBuilder builder, const glm::dvec3& place, int depth = 1) {
    Json below = builder.json["scenes"][0]["nodes"];
    for (int i = 0; i < depth; ++i) {
        // The detour over 1e9 m leaves nothing behind in doubles.
        const glm::dvec3 step = place / double(depth) + (i % 2 == 0 ? 1e9 : -1e9);
        const glm::dvec3 last = i + 1 == depth && depth % 2 == 1 ? step - 1e9 : step;
        below = {builder.push("nodes",
                              {{"translation", {last.x, last.y, last.z}}, {"children", below}})};
    }
    builder.json["scenes"][0]["nodes"] = below;
    return builder;
}

// A quad whose corners floats cannot hold exactly.
GltfBuilder make_thirds() {
    GltfBuilder builder = make_quad();
    const float third = 1.0f / 3.0f;
    builder.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = builder.add_positions(
        {-third, -third, 0, 2, -third, third, 2, 2 * third, 0, -third, 2, -third});
    return builder;
}

Level import(const GltfBuilder& builder, const std::string& animation = gltf::no_animation) {
    return gltf::import_bytes(builder.glb(), "far", animation);
}

double error_of(const Level& level, const glm::dvec3& place, const Mesh& mesh, const Mesh& near) {
    EXPECT_EQ(mesh.positions.size(), near.positions.size());
    double error = 0.0;
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dvec3 found = level.origin - place + glm::dvec3(mesh.positions[i]);
        error = std::max(error, glm::length(found - glm::dvec3(near.positions[i])));
    }
    return error;
}

TEST(GltfFar, StaticMeshesKeepTheirShape) {
    const Level near = import(make_thirds());
    for (const glm::dvec3& place : {far_away, -far_away, glm::dvec3(0, 1e7, 0),
                                    glm::dvec3(3000.1, 0, 0), glm::dvec3(1e9, -1e9, 1e9)}) {
        const Level level = import(move_to(make_thirds(), place));
        const double rounding = 1e-15 * 1e9; // of doubles on the way
        EXPECT_LT(error_of(level, place, level.meshes.at(0), near.meshes.at(0)), 2e-7 + rounding);
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(level.bounds.upper[axis] - place[axis], near.bounds.upper[axis], 2e-6);
    }
}

TEST(GltfFar, ChainsOfNodesAreMultipliedInDoubles) {
    const Level near = import(make_thirds());
    const Level level = import(move_to(make_thirds(), far_away, 9));
    EXPECT_LT(error_of(level, far_away, level.meshes.at(0), near.meshes.at(0)), 2e-6);
    const Level back = import(move_to(move_to(make_thirds(), far_away), -far_away));
    EXPECT_EQ(back.origin, glm::dvec3(0.0));
    EXPECT_LT(error_of(back, glm::dvec3(0.0), back.meshes.at(0), near.meshes.at(0)), 2e-6);
}

TEST(GltfFar, MatricesAreReadInDoubles) {
    const Level near = import(make_thirds());
    GltfBuilder builder = make_thirds();
    builder.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0,          1,          0,          0,
                                          0, 0, 1, 0, far_away.x, far_away.y, far_away.z, 1};
    const Level level = import(builder);
    EXPECT_LT(error_of(level, far_away, level.meshes.at(0), near.meshes.at(0)), 2e-7);
}

TEST(GltfFar, NearScenesAreRelativeToNothing) {
    for (const glm::dvec3& place : {glm::dvec3(0.0), glm::dvec3(100, 20, -30)})
        EXPECT_EQ(import(move_to(make_thirds(), place)).origin, glm::dvec3(0.0));
    GltfBuilder wide = move_to(make_thirds(), glm::dvec3(1e6, 0, 0));
    wide.json["scenes"][0]["nodes"].push_back(wide.push("nodes", {{"mesh", 0}}));
    EXPECT_EQ(import(wide).origin, glm::dvec3(0.0)); // half of it is near
}

TEST(GltfFar, OtherThingsStayWhereTheyAre) {
    GltfBuilder builder = make_thirds();
    builder.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    Json& roots = builder.json["scenes"][0]["nodes"];
    roots.push_back(builder.push("nodes", {{"camera", 0}, {"translation", {0, 0, 4}}}));
    roots.push_back(
        builder.push("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}));
    roots.push_back(builder.push("nodes", {{"name", "spawn_1"}, {"translation", {1, 2, 3}}}));
    roots.push_back(builder.push("nodes", {{"name", "core_1"}}));
    const Level level = import(move_to(builder, far_away));
    EXPECT_NE(level.origin, glm::dvec3(0.0));
    const auto expect_at = [&](const glm::dvec3& found, const glm::dvec3& expected) {
        EXPECT_LT(glm::length(found - far_away - expected), 1e-6);
    };
    expect_at(level.cameras.at(0).position, {0, 0, 4});
    expect_at(level.lights.at(0).position, {0, 0, 0});
    expect_at(level.spawns.at(0).position, {1, 2, 3});
    expect_at(level.places.at(0).position, {0, 0, 0});
}

TEST(GltfFar, SkinsAtRest) {
    const Level near = import(make_strip());
    const Level level = import(move_to(make_strip(), far_away));
    EXPECT_LT(error_of(level, far_away, level.meshes.at(0), near.meshes.at(0)), 1e-6);
}

TEST(GltfFar, SkinsThatMove) {
    const auto shape_of = [](const Level& level) {
        Pose pose(level.rig);
        pose.set(1.0);
        const DeformingMesh& mesh = level.deforming_meshes.at(0);
        std::vector<glm::mat4x3> joints;
        joint_matrices(mesh, pose, joints, level.origin);
        Shape shape;
        deform(mesh, joints, {}, shape);
        return shape;
    };
    const Level near = import(make_strip(), ""),
                level = import(move_to(make_strip(), far_away), "");
    const Shape expected = shape_of(near), found = shape_of(level);
    for (size_t i = 0; i < expected.positions.size(); ++i)
        EXPECT_LT(glm::length(level.origin - far_away + glm::dvec3(found.positions[i])
                              - glm::dvec3(expected.positions[i])),
                  2e-6);
    EXPECT_LT(glm::length(level.bounds.center() - far_away - near.bounds.center()), 1e-5);
}

TEST(GltfFar, RigidMeshesAndInstancesAreAbsolute) {
    const Level door = import(move_to(make_door(), far_away), "");
    const Pose pose(door.rig);
    const glm::dvec3 hinge(pose.world(door.rigid_meshes.at(0).nodes[0])[3]);
    EXPECT_LT(glm::length(hinge - far_away - glm::dvec3(10, 0, 0)), 1e-6);

    GltfBuilder builder = make_quad();
    builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", builder.add_positions({0, 7, 0})}};
    const Level forest = import(move_to(builder, far_away));
    const glm::dvec3 tree(forest.rigid_meshes.at(0).places.at(0)[3]);
    EXPECT_LT(glm::length(tree - far_away - glm::dvec3(0, 7, 0)), 1e-6);
}

// Numbers that no engine takes do not become an origin.
TEST(GltfFar, AbsurdPlacesAreSurvived) {
    for (const double far : {1e20, 1e29, 1e30, 1e38, 1e200, 1e307}) {
        const Level level = import(move_to(make_thirds(), glm::dvec3(far, -far, far)));
        for (int axis = 0; axis < 3; ++axis) EXPECT_LE(std::abs(level.origin[axis]), 1e30);
    }
    GltfBuilder tiny = make_thirds();
    tiny.json["nodes"][0]["scale"] = {1e-40, 1e-40, 1e-300};
    EXPECT_TRUE(std::isfinite(glm::length(import(move_to(tiny, far_away)).origin)));
}

} // namespace
} // namespace host::test
