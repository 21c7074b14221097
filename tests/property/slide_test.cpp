// What slides: RT_QUERY_SKIP_SEPARATING. No touch that the motion does not deepen stops a shape, no
// seam of a surface gives a normal that none of its faces has; and all of it gives the bits of
// brute force.
#include "slide_cases.h"
#include "support/closed_meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace peregrine::test {
namespace {

using math::Vec3;
using math::Vec3d;
using scene::MeshKind;
using Mesh = SlideMesh;

// --------------------------------------------------------------------------------- flat floors

TEST(SlideFloor, OfOneMesh) {
    for (const MeshKind kind : {MeshKind::fixed, MeshKind::deforming, MeshKind::rigid})
        expect_free({{floor_of(0, 20), kind}}, all_around(), "plain");
    expect_free({{floor_of(0, 20), MeshKind::rigid, turned(0, 0, 1, Vec3d(20, 0, 0), true)}},
                all_around(), "mirrored");
}

TEST(SlideFloor, TurnedAndTilted) {
    for (const MeshKind kind : {MeshKind::fixed, MeshKind::deforming, MeshKind::rigid})
        for (const double tilt : {0.5, 2.8})
            for (const double scale : {1.0, 1e-4, 3e4}) {
                const math::Affine map = turned(0.7, tilt, scale, scale * Vec3d(-3, 2, 1));
                expect_free({placed_mesh(floor_of(0, 20), kind, map)}, all_around(map, scale),
                            "turned");
            }
}

TEST(SlideFloor, FarAway) {
    for (const double far : {1e3, 1e5})
        for (const MeshKind kind : {MeshKind::fixed, MeshKind::rigid}) {
            const math::Affine flat = turned(0, 0, 1, Vec3d(far, 0, -far));
            expect_free({placed_mesh(floor_of(0, 20), kind, flat)}, all_around(flat), "flat");
            if (kind == MeshKind::fixed && far > 1e4) continue; // rounding has made hills of it
            const math::Affine tilted = turned(0.7, 0.5, 1, Vec3d(far, 0, -far));
            expect_free({placed_mesh(floor_of(0, 20), kind, tilted)}, all_around(tilted), "tilted");
        }
}

TEST(SlideFloor, OfMeshesThatMeet) {
    constexpr MeshKind kinds[] = {MeshKind::fixed, MeshKind::deforming, MeshKind::rigid};
    for (const MeshKind left : kinds)
        for (const MeshKind right : kinds)
            for (const double tilt : {0.0, 0.5}) {
                const math::Affine map = turned(tilt, tilt, 1, Vec3d(0));
                expect_free({placed_mesh(floor_of(0, 11), left, map),
                             placed_mesh(floor_of(11, 20), right, map)},
                            all_around(map), "halves");
                // Whose vertices lie elsewhere along the line where they meet.
                const Triangles coarse = grid({11, 0, 0}, {3, 0, 0}, {0, 0, 20.0f / 7}, 3, 7);
                expect_free(
                    {placed_mesh(floor_of(0, 11), left, map), placed_mesh(coarse, right, map)},
                    all_around(map), "halves of other triangles");
            }
}

//    +---+---+---+     The sides where they meet are walls that nothing can run against.
//    |   |   |   |
TEST(SlideFloor, OfBoxes) {
    std::vector<Mesh> fixed{{{}}}, rigid;
    for (int x = 0; x < 20; x += 2)
        for (int z = 0; z < 20; z += 2) {
            const Triangles box = closed_box({x, -1, z}, {2, 1, 2});
            fixed[0].triangles.insert(fixed[0].triangles.end(), box.begin(), box.end());
            rigid.push_back({closed_box({-1, -1, -1}, {2, 1, 2}), MeshKind::rigid,
                             turned(0, 0, 1, Vec3d(x + 1, 0, z + 1))});
        }
    expect_free(fixed, all_around(), "one mesh");
    expect_free(rigid, all_around(), "a mesh each");
}

// Layers of it, decals, triangles that lie across each other.
TEST(SlideFloor, CoveredByItself) {
    const Triangles other = grid({0.3f, 0, 0.4f}, {1.7f, 0, 0.1f}, {-0.1f, 0, 1.3f}, 10, 12);
    expect_free({{floor_of(0, 20)}, {other}, {floor_of(5, 15), MeshKind::rigid}}, all_around(),
                "layers");
}

TEST(SlideFloor, OfSliversAndFans) {
    Triangles slivers;
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0, 1);
    for (float x = 0; x < 20;) {
        const float width = unit(random) < 0.5f ? std::exp2(-18 * unit(random)) : 1;
        add_quad(slivers, {x, 0, 0}, {width, 0, 0}, {0, 0, 20});
        x += width;
    }
    expect_free({{slivers}}, all_around(), "slivers");
    Triangles fan;
    for (int i = 0; i < 200; ++i) {
        const auto rim = [](int k) {
            const double angle = k * std::numbers::pi / 100;
            return Vec3(Vec3d(10.5 + 10 * std::cos(angle), 0, 10.3 + 10 * std::sin(angle)));
        };
        fan.push_back({{10.5f, 0, 10.3f}, 0, rim(i + 1), 0, rim(i), 0});
    }
    expect_free({{fan}}, all_around(), "fan");
}

