#include "variants.h"

#include "support/frame_look.h"

namespace peregrine::test {
namespace {

// Those that this processor may have.
constexpr Variant kVariants[] = {
    {"scalar", RT_ISA_SCALAR, 1},
    {"scalar_3_threads", RT_ISA_SCALAR, 3},
    {"scalar_proved", RT_ISA_SCALAR, 1, true},
#if defined(__aarch64__)
    {"neon", RT_ISA_NEON, 1},
    {"neon_3_threads", RT_ISA_NEON, 3},
    {"neon_proved", RT_ISA_NEON, 1, true},
#else
    {"sse4", RT_ISA_SSE4, 1},
    {"sse4_3_threads", RT_ISA_SSE4, 3},
    {"sse4_proved", RT_ISA_SSE4, 1, true},
    {"avx2", RT_ISA_AVX2, 1},
    {"avx2_3_threads", RT_ISA_AVX2, 3},
    {"avx2_proved", RT_ISA_AVX2, 3, true},
    {"avx512", RT_ISA_AVX512, 1},
    {"avx512_3_threads", RT_ISA_AVX512, 3},
    {"avx512_proved", RT_ISA_AVX512, 1, true},
#endif
};

bool machine_has(rt_isa isa) {
    rt_scene_desc desc = rt_default_scene_desc();
    desc.isa = isa;
    rt_scene scene;
    if (rt_create_scene(&desc, &scene) != RT_OK) return false;
    rt_destroy_scene(scene);
    return true;
}

} // namespace

void PrintTo(const Variant& variant, std::ostream* out) {
    *out << variant.name;
}

testing::internal::ParamGenerator<Variant> all_variants() {
    return testing::ValuesIn(kVariants);
}

rt_frame_desc frame_of(uint32_t width, uint32_t height, rt_pixel_format format) {
    rt_frame_desc frame = rt_default_frame_desc();
    frame.width = width;
    frame.height = height;
    frame.format = format;
    set_options(Look::exact, frame);
    return frame;
}

Picture blank(const rt_frame_desc& frame, uint32_t units) {
    const size_t bytes = size_t(frame.width) * frame.height * units * 4;
    return {frame.width, frame.height, units, std::vector<uint8_t>(bytes, 0xcd)};
}

void render(const host::Stage& stage, const rt_camera& camera, const rt_frame_desc& frame) {
    stage.check(stage.api().render_frame(stage.scene(), &camera, &frame, nullptr),
                "rendering a frame");
}

void expect_pixels(const std::string& name, const std::string& how, const host::Stage& stage,
                   const rt_camera& camera, rt_frame_desc frame) {
    Picture picture = blank(frame, frame.format == RT_FORMAT_RGBA32F   ? 4
                                   : frame.format == RT_FORMAT_RGBA16F ? 2
                                                                       : 1);
    frame.pixels = picture.bytes.data();
    render(stage, camera, frame);
    expect_golden(name, how, picture);
}

void Pictures::SetUp() {
    if (!machine_has(GetParam().isa)) GTEST_SKIP() << "this machine has no " << how();
    stage_ = std::make_unique<host::Stage>(*rt_get_api(RT_API_VERSION), GetParam().threads,
                                           GetParam().isa);
}

} // namespace peregrine::test
