// What is proved of a lamp's view of fixed triangles, against tracing: every point that is said to
// be lit or hidden is asked for with the very ray that a frame would trace.
#include "support/adversaries.h"
#include "support/world.h"
#include "trace/visibility/prove.h"

#include <filesystem>
#include <random>

#include <gtest/gtest.h>

namespace peregrine::test {
namespace {

using math::Vec3;
using math::Vec3d;
using trace::visibility::Lamp;
using trace::visibility::State;

Lamp lamp_at(const Vec3& position, float reach) {
    return {position, Vec3(0, -1, 0), reach, false};
}

Lamp sun(const Vec3& direction) {
    return {Vec3(0), direction, 1, true};
}

// A point of a triangle as the shader has it (surfaces-inl.h, triangle_shading.cpp), on the lamp's
// side.
struct Point {
    uint32_t triangle;
    float u, v;
    Vec3 position, to_lamp;
    bool is_lit; // before anything is in between
};

class Lights {
public:
    explicit Lights(std::vector<geometry::Triangle> list)
        : world_(std::move(list)), target_(world_.target()) {
        for (const geometry::Triangle& t : world_.triangles)
            corners_.push_back({{t.v0, t.v1, t.v2},
                                (t.flags & geometry::kMasked) != 0,
                                (t.flags & geometry::kSingleSided) != 0});
        tree_.emplace(corners_, &world_.memory);
    }

    const math::Box& bounds() const { return target_.bounds; }

    // Proves for a lamp and asks `count` points; returns the share that was proved of those that
    // the lamp may light.
    double check(const Lamp& lamp, size_t count, float patch_size, uint32_t seed) {
        const auto setting = trace::visibility::make_setting(lamp, bounds());
        trace::visibility::ProofOptions options;
        options.patch_size = patch_size;
        trace::visibility::ProofReport report;
        const auto visibility =
            trace::visibility::prove(*tree_, setting, options, &world_.memory, report);
        std::mt19937 random(seed);
        size_t asked = 0, proved = 0;
        for (size_t i = 0; i < count; ++i) {
            const Point point = random_point(lamp, random, i);
            if (!point.is_lit) continue;
            ++asked;
            const State state = visibility->at(point.triangle, point.u, point.v);
            if (state == State::mixed) continue;
            ++proved;
            EXPECT_EQ(is_occluded(lamp, point), state == State::hidden)
                << "triangle " << point.triangle << " at " << point.u << ", " << point.v;
            if (testing::Test::HasFailure()) return 0;
        }
        return asked == 0 ? 1 : double(proved) / double(asked);
    }

private:
    // Many of them near borders and corners.
    Point random_point(const Lamp& lamp, std::mt19937& random, size_t number) const {
        std::uniform_real_distribution<float> uniform(0, 1);
        Point p{};
        p.triangle = uint32_t(random() % corners_.size());
        p.u = uniform(random);
        p.v = uniform(random);
        if (p.u + p.v > 1) p.u = 1 - p.u, p.v = 1 - p.v;
        const float near = number % 8 == 3 ? 1e-7f : 0.01f;
        if (number % 4 == 0) p.u *= near;
        if (number % 4 == 1) p.v *= near;
        if (number % 8 == 2) p.v = (1 - p.u) * (1 - near * uniform(random));
        const Vec3* const c = corners_[p.triangle].v;
        const Vec3d front = glm::cross(Vec3d(c[1]) - Vec3d(c[0]), Vec3d(c[2]) - Vec3d(c[0]));
        const double length = std::sqrt(glm::dot(front, front));
        Vec3 normal = length > 0 ? Vec3(front / length) : Vec3(0, 0, 1);
        const float w = (1.0f - p.u) - p.v;
        for (int k = 0; k < 3; ++k) p.position[k] = (w * c[0][k] + p.u * c[1][k]) + p.v * c[2][k];
        const bool is_behind = glm::dot(normal, way(lamp, p.position)) < 0;
        if (is_behind && corners_[p.triangle].single_sided) return p;
        if (is_behind) normal = -normal;
        // Bounds grow with what moves, and with them the lift.
        const float error =
            geometry::intersection_error(geometry::largest_side(bounds())) * (1 + uniform(random));
        p.position += geometry::surface_lift(geometry::largest_coordinates(c), normal, error);
        p.to_lamp = way(lamp, p.position);
        p.is_lit =
            glm::dot(normal, p.to_lamp) > 0 && (lamp.is_far || glm::length(p.to_lamp) < lamp.reach);
        return p;
    }

    static Vec3 way(const Lamp& lamp, const Vec3& from) {
        return lamp.is_far ? -lamp.direction : lamp.position - from;
    }

    // Shader::hide_occluded
    bool is_occluded(const Lamp& lamp, const Point& p) const {
        math::Ray ray = {p.position, 0, p.to_lamp, 1.0f - 0x1p-12f};
        const bool inside =
            glm::clamp(lamp.position, bounds().lower, bounds().upper) == lamp.position;
        if (lamp.is_far)
            ray.t_max = std::numeric_limits<float>::infinity();
        else if (inside)
            ray = {lamp.position, 0x1p-12f, -p.to_lamp, 1};
        return trace::select_kernels(trace::Structure::bvh, base::Isa::best)
            ->occluded(target_, ray, {});
    }