// Points, and shapes so small that the way to their centre is rounding.
TEST(SlideFloor, ByPoints) {
    std::vector<query::Sweep> sweeps;
    for (const float radius : {0.0f, 1e-12f, 1e-6f, 1e-3f})
        for (int i = 0; i < 36; ++i)
            sweeps.push_back({{10.25f, radius, 10.2f}, radius, Vec3(0), 1, heading(i), 0});
    expect_free({{floor_of(0, 20)}}, sweeps, "points");
    for (query::Sweep& sweep : sweeps) {
        sweep.center.y = 0.5f;
        sweep.direction.y = -1;
    }
    for (const query::SweepHit& hit : slide({{floor_of(0, 20)}}, sweeps)) {
        ASSERT_FALSE(is_free(hit));
        EXPECT_EQ(hit.normal, kY);
    }
}

// As near as it gets to not counting at all: rounding decides of each triangle which side it is.
TEST(SlideFloor, OfOneSide) {
    const math::Affine map = turned(0.7, 0.5, 1, Vec3d(1, 2, 3));
    for (const trace::Faces faces : {trace::Faces::front, trace::Faces::back}) {
        query::Selection selection = sliding();
        selection.faces = faces;
        expect_free({placed_mesh(floor_of(0, 20), MeshKind::fixed, map)}, all_around(map), "side",
                    selection);
    }
}

// ------------------------------------------------------------------------ what does stop a slider

// What goes deeper stops, with the floor's normal, however it is divided.
TEST(SlideStops, AtTheFloor) {
    std::vector<query::Sweep> sweeps;
    for (const Vec3& axis : kAxes)
        for (const float sunk : kSunk)
            for (int i = 0; i < 36; ++i)
                for (const float fall : {1e-3f, 0.5f, 1e6f})
                    sweeps.push_back(on_floor(axis, sunk, heading(i) - Vec3(0, fall, 0)));
    for (const query::SweepHit& hit : slide({{floor_of(0, 20)}}, sweeps)) {
        ASSERT_FALSE(is_free(hit));
        EXPECT_NEAR(hit.normal.y, 1, 1e-6);
        EXPECT_EQ(hit.t, 0);
    }
}

// However little it goes into a floor, it does not get through.
TEST(SlideStops, OnLongWays) {
    const Vec3 far(1 << 14, 0, 1 << 14);
    std::vector<query::Sweep> sweeps;
    for (const float radius : {0.01f, 0.5f})
        for (int i = 1; i < 12; ++i) {
            const Vec3 along(20000, -std::ldexp(20000.0f, -9 - i), 0);
            sweeps.push_back({far + Vec3(0.3f, radius, 1.4f), radius, Vec3(0), 1, along, 0});
            sweeps.push_back({far + Vec3(0.3f, radius, 1.4f), radius, Vec3(0),
                              std::numeric_limits<float>::infinity(), along, 0});
        }
    for (const Vec3& side : {Vec3(4, 0, 0), Vec3(20000, 0, 0)}) {
        const Triangles floor = grid(far, side, {0, 0, 3}, int(20000 / side.x), 1);
        const std::vector<query::SweepHit> hits = slide({{floor}}, sweeps);
        for (size_t i = 0; i < hits.size(); ++i) {
            const float depth = -hits[i].t * sweeps[i].direction.y;
            if (!is_free(hits[i]))
                EXPECT_LT(depth, sweeps[i].radius / 2) << i;
            else
                EXPECT_LT(-sweeps[i].direction.y, sweeps[i].radius / 2) << i;
        }
    }
}

