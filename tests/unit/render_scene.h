#pragma once

#include "render/frame.h"
#include "scene/scene.h"

#include <cstring>
#include <memory>
#include <vector>

namespace peregrine::test {

// Shows one colour, whatever the light is.
inline scene::Material glowing(const math::Vec3& color) {
    scene::Material material;
    material.base_color = {0, 0, 0, 1};
    material.emissive = color;
    material.double_sided = true;
    return material;
}

// A small scene for tests of frames, and frames of it.
class RenderScene {
public:
    explicit RenderScene(uint32_t threads = 1, base::Isa isa = base::Isa::best)
        : scene(scene::SceneOptions{{}, {}, threads, isa}) {
        scene.environment.ambient = math::Vec3(0);
    }

    base::Handle add(const scene::Material& material, base::Handle base_color_texture = {},
                     base::Handle normal_texture = {}, base::Handle emissive_texture = {}) {
        return scene.materials.insert(
            {material, base_color_texture, normal_texture, emissive_texture});
    }

    // Linear texels, 4 a pixel.
    base::Handle add_texture(uint32_t width, uint32_t height, const std::vector<float>& texels) {
        auto texture = std::make_shared<scene::Texture>(&scene.memory);
        texture->width = width;
        texture->height = height;
        texture->storage = scene::Texture::Storage::float32;
        texture->sampling = scene::Sampling::nearest;
        texture->texels.resize(texels.size() * sizeof(float));
        std::memcpy(texture->texels.data(), texels.data(), texture->texels.size());
        return scene.textures.insert(texture);
    }

    // A mesh that is still to be filled.
    struct OpenMesh {
        std::shared_ptr<scene::MeshSurface> surface;
        std::shared_ptr<scene::MeshData> data;
    };
    OpenMesh make_mesh(base::Handle material) {
        const auto surface = std::make_shared<scene::MeshSurface>(&scene.memory);
        surface->material = {material.index, material.generation};
        return {surface, std::make_shared<scene::MeshData>(surface, &scene.memory)};
    }

    // Corners counter-clockwise; texture coordinates (0,0), (1,0), (1,1), (0,1).
    void add_quad(const math::Vec3& a, const math::Vec3& b, const math::Vec3& c,
                  const math::Vec3& d, base::Handle material) {
        const auto mesh = make_mesh(material);
        mesh.data->positions = {a, b, c, d};
        mesh.surface->texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        mesh.surface->triangles = {{0, 1, 2}, {0, 2, 3}};
        scene.meshes.insert({mesh.data});
    }

    void add_triangle(const math::Vec3& a, const math::Vec3& b, const math::Vec3& c,
                      base::Handle material) {
        const auto mesh = make_mesh(material);
        mesh.data->positions = {a, b, c};
        mesh.surface->triangles = {{0, 1, 2}};
        scene.meshes.insert({mesh.data});
    }

    void add(const scene::Light& light) { scene.lights.insert(light); }

    scene::Scene scene;
};

// A frame of linear floats, as most tests want to look at it.
struct Picture {
    uint32_t width, height;
    std::vector<float> pixels;
    render::FrameStats stats;

    math::Vec3 at(uint32_t x, uint32_t y) const {
        const float* p = &pixels[(size_t(y) * width + x) * 4];
        return {p[0], p[1], p[2]};
    }
};

inline render::Frame float_frame(uint32_t width, uint32_t height) {
    render::Frame frame;
    frame.format = render::PixelFormat::rgba32f;
    frame.tone_mapping = render::ToneMapping::none;
    frame.width = width;
    frame.height = height;
    frame.row_stride = width * uint64_t(16);
    return frame;
}

// Commits and renders.
inline Picture take_picture(RenderScene& world, const render::Camera& camera, render::Frame frame) {
    world.scene.commit({});
    const scene::SnapshotStore::Pin pin(world.scene.snapshots);
    Picture picture{frame.width, frame.height, {}, {}};
    picture.pixels.assign(size_t(frame.width) * frame.height * 4, -1.0f);
    frame.pixels = picture.pixels.data();
    render::render_frame(*pin.get(), camera, frame, world.scene.scheduler, &world.scene.memory,
                         &picture.stats);
    return picture;
}

inline Picture take_picture(RenderScene& world, const render::Camera& camera, uint32_t width = 64,
                            uint32_t height = 64) {
    return take_picture(world, camera, float_frame(width, height));
}

} // namespace peregrine::test
