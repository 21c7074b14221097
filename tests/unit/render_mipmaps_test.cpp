#include "render/plan.h"
#include "render/primary_rays.h"
#include "render_scene.h"
#include "scene/texture_levels.h"
#include "scene/texture_sampling.h"

#include <cstring>
#include <limits>

#include <gtest/gtest.h>

namespace peregrine::render {
namespace {

using math::Vec2;
using math::Vec3;
using scene::Texture;
using scene::Wrap;

struct TextureKind {
    uint32_t width = 32, height = 32;
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
    scene::Sampling sampling = scene::Sampling::bilinear;
};

std::shared_ptr<Texture> make_texture(base::Memory* memory, const TextureKind& kind) {
    auto texture = std::make_shared<Texture>(memory);
    texture->width = kind.width;
    texture->height = kind.height;
    texture->wrap_u = kind.wrap_u;
    texture->wrap_v = kind.wrap_v;
    texture->sampling = kind.sampling;
    scene::lay_out_levels(*texture);
    for (size_t i = 0; i < size_t(kind.width) * kind.height * 4; ++i) {
        const uint16_t value = i % 4 == 3 ? uint16_t(65535) : uint16_t(i / 4 * 40503u + i % 4);
        std::memcpy(texture->texels.data() + 2 * i, &value, 2);
    }
    scene::fill_levels(*texture);
    return texture;
}

// A level as a texture of its own.
Texture level_of(const Texture& texture, uint32_t level, base::Memory* memory) {
    Texture out(memory);
    out.width = texture.level_width(level);
    out.height = texture.level_height(level);
    out.wrap_u = texture.wrap_u;
    out.wrap_v = texture.wrap_v;
    out.sampling = texture.sampling;
    out.texels.resize(size_t(out.width) * out.height * 8);
    std::memcpy(out.texels.data(), texture.texels.data() + texture.level_first[level] * size_t(8),
                out.texels.size());
    return out;
}

// A scene in which what is seen of a texture is all the light.
struct GlowingScene : test::RenderScene {
    using RenderScene::RenderScene;

