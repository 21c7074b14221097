// What lies over a picture, bit for bit: bloom.
#include "feature_scene.h"
#include "variants.h"

namespace peregrine::test {
namespace {

class GlowPictures : public Pictures {};

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

INSTANTIATE_TEST_SUITE_P(By, GlowPictures, all_variants(),
                         [](const auto& info) { return std::string(info.param.name); });

} // namespace
} // namespace peregrine::test
