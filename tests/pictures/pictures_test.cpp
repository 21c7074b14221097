// Frames that stay as they are, bit for bit: with every instruction set and number of threads.
#include "feature_scene.h"
#include "golden.h"
#include "variants.h"

#include "animation/player.h"
#include "camera.h"
#include "cameras.h"
#include "gltf/import.h"
#include "upload.h"

#include <cstring>
#include <string>

#include <gtest/gtest.h>

namespace peregrine::test {
namespace {

constexpr glm::dvec3 kFarAway(12345678.25, 1500.5, -7654321.75);

// With light in blocks.
rt_frame_desc direct_frame_of(uint32_t width, uint32_t height) {
    rt_frame_desc frame = rt_default_frame_desc();
    frame.light_block = 8;
    frame.light_tolerance = 0.03f;
    frame.width = width;
    frame.height = height;
    return frame;
}

// The planes by themselves.
void expect_planes(const std::string& name, const std::string& how, const host::Stage& stage,
                   const rt_camera& camera, rt_frame_desc frame) {
    Picture depth = blank(frame, 1), triangles = blank(frame, 1), meshes = blank(frame, 2),
            normals = blank(frame, 3);
    // Vectors of bytes are aligned for any of these.
    frame.depth = reinterpret_cast<float*>(depth.bytes.data());
    frame.triangle_ids = reinterpret_cast<uint32_t*>(triangles.bytes.data());
    frame.mesh_ids = reinterpret_cast<rt_mesh*>(meshes.bytes.data());
    frame.normals = reinterpret_cast<float*>(normals.bytes.data());
    render(stage, camera, frame);
    expect_golden(name + "_depth", how, depth);
    expect_golden(name + "_triangle_ids", how, triangles);
    expect_golden(name + "_normals", how, normals);
    // Of a handle only the index is the same in every scene.
    Picture mesh_ids = blank(frame, 1);
    for (size_t i = 0; i < meshes.bytes.size() / 8; ++i)
        std::memcpy(&mesh_ids.bytes[4 * i], &meshes.bytes[8 * i], 4);
    expect_golden(name + "_mesh_ids", how, mesh_ids);
}

TEST_P(Pictures, Features) {
    const FeatureScene scene(*stage_, {});
    commit();
    expect("features", scene.camera(), frame_of(320, 180));
    expect("features_side", scene.camera_from_the_side(), frame_of(161, 91));
    rt_frame_desc frame = frame_of(160, 90, RT_FORMAT_BGRA8_SRGB);
    frame.no_shadows = 1;
    frame.tone_mapping = RT_TONE_CLAMP;
    frame.exposure = 0.7f;
    expect("features_bgra_no_shadows", scene.camera(), frame);
    frame = frame_of(96, 54, RT_FORMAT_RGBA16F);
    expect("features_half", scene.camera(), frame);
    frame = frame_of(96, 54, RT_FORMAT_RGBA32F);
    frame.tone_mapping = RT_TONE_NONE;
    expect("features_float", scene.camera(), frame);
}

TEST_P(Pictures, Mipmaps) {
    FeatureScene scene(*stage_, {});
    commit();
    rt_frame_desc frame = frame_of(121, 68);
    frame.texture_filter = RT_TEXTURE_MIPMAPS;
    expect("mipmaps", scene.camera(), frame);
    expect("mipmaps_side", scene.camera_from_the_side(), frame);
}

TEST_P(Pictures, Views) {
    const FeatureScene scene(*stage_, {});
    commit();
    rt_frame_desc frame = frame_of(160, 90);
    frame.view = RT_VIEW_NORMALS;
    expect("view_normals", scene.camera(), frame);
    frame.view = RT_VIEW_DEPTH;
    frame.depth_range = 14;
    expect("view_depth", scene.camera(), frame);
    frame.view = RT_VIEW_STEPS;
    frame.steps_range = 30;
    // How a ray goes through the tree is the one thing that kernels may differ in.
    expect(GetParam().isa == RT_ISA_SCALAR ? "view_steps_scalar" : "view_steps", scene.camera(),
           frame);
}

TEST_P(Pictures, Planes) {
    const FeatureScene scene(*stage_, {});
    commit();
    expect_planes("plane", how(), *stage_, scene.camera(), frame_of(96, 54));
}

// Whatever approximates gives the same bits everywhere, too; what commits proved may show in it.
TEST_P(Pictures, Approximated) {
    if (GetParam().proofs) GTEST_SKIP() << "which lamps are compared depends on what was proved";
    FeatureScene scene(*stage_, {});
    commit();
    expect("features_direct", scene.camera(), direct_frame_of(320, 180));
    rt_frame_desc frame = direct_frame_of(161, 91);
    frame.light_block = 16;
    frame.light_tolerance = 0.2f;
    expect("features_blocks_of_16", scene.camera_from_the_side(), frame);
    frame.light_block = 4;
    frame.view = RT_VIEW_LIGHT;
    expect("features_light", scene.camera_from_the_side(), frame);
    scene.move();
    commit();
    expect("moved_direct", scene.camera(), direct_frame_of(160, 90));
}

TEST_P(Pictures, SoftShadows) {
    FeatureScene scene(*stage_, {});
    scene.soften();
    commit();
    expect("soft", scene.camera(), frame_of(320, 180));
    expect("soft_side", scene.camera_from_the_side(), frame_of(161, 91));
    if (GetParam().proofs) return;
    rt_frame_desc frame = direct_frame_of(161, 91);
    frame.light_block = 8;
    frame.light_tolerance = 0.05f;
    expect("soft_blocks", scene.camera_from_the_side(), frame);
}

TEST_P(Pictures, Occlusion) {
    if (GetParam().proofs) GTEST_SKIP() << "nothing is proved of it";
    FeatureScene scene(*stage_, {});
    commit();
    rt_frame_desc frame = frame_of(161, 91);
    frame.occlusion_range = 1.5f;
    frame.occlusion_block = 1;
    expect("occlusion", scene.camera(), frame);
    frame.occlusion_block = 8;
    expect("occlusion_side", scene.camera_from_the_side(), frame);
    frame.view = RT_VIEW_OCCLUSION;
    frame.occlusion_block = 16;
    expect("occlusion_view", scene.camera_from_the_side(), frame);
    scene.move();
    commit();
    frame = direct_frame_of(160, 90);
    frame.occlusion_range = 1.5f;
    frame.edge_samples = 4;
    frame.render_width = 120;
    expect("occlusion_moved", scene.camera(), frame);
}

TEST_P(Pictures, Baked) {
    if (GetParam().proofs) GTEST_SKIP() << "nothing is proved of it";
    FeatureScene scene(*stage_, {});
    commit();
    rt_bake_desc bake = rt_default_bake_desc();
    bake.bounces = 2;
    bake.occlusion_range = 1.5f;
    stage_->bake(bake, nullptr);
    commit();
    rt_frame_desc frame = frame_of(161, 91);
    frame.baked_light = 1;
    frame.occlusion_range = 1.5f;
    frame.occlusion_block = 8;
    expect("baked", scene.camera(), frame);
    expect("baked_side", scene.camera_from_the_side(), frame);
    frame.view = RT_VIEW_OCCLUSION;
    expect("baked_view", scene.camera(), frame);
    scene.move();
    commit();
    frame = direct_frame_of(160, 90);
    frame.occlusion_range = 1.5f;
    frame.edge_samples = 4;
    expect("baked_moved", scene.camera(), frame);
    frame.occlusion_range = 0;
    expect("baked_light_alone", scene.camera(), frame);
}

TEST_P(Pictures, Moved) {
    FeatureScene scene(*stage_, {});
    commit();
    scene.move();
    commit();
    expect("moved", scene.camera(), frame_of(160, 90));
}

TEST_P(Pictures, FarAway) {
    FeatureScene scene(*stage_, kFarAway);
    commit();
    expect("far_away", scene.camera(), frame_of(160, 90));
    rt_frame_desc frame = frame_of(160, 90);
    frame.occlusion_range = 1.5f;
    expect("far_away_occlusion", scene.camera(), frame);
    scene.move();
    commit();
    expect("far_away_moved", scene.camera(), frame_of(160, 90));
}

TEST_P(Pictures, Hall) {
    if (GetParam().proofs && GetParam().isa != RT_ISA_AVX2)
        GTEST_SKIP() << "its two million proofs are the same with every instruction set";
    const host::Level level = host::gltf::import_file(PEREGRINE_CONTENT "/hall.glb");
    host::upload_level(*stage_, level, 0.1f);
    commit();
    const auto camera = [&](const char* name) {
        return host::camera_of(level.cameras[host::find_camera(level.cameras, name)]);
    };
    expect("hall", camera("cam_hero"), frame_of(240, 135));
    if (!GetParam().proofs) expect("hall_direct", camera("cam_hero"), direct_frame_of(240, 135));
    rt_frame_desc filtered = frame_of(240, 135);
    filtered.texture_filter = RT_TEXTURE_MIPMAPS;
    expect("hall_mipmaps", camera("cam_hero"), filtered);
    expect("hall_library", camera("cam_library"), frame_of(128, 72));
    expect("hall_courtyard", camera("cam_courtyard"), frame_of(128, 72));
}

TEST_P(Pictures, Mill) {
    const host::Level level = host::gltf::import_file(PEREGRINE_CONTENT "/mill.glb");
    host::Player player(*stage_, level, host::upload_level(*stage_, level, 0.1f));
    player.describe(0);
    commit();
    player.describe(1.75);
    commit();
    expect("mill", host::camera_of(player.follow(level.cameras[0])), frame_of(240, 135));
}

INSTANTIATE_TEST_SUITE_P(By, Pictures, all_variants(),
                         [](const auto& info) { return std::string(info.param.name); });

// What a commit can be asked for changes speed and memory, not a pixel.
TEST(PicturesOfStructures, AreTheSame) {
    constexpr struct {
        const char* name;
        rt_structure structure;
        rt_build_quality quality;
        rt_memory memory;
    } kChoices[] = {
        {"kdtree", RT_STRUCTURE_KDTREE, RT_BUILD_BALANCED, RT_MEMORY_FULL},
        {"bih", RT_STRUCTURE_BIH, RT_BUILD_BALANCED, RT_MEMORY_FULL},
        {"compact", RT_STRUCTURE_BVH, RT_BUILD_BALANCED, RT_MEMORY_COMPACT},
        {"fast", RT_STRUCTURE_BVH, RT_BUILD_FAST, RT_MEMORY_FULL},
        {"best", RT_STRUCTURE_BVH, RT_BUILD_BEST, RT_MEMORY_FULL},
    };
    for (const auto& [name, structure, quality, memory] : kChoices) {
        // In a new scene, so that nothing is left of the structure before.
        host::Stage stage(*rt_get_api(RT_API_VERSION), 1, RT_ISA_BEST);
        const FeatureScene scene(stage, {});
        rt_commit_desc commit = rt_default_commit_desc();
        commit.light_proofs = RT_LIGHT_PROOFS_MADE;
        commit.structure = structure;
        commit.quality = quality;
        commit.memory = memory;
        stage.check(stage.api().commit_scene(stage.scene(), &commit, nullptr), "building");
        expect_pixels("features", name, stage, scene.camera(), frame_of(320, 180));
        expect_planes("plane", name, stage, scene.camera(), frame_of(96, 54));
    }
}

} // namespace
} // namespace peregrine::test