void expect_wall(const std::vector<Mesh>& meshes, const char* what) {
    std::vector<query::Sweep> sweeps;
    for (const Vec3& axis : kAxes)
        for (const float sunk : kSunk)
            for (const int i : {0, 3, 33, 6}) sweeps.push_back(on_floor(axis, sunk, heading(i)));
    const std::vector<query::SweepHit> hits = slide(meshes, sweeps);
    for (size_t i = 0; i < hits.size(); ++i) {
        ASSERT_FALSE(is_free(hits[i])) << what << ' ' << i;
        const float room = 12 - 0.5f - std::fabs(sweeps[i].axis.x) - 10.25f;
        EXPECT_NEAR(hits[i].t, room / sweeps[i].direction.x, 1e-5) << what << ' ' << i;
        EXPECT_NEAR(hits[i].normal.x, -1, 1e-6) << what << ' ' << i;
    }
}

TEST(SlideStops, AtAWall) {
    const Triangles wall = grid({12, 0, 0}, kY, kZ, 4, 20);
    expect_wall({{joined({floor_of(0, 12), wall})}}, "one mesh");
    expect_wall({{floor_of(0, 20)}, {wall, MeshKind::rigid}}, "on the floor");
    expect_wall({{floor_of(0, 20)}, {closed_box({12, 0, 0}, {1, 3, 20})}}, "a box on the floor");
    expect_wall({{floor_of(0, 20), MeshKind::rigid}, {closed_box({12, -1, -1}, {1, 3, 30})}},
                "a box through the floor");
    expect_wall({{floor_of(0, 20)}, {grid({12, -0.3f, 0}, 0.07f * kY, 0.9f * kZ, 40, 20)}},
                "another grid");
}

// Up a slope, with its own normal, also where the shape is in the floor so far that it meets the
// slope's lower edge.
TEST(SlideStops, AtSlopes) {
    for (const double angle : {0.02, 0.1, 0.5, 1.2}) {
        const Vec3 up(float(std::cos(angle)), float(std::sin(angle)), 0);
        const Triangles slope = grid({12, 0, 0}, up, kZ, 10, 20);
        std::vector<query::Sweep> sweeps;
        for (const Vec3& axis : {kAxes[0], kAxes[1]})
            for (const float sunk : kSunk)
                for (const int i : {0, 2, 34}) sweeps.push_back(on_floor(axis, sunk, heading(i)));
        for (const auto& meshes :
             {std::vector<Mesh>{{joined({floor_of(0, 12), slope})}},
              std::vector<Mesh>{{floor_of(0, 20)}, {slope, MeshKind::deforming}}})
            for (const query::SweepHit& hit : slide(meshes, sweeps)) {
                ASSERT_FALSE(is_free(hit));
                EXPECT_NEAR(hit.normal.x, -up.y, 1e-5);
                EXPECT_NEAR(hit.normal.y, up.x, 1e-5);
            }
    }
}

// The nose of a step, with a normal between those of its faces.
TEST(SlideStops, AtSteps) {
    for (const float height : {0.02f, 0.2f, 0.45f}) {
        std::vector<query::Sweep> sweeps;
        for (const Vec3& axis : {kAxes[0], kAxes[1]})
            for (const float sunk : kSunk)
                for (const int i : {0, 3}) sweeps.push_back(on_floor(axis, sunk, heading(i)));
        const Triangles step = joined(
            {grid({12, 0, 0}, height * kY, kZ, 1, 20), grid({12, height, 0}, kX, kZ, 8, 20)});
        for (const auto& meshes :
             {std::vector<Mesh>{{joined({floor_of(0, 12), step})}},
              std::vector<Mesh>{{floor_of(0, 20)}, {closed_box({12, 0, 0}, {8, height, 20})}}}) {
            const std::vector<query::SweepHit> hits = slide(meshes, sweeps);
            for (size_t i = 0; i < hits.size(); ++i) {
                ASSERT_FALSE(is_free(hits[i]));
                const float center = sweeps[i].center.y - sweeps[i].axis.y;
                EXPECT_NEAR(hits[i].normal.y, (center - height) / 0.5f, 1e-4);
                EXPECT_LT(hits[i].normal.x, 0);
                EXPECT_EQ(hits[i].point.y, height);
            }
        }
    }
}

