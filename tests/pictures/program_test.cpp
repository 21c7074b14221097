// What programs of the host shade, bit for bit.
#include "program_scene.h"
#include "variants.h"

namespace peregrine::test {
namespace {

class ProgramPictures : public Pictures {};

TEST_P(ProgramPictures, AmongMirrorsAndGlass) {
    const ProgramScene scene(*stage_, {});
    commit();
    rt_frame_desc frame = frame_of(320, 180);
    frame.texture_filter = RT_TEXTURE_MIPMAPS;
    expect("program", scene.camera(), frame);
    frame = frame_of(161, 91);
    frame.max_depth = 0;
    expect("program_alone", scene.camera(), frame);
}

TEST_P(ProgramPictures, Approximated) {
    if (GetParam().proofs) GTEST_SKIP() << "which lamps are compared depends on what was proved";
    const ProgramScene scene(*stage_, {12345678.25, 1500.5, -7654321.75});
    rt_fog fog = rt_default_fog();
    fog.top = 1502;
    fog.bottom = 1500.5;
    stage_->check(stage_->api().set_fog(stage_->scene(), &fog), "setting the fog");
    commit();
    rt_frame_desc frame = frame_of(161, 91);
    frame.light_block = 8;
    frame.edge_samples = 4;
    frame.occlusion_range = 1;
    frame.bloom = 0.3f;
    expect("program_direct", scene.camera(), frame);
}

INSTANTIATE_TEST_SUITE_P(By, ProgramPictures, all_variants(),
                         [](const auto& info) { return std::string(info.param.name); });

} // namespace
} // namespace peregrine::test
