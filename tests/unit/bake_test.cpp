// Light that is found once: what is kept of it, and what frames make of that.
#include "render/bake/bake.h"
#include "render_scene.h"
#include "shade/kernels.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include <gtest/gtest.h>

namespace peregrine::render {
namespace {

using math::Vec3;
using math::Vec3d;
using test::RenderScene;

constexpr float kPi = 3.14159265358979f;

bake::Options openness_of(float range) {
    bake::Options options;
    options.range = range;
    options.bounces = 0;
    options.samples = 256;
    return options;
}

bake::Options bounces_of(uint32_t count) {
    bake::Options options;
    options.range = 0;
    options.bounces = count;
    return options;
}

struct BakedScene : RenderScene {
    using RenderScene::RenderScene;

    bake::Report report;

    void bake(const bake::Options& options) {
        scene.commit({});
        const scene::SnapshotStore::Pin pin(scene.snapshots);
        scene.set_light_map(
            bake::bake(*pin.get(), options, scene.scheduler, &scene.memory, report));
    }
    const scene::LightMap& map() {
        scene.commit({});
        const scene::SnapshotStore::Pin pin(scene.snapshots);
        return *pin.get()->light_map;
    }
    base::Handle add_matt(float albedo) {
        scene::Material material;
        material.base_color = {albedo, albedo, albedo, 1};
        return add(material);
    }
    // What is seen of a place from a little in front of it.
    Vec3 look_at(const Vec3d& place, const Vec3& normal, float range = 0) {
        Camera camera;
        camera.position = place + 1e-2 * Vec3d(normal);
        camera.forward = -normal;
        camera.up = std::fabs(normal.y) > 0.5f ? Vec3(0, 0, 1) : Vec3(0, 1, 0);
        camera.vertical_fov = 1e-4f;
        Frame frame = test::float_frame(1, 1);
        frame.baked_light = true;
        frame.occlusion = {range, 16, 1, 0.13f, 0.3f, 0.1f};
        last = take_picture(*this, camera, frame);
        return last.at(0, 0);
    }

