// Textures and their levels through the door.
#include "support.h"

#include <vector>

namespace peregrine::test {
namespace {

uint64_t texture_bytes(rt_scene scene) {
    rt_commit_report report = rt_default_commit_report();
    EXPECT_OK(rt_commit_scene(scene, nullptr, &report));
    return report.bytes_textures;
}

TEST(Textures, CountTheBytesOfTheirLevels) {
    WorldGuard world;
    const rt_scene scene = world->scene;
    const uint64_t before = texture_bytes(scene);
    const std::vector<float> pixels(64 * 4 * 4, 0.5f);
    rt_texture_desc desc = rt_default_texture_desc();
    desc.pixels = pixels.data();
    desc.width = 7;
    desc.height = 5;
    rt_texture bytes{}, floats{};
    ASSERT_OK(rt_add_texture(scene, &desc, &bytes));
    desc.format = RT_FORMAT_RGBA32F;
    desc.width = 64;
    desc.height = 4;
    ASSERT_OK(rt_add_texture(scene, &desc, &floats));
    for (const rt_texture texture : {bytes, floats}) {
        rt_material_desc material = rt_default_material_desc();
        material.base_color_texture.texture = texture;
        rt_material out{};
        ASSERT_OK(rt_add_material(scene, &material, &out));
    }
    const uint64_t texels = 7 * 5 + 3 * 2 + 1 * 1;
    const uint64_t float_texels = 64 * 4 + 32 * 2 + 16 + 8 + 4 + 2 + 1;
    EXPECT_EQ(texture_bytes(scene) - before, texels * 8 + float_texels * 16);
}

// A program that was compiled before the field existed passes a shorter struct.
TEST(Textures, AreFilteredByDefaultAndNotForOldPrograms) {
    EXPECT_EQ(rt_default_frame_desc().texture_filter, RT_TEXTURE_MIPMAPS);
    WorldGuard world;
    const rt_camera camera = world_camera();
    Bytes pixels[3];
    for (int i = 0; i < 3; ++i) {
        pixels[i].resize(64 * 64 * 4);
        rt_frame_desc frame = rt_default_frame_desc();
        frame.width = frame.height = 64;
        frame.pixels = pixels[i].data();
        if (i == 1) frame.texture_filter = RT_TEXTURE_FINEST;
        if (i == 2) frame.struct_size = offsetof(rt_frame_desc, light_block);
        ASSERT_OK(rt_render_frame(world->scene, &camera, &frame, nullptr));
    }
    EXPECT_EQ(pixels[1], pixels[2]);
}

} // namespace
} // namespace peregrine::test
