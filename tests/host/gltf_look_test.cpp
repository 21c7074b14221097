#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <stb/stb_image_write.h>

#include "gltf/import.h"
#include "gltf_builder.h"

// Materials, textures, lights and cameras.
namespace host::test {
namespace {

Level import(const GltfBuilder& builder) {
    return gltf::import_bytes(builder.glb(), "test");
}

std::vector<uint8_t> make_png(int width, int height, int channels) {
    const std::vector<uint8_t> pixels(static_cast<size_t>(width * height * channels), 128);
    std::vector<uint8_t> png;
    stbi_write_png_to_func(
        [](void* to, void* data, int size) {
            const auto* bytes = static_cast<const uint8_t*>(data);
            static_cast<std::vector<uint8_t>*>(to)->insert(
                static_cast<std::vector<uint8_t>*>(to)->end(), bytes, bytes + size);
        },
        &png, width, height, channels, pixels.data(), width * channels);
    return png;
}

GltfBuilder make_textured(const std::vector<uint8_t>& image, const Json& material) {
    GltfBuilder builder = make_quad();
    builder.json["images"] = {{{"bufferView", builder.add_view(image)}, {"mimeType", "image/png"}}};
    builder.json["samplers"] = {{{"magFilter", 9728}, {"wrapS", 33071}, {"wrapT", 33648}}};
    builder.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
    builder.json["materials"] =
        Json::array({material}); // braces alone: a copy or an array, as the compiler likes
    builder.json["meshes"][0]["primitives"][0]["material"] = 0;
    return builder;
}

const Json base_texture = {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}};

// make_png's: 128 / 255 everywhere.
TEST(GltfLook, MetallicRoughnessAndOcclusionTextures) {
    constexpr float half = 128.0f / 255.0f;
    Json material = {{"pbrMetallicRoughness",
                      {{"baseColorFactor", {0.5, 1, 0.25, 1}},
                       {"metallicFactor", 0.5},
                       {"roughnessFactor", 0.25},
                       {"metallicRoughnessTexture", {{"index", 0}, {"texCoord", 1}}}}},
                     {"occlusionTexture", {{"index", 0}, {"strength", 0.75}}}};
    const Level level = import(make_textured(make_png(4, 2, 3), material));
    EXPECT_TRUE(level.notes.empty());
    ASSERT_EQ(level.textures.size(), 1u);
    EXPECT_FALSE(level.textures[0].srgb);
    const Material& worn = level.materials[0];
    EXPECT_EQ(worn.roughness_texture.texture, 0u);
    EXPECT_EQ(worn.roughness_texture.texcoord_set, 1u);
    EXPECT_EQ(worn.occlusion_texture.texture, 0u);
    EXPECT_EQ(worn.occlusion_strength, 0.75f);
    EXPECT_EQ(worn.metalness, 0.5f);
    EXPECT_EQ(worn.roughness, 0.25f);
    EXPECT_EQ(glm::vec3(worn.base_color), glm::vec3(0.5f, 1, 0.25f)) << "the engine darkens metals";
    EXPECT_EQ(worn.specular, glm::vec3(0.04f));
    // What mirrors does so by the mean: 1 - roughness / limit of the reflectance.
    const float metallic = 0.5f * half, limit = 0.1f + 0.15f * metallic;
    const float green = 0.04f + (1 - 0.04f) * metallic;
    EXPECT_NEAR(worn.reflectivity, green * std::max(0.0f, 1 - 0.25f * half / limit), 1e-6f);

    material["occlusionTexture"]["strength"] = 0;
    EXPECT_EQ(
        import(make_textured(make_png(1, 1, 1), material)).materials[0].occlusion_texture.texture,
        no_index);
}

// Its factors alone mean what they did.
TEST(GltfLook, WithoutATextureNothingIsWorn) {
    GltfBuilder builder = make_quad();
    builder.json["materials"] = {{{"pbrMetallicRoughness", {{"roughnessFactor", 0.5}}}}};
    const Level level = import(builder);
    EXPECT_EQ(level.materials[0].roughness_texture.texture, no_index);
    EXPECT_FLOAT_EQ(level.materials[0].shininess, 30);
}

TEST(GltfLook, ImagesBecomeRgba) {
    for (const int channels : {1, 2, 3, 4}) {
        const Level level = import(make_textured(make_png(3, 2, channels), base_texture));
        ASSERT_EQ(level.images.size(), 1u);
        EXPECT_EQ(level.images[0].rgba.size(), 24u);
        EXPECT_EQ(level.images[0].rgba[0], 128);
        EXPECT_EQ(level.images[0].rgba[3], channels % 2 == 0 ? 128 : 255);
        const Texture& texture = level.textures.at(0);
        EXPECT_TRUE(texture.srgb && texture.nearest);
        EXPECT_EQ(texture.wrap_u, Wrap::clamp);
        EXPECT_EQ(texture.wrap_v, Wrap::mirror);
    }
}

TEST(GltfLook, AnImageInTwoRolesIsTwoTexturesOfOneImage) {
    Json material = base_texture;
    material["normalTexture"] = {{"index", 0}, {"scale", 0.5}};
    const Level level = import(make_textured(make_png(2, 2, 3), material));
    EXPECT_EQ(level.images.size(), 1u);
    ASSERT_EQ(level.textures.size(), 2u);
    EXPECT_NE(level.textures[0].srgb, level.textures[1].srgb);
    EXPECT_EQ(level.materials[0].normal_scale, 0.5f);
}

TEST(GltfLook, UnreadableImagesBecomeAChequerboardAndANote) {
    auto png = make_png(4, 4, 3);
    png.resize(png.size() / 2);
    const std::vector<uint8_t> garbage(64, 'x');
    for (const auto& bytes : {png, garbage}) {
        const Level level = import(make_textured(bytes, base_texture));
        ASSERT_EQ(level.images.size(), 1u);
        EXPECT_EQ(level.images[0].rgba[1], 0);
        EXPECT_FALSE(level.notes.empty());
    }
}

TEST(GltfLook, AnImageThatUnfoldsToAGigabyteIsNotDecoded) {
    auto png = make_png(4, 4, 3);
    for (const size_t byte : {18u, 22u}) png[byte] = 0x40; // 16384 pixels wide and high
    const Level level = import(make_textured(png, base_texture));
    EXPECT_EQ(level.images.at(0).width, 8u);
}

TEST(GltfLook, TextureTransforms) {
    Json material = base_texture;
    material["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"] = {
        {"offset", {0.5, 0.25}},
        {"rotation", 1.5707963267948966},
        {"scale", {2, 3}},
        {"texCoord", 1}};
    const Level level = import(make_textured(make_png(2, 2, 3), material));
    const TextureUse& use = level.materials[0].base_color_texture;
    EXPECT_EQ(use.texcoord_set, 1u);
    const float expected[6] = {0, 3, 0.5f, -2, 0, 0.25f};
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(use.transform[i], expected[i], 1e-6f) << i;
}

TEST(GltfLook, AlphaModes) {
    GltfBuilder builder = make_quad();
    builder.json["materials"] = {{{"alphaMode", "MASK"}, {"alphaCutoff", 0.3}},
                                 {{"alphaMode", "BLEND"}, {"doubleSided", true}},
                                 Json::object()};
    const Level level = import(builder);
    EXPECT_TRUE(level.materials[0].masked);
    EXPECT_FLOAT_EQ(level.materials[0].alpha_cutoff, 0.3f);
    EXPECT_TRUE(level.materials[1].blended && level.materials[1].double_sided);
    EXPECT_FALSE(level.materials[0].blended || level.materials[1].masked);
    EXPECT_FALSE(level.materials[2].masked || level.materials[2].blended
                 || level.materials[2].double_sided);
    EXPECT_TRUE(level.notes.empty());
}

TEST(GltfLook, UnlitAndEmissiveStrength) {
    GltfBuilder builder = make_quad();
    builder.json["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 1, 1}}}},
         {"extensions", {{"KHR_materials_unlit", Json::object()}}}},
        {{"emissiveFactor", {1, 0.5, 0}},
         {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}}}}}};
    const Level level = import(builder);
    EXPECT_EQ(level.materials[0].emissive, glm::vec3(0.5f, 0.25f, 1.0f));
    EXPECT_EQ(glm::vec3(level.materials[0].base_color), glm::vec3(0.0f));
    EXPECT_EQ(level.materials[1].emissive, glm::vec3(4, 2, 0));
}

