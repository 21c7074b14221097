#include "mesh_data.h"

#include "check.h"
#include "read_array.h"

#include <cmath>
#include <limits>

namespace peregrine::abi {
namespace {

using base::Code;
using base::fail;
using scene::MeshData;
using scene::MeshSurface;

constexpr uint64_t kMostTriangles = uint64_t(1) << 27;
constexpr uint64_t kMostVertices = uint64_t(1) << 30;
constexpr uint64_t kAnyCount = std::numeric_limits<uint64_t>::max();
constexpr float kLongestNormal = 1e18f; // whose square is a float

unsigned long long print(uint64_t value) {
    return value;
}

// Directions that cannot be normalised become zero: the renderer then falls back to the face.
template <class Vec>
Vec clean_direction(const Vec& direction) {
    for (int i = 0; i < direction.length(); ++i)
        if (!(std::fabs(direction[i]) <= kLongestNormal)) return Vec(0);
    return direction;
}

math::Vec4 clean_tangent(const math::Vec4& tangent) {
    const math::Vec4 clean = clean_direction(tangent);
    return {clean.x, clean.y, clean.z, clean.w < 0 ? -1.0f : 1.0f};
}

math::Vec2 clean_texcoord(const math::Vec2& texcoord) {
    return std::isfinite(texcoord.x) && std::isfinite(texcoord.y) ? texcoord : math::Vec2(0);
}

math::Vec3 as_it_is(const math::Vec3& position) {
    return position;
}

template <class T>
void copy(const Array<T>& array, base::Vector<T>& out, T (*clean)(const T&)) {
    out.resize(array.count());
    for (uint64_t i = 0; i < array.count(); ++i) out[i] = clean(array[i]);
}

// Vertex attributes come one a vertex or not at all.
template <class T>
Array<T> per_vertex(const rt_array& array, const char* field, uint64_t vertices) {
    const Array<T> result(array, field, kAnyCount);
    if (!result.absent() && result.count() != vertices)
        fail(Code::invalid_argument, "%s.count is %llu, but there are %llu vertices", field,
             print(result.count()), print(vertices));
    return result;
}

uint64_t count_triangles(const char* field, uint64_t corners) {
    if (corners % 3 != 0)
        fail(Code::invalid_argument, "%s.count is %llu, which is no multiple of 3", field,
             print(corners));
    if (corners / 3 > kMostTriangles)
        fail(Code::limit, "%s.count is %llu: more than 2^27 triangles", field, print(corners));
    return corners / 3;
}

template <class Index>
void copy_indices(const Array<Index>& indices, uint64_t vertices,
                  base::Vector<std::array<uint32_t, 3>>& out) {
    out.resize(indices.count() / 3);
    for (uint64_t i = 0; i < indices.count(); ++i) {
        const uint32_t index = indices[i];
        if (index >= vertices) [[unlikely]]
            fail(Code::invalid_argument, "%s[%llu] is %u, but there are %llu vertices",
                 indices.field(), print(i), index, print(vertices));
        out[i / 3][i % 3] = index;
    }
}

template <class Index>
void read_indices(const rt_mesh_desc& desc, uint64_t vertices, MeshSurface& out) {
    const Array<Index> indices(desc.indices, "rt_mesh_desc.indices", 3 * kMostTriangles);
    if (indices.absent())
        fail(Code::invalid_argument,
             "rt_mesh_desc.indices is absent, but index_type is not RT_INDEX_NONE");
    count_triangles(indices.field(), indices.count());
    copy_indices(indices, vertices, out.triangles);
}

void number_corners(const rt_mesh_desc& desc, uint64_t vertices, MeshSurface& out) {
    if (desc.indices.count != 0 || desc.indices.data)
        fail(Code::invalid_argument,
             "rt_mesh_desc.indices is there, but index_type is RT_INDEX_NONE");
    out.triangles.resize(count_triangles("rt_mesh_desc.positions", vertices));
    for (uint32_t i = 0; i < out.triangles.size(); ++i)
        out.triangles[i] = {3 * i, 3 * i + 1, 3 * i + 2};
}

bool is_null(rt_material material) {
    return material.index == 0 && material.generation == 0;
}

void read_material(scene::Scene& scene, const rt_mesh_desc& desc, MeshSurface& out) {
    if (!is_null(desc.material))
        require_object(scene.materials, to_handle(desc.material), "rt_mesh_desc.material",
                       "material");
    out.material = {desc.material.index, desc.material.generation};
}

void read_materials(scene::Scene& scene, const rt_mesh_desc& desc, MeshSurface& out) {
    const Array<rt_material> materials(desc.materials, "rt_mesh_desc.materials", kAnyCount);
    if (materials.absent()) return;
    if (materials.count() != out.triangles.size())
        fail(Code::invalid_argument,
             "rt_mesh_desc.materials.count is %llu, but there are %zu triangles",
             print(materials.count()), out.triangles.size());
    out.materials.resize(materials.count());
    for (uint64_t i = 0; i < materials.count(); ++i) {
        const rt_material material = materials[i];
        if (!is_null(material) && !scene.materials.find(to_handle(material)))
            fail(Code::invalid_handle,
                 "rt_mesh_desc.materials[%llu] is {%u, %u}, which names no material of this scene",
                 print(i), material.index, material.generation);
        out.materials[i] = is_null(material)
                               ? out.material
                               : MeshSurface::MaterialRef{material.index, material.generation};
    }
}

void read_triangles(const rt_mesh_desc& desc, uint64_t vertices, MeshSurface& out) {
    switch (desc.index_type) {
    case RT_INDEX_UINT32:
        return read_indices<uint32_t>(desc, vertices, out);
    case RT_INDEX_UINT16:
        return read_indices<uint16_t>(desc, vertices, out);
    default:
        return number_corners(desc, vertices, out);
    }
}

std::shared_ptr<MeshData> allocate(std::shared_ptr<const MeshSurface> surface,
                                   base::Memory* memory) {
    return std::allocate_shared<MeshData>(std::pmr::polymorphic_allocator<MeshData>(memory),
                                          std::move(surface), memory);
}

} // namespace

MeshDataPointer make_mesh_data(scene::Scene& scene, const rt_mesh_desc& desc) {
    require_enum(desc.index_type, RT_INDEX_NONE, "rt_mesh_desc.index_type");
    require_zero(desc.reserved, "rt_mesh_desc.reserved");
    const Array<math::Vec3> positions(desc.positions, "rt_mesh_desc.positions", kMostVertices);
    const uint64_t vertices = positions.count();
    if (vertices == 0)
        fail(Code::invalid_argument, "rt_mesh_desc.positions is absent; a mesh needs vertices");
    const auto normals = per_vertex<math::Vec3>(desc.normals, "rt_mesh_desc.normals", vertices);
    const auto tangents = per_vertex<math::Vec4>(desc.tangents, "rt_mesh_desc.tangents", vertices);
    const auto texcoords =
        per_vertex<math::Vec2>(desc.texcoords, "rt_mesh_desc.texcoords", vertices);
    const auto texcoords1 =
        per_vertex<math::Vec2>(desc.texcoords1, "rt_mesh_desc.texcoords1", vertices);

    const auto surface = std::allocate_shared<MeshSurface>(
        std::pmr::polymorphic_allocator<MeshSurface>(&scene.memory), &scene.memory);
    read_material(scene, desc, *surface);
    read_triangles(desc, vertices, *surface);
    read_materials(scene, desc, *surface);
    copy(texcoords, surface->texcoords, clean_texcoord);
    copy(texcoords1, surface->texcoords1, clean_texcoord);
    const auto data = allocate(surface, &scene.memory);
    copy(positions, data->positions, as_it_is);
    copy(normals, data->normals, clean_direction<math::Vec3>);
    copy(tangents, data->tangents, clean_tangent);
    return data;
}

MeshDataPointer update_mesh_data(scene::Scene& scene, const MeshData& old,
                                 const rt_mesh_update& update) {
    const uint64_t vertices = old.positions.size();
    const auto positions =
        per_vertex<math::Vec3>(update.positions, "rt_mesh_update.positions", vertices);
    const auto normals = per_vertex<math::Vec3>(update.normals, "rt_mesh_update.normals", vertices);
    const auto tangents =
        per_vertex<math::Vec4>(update.tangents, "rt_mesh_update.tangents", vertices);

    const auto data = allocate(old.surface, &scene.recycled);
    if (positions.absent())
        data->positions = old.positions;
    else
        copy(positions, data->positions, as_it_is);
    if (normals.absent())
        data->normals = old.normals;
    else
        copy(normals, data->normals, clean_direction<math::Vec3>);
    if (tangents.absent())
        data->tangents = old.tangents;
    else
        copy(tangents, data->tangents, clean_tangent);
    return data;
}

} // namespace peregrine::abi
