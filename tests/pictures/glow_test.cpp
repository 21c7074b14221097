// What lies in the air and over a picture, bit for bit: fog, bloom.
#include "feature_scene.h"
#include "glass_scene.h"
#include "variants.h"

namespace peregrine::test {
namespace {

class GlowPictures : public Pictures {
protected:
    void set_fog(float density, double bottom, double top) {
        rt_fog fog = rt_default_fog();
        fog.density = density;
        fog.bottom = bottom;
        fog.top = top;
        fog.color[2] = 0.3f;
        stage_->check(stage_->api().set_fog(stage_->scene(), &fog), "setting the fog");
    }
};

TEST_P(GlowPictures, Bloom) {
    const FeatureScene scene(*stage_, {});
    commit();
    rt_frame_desc frame = frame_of(321, 179);
    frame.bloom = 0.4f;
    frame.bloom_threshold = 0.6f;
    frame.bloom_radius = 0.3f;
    expect("bloom", scene.camera(), frame);
    frame = frame_of(96, 54, RT_FORMAT_RGBA32F);
    frame.tone_mapping = RT_TONE_NONE;
    frame.bloom = 0.8f;
    frame.exposure = 3;
    expect("bloom_float", scene.camera(), frame);
}

TEST_P(GlowPictures, BloomOfEdgesAndEnlarged) {
    const FeatureScene scene(*stage_, {});
    commit();
    rt_frame_desc frame = frame_of(161, 91);
    frame.bloom = 0.4f;
    frame.bloom_threshold = 0.5f;
    frame.edge_samples = 4;
    expect("bloom_edges", scene.camera(), frame);
    frame.render_width = 111;
    frame.render_height = 65;
    expect("bloom_enlarged", scene.camera(), frame);
}

TEST_P(GlowPictures, Fog) {
    const FeatureScene scene(*stage_, {});
    set_fog(0.3f, 0, 1.5);
    commit();
    expect("fog", scene.camera(), frame_of(161, 91));
    rt_frame_desc frame = frame_of(97, 55);
    frame.edge_samples = 4;
    frame.light_block = 8;
    if (!GetParam().proofs) expect("fog_direct", scene.camera_from_the_side(), frame);
}

TEST_P(GlowPictures, FogAmongGlass) {
    const GlassScene scene(*stage_, {});
    set_fog(0.35f, 0.2, 1.2);
    commit();
    expect("fog_glass", scene.camera(), frame_of(161, 91));
    expect("fog_within", scene.camera_in_the_die(), frame_of(80, 45));
}

INSTANTIATE_TEST_SUITE_P(By, GlowPictures, all_variants(),
                         [](const auto& info) { return std::string(info.param.name); });

} // namespace
} // namespace peregrine::test