TEST(GltfLook, LightsCamerasAndSpawns) {
    GltfBuilder builder = make_quad();
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"intensity", 0.02}},
        {{"type", "spot"},
         {"intensity", 10},
         {"range", 4},
         {"color", {1, 0.5, 0}},
         {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.5}}}},
        {{"type", "directional"}}};
    builder.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}}};
    for (int i = 0; i < 3; ++i)
        builder.push("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", i}}}}},
                               {"translation", {i, 2, 0}}});
    builder.push("nodes", {{"name", "eye"}, {"camera", 0}, {"rotation", {0, 1, 0, 0}}});
    builder.push("nodes", {{"name", "spawn_0"}, {"translation", {7, 8, 9}}});
    builder.json["scenes"][0]["nodes"] = {0, 1, 2, 3, 4, 5};
    const Level level = import(builder);
    ASSERT_EQ(level.lights.size(), 3u);
    EXPECT_EQ(level.lights[0].radius, std::numeric_limits<float>::infinity()); // no range, no end
    EXPECT_EQ(level.lights[1].radius, 4.0f);
    EXPECT_EQ(level.lights[1].intensity, glm::vec3(10, 5, 0));
    EXPECT_NEAR(level.lights[1].cone_outer_cos, std::cos(0.5f), 1e-6f);
    EXPECT_EQ(level.lights[2].direction, glm::vec3(0, 0, -1));
    ASSERT_EQ(level.cameras.size(), 1u);
    EXPECT_EQ(level.cameras[0].name, "eye");
    EXPECT_NEAR(level.cameras[0].forward.z, 1.0f, 1e-6f);
    EXPECT_FLOAT_EQ(level.cameras[0].vertical_fov, 0.8f);
    ASSERT_EQ(level.spawns.size(), 1u);
    EXPECT_EQ(level.spawns[0].position, glm::dvec3(7, 8, 9));
}