    World world_;
    trace::Target target_;
    std::vector<trace::visibility::Corners> corners_;
    std::optional<trace::visibility::TriangleTree> tree_;
};

//     lamp
//      *          The wall's shadow covers a part of the floor.
//      :  |
//   ___:__|____
std::vector<geometry::Triangle> floor_and_wall(float scale, const Vec3& shift) {
    TriangleList list;
    const auto quad = [&](Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
        for (Vec3* p : {&a, &b, &c, &d}) *p = *p * scale + shift;
        list.add(a, b, c);
        list.add(a, c, d);
    };
    quad({-5, 0, 5}, {5, 0, 5}, {5, 0, -5}, {-5, 0, -5});
    quad({1, 0, -4}, {1, 0, 4}, {1, 2, 4}, {1, 2, -4});
    return list.triangles;
}

TEST(Visibility, AWallHidesAPartOfAFloor) {
    for (const float scale : {1e-6f, 1.0f, 1e6f}) {
        Lights lights(floor_and_wall(scale, Vec3(0)));
        const Lamp lamp = lamp_at(Vec3(-1, 1.5f, 0.3f) * scale, 30 * scale);
        EXPECT_GT(lights.check(lamp, 20000, 0.1f * scale, 1), 0.7) << scale;
        EXPECT_GT(lights.check(sun({0.5f, -0.8f, 0.1f}), 20000, 0.1f * scale, 1), 0.7) << scale;
    }
}

TEST(Visibility, FarFromTheOriginLessIsProvedAndAllOfItIsTrue) {
    for (const float distance : {1e2f, 1e4f, 1e6f}) {
        Lights lights(floor_and_wall(1, Vec3(distance, 0, -distance)));
        lights.check(lamp_at(Vec3(distance - 1, 1.5f, -distance), 30), 5000, 0.5f, 1);
    }
}

TEST(Visibility, LampsInOddPlaces) {
    Lights lights(floor_and_wall(1, Vec3(0)));
    for (const Vec3& place :
         {Vec3(0), Vec3(1, 1, 0), Vec3(1, 2, 4), Vec3(1, 0, -4), Vec3(0, 1e-7f, 0),
          Vec3(0, 1e-4f, 0), Vec3(0, -1, 0), Vec3(0, 1e9f, 0), Vec3(5, 0, 5)})
        for (const float reach : {1e-30f, 1.0f, 1e30f, std::numeric_limits<float>::infinity()})
            lights.check(lamp_at(place, reach), 2000, 0.5f, 1);
    for (const Vec3& direction : {Vec3(0, -1, 0), Vec3(1, 0, 0), Vec3(1, -1e-7f, 0), Vec3(0, 1, 0)})
        lights.check(sun(direction), 2000, 0.5f, 1);
}

TEST(Visibility, Soups) {
    for (const float size : {0.02f, 0.3f, 3.0f})
        for (const float scale : {1e-20f, 1.0f, 1e20f}) {
            Lights lights(soup(7, 300, size, scale));
            for (const Vec3& place : {Vec3(0), Vec3(0.9f, -0.2f, 0.5f), Vec3(3, 0, 0)})
                lights.check(lamp_at(place * scale, 10 * scale), 4000, 0.2f * scale, 3);
            lights.check(sun({0.3f, -0.5f, 0.8f}), 4000, 0.2f * scale, 4);
        }
}

TEST(Visibility, NothingAndOneTriangle) {
    Lights one({{Vec3(0), 0, Vec3(1, 0, 0), 0, Vec3(0, 0, -1), 0}});
    EXPECT_EQ(one.check(lamp_at(Vec3(0.2f, 1, -0.2f), 10), 4000, 1, 1), 1);
    base::HostMemory heap({});
    const trace::visibility::TriangleTree none({}, &heap);
    trace::visibility::ProofReport report;
    const auto setting = trace::visibility::make_setting(lamp_at(Vec3(0), 1), math::Box());
    EXPECT_NE(trace::visibility::prove(none, setting, {}, &heap, report), nullptr);
    EXPECT_EQ(report.proofs, 0u);
}

class VisibilityInFiles : public testing::TestWithParam<std::string> {};

TEST_P(VisibilityInFiles, IsWhatIsTraced) {
    const SceneFile file = load_file(GetParam());
    Lights lights(file.triangles);
    const size_t count = rays_per_set(300) * 10;
    size_t number = 0;
    for (const Vec3& place : file.lights)
        if (number++ % 16 == 0) lights.check(lamp_at(place, 12), count, 1, uint32_t(number));
    lights.check(sun({0.3f, -0.8f, 0.52f}), count, 4, 1);
}

INSTANTIATE_TEST_SUITE_P(Files, VisibilityInFiles, testing::ValuesIn(scene_files()),
                         [](const auto& info) {
                             return std::filesystem::path(info.param).stem().string();
                         });

} // namespace
} // namespace peregrine::test
