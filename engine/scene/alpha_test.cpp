#include "scene/alpha_test.h"

#include "scene/texture_sampling.h"

namespace peregrine::scene {
namespace {

bool present(const void* context, const geometry::TriangleInfo& triangle, float u, float v) {
    const auto& snapshot = *static_cast<const Snapshot*>(context);
    const Snapshot::Mesh& mesh = snapshot.meshes[triangle.mesh];
    const Material& material = snapshot.materials[mesh.material_of(triangle.primitive)];
    float alpha = material.base_color.a;
    const TextureUse& use = material.base_color_texture;
    if (use.texture) {
        const math::Vec2 uv = texcoord_at(*mesh.data, triangle.primitive, use.texcoord_set, u, v);
        alpha *= sample(*use.texture, transform(use, uv)).a;
    }
    return alpha >= material.alpha_cutoff;
}

} // namespace

trace::AlphaTest alpha_test(const Snapshot& snapshot) {
    if (!(snapshot.features & kAlphaMask)) return {};
    return {present, &snapshot};
}

} // namespace peregrine::scene
