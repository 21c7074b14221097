// Mirrors and glass, bit for bit.
#include "glass_scene.h"
#include "variants.h"

namespace peregrine::test {
namespace {

class GlassPictures : public Pictures {};

TEST_P(GlassPictures, OfEachKind) {
    const GlassScene scene(*stage_, {});
    commit();
    expect("glass", scene.camera(), frame_of(320, 180));
    expect("glass_within", scene.camera_in_the_die(), frame_of(120, 68));
    rt_frame_desc frame = frame_of(161, 91);
    frame.texture_filter = RT_TEXTURE_MIPMAPS;
    frame.max_depth = 8;
    frame.least_importance = 0;
    expect("glass_deep", scene.camera(), frame);
    frame.max_depth = 0;
    expect("glass_matt", scene.camera(), frame);
}

// The lamps' light through the window, the ball, the die and the veil.
TEST_P(GlassPictures, InTintedShadows) {
    GlassScene scene(*stage_, {});
    scene.shine_through();
    commit();
    rt_frame_desc frame = frame_of(320, 180);
    frame.tinted_shadows = 1;
    expect("tinted", scene.camera(), frame);
    frame = frame_of(161, 91);
    frame.tinted_shadows = 1;
    frame.max_depth = 0;
    frame.edge_samples = 4;
    if (!GetParam().proofs) frame.light_block = 8;
    expect(GetParam().proofs ? "tinted_edges" : "tinted_blocks", scene.camera(), frame);
}

TEST_P(GlassPictures, Approximated) {
    if (GetParam().proofs) GTEST_SKIP() << "which lamps are compared depends on what was proved";
    const GlassScene scene(*stage_, {});
    commit();
    rt_frame_desc frame = frame_of(161, 91);
    frame.light_block = 8;
    frame.edge_samples = 4;
    frame.render_width = 121;
    expect("glass_direct", scene.camera(), frame);
    frame = frame_of(161, 91);
    frame.occlusion_range = 2;
    expect("glass_occlusion", scene.camera(), frame);
}

TEST_P(GlassPictures, UnderASkyThatIsAnImage) {
    GlassScene scene(*stage_, {});
    scene.change_sky();
    commit();
    expect("glass_sky", scene.camera(), frame_of(160, 90));
    rt_frame_desc frame = frame_of(121, 67);
    frame.max_depth = 0;
    frame.texture_filter = RT_TEXTURE_MIPMAPS;
    expect("glass_sky_alone", scene.camera_at_the_sky(), frame);
}

TEST_P(GlassPictures, FarAwayAndMoved) {
    GlassScene scene(*stage_, {12345678.25, 1500.5, -7654321.75});
    commit();
    scene.move();
    commit();
    expect("glass_far_away_moved", scene.camera(), frame_of(160, 90));
}

INSTANTIATE_TEST_SUITE_P(By, GlassPictures, all_variants(),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(GlassOfStructures, IsTheSame) {
    for (const auto& [name, structure] :
         {std::pair{"kdtree", RT_STRUCTURE_KDTREE}, std::pair{"bih", RT_STRUCTURE_BIH}}) {
        host::Stage stage(*rt_get_api(RT_API_VERSION), 2, RT_ISA_BEST);
        const GlassScene scene(stage, {});
        rt_commit_desc commit = rt_default_commit_desc();
        commit.structure = structure;
        stage.check(stage.api().commit_scene(stage.scene(), &commit, nullptr), "building");
        expect_pixels("glass", name, stage, scene.camera(), frame_of(320, 180));
    }
}

} // namespace
} // namespace peregrine::test