TEST(GltfLook, MetalsAreDarkAndShiny) {
    GltfBuilder builder = make_quad();
    builder.json["materials"] = {
        {{"pbrMetallicRoughness", {{"metallicFactor", 1}, {"roughnessFactor", 0.2}}}},
        {{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 1}}}}};
    const Level level = import(builder);
    EXPECT_GT(level.materials[0].specular.r, level.materials[1].specular.r);
    EXPECT_GT(level.materials[0].shininess, level.materials[1].shininess);
    EXPECT_LT(level.materials[0].base_color.r, level.materials[1].base_color.r);
    EXPECT_EQ(level.materials[1].shininess, 1.0f);
}

TEST(GltfLook, SmoothMetalsMirror) {
    GltfBuilder builder = make_quad();
    const auto add = [&](double metallic, double roughness) {
        builder.push("materials", {{"pbrMetallicRoughness",
                                    {{"baseColorFactor", {0.5, 1, 0.25, 1}},
                                     {"metallicFactor", metallic},
                                     {"roughnessFactor", roughness}}}});
    };
    add(1, 0);
    add(1, 0.125);
    add(1, 0.25);
    add(0, 0);
    add(0, 0.1);
    const Level level = import(builder);
    EXPECT_EQ(level.materials[0].reflectivity, 1.0f);
    EXPECT_EQ(level.materials[0].reflection_color, glm::vec3(0.5f, 1, 0.25f));
    EXPECT_EQ(glm::vec3(level.materials[0].base_color), glm::vec3(0));
    EXPECT_EQ(level.materials[1].reflectivity, 0.5f);
    EXPECT_EQ(level.materials[2].reflectivity, 0.0f);
    EXPECT_EQ(glm::vec3(level.materials[2].base_color), glm::vec3(0.25f, 0.5f, 0.125f));
    EXPECT_FLOAT_EQ(level.materials[3].reflectivity, 0.04f);
    EXPECT_EQ(level.materials[4].reflectivity, 0.0f);
}

TEST(GltfLook, GlassAndPanes) {
    GltfBuilder builder = make_quad();
    builder.json["materials"] = {
        {{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 0}}},
         {"extensions",
          {{"KHR_materials_transmission", {{"transmissionFactor", 0.9}}},
           {"KHR_materials_ior", {{"ior", 1.33}}},
           {"KHR_materials_volume",
            {{"thicknessFactor", 1},
             {"attenuationColor", {0.5, 0.75, 2}},
             {"attenuationDistance", 3}}}}}},
        {{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 0.5}}},
         {"extensions",
          {{"KHR_materials_transmission",
            {{"transmissionFactor", 1}, {"transmissionTexture", {{"index", 0}}}}},
           {"KHR_materials_ior", {{"ior", 0}}},
           {"KHR_materials_volume", Json::object()}}}},
        {{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 0}}},
         {"extensions",
          {{"KHR_materials_specular",
            {{"specularFactor", 0.5}, {"specularColorFactor", {1, 0.5, 100}}}}}}}};
    const Level level = import(builder);
    const Material& glass = level.materials[0];
    EXPECT_FLOAT_EQ(glass.transmission, 0.9f);
    EXPECT_FLOAT_EQ(glass.index_of_refraction, 1.33f);
    EXPECT_FALSE(glass.thin);
    EXPECT_EQ(glass.attenuation_color, glm::vec3(0.5f, 0.75f, 1));
    EXPECT_EQ(glass.attenuation_distance, 3.0f);
    EXPECT_EQ(glass.reflectivity, 0.0f);
    EXPECT_TRUE(level.materials[1].thin);
    EXPECT_EQ(level.materials[1].index_of_refraction, 10.0f);
    EXPECT_EQ(level.notes.size(), 2u) << "a texture, and rough glass";
    EXPECT_FLOAT_EQ(level.materials[2].reflectivity, 0.5f);
    EXPECT_NEAR(level.materials[2].reflection_color.x, 0.04f, 1e-6f);
    EXPECT_NEAR(level.materials[2].reflection_color.y, 0.02f, 1e-6f);
}

} // namespace
} // namespace host::test
