#include "shade/surface/triangle_shading.h"

#include "geometry/lift.h"
#include "scene/texture_sampling.h"

#include <algorithm>
#include <cmath>

namespace peregrine::shade {
namespace {

using math::Vec2;
using math::Vec3;

// In double, where neither slivers nor triangles of any scale underflow.
Vec3 unit_normal(const Vec3* v) {
    const math::Vec3d a = math::Vec3d(v[1]) - math::Vec3d(v[0]);
    const math::Vec3d b = math::Vec3d(v[2]) - math::Vec3d(v[0]);
    const math::Vec3d n = glm::cross(a, b);
    const double length = std::sqrt(glm::dot(n, n));
    return length > 0 ? Vec3(n / length) : Vec3(0, 0, 1);
}

void place_textures(const scene::MeshData& mesh, const std::array<uint32_t, 3>& vertices,
                    TriangleShading& out) {
    for (uint32_t i = 0; i < out.look.place_count; ++i) {
        const scene::TextureUse& use = *out.look.places[i];
        for (uint32_t k = 0; k < 3; ++k)
            out.texcoord[i][k] =
                scene::transform(use, scene::vertex_texcoord(mesh, vertices[k], use.texcoord_set));
    }
}

// From the mesh's own space into the world, relative to a point. Normals go by the inverse
// transpose, which keeps them on their side even if it mirrors.
void place(const scene::Placement& placement, const math::Vec3d& origin, TriangleShading& out) {
    const math::Vec3d offset = placement.to_world.offset - origin;
    for (Vec3& vertex : out.vertex)
        vertex = Vec3(placement.to_world.vector(math::Vec3d(vertex)) + offset);
    if (!out.smooth) return;
    for (Vec3& normal : out.normal) {
        const math::Vec3d turned = placement.to_local.transposed(math::Vec3d(normal));
        const double length = std::sqrt(glm::dot(turned, turned));
        normal = length > 0 ? Vec3(turned / length) : Vec3(0);
    }
}

// The directions in which u grows and v falls: +Y of a normal map is up in the image, whose row 0
// is at v = 0. Without usable coordinates any tangent will do.
void derive_tangents(TriangleShading& out, const Vec3& front) {
    const Vec3 e1 = out.vertex[1] - out.vertex[0], e2 = out.vertex[2] - out.vertex[0];
    const Vec2* const texcoord = out.texcoord[out.look.normal.place];
    const Vec2 d1 = texcoord[1] - texcoord[0], d2 = texcoord[2] - texcoord[0];
    const float area = d1.x * d2.y - d2.x * d1.y;
    // Only the direction matters: multiplying by the sign instead of dividing by the area.
    const Vec3 du = (e1 * d2.y - e2 * d1.y) * (area < 0 ? -1.0f : 1.0f);
    const float length = std::sqrt(glm::dot(du, du));
    Vec3 tangent = std::fabs(front.x) < 0.7f ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    if (area != 0 && length > 0 && std::isfinite(length)) tangent = du / length;
    out.tangent[0] = out.tangent[1] = out.tangent[2] = tangent;
    out.handedness = area < 0 ? 1.0f : -1.0f;
}

void gather_tangents(const scene::MeshData& mesh, const std::array<uint32_t, 3>& vertices,
                     const Vec3& front, TriangleShading& out) {
    if (mesh.tangents.empty()) return derive_tangents(out, front);
    for (uint32_t k = 0; k < 3; ++k) out.tangent[k] = Vec3(mesh.tangents[vertices[k]]);
    out.handedness = mesh.tangents[vertices[0]].w < 0 ? -1.0f : 1.0f;
}

} // namespace

void gather(const scene::Snapshot& snapshot, uint32_t features, uint32_t triangle_index,
            bool back_face, const SurfaceSpace& space, TriangleShading& out) {
    const geometry::TriangleInfo triangle = trace::info(snapshot.world, triangle_index);
    const scene::Snapshot::Mesh& slot = snapshot.meshes[triangle.mesh];
    const scene::MeshData& mesh = *slot.data;
    const std::array<uint32_t, 3>& vertices = mesh.triangles()[triangle.primitive];
    const scene::Material& material = snapshot.material_of(slot, triangle.primitive);
    if (out.look.material != &material) out.look.look_at(material, features);
    for (uint32_t k = 0; k < 3; ++k) out.vertex[k] = mesh.positions[vertices[k]];
    out.smooth = !mesh.normals.empty();
    if (out.smooth)
        for (uint32_t k = 0; k < 3; ++k) out.normal[k] = mesh.normals[vertices[k]];
    const scene::Placement* const placement = snapshot.placement_of(slot);
    const float reach =
        slot.shape ? space.reach_of(slot.shape->bounds(), placement) : space.fixed_reach;
    Vec3 in_world;
    const bool is_moved = space.is_elsewhere && !placement;
    if (placement) {
        place(*placement, space.origin, out);
    } else if (is_moved) [[unlikely]] {
        in_world = geometry::largest_coordinates(out.vertex);
        for (Vec3& vertex : out.vertex) vertex = Vec3(math::Vec3d(vertex) - space.origin);
    }
    Vec3 front = unit_normal(out.vertex);
    if (placement && placement->mirrored) front = -front;
    out.geometric = back_face ? -front : front;
    Vec3 largest = geometry::largest_coordinates(out.vertex);
    if (is_moved) largest += 0.25f * (largest + in_world); // for two more roundings, of either
    out.lift = geometry::surface_lift(largest, out.geometric, geometry::intersection_error(reach));
    place_textures(mesh, vertices, out);
    if (!out.look.normal.texture) return;
    gather_tangents(mesh, vertices, front, out);
    if (!placement) return;
    if (!mesh.tangents.empty())
        for (Vec3& tangent : out.tangent)
            tangent = Vec3(placement->to_world.vector(math::Vec3d(tangent)));
    if (placement->mirrored) out.handedness = -out.handedness;
}

} // namespace peregrine::shade
