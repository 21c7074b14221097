// What lies in the air and over a picture, bit for bit: fog, light in it, particles,
// bloom.
#include "feature_scene.h"
#include "glass_scene.h"
#include "variants.h"

#include <cmath>
#include <vector>

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

// A cloud of sparks over the middle of both scenes, some of them behind something.
std::vector<rt_particle> make_sparks(const glm::dvec3& origin) {
    std::vector<rt_particle> sparks;
    for (int i = 0; i < 700; ++i) {
        // Sums, products and square roots alone: the same on all machines.
        const auto fraction = [&](double step) { return i * step - std::floor(i * step); };
        const double x = 3 * fraction(0.618) - 1.5, y = 3 * fraction(0.7548), z = fraction(0.5698);
        sparks.push_back({{origin.x + x, origin.y + y, origin.z - 4.5 * z},
                          0.01f + 0.05f * float(fraction(0.33)),
                          {4, 1 + 2 * float(z), 0.4f}});
    }
    return sparks;
}

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

// A spot from above and a point among things, which all have shadows but the second spot.
void add_lamps_in_fog(host::Stage& stage, const glm::dvec3& origin) {
    const auto add = [&](rt_light_desc desc, const glm::dvec3& position) {
        for (int k = 0; k < 3; ++k) desc.position[k] = origin[k] + position[k];
        rt_light light;
        stage.check(stage.api().add_light(stage.scene(), &desc, &light), "adding a light");
    };
    const auto shine = [](rt_light_desc& desc, const glm::vec3& color, const glm::vec3& way) {
        for (int k = 0; k < 3; ++k) {
            desc.intensity[k] = color[k];
            desc.direction[k] = way[k];
        }
    };
    rt_light_desc lamp = rt_default_light_desc();
    lamp.radius = 5;
    lamp.fog_scatter = 0.75f;
    shine(lamp, {6, 5, 3}, {0, -1, 0});
    add(lamp, {1.4, 0.7, -3});
    lamp.type = RT_LIGHT_SPOT;
    lamp.radius = 8;
    lamp.cone_inner_cos = 0.95f;
    lamp.cone_outer_cos = 0.9f;
    shine(lamp, {30, 40, 60}, {0.3f, -1, -0.3f});
    add(lamp, {-0.5, 3.5, -2});
    lamp.casts_no_shadow = 1;
    lamp.falloff = RT_FALLOFF_COSINE_LINEAR;
    shine(lamp, {2, 40, 10}, {-1, 0.1f, -0.2f});
    add(lamp, {2.2, 1.1, -1.5});
}

TEST_P(GlowPictures, Airlight) {
    const FeatureScene scene(*stage_, {});
    set_fog(0.15f, 0.3, 2.5);
    add_lamps_in_fog(*stage_, {});
    commit();
    rt_frame_desc frame = frame_of(161, 91);
    expect("airlight", scene.camera(), frame);
    frame = frame_of(97, 55);
    frame.edge_samples = 4;
    frame.light_block = 8;
    frame.airlight_shadows = 0;
    if (!GetParam().proofs) expect("airlight_direct", scene.camera_from_the_side(), frame);
}

TEST_P(GlowPictures, AirlightAmongGlass) {
    const glm::dvec3 far_away(12345678.25, 1500.5, -7654321.75);
    const GlassScene scene(*stage_, far_away);
    set_fog(0.2f, far_away.y + 0.2, far_away.y + 2);
    add_lamps_in_fog(*stage_, far_away);
    commit();
    rt_frame_desc frame = frame_of(161, 91);
    frame.airlight_shadows = 5;
    frame.airlight_block = 2;
    expect("airlight_glass", scene.camera(), frame);
    expect("airlight_within", scene.camera_in_the_die(), frame_of(80, 45));
}

TEST_P(GlowPictures, Particles) {
    const glm::dvec3 far_away(12345678.25, 1500.5, -7654321.75);
    GlassScene scene(*stage_, far_away);
    set_fog(0.1f, far_away.y + 0.2, far_away.y + 1.2);
    commit();
    const std::vector<rt_particle> sparks = make_sparks(far_away);
    rt_frame_desc frame = frame_of(161, 91);
    frame.particles = {sparks.data(), sparks.size(), 0, 0};
    expect("particles", scene.camera(), frame);
    frame.bloom = 0.5f;
    frame.edge_samples = 3;
    expect("particles_bloom", scene.camera(), frame);
}

INSTANTIATE_TEST_SUITE_P(By, GlowPictures, all_variants(),
                         [](const auto& info) { return std::string(info.param.name); });

} // namespace
} // namespace peregrine::test
