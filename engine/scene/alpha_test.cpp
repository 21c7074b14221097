#include "scene/alpha_test.h"

#include "scene/texture_sampling.h"

namespace peregrine::scene {
namespace {

bool present_at(const Snapshot& snapshot, uint32_t slot, uint32_t primitive, float u, float v) {
    const Snapshot::Mesh& mesh = snapshot.meshes[slot];
    const Material& material = snapshot.material_of(mesh, primitive);
    float alpha = material.base_color.a;
    const TextureUse& use = material.base_color_texture;
    if (use.texture) {
        const math::Vec2 uv = texcoord_at(*mesh.data, primitive, use.texcoord_set, u, v);
        alpha *= sample(*use.texture, transform(use, uv)).a;
    }
    return alpha >= material.alpha_cutoff;
}

bool present(const void* context, const geometry::TriangleInfo& triangle, float u, float v) {
    const auto& snapshot = *static_cast<const Snapshot*>(context);
    return present_at(snapshot, triangle.mesh, triangle.primitive, u, v);
}

bool present_in_instance(const void* context, const geometry::TriangleInfo& triangle, float u,
                         float v) {
    const auto& instance = *static_cast<const InstanceAlpha*>(context);
    return present_at(*instance.snapshot, instance.mesh, triangle.primitive, u, v);
}

} // namespace

trace::AlphaTest alpha_test(const Snapshot& snapshot) {
    if (!(snapshot.features & kAlphaMask)) return {};
    return {present, &snapshot};
}

trace::AlphaTest alpha_test(const InstanceAlpha& instance) {
    return {present_in_instance, &instance};
}

} // namespace peregrine::scene