// What is only met at its border has no surface beside it: also where a mask took that away.
TEST(SlideStops, AtBorders) {
    const std::vector<Mesh> meshes{{floor_of(0, 11), MeshKind::fixed, {}, 1},
                                   {floor_of(11, 20), MeshKind::fixed, {}, 2}};
    const std::vector<query::Sweep> sweeps{on_floor(kAxes[0], 0.01f, heading(0))};
    EXPECT_TRUE(is_free(slide(meshes, sweeps)[0]));
    query::Selection right = sliding();
    right.layer_mask = 2;
    const query::SweepHit hit = slide(meshes, sweeps, right)[0];
    ASSERT_FALSE(is_free(hit));
    EXPECT_NEAR(hit.normal.y, 0.98, 1e-3);
}

// ----------------------------------------------------------------------------------------- edges

//   ________   ->     Off an edge, whatever is below it.
//           |
TEST(SlideEdges, OffACliff) {
    std::vector<query::Sweep> sweeps;
    for (const Vec3& axis : kAxes)
        for (const float sunk : kSunk)
            for (const int i : {0, 2, 5, 34}) sweeps.push_back(on_floor(axis, sunk, heading(i)));
    const Triangles drop = grid({12, -4, 0}, kY, kZ, 4, 20);
    expect_free({{joined({floor_of(0, 12), drop})}}, sweeps, "one mesh");
    expect_free({{floor_of(0, 12)}, {drop, MeshKind::rigid}}, sweeps, "two");
    expect_free({{closed_box({0, -1, 0}, {12, 1, 20})}}, sweeps, "box");
}

//     /\       A ball on a ridge, and along it.
//    /  \          .
TEST(SlideEdges, AlongARidge) {
    const Triangles roof = joined(
        {grid({0, 0, 10}, kX, {0, -0.5f, 1}, 20, 5), grid({0, 0, 10}, kX, {0, -0.5f, -1}, 20, 5)});
    std::vector<query::Sweep> sweeps;
    for (const float sunk : kSunk)
        for (const int i : {0, 18})
            sweeps.push_back(on_floor(kAxes[0], sunk, heading(i), 10.25f, 10));
    expect_free({{roof}}, sweeps, "along");
    std::vector<query::Sweep> across;
    for (const float sunk : kSunk)
        across.push_back({{10.25f, 0.4f - sunk, 9}, 0.5f, Vec3(0), 1, {0, 0, 5}, 0});
    for (const query::SweepHit& hit : slide({{roof}}, across)) {
        ASSERT_FALSE(is_free(hit));
        EXPECT_LT(hit.normal.z, 0);
        EXPECT_GT(hit.normal.y, 0);
    }
}

// In a hollow every normal is that of the face.
TEST(SlideEdges, InsideOfASphere) {
    const ClosedMesh sphere = icosphere(2);
    Triangles hollow;
    for (const auto& face : sphere.faces)
        hollow.push_back({10.0f * sphere.vertices[face[0]], 0, 10.0f * sphere.vertices[face[1]], 0,
                          10.0f * sphere.vertices[face[2]], 0});
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(-1, 1);
    std::vector<query::Sweep> sweeps;
    while (sweeps.size() < 3000) {
        const auto& t = hollow[random() % hollow.size()];
        const Vec3 normal = glm::normalize(glm::cross(t.v1 - t.v0, t.v2 - t.v0));
        const Vec3 at = t.v0 + 0.5f * std::fabs(unit(random)) * (t.v1 - t.v0)
                        + 0.5f * std::fabs(unit(random)) * (t.v2 - t.v0);
        const Vec3 way(unit(random), unit(random), unit(random));
        sweeps.push_back({at - (1 - kSunk[random() % 5]) * normal, 1, Vec3(0), 1,
                          5.0f * glm::normalize(way - glm::dot(way, normal) * normal), 0});
    }
    size_t stopped = 0;
    for (const query::SweepHit& hit : slide({{hollow}}, sweeps)) {
        if (is_free(hit)) continue;
        ++stopped;
        const auto& t = hollow[hit.triangle];
        const Vec3 normal = glm::normalize(glm::cross(t.v1 - t.v0, t.v2 - t.v0));
        EXPECT_LT(glm::length(glm::cross(normal, hit.normal)), 1e-5f);
    }
    EXPECT_GT(stopped, 2000u);
}

} // namespace
} // namespace peregrine::test