    base::Handle glow(const std::shared_ptr<Texture>& texture) {
        scene::Material material;
        material.base_color = {0, 0, 0, 1};
        material.emissive = Vec3(1);
        material.double_sided = true;
        return add(material, {}, {}, scene.textures.insert(texture));
    }
};

Frame frame_of(TextureFilter filter, uint32_t width = 64, uint32_t height = 64) {
    Frame frame = test::float_frame(width, height);
    frame.approximations.texture_filter = filter;
    return frame;
}

// From so far away that all rays are all but parallel, a pixel is as wide as `texels` of 32.
Camera distant_camera(float texels, uint32_t height) {
    Camera camera;
    camera.position = {0, 0, 1000};
    camera.vertical_fov = 2 * std::atan(0.0005f * float(height) * texels / 32);
    return camera;
}

// A pixel of four texels: half a step finer than the third level is half of each of two.
TEST(Mipmaps, AreSampledAsTheirLevelsAreInEveryWrapMode) {
    for (const Wrap wrap_u : {Wrap::repeat, Wrap::mirror, Wrap::clamp})
        for (const Wrap wrap_v : {Wrap::repeat, Wrap::mirror, Wrap::clamp})
            for (const auto sampling : {scene::Sampling::bilinear, scene::Sampling::nearest}) {
                GlowingScene world;
                const auto texture =
                    make_texture(&world.scene.memory, {32, 32, wrap_u, wrap_v, sampling});
                const Texture fine = level_of(*texture, 1, &world.scene.memory);
                const Texture coarse = level_of(*texture, 2, &world.scene.memory);
                world.add_quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, world.glow(texture));
                // ... repeated to the right and above
                const auto mesh = world.make_mesh(world.glow(texture));
                mesh.data->positions = {{-2, -2, 0}, {0, -2, 0}, {0, 2, 0}, {-2, 2, 0}};
                mesh.surface->texcoords = {{-2, -2}, {0, -2}, {0, 2}, {-2, 2}};
                mesh.surface->triangles = {{0, 1, 2}, {0, 2, 3}};
                world.scene.meshes.insert({mesh.data});
                Camera camera = distant_camera(4, 20);
                camera.position += math::Vec3d(0.02, 0.03, 0); // where no texels meet
                const test::Picture picture =
                    test::take_picture(world, camera, frame_of(TextureFilter::mipmaps, 20, 20));
                for (uint32_t y = 0; y < 20; ++y)
                    for (uint32_t x = 0; x < 20; ++x) {
                        const Vec2 uv((float(x) - 9.5f) / 8 + 0.02f, (9.5f - float(y)) / 8 + 0.03f);
                        const bool is_seen = uv.x < 0 || (uv.y > 0 && uv.x < 1 && uv.y < 1);
                        if (!is_seen) continue;
                        const Vec3 expected(
                            0.5f * (scene::sample(fine, uv) + scene::sample(coarse, uv)));
                        const Vec3 error = glm::abs(picture.at(x, y) - expected);
                        ASSERT_LT(std::max({error.x, error.y, error.z}), 0.02f) << x << " " << y;
                    }
            }
}

TEST(Mipmaps, OfLargeTexelsAreTheFinestLevelBitForBit) {
    for (const auto sampling : {scene::Sampling::bilinear, scene::Sampling::nearest}) {
        GlowingScene world;
        const auto texture =
            make_texture(&world.scene.memory, {7, 5, Wrap::repeat, Wrap::mirror, sampling});
        world.add_quad({-9, -9, -5}, {9, -9, -5}, {9, 9, -6}, {-9, 9, -6}, world.glow(texture));
        EXPECT_EQ(test::take_picture(world, {}, frame_of(TextureFilter::mipmaps)).pixels,
                  test::take_picture(world, {}, frame_of(TextureFilter::finest)).pixels);
    }
}

TEST(Mipmaps, FadeToTheMeanFarAway) {
    GlowingScene world;
    const auto texture = make_texture(&world.scene.memory, {64, 16});
    const Texture mean = level_of(*texture, texture->level_count - 1, &world.scene.memory);
    world.add_quad({-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}, world.glow(texture));
    const test::Picture picture =
        test::take_picture(world, distant_camera(32, 4), frame_of(TextureFilter::mipmaps, 4, 4));
    const Vec3 error = glm::abs(picture.at(1, 1) - Vec3(scene::sample(mean, {0, 0})));
    EXPECT_LT(std::max({error.x, error.y, error.z}), 0.05f);
}

// What a ray is given does not depend on the rays beside it.
TEST(Mipmaps, AreTheSameForARayAloneAndInABatch) {
    for (const base::Isa isa : {base::Isa::scalar, base::Isa::best}) {
        GlowingScene world(1, isa);
        const auto texture = make_texture(&world.scene.memory, {64, 48});
        const base::Handle material = world.glow(texture);
        for (float z = -2; z > -40; z -= 1.5f)
            world.add_triangle({-3 - z, -1.1f, z}, {z, -1 - 0.02f * z, z}, {1, -1, 3 * z},
                               material);
        const auto mesh = world.make_mesh(material);
        mesh.data->positions = {{-40, -1, 0}, {40, -1, 0}, {40, -1, -90}, {-40, -1, -90}};
        mesh.surface->texcoords = {{0, 0}, {30, 0}, {30, 44}, {0, 44}};
        mesh.surface->triangles = {{0, 1, 2}, {0, 2, 3}};
        world.scene.meshes.insert({mesh.data});
        world.scene.commit({});
        const scene::SnapshotStore::Pin pin(world.scene.snapshots);
        Frame frame = frame_of(TextureFilter::mipmaps, 32, 32);
        frame.pixels = &frame;
        base::Vector<shade::PreparedLight> lights(&world.scene.memory);
        const Plan plan(*pin.get(), {}, frame, lights, nullptr);
        const auto buffers = std::make_unique<TileBuffers>();
        begin_primary_rays(plan, *buffers);
        buffers->tile.place(0, 32, 32);
        trace_primary_rays(plan, *buffers);
        const auto alone = std::make_unique<shade::Scratch>();
        buffers->for_each_batch([&](const shade::RayHits& hits, uint32_t) {
            plan.shader.find_surfaces(hits, shade::SurfacePart::all, buffers->scratch);
            for (uint32_t i = 0; i < hits.count; ++i) {
                const shade::RayHits one = {
                    {hits.direction[0] + i, hits.direction[1] + i, hits.direction[2] + i},
                    hits.u + i,
                    hits.v + i,
                    hits.triangle + i,
                    hits.back_face + i,
                    hits.t + i,
                    1,
                    hits.footprint};
                plan.shader.find_surfaces(one, shade::SurfacePart::all, *alone);
                for (int k = 0; k < 3; ++k)
                    ASSERT_EQ(alone->surface.emissive[k][0],
                              buffers->scratch.surface.emissive[k][i]);
            }
        });
    }
}

// Slivers, coordinates that run away, and triangles that a ray all but grazes.
TEST(Mipmaps, AreSafeForAnyFootprint) {
    constexpr float kHuge = 1e30f;
    for (const float far : {1e-30f, 1.0f, 1e4f, 1e15f, kHuge, -kHuge}) {
        GlowingScene world;
        const base::Handle material = world.glow(make_texture(&world.scene.memory, {9, 1}));
        const auto mesh = world.make_mesh(material);
        mesh.data->positions = {{-9, -9, -5},      {9, -9, -5},      {0, 9, -5},
                                {-9, -1e-6f, -1},  {9, -1e-6f, -1},  {0, -1e-6f, -1e9f},
                                {-1e-20f, 0, -1},  {1e-20f, 0, -1},  {0, 1e-20f, -1},
                                {-1e9f, 1, -1e9f}, {1e9f, 1, -1e9f}, {0, 1e9f, -1e9f}};
        for (uint32_t i = 0; i < 12; ++i)
            mesh.surface->texcoords.push_back({float(i % 3) * far, float(i % 2) * -far});
        mesh.surface->triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}};
        world.scene.meshes.insert({mesh.data});
        const test::Picture picture =
            test::take_picture(world, {}, frame_of(TextureFilter::mipmaps, 65, 65));
        for (const float value : picture.pixels) ASSERT_TRUE(value >= 0 && value <= 1.001f) << far;
    }
}

} // namespace
} // namespace peregrine::render
