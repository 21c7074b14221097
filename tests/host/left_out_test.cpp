// What commits say that scenes do not have is what their files do not have.
#include <filesystem>
#include <set>

#include <gtest/gtest.h>

#include "gltf/import.h"
#include "plugin.h"
#include "support/world.h"
#include "upload.h"

namespace host {

namespace {

uint32_t features_of(const Material& material) {
    uint32_t features = 0;
    const auto add = [&](bool has, uint32_t bit) { features |= has ? bit : 0u; };
    const bool has_normals = material.normal_texture.texture != no_index;
    add(has_normals, RT_FEATURE_NORMAL_MAPS | RT_FEATURE_TEXTURES);
    add(material.base_color_texture.texture != no_index, RT_FEATURE_TEXTURES);
    add(material.emissive_texture.texture != no_index, RT_FEATURE_TEXTURES);
    add(material.emissive != glm::vec3(0.0f), RT_FEATURE_EMISSIVE);
    const bool has_occlusion = material.occlusion_texture.texture != no_index;
    add(has_occlusion, RT_FEATURE_OCCLUSION_TEXTURES | RT_FEATURE_TEXTURES);
    const bool has_roughness = material.roughness_texture.texture != no_index;
    add(has_roughness, RT_FEATURE_ROUGHNESS_TEXTURES | RT_FEATURE_TEXTURES | RT_FEATURE_SPECULAR);
    add(material.masked, RT_FEATURE_ALPHA_MASK);
    add(material.blended && !material.masked, RT_FEATURE_BLENDING);
    add(material.specular != glm::vec3(0.0f), RT_FEATURE_SPECULAR);
    add(material.reflectivity > 0.0f, RT_FEATURE_REFLECTION);
    add(material.transmission > 0.0f, RT_FEATURE_TRANSMISSION);
    const bool is_solid_glass = material.transmission > 0.0f && !material.thin;
    add(!material.double_sided && !is_solid_glass, RT_FEATURE_SINGLE_SIDED);
    return features;
}

uint32_t features_of(const Level& level) {
    std::set<uint32_t> shown;
    const auto show = [&](const Mesh& mesh) {
        shown.insert(mesh.materials.begin(), mesh.materials.end());
    };
    for (const Mesh& mesh : level.meshes) show(mesh);
    for (const RigidMesh& rigid : level.rigid_meshes) show(rigid.mesh);
    for (const DeformingMesh& deforming : level.deforming_meshes) show(deforming.mesh);
    uint32_t features = 0;
    for (const uint32_t material : shown)
        if (material != no_index) features |= features_of(level.materials[material]);
    if (!level.lights.empty()) features |= RT_FEATURE_LIGHTS | RT_FEATURE_SHADOWS;
    if (!level.rigid_meshes.empty() || !level.deforming_meshes.empty())
        features |= RT_FEATURE_DYNAMIC_MESHES;
    return features;
}

class LeftOut : public testing::TestWithParam<std::string> {};

} // namespace

TEST_P(LeftOut, IsWhatTheFileDoesNotHave) {
    const Plugin plugin(ENGINE);
    Stage stage(plugin.api(), 2, RT_ISA_BEST);
    const Level level = gltf::import_file(GetParam());
    upload_level(stage, level, 0.1f);
    const rt_commit_report report = stage.commit(RT_STRUCTURE_AUTO, RT_BUILD_FAST, nullptr);
    constexpr uint32_t all = RT_FEATURE_ROUGHNESS_TEXTURES * 2 - 1;
    const uint32_t sky = report.left_out & RT_FEATURE_SKY; // the host's, not the file's
    EXPECT_EQ(report.left_out & ~sky, all & ~RT_FEATURE_SKY & ~features_of(level));
}

INSTANTIATE_TEST_SUITE_P(Files, LeftOut, testing::ValuesIn(peregrine::test::scene_files()),
                         [](const auto& info) {
                             return std::filesystem::path(info.param).stem().string();
                         });

} // namespace host
