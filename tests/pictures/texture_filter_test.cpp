// What filtering textures by the footprint of a pixel gives: frames that are nearer to the truth,
// which is here the mean of 16 rays a pixel, each with textures at their finest level.
#include "support/flip.h"

#include "camera.h"
#include "cameras.h"
#include "gltf/import.h"
#include "upload.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace peregrine::test {
namespace {

constexpr uint32_t kWidth = 320, kHeight = 180, kSide = 4;

struct Image {
    uint32_t width, height;
    std::vector<uint8_t> bytes; // RGBA, sRGB
};

// Without shadows, which filtering does not touch.
Image render(const host::Stage& stage, const host::Viewpoint& view, uint32_t scale,
             rt_texture_filter filter) {
    Image image{scale * kWidth, scale * kHeight, {}};
    image.bytes.resize(size_t(image.width) * image.height * 4);
    rt_frame_desc frame = rt_default_frame_desc();
    frame.width = image.width;
    frame.height = image.height;
    frame.pixels = image.bytes.data();
    frame.no_shadows = 1;
    frame.texture_filter = filter;
    const rt_camera camera = host::camera_of(view);
    stage.check(stage.api().render_frame(stage.scene(), &camera, &frame, nullptr), "rendering");
    return image;
}

double to_linear(uint8_t byte) {
    const double x = byte / 255.0;
    return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

uint8_t to_srgb(double x) {
    const double y = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    return uint8_t(255 * y + 0.5);
}

// Squares of kSide pixels as one.
Image shrink(const Image& large) {
    Image small{kWidth, kHeight, std::vector<uint8_t>(size_t(kWidth) * kHeight * 4, 255)};
    for (uint32_t y = 0; y < kHeight; ++y)
        for (uint32_t x = 0; x < kWidth; ++x)
            for (uint32_t k = 0; k < 3; ++k) {
                double sum = 0;
                for (uint32_t j = 0; j < kSide; ++j)
                    for (uint32_t i = 0; i < kSide; ++i) {
                        const size_t at =
                            (size_t(y) * kSide + j) * large.width + size_t(x) * kSide + i;
                        sum += to_linear(large.bytes[4 * at + k]);
                    }
                small.bytes[(size_t(y) * kWidth + x) * 4 + k] = to_srgb(sum / (kSide * kSide));
            }
    return small;
}

double error(const Image& truth, const Image& found) {
    return flip(truth.bytes.data(), found.bytes.data(), kWidth, kHeight).mean();
}

TEST(TextureFilter, ByFootprintIsNearerToTheTruth) {
    const host::Level level = host::gltf::import_file(PEREGRINE_CONTENT "/hall.glb");
    host::Stage stage(*rt_get_api(RT_API_VERSION), 1, RT_ISA_BEST);
    host::upload_level(stage, level, 0.1f);
    stage.check(stage.api().commit_scene(stage.scene(), nullptr, nullptr), "building");
    for (const char* name : {"cam_hero", "cam_library", "cam_courtyard"}) {
        const host::Viewpoint& view = level.cameras[host::find_camera(level.cameras, name)];
        const Image truth = shrink(render(stage, view, kSide, RT_TEXTURE_FINEST));
        const double finest = error(truth, render(stage, view, 1, RT_TEXTURE_FINEST));
        const double filtered = error(truth, render(stage, view, 1, RT_TEXTURE_MIPMAPS));
        RecordProperty(std::string(name) + "_finest", std::to_string(finest));
        RecordProperty(std::string(name) + "_mipmaps", std::to_string(filtered));
        EXPECT_LT(filtered, 0.9 * finest) << name;
    }
}

} // namespace
} // namespace peregrine::test
