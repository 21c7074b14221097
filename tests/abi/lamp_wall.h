// A white wall and what one lamp gives it, by way of frames.
#pragma once

#include "support.h"

#include <cmath>
#include <limits>
#include <memory>

namespace peregrine::test {

// The square |x|, |y| <= half in the plane z = 0, and a speck far behind it or before it: where
// the speck lies behind the lamp as seen from the wall, shadow rays run from the lamp.
class LampWall {
public:
    explicit LampWall(float half, float speck_z = 0, rt_isa isa = RT_ISA_BEST) : half_(half) {
        rt_scene_desc desc = rt_default_scene_desc();
        desc.isa = isa;
        supported_ = rt_create_scene(&desc, &scene_) != RT_ERROR_UNSUPPORTED;
        if (!supported_) return;
        const float s = 1e-3f * half, z = speck_z;
        const std::vector<float> corners = {-half, -half, 0,     half, -half, 0,  half,
                                            half,  0,     -half, half, 0,     s,  s,
                                            z,     -s,    s,     z,    0,     -s, z};
        const std::vector<uint16_t> indices = {0, 1, 2, 0, 2, 3, 4, 5, 6};
        rt_mesh_desc wall = rt_default_mesh_desc();
        wall.positions = array_of(corners, 7);
        wall.index_type = RT_INDEX_UINT16;
        wall.indices = array_of(indices, speck_z != 0 ? 9 : 6);
        rt_mesh mesh{};
        EXPECT_OK(rt_add_static_mesh(scene_, &wall, &mesh));
        set_ambient(0);
    }
    ~LampWall() {
        if (supported_) EXPECT_OK(rt_destroy_scene(scene_));
    }
    LampWall(const LampWall&) = delete;
    LampWall& operator=(const LampWall&) = delete;

    bool is_supported() const { return supported_; } // the instruction set, by this machine
    rt_scene scene() const { return scene_; }

    void set_ambient(float radiance) {
        rt_environment environment = rt_default_environment();
        for (float& part : environment.ambient) part = radiance;
        EXPECT_OK(rt_set_environment(scene_, &environment));
    }

    // Linear radiance, 4 floats a pixel, of a square around the wall's middle.
    std::vector<float> picture(double distance, uint32_t size, float vertical_fov) const {
        EXPECT_OK(rt_commit_scene(scene_, nullptr, nullptr));
        rt_camera camera = rt_default_camera();
        camera.position[2] = distance;
        camera.vertical_fov = vertical_fov;
        std::vector<float> pixels(size_t(4) * size * size, -1.0f);
        rt_frame_desc frame = rt_default_frame_desc();
        frame.format = RT_FORMAT_RGBA32F;
        frame.tone_mapping = RT_TONE_NONE;
        frame.pixels = pixels.data();
        frame.width = frame.height = size;
        EXPECT_OK(rt_render_frame(scene_, &camera, &frame, nullptr));
        return pixels;
    }

    // The red illuminance of the wall's middle with this lamp alone.
    double lux(const rt_light_desc& lamp) const {
        rt_light light{};
        EXPECT_OK(rt_add_light(scene_, &lamp, &light));
        const double radiance = double(picture(0.5 * double(half_), 1, 0.01f)[0]);
        EXPECT_OK(rt_remove_light(scene_, light));
        return radiance * 3.14159265358979324;
    }

private:
    float half_;
    rt_scene scene_{};
    bool supported_ = true;
};

inline rt_light_desc lamp_at(double z, float candela, float radius) {
    rt_light_desc lamp = rt_default_light_desc();
    lamp.position[2] = z;
    lamp.direction[0] = lamp.direction[1] = 0;
    lamp.direction[2] = -1;
    lamp.radius = radius;
    for (float& part : lamp.intensity) part = candela;
    return lamp;
}

} // namespace peregrine::test
