// Scenes whose ground a program of the host shades, and frames of them.
#pragma once

#include "support.h"

namespace peregrine::test {

inline constexpr uint32_t kAll = (1u << 17) - 1;
inline constexpr uint32_t kWidth = 61, kHeight = 47;

struct ProgramFrame {
    std::vector<float> pixels;
    rt_frame_stats stats = rt_default_frame_stats();

    // A pixel to the left of the lift.
    const float* on_ground() const { return &pixels[4 * (size_t(kWidth) * 26 + 18)]; }
};

inline ProgramFrame render_radiance(rt_scene scene, rt_frame_desc desc = rt_default_frame_desc(),
                                    const rt_camera& camera = world_camera()) {
    ProgramFrame frame;
    frame.pixels.resize(size_t(kWidth) * kHeight * 4);
    desc.format = RT_FORMAT_RGBA32F;
    desc.tone_mapping = RT_TONE_NONE;
    desc.pixels = frame.pixels.data();
    desc.width = kWidth;
    desc.height = kHeight;
    EXPECT_OK(rt_render_frame(scene, &camera, &desc, &frame.stats));
    return frame;
}

inline rt_program add_program(rt_scene scene, uint32_t fields, rt_program_function shade,
                              void* user = nullptr) {
    rt_program_desc desc = rt_default_program_desc();
    desc.fields = fields;
    desc.shade = shade;
    desc.user = user;
    rt_program program{};
    EXPECT_OK(rt_add_program(scene, &desc, &program));
    return program;
}

inline rt_material_desc shaded_by(rt_program program) {
    rt_material_desc desc = rt_default_material_desc();
    desc.base_color[2] = 0.25f;
    desc.specular[0] = desc.specular[1] = 0.1f;
    desc.emissive[0] = 0.25f;
    desc.double_sided = 1;
    desc.user_data = 7;
    desc.program = program;
    return desc;
}

// The ground gets the material; the lift stays what it was.
inline void cover_ground(const World& world, const rt_material_desc& desc) {
    ASSERT_OK(rt_update_material(world.scene, world.material, &desc));
    ASSERT_OK(rt_commit_scene(world.scene, nullptr, nullptr));
}

} // namespace peregrine::test
