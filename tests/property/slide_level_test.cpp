// Slides in the levels of others: the bits of brute force, and first touches as they are without.
//
//     PEREGRINE_RAYS=N build/release/bin/slide_test --gtest_filter='Files*'    # N slides in a
//     level
#include "slide_cases.h"

#include <gtest/gtest.h>

#include <cmath>

namespace peregrine::test {
namespace {

using math::Vec3;
using Mesh = SlideMesh;

// ---------------------------------------------------------------------------- levels of others

struct Level {
    std::vector<Mesh> meshes;
    Triangles triangles;
    float diagonal = 0;
};

Level level_of(const std::string& name) {
    Level level;
    math::Box bounds;
    for (const geometry::Triangle& triangle : load_scene(name).triangles) {
        if (level.meshes.size() <= triangle.mesh) level.meshes.resize(triangle.mesh + 1);
        level.meshes[triangle.mesh].triangles.push_back(triangle);
        level.triangles.push_back(triangle);
        bounds.extend(geometry::bounds(triangle));
    }
    level.diagonal = glm::length(bounds.upper - bounds.lower);
    return level;
}

// Shapes that stand on something, or are in it a bit, and go along it or a bit into it.
std::vector<query::Sweep> sliders(const Level& level, size_t count) {
    std::mt19937 random(9);
    std::uniform_real_distribution<float> unit(-1, 1);
    std::vector<query::Sweep> sweeps;
    while (sweeps.size() < count) {
        const auto& t = level.triangles[random() % level.triangles.size()];
        const Vec3 normal = glm::cross(t.v1 - t.v0, t.v2 - t.v0);
        if (!(glm::length(normal) > 0)) continue;
        const Vec3 up = (random() % 2 ? 1.0f : -1.0f) * glm::normalize(normal);
        const float u = std::fabs(unit(random)), v = (1 - u) * std::fabs(unit(random));
        const float radius = level.diagonal * std::exp2(-6 - 5 * std::fabs(unit(random)));
        const float height = radius * (1 - 2 * kSunk[random() % 5]);
        const Vec3 way(unit(random), unit(random), unit(random));
        const Vec3 along = way - glm::dot(way, up) * up - (random() % 4 ? 0.0f : 0.1f) * up;
        if (along == Vec3(0)) continue;
        query::Sweep sweep{t.v0 + u * (t.v1 - t.v0) + v * (t.v2 - t.v0) + height * up,
                           radius,
                           Vec3(0),
                           0.1f,
                           level.diagonal * along,
                           0};
        if (random() % 2) {
            sweep.axis = radius * Vec3(unit(random), unit(random), unit(random));
            sweep.center += std::fabs(glm::dot(sweep.axis, up)) * up;
        }
        sweeps.push_back(sweep);
    }
    return sweeps;
}

class SlideFileTest : public testing::TestWithParam<std::string> {};

TEST_P(SlideFileTest, EqualsBruteForce) {
    const Level level = level_of(GetParam());
    const size_t count = rays_per_set(20);
    slide(level.meshes, sliders(level, count));
    query::Selection front = sliding();
    front.faces = trace::Faces::front;
    slide(level.meshes, sliders(level, count), front);
}

// What starts clear of everything is stopped by the first touch that it gets deeper into, as
// without the flag: its normal is no other.
TEST_P(SlideFileTest, LeavesFirstTouchesAlone) {
    const Level level = level_of(GetParam());
    std::vector<query::Sweep> sweeps = sliders(level, 50 * rays_per_set(20));
    std::vector<query::SweepHit> plain(sweeps.size()), slid(sweeps.size());
    ShapeWorld world(base::Isa::best, trace::Structure::bvh);
    for (const Mesh& mesh : level.meshes) world.add(mesh.triangles, mesh.kind);
    world.commit();
    for (query::Sweep& sweep : sweeps) sweep.center -= 0.02f * sweep.direction;
    query::sweep(world.snapshot(), placed(sweeps), {}, strided(plain));
    query::sweep(world.snapshot(), placed(sweeps), {sliding()}, strided(slid));
    size_t same = 0, passed = 0;
    for (size_t i = 0; i < sweeps.size(); ++i) {
        if (is_free(plain[i]) || plain[i].initial_contact) continue;
        const float sine = glm::dot(glm::normalize(sweeps[i].direction), plain[i].normal);
        if (sine > -0.01f) { // or is stopped by no more than rounding
            ++passed;
            EXPECT_GE(slid[i].t, plain[i].t);
            continue;
        }
        ++same;
        EXPECT_NEAR(plain[i].t, slid[i].t, 1e-5f * level.diagonal) << i;
        EXPECT_LT(glm::length(plain[i].normal - slid[i].normal), 0.01f) << i;
    }
    RecordProperty("same", int(same));
    RecordProperty("passed", int(passed));
}

std::vector<std::string> files() {
    std::vector<std::string> names = scene_names();
    names.push_back("hall");
    return names;
}

INSTANTIATE_TEST_SUITE_P(Files, SlideFileTest, testing::ValuesIn(files()),
                         [](const auto& info) { return info.param; });

} // namespace
} // namespace peregrine::test
