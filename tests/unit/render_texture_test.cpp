#include "render_scene.h"
#include "scene/texture_sampling.h"
#include "trace/world/single.h"

#include <cstring>

#include <gtest/gtest.h>

namespace peregrine::render {
namespace {

using math::Vec2;
using math::Vec3;
using scene::Sampling;
using scene::Texture;
using scene::Wrap;

std::shared_ptr<Texture> make_texture(test::RenderScene& world, Wrap wrap_u, Wrap wrap_v,
                                      Sampling sampling, Texture::Storage storage) {
    auto texture = std::make_shared<Texture>(&world.scene.memory);
    texture->width = 7;
    texture->height = 5;
    texture->wrap_u = wrap_u;
    texture->wrap_v = wrap_v;
    texture->sampling = sampling;
    texture->storage = storage;
    for (uint32_t i = 0; i < 7 * 5 * 4; ++i) {
        const auto fixed = uint16_t(i * 40503u);
        const float number = float(i % 13) * 0.37f;
        const bool floats = storage == Texture::Storage::float32;
        const size_t size = floats ? sizeof number : sizeof fixed, at = texture->texels.size();
        texture->texels.resize(at + size);
        std::memcpy(texture->texels.data() + at,
                    floats ? static_cast<const void*>(&number) : &fixed, size);
    }
    return texture;
}

// A glowing wall under every pixel shows the bits of scene::sample at its texture coordinates,
// which go far beyond [0, 1] and are turned by the material.
void expect_same_as_sample(Wrap wrap_u, Wrap wrap_v, Sampling sampling, Texture::Storage storage) {
    test::RenderScene world;
    const auto texture = make_texture(world, wrap_u, wrap_v, sampling, storage);
    scene::Material material;
    material.base_color = {0, 0, 0, 1};
    material.emissive = Vec3(1);
    material.emissive_texture.row_u = {3, 0.5f, -1.2f};
    material.emissive_texture.row_v = {-0.4f, -2.5f, 0.3f};
    world.add_quad({-9, -9, -5}, {9, -9, -5}, {9, 9, -6}, {-9, 9, -6},
                   world.add(material, {}, {}, world.scene.textures.insert(texture)));
    const test::Picture picture = test::take_picture(world, Camera{}, 61, 47);

    const scene::SnapshotStore::Pin pin(world.scene.snapshots);
    const scene::Snapshot& snapshot = *pin.get();
    const Vec2 corners[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const Pinhole pinhole(Camera{}, 61, 47);
    for (uint32_t y = 0; y < 47; ++y)
        for (uint32_t x = 0; x < 61; ++x) {
            const trace::Hit hit = trace::closest(snapshot.world, pinhole.primary(x, y), {});
            const auto& triangle = snapshot.world.fixed.target.infos[hit.triangle];
            const auto& vertices = snapshot.meshes[0].data->triangles()[triangle.primitive];
            Vec2 uv[3];
            for (uint32_t k = 0; k < 3; ++k)
                uv[k] = scene::transform(material.emissive_texture, corners[vertices[k]]);
            const float w = 1.0f - hit.u - hit.v;
            const Vec2 at = uv[0] * w + uv[1] * hit.u + uv[2] * hit.v;
            ASSERT_EQ(picture.at(x, y), Vec3(scene::sample(*texture, at))) << x << " " << y;
        }
}

TEST(Textures, ShowTheBitsOfTheirDefinition) {
    for (const Wrap u : {Wrap::repeat, Wrap::mirror, Wrap::clamp})
        for (const Wrap v : {Wrap::repeat, Wrap::mirror, Wrap::clamp})
            for (const Sampling sampling : {Sampling::bilinear, Sampling::nearest})
                for (const auto storage : {Texture::Storage::unorm16, Texture::Storage::float32})
                    expect_same_as_sample(u, v, sampling, storage);
}

TEST(Textures, UseTheSecondSetOfCoordinatesWhenAsked) {
    test::RenderScene world;
    const base::Handle texture = world.add_texture(2, 1, {1, 0, 0, 1, 0, 1, 0, 1});
    scene::Material material;
    material.base_color = {0, 0, 0, 1};
    material.emissive = Vec3(1);
    material.emissive_texture.texcoord_set = 1;
    const auto mesh = world.make_mesh(world.add(material, {}, {}, texture));
    mesh.data->positions = {{-9, -9, -5}, {9, -9, -5}, {0, 9, -5}};
    mesh.surface->texcoords = {{0.2f, 0}, {0.2f, 0}, {0.2f, 0}};
    mesh.surface->texcoords1 = {{0.8f, 0}, {0.8f, 0}, {0.8f, 0}};
    mesh.surface->triangles = {{0, 1, 2}};
    world.scene.meshes.insert({mesh.data});
    EXPECT_EQ(test::take_picture(world, Camera{}, 9, 9).at(4, 4), Vec3(0, 1, 0));
}

} // namespace
} // namespace peregrine::render