    test::Picture last;
};

void add_box(BakedScene& world, float half, base::Handle material) {
    const auto at = [&](int i) {
        return half * Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    };
    // Counter-clockwise from within.
    for (const std::array<int, 4>& side : {std::array{0, 4, 5, 1},
                                           {2, 3, 7, 6},
                                           {0, 2, 6, 4},
                                           {1, 5, 7, 3},
                                           {0, 1, 3, 2},
                                           {4, 6, 7, 5}})
        world.add_quad(at(side[0]), at(side[1]), at(side[2]), at(side[3]), material);
}

// Of triangles, seen from within.
void add_sphere(BakedScene& world, float radius, int rings, base::Handle material) {
    const auto mesh = world.make_mesh(material);
    const auto vertex = [&](int ring, int k) {
        const float polar = kPi * float(ring) / float(rings);
        const float turn = kPi * float(k) / float(rings);
        return Vec3(std::sin(polar) * std::cos(turn), std::cos(polar),
                    std::sin(polar) * std::sin(turn));
    };
    for (int ring = 0; ring <= rings; ++ring)
        for (int k = 0; k <= 2 * rings; ++k) {
            mesh.data->positions.push_back(radius * vertex(ring, k));
            mesh.data->normals.push_back(-vertex(ring, k));
        }
    const auto index = [&](int ring, int k) { return uint32_t(ring * (2 * rings + 1) + k); };
    for (int ring = 0; ring < rings; ++ring)
        for (int k = 0; k < 2 * rings; ++k) {
            const uint32_t a = index(ring, k), b = index(ring + 1, k), c = index(ring + 1, k + 1),
                           d = index(ring, k + 1);
            if (ring + 1 < rings) mesh.surface->triangles.push_back({a, b, c});
            if (ring > 0) mesh.surface->triangles.push_back({a, c, d});
        }
    world.scene.meshes.insert({mesh.data});
}

TEST(SharedExponent, KeepsNineBitsOfTheLargestChannel) {
    std::mt19937 random(1);
    for (int i = 0; i < 100000; ++i) {
        const auto part = [&] { return float(random() >> 8) * 0x1p-24f; };
        const float scale = std::ldexp(1.0f, int(random() % 28) - 13);
        const Vec3 color = scale * Vec3(part(), part(), part());
        const Vec3 kept = scene::SharedExponent::decode(scene::SharedExponent::encode(color));
        const float largest = std::max({color.x, color.y, color.z});
        for (int k = 0; k < 3; ++k)
            ASSERT_NEAR(kept[k], color[k], largest * (1.0f / 512) + 0x1p-25f) << i;
    }
    EXPECT_EQ(scene::SharedExponent::decode(scene::SharedExponent::encode(Vec3(0))), Vec3(0));
    const Vec3 most = scene::SharedExponent::decode(scene::SharedExponent::encode(Vec3(1e30f)));
    EXPECT_EQ(most, Vec3(65408));
}

// A grid of random values over a triangle, as kernels read it and as its formulas say.
TEST(PointGrids, AreReadAlikeByAllKernels) {
    std::mt19937 random(2);
    scene::PointGrids grids(std::pmr::get_default_resource());
    for (uint32_t level = 0; level <= scene::PointGrids::kMaxLevel; ++level) {
        grids.grids.push_back(scene::PointGrids::bits(level, uint32_t(grids.values.size())));
        for (uint32_t i = 0; i < scene::PointGrids::count(level); ++i)
            grids.values.push_back(uint32_t(random() & 0xffff));
    }
    constexpr uint32_t kCount = shade::kBatch - 3;
    alignas(64) float u[shade::kPadded] = {}, v[shade::kPadded] = {}, t[shade::kPadded] = {};
    alignas(64) uint32_t triangle[shade::kPadded] = {}, back_face[shade::kPadded] = {};
    const shade::RayHits hits = {{t, t, t}, u, v, triangle, back_face, t, kCount, 0};
    for (int round = 0; round < 50; ++round) {
        for (uint32_t i = 0; i < kCount; ++i) {
            u[i] = float(random() % 1025) / 1024;
            v[i] = random() % 4 == 0 ? 1 - u[i] : (1 - u[i]) * (float(random() % 1025) / 1024);
            triangle[i] = uint32_t(random() % 10);
            if (triangle[i] == 9) triangle[i] = geometry::kNoTriangle;
            back_face[i] = random() % 8 == 0;
        }
        for (const base::Isa isa : {base::Isa::scalar, base::best_isa()}) {
            float found[shade::kPadded];
            shade::kernels(isa).recall_openness(grids, hits, found);
            for (uint32_t i = 0; i < kCount; ++i) {
                float expected = triangle[i] == geometry::kNoTriangle ? 1.0f : -1.0f;
                if (triangle[i] < grids.grids.size() && !back_face[i]) {
                    const scene::GridPlace place(triangle[i], u[i], v[i]);
                    const uint32_t first =
                        grids.grids[triangle[i]] & (scene::PointGrids::kMostPoints - 1);
                    float sum = 0;
                    for (int k = 0; k < 3; ++k) {
                        ASSERT_LT(place.index[k], scene::PointGrids::count(triangle[i]));
                        sum += place.weight[k] * float(grids.values[first + place.index[k]]);
                    }
                    expected = std::min(sum * (1.0f / 65535.0f), 1.0f);
                }
                ASSERT_EQ(found[i], expected) << i << " " << triangle[i];
            }
        }
    }
}

// Below a ceiling at a part a of the range, (1 - a)^2 of the ambient light is hidden.
TEST(Bake, FindsTheOpennessThatRaysFind) {
    BakedScene world;
    world.scene.environment.ambient = Vec3(1);
    const base::Handle white = world.add_matt(1);
    world.add_quad({-50, 0, 50}, {50, 0, 50}, {50, 0, -50}, {-50, 0, -50}, white);
    world.add_quad({-50, 1, -50}, {50, 1, -50}, {50, 1, 50}, {-50, 1, 50}, white);
    world.bake(openness_of(2));
    const float expected = 1 - 0.5f * 0.5f;
    EXPECT_NEAR(world.look_at({3, 0, 4}, {0, 1, 0}, 2).x, expected, 0.01f);
    EXPECT_EQ(world.last.stats.rays_occlusion, 0u);
    EXPECT_NEAR(world.look_at({3, 0, 4}, {0, 1, 0}, 4).x, 1 - 0.75f * 0.75f, 0.07f)
        << "of another range nothing was baked";
    EXPECT_EQ(world.last.stats.rays_occlusion, 16u);
}

// What a wall of 2 m hides of a floor, between points and at them.
TEST(Bake, IsFineWhereOpennessChanges) {
    BakedScene world;
    world.scene.environment.ambient = Vec3(1);
    const base::Handle white = world.add_matt(1);
    world.add_quad({-20, 0, 20}, {20, 0, 20}, {20, 0, -20}, {-20, 0, -20}, white);
    world.add_quad({0, 0, 4000}, {0, 0, -4000}, {0, 2, -4000}, {0, 2, 4000}, white);
    bake::Options options = openness_of(std::numeric_limits<float>::infinity());
    options.spacing = 0.25f;
    options.tolerance = 0.01f;
    world.bake(options);
    for (const double x : {0.5, 1.0, 1.7, 2.4, 5.0, 9.0}) {
        const double hidden = 0.5 * (1 - x / std::sqrt(x * x + 4));
        EXPECT_NEAR(world.look_at({x, 0, 0.3}, {0, 1, 0}, options.range).x, 1 - hidden, 0.02) << x;
    }
    EXPECT_LT(world.report.sampled, world.report.points) << "some lie between others";
}

// In a sphere with a lamp in its middle each bounce is `albedo` times the one before.
TEST(Bake, SendsLightRoundASphere) {
    constexpr float kAlbedo = 0.6f, kRadius = 4, kIntensity = 100;
    BakedScene world;
    add_sphere(world, kRadius, 64, world.add_matt(kAlbedo));
    scene::Light lamp;
    lamp.intensity = Vec3(kIntensity);
    lamp.falloff = scene::Falloff::inverse_square;
    lamp.radius = 100;
    world.add(lamp);
    const float direct = world.look_at({kRadius * 0.99, 0, 0}, {-1, 0, 0}).x;
    EXPECT_NEAR(direct, kAlbedo * kIntensity / (kRadius * kRadius) / kPi, 0.03f * direct);
    float sum = 0, part = 1;
    for (uint32_t bounces = 1; bounces <= 4; ++bounces) {
        world.bake(bounces_of(bounces));
        part *= kAlbedo;
        sum += part;
        const float seen = world.look_at({kRadius * 0.99, 0, 0}, {-1, 0, 0}).x;
        EXPECT_NEAR(seen, direct * (1 + sum), 0.02f * seen) << bounces;
    }
}

TEST(Bake, BringsTheColourOfAWallToTheFloor) {
    BakedScene world;
    scene::Material red;
    red.base_color = {1, 0, 0, 1};
    world.add_quad({-5, 0, 5}, {5, 0, 5}, {5, 0, -5}, {-5, 0, -5}, world.add_matt(1));
    world.add_quad({-5, 0, -5}, {5, 0, -5}, {5, 5, -5}, {-5, 5, -5}, world.add(red));
    scene::Light sun;
    sun.type = scene::LightType::directional;
    sun.direction = {0, 0, -1};
    sun.intensity = Vec3(kPi);
    world.add(sun); // along the floor, onto the wall
    world.bake(bounces_of(1));
    const Vec3 near = world.look_at({0, 0, -4.5}, {0, 1, 0});
    const Vec3 far = world.look_at({0, 0, 4}, {0, 1, 0});
    EXPECT_NEAR(near.x, 0.5f * (1 - 0.5f / std::sqrt(25.25f)), 0.06f);
    EXPECT_EQ(near.y, 0);
    EXPECT_LT(far.x, 0.3f * near.x);
    EXPECT_GT(far.x, 0);
}

// Points that would be within the foot of a pillar take what is around it.
TEST(Bake, DoesNotDarkenWhatIsBuried) {
    BakedScene world;
    world.scene.environment.ambient = Vec3(1);
    world.add_quad({-8, 0, 8}, {8, 0, 8}, {8, 0, -8}, {-8, 0, -8}, world.add_matt(1));
    const base::Handle stone = world.add_matt(0.5f);
    const float half = 1, low = -1, high = 3;
    const auto at = [&](int i) {
        return Vec3(i & 1 ? half : -half, i & 2 ? high : low, i & 4 ? half : -half);
    };
    for (const std::array<int, 4>& side :
         {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 4, 6, 2}, {1, 3, 7, 5}, {2, 6, 7, 3}})
        world.add_quad(at(side[0]), at(side[1]), at(side[2]), at(side[3]), stone);
    world.bake(openness_of(0.5f));
    EXPECT_GT(world.look_at({1.05, 0, 0.4}, {0, 1, 0}, 0.5f).x, 0.4f);
    EXPECT_EQ(world.look_at({2.5, 0, 0.4}, {0, 1, 0}, 0.5f).x, 1);
}

// A mesh that moves hides the more, on top of what was baked.
TEST(Bake, SeesWhatMoves) {
    BakedScene world;
    world.scene.environment.ambient = Vec3(1);
    const base::Handle white = world.add_matt(1);
    world.add_quad({-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9}, white);
    const auto lid = world.make_mesh(white);
    lid.data->positions = {{-3, 0.5f, -3}, {3, 0.5f, -3}, {3, 0.5f, 3}, {-3, 0.5f, 3}};
    lid.surface->triangles = {{0, 1, 2}, {0, 2, 3}};
    scene::MeshDescription description{lid.data};
    description.kind = scene::MeshKind::deforming;
    description.shape = std::make_shared<scene::Shape>();
    world.scene.meshes.insert(description);
    world.bake(openness_of(1));
    EXPECT_NEAR(world.look_at({0.2, 0, 0.1}, {0, 1, 0}, 1).x, 0.75f, 0.04f);
    EXPECT_EQ(world.last.stats.rays_occlusion, 16u);
    EXPECT_EQ(world.look_at({6, 0, 6}, {0, 1, 0}, 1).x, 1);
    EXPECT_EQ(world.last.stats.rays_occlusion, 0u);
}

TEST(Bake, IsTheSameWithAllThreadsAndInstructionSets) {
    const auto bake = [](uint32_t threads, base::Isa isa) {
        auto world = std::make_unique<BakedScene>(threads, isa);
        add_box(*world, 3, world->add_matt(0.7f));
        add_sphere(*world, 1, 6, world->add_matt(0.3f));
        scene::Light lamp;
        lamp.position = {1, 2, -1.5};
        lamp.intensity = Vec3(20);
        lamp.radius = 20;
        world->add(lamp);
        bake::Options options;
        options.bounces = 2;
        options.samples = 32;
        world->bake(options);
        return world;
    };
    const auto first = bake(1, base::Isa::scalar);
    const scene::LightMap& expected = first->map();
    for (const uint32_t threads : {1u, 3u}) {
        const auto other = bake(threads, base::Isa::best);
        EXPECT_EQ(other->map().openness.grids, expected.openness.grids);
        EXPECT_EQ(other->map().openness.values, expected.openness.values);
        EXPECT_EQ(other->map().bounced.grids, expected.bounced.grids);
        EXPECT_EQ(other->map().bounced.values, expected.bounced.values);
        EXPECT_EQ(other->report.rays, first->report.rays);
    }
}

TEST(Bake, FitsIntoItsMemory) {
    BakedScene world;
    add_box(world, 10, world.add_matt(0.5f));
    bake::Options options;
    world.bake(options);
    const uint64_t whole = world.report.bytes;
    for (const uint64_t most : {whole / 2, whole / 20, uint64_t(12 * 16 * 2)}) {
        options.most_bytes = most;
        world.bake(options);
        EXPECT_LE(world.map().openness.bytes() + world.map().bounced.bytes(), most);
        EXPECT_EQ(world.map().openness.grids.size(), 12u);
    }
    options.most_bytes = 12 * 16 * 2 - 1;
    try {
        world.bake(options);
        ADD_FAILURE();
    } catch (const base::Error& error) {
        EXPECT_EQ(error.code, base::Code::limit);
    }
    EXPECT_EQ(world.map().openness.grids.size(), 12u) << "what was there stays";
}

} // namespace
} // namespace peregrine::render
