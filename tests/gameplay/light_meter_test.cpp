// What is lit in the picture is lit for the drones: the meter reads what frames show.
#include "gameplay/three_cores/light_meter.h"
#include "support/arena.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace peregrine::test {
namespace {

using three_cores::Lamp;
using three_cores::LightMeter;

class Meter : public testing::Test {
protected:
    Meter() { arena_.add_floor(40); }

    // Lux of light from above at the origin, as a frame has it.
    double lux_of_picture(const Lamp& lamp) {
        const rt_api& api = *rt_get_api(RT_API_VERSION);
        rt_light_desc desc = rt_default_light_desc();
        desc.type = lamp.kind == Lamp::Kind::point  ? RT_LIGHT_POINT
                    : lamp.kind == Lamp::Kind::spot ? RT_LIGHT_SPOT
                                                    : RT_LIGHT_DIRECTIONAL;
        for (int k = 0; k < 3; ++k) {
            desc.position[k] = lamp.position[k];
            desc.direction[k] = float(lamp.direction[k]);
            desc.intensity[k] = float(lamp.candela);
        }
        desc.radius = float(lamp.radius);
        desc.cone_inner_cos = float(lamp.cos_inner), desc.cone_outer_cos = float(lamp.cos_outer);
        rt_environment dark = rt_default_environment();
        for (float& part : dark.ambient) part = 0;
        rt_light light{};
        EXPECT_EQ(api.set_environment(arena_.scene(), &dark), RT_OK);
        EXPECT_EQ(api.add_light(arena_.scene(), &desc, &light), RT_OK);
        arena_.commit();
        rt_camera camera = rt_default_camera();
        camera.position[1] = 1;
        camera.forward[1] = -1, camera.forward[2] = 0;
        camera.up[1] = 0, camera.up[2] = -1;
        camera.vertical_fov = 0.01f;
        float pixel[4] = {};
        rt_frame_desc frame = rt_default_frame_desc();
        frame.format = RT_FORMAT_RGBA32F;
        frame.tone_mapping = RT_TONE_NONE;
        frame.pixels = pixel;
        frame.width = frame.height = 1;
        EXPECT_EQ(api.render_frame(arena_.scene(), &camera, &frame, nullptr), RT_OK);
        EXPECT_EQ(api.remove_light(arena_.scene(), light), RT_OK);
        arena_.commit();
        return double(pixel[0]) * 3.14159265358979;
    }

    // What the meter says to light of so many lux.
    double reading_of(double lux) {
        Lamp sun;
        sun.kind = Lamp::Kind::sun;
        sun.candela = lux;
        return read(sun);
    }

    double read(const Lamp& lamp) {
        LightMeter meter(std::span(&lamp, 1));
        return meter.measure(arena_.world(), {0, 1e-4, 0}, {});
    }

    Arena arena_;
};

TEST_F(Meter, ReadsWhatFramesShow) {
    for (const Lamp::Kind kind : {Lamp::Kind::point, Lamp::Kind::spot})
        for (const double radius : {6.0, 14.0, std::numeric_limits<double>::infinity()})
            for (const double height : {0.5, 2.0, 5.0, 5.9, 8.0, 30.0})
                for (const double cosine : {1.0, 0.95, 0.85, 0.72}) {
                    const double sine = std::sqrt(1 - cosine * cosine);
                    const Lamp lamp{kind, {0, height, 0}, {sine, -cosine, 0}, radius, 9, 0.9, 0.7};
                    EXPECT_NEAR(read(lamp), reading_of(lux_of_picture(lamp)), 2e-3)
                        << radius << " " << height << " " << cosine;
                }
}

} // namespace
} // namespace peregrine::test
