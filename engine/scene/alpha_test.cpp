#include "scene/alpha_test.h"

#include "scene/texture_sampling.h"

namespace peregrine::scene {
namespace {

using geometry::TriangleInfo;

inline float alpha_at(const MeshData& mesh, const Material& material, uint32_t primitive, float u,
                      float v) {
    float alpha = material.base_color.a;
    const TextureUse& use = material.base_color_texture;
    if (use.texture) {
        const math::Vec2 uv = texcoord_at(mesh, primitive, use.texcoord_set, u, v);
        alpha *= sample(*use.texture, transform(use, uv)).a;
    }
    return alpha;
}

// Of what is masked.
bool present_at(const Snapshot& snapshot, uint32_t slot, uint32_t primitive, float u, float v) {
    const Snapshot::Mesh& mesh = snapshot.meshes[slot];
    const Material& material = snapshot.material_of(mesh, primitive);
    return alpha_at(*mesh.data, material, primitive, u, v) >= material.alpha_cutoff;
}

// In scenes where what light may pass asks, too.
bool present_among_glass_at(const Snapshot& snapshot, uint32_t slot, uint32_t primitive, float u,
                            float v) {
    const Snapshot::Mesh& mesh = snapshot.meshes[slot];
    return !snapshot.material_of(mesh, primitive).masked
           || present_at(snapshot, slot, primitive, u, v);
}

// How much of the light a surface keeps, but for what it mirrors.
float cover_at(const Snapshot& snapshot, uint32_t slot, uint32_t primitive, float u, float v) {
    const Snapshot::Mesh& mesh = snapshot.meshes[slot];
    const Material& material = snapshot.material_of(mesh, primitive);
    const float covers = 1.0f - material.transmission;
    return material.is_translucent() ? covers * alpha_at(*mesh.data, material, primitive, u, v)
                                     : covers;
}

bool blocks_light_at(const Snapshot& snapshot, uint32_t slot, uint32_t primitive, float u,
                     float v) {
    return cover_at(snapshot, slot, primitive, u, v) >= 0.5f
           && present_among_glass_at(snapshot, slot, primitive, u, v);
}

bool is_opaque_at(const Snapshot& snapshot, uint32_t slot, uint32_t primitive, float u, float v) {
    return cover_at(snapshot, slot, primitive, u, v) >= 1.0f
           && present_among_glass_at(snapshot, slot, primitive, u, v);
}

using AskAt = bool (*)(const Snapshot& snapshot, uint32_t slot, uint32_t primitive, float u,
                       float v);

template <AskAt Ask>
bool ask(const void* context, const TriangleInfo& triangle, float u, float v) {
    const auto& snapshot = *static_cast<const Snapshot*>(context);
    return Ask(snapshot, triangle.mesh, triangle.primitive, u, v);
}

template <AskAt Ask>
bool ask_in_instance(const void* context, const TriangleInfo& triangle, float u, float v) {
    const auto& instance = *static_cast<const InstanceAlpha*>(context);
    return Ask(*instance.snapshot, instance.mesh, triangle.primitive, u, v);
}

} // namespace

trace::AlphaTest alpha_test(const Snapshot& snapshot) {
    if (!(snapshot.features & kAlphaMask)) return {};
    if (snapshot.features & kLightPassingFeatures) return {ask<present_among_glass_at>, &snapshot};
    return {ask<present_at>, &snapshot};
}

trace::AlphaTest alpha_test(const InstanceAlpha& instance) {
    if (instance.snapshot->features & kLightPassingFeatures)
        return {ask_in_instance<present_among_glass_at>, &instance};
    return {ask_in_instance<present_at>, &instance};
}

trace::AlphaTest light_test(const Snapshot& snapshot) {
    if (!(snapshot.features & kLightPassingFeatures)) return alpha_test(snapshot);
    return {ask<blocks_light_at>, &snapshot};
}

trace::AlphaTest light_test(const InstanceAlpha& instance) {
    if (!(instance.snapshot->features & kLightPassingFeatures)) return alpha_test(instance);
    return {ask_in_instance<blocks_light_at>, &instance};
}

trace::AlphaTest opacity_test(const Snapshot& snapshot) {
    if (!(snapshot.features & kLightPassingFeatures)) return alpha_test(snapshot);
    return {ask<is_opaque_at>, &snapshot};
}

trace::AlphaTest opacity_test(const InstanceAlpha& instance) {
    if (!(instance.snapshot->features & kLightPassingFeatures)) return alpha_test(instance);
    return {ask_in_instance<is_opaque_at>, &instance};
}

} // namespace peregrine::scene
