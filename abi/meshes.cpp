#include "check.h"
#include "guard.h"
#include "mesh_data.h"
#include "read_struct.h"
#include "scene_table.h"

namespace peregrine::abi {
namespace {

using base::Code;
using base::fail;
using scene::MeshDescription;
using scene::MeshKind;

rt_mesh add(scene::Scene& scene, const rt_mesh_desc& desc, MeshKind kind) {
    MeshDescription mesh;
    mesh.data = make_mesh_data(scene, desc);
    mesh.layer_mask = desc.layer_mask;
    mesh.kind = kind;
    mesh.user_data = desc.user_data;
    if (kind == MeshKind::rigid) mesh.stand({}, scene.origin());
    if (kind != MeshKind::fixed)
        mesh.shape = std::allocate_shared<scene::Shape>(
            std::pmr::polymorphic_allocator<scene::Shape>(&scene.memory));
    const base::Handle handle = scene.meshes.insert(std::move(mesh));
    scene.touch_triangles(kind);
    return to_host<rt_mesh>(handle);
}

MeshDescription& find(scene::Scene& scene, rt_mesh mesh) {
    return require_object(scene.meshes, to_handle(mesh), "rt_mesh", "mesh");
}

MeshDescription& find_rigid(scene::Scene& scene, rt_mesh handle) {
    MeshDescription& mesh = find(scene, handle);
    if (mesh.kind != MeshKind::rigid)
        fail(Code::invalid_argument,
             "rt_mesh {%u, %u} is not rigid; rt_add_rigid_mesh makes meshes that move as a whole",
             handle.index, handle.generation);
    return mesh;
}

void update(scene::Scene& scene, rt_mesh handle, const rt_mesh_update& update) {
    MeshDescription& mesh = find(scene, handle);
    if (mesh.kind != MeshKind::deforming)
        fail(Code::invalid_argument,
             "rt_mesh {%u, %u} is %s; rt_add_dynamic_mesh makes meshes whose vertices move",
             handle.index, handle.generation, mesh.kind == MeshKind::fixed ? "static" : "rigid");
    require_zero(update.reserved, "rt_mesh_update.reserved");
    mesh.data = update_mesh_data(scene, *mesh.data, update);
    if (update.positions.count == 0) return; // the structure knows no normals
    mesh.shape->geometry = nullptr;
    mesh.extent_is_known = false;
}

rt_mesh add_instance(scene::Scene& scene, rt_mesh of) {
    MeshDescription instance = find_rigid(scene, of);
    return to_host<rt_mesh>(scene.meshes.insert(std::move(instance)));
}

math::Affine to_affine(const rt_transform& transform) {
    for (int i = 0; i < 12; ++i)
        if (!(std::fabs(transform.m[i]) <= 1e30))
            fail(Code::invalid_argument,
                 "rt_transform.m[%d] is %g; it must be finite and at most 1e30 in magnitude", i,
                 transform.m[i]);
    math::Affine affine;
    for (int row = 0; row < 3; ++row) {
        const double* m = transform.m + 4 * row;
        for (int k = 0; k < 3; ++k) affine.column[k][row] = m[k];
        affine.offset[row] = m[3];
    }
    const scene::Placement placement = scene::place(affine, math::Vec3d(0));
    if (!(placement.condition <= 1e9) || !(glm::length(placement.to_local.offset) <= 1e300))
        fail(Code::invalid_argument,
             "the rt_transform has no inverse, or stretches one direction more than 1e9 times as "
             "much as another");
    return affine;
}

void set_hidden(scene::Scene& scene, rt_mesh handle, uint32_t hidden) {
    MeshDescription& mesh = find(scene, handle);
    if (hidden > 1) fail(Code::invalid_argument, "hidden is %u; it must be 0 or 1", hidden);
    if (mesh.hidden == (hidden != 0)) return;
    mesh.hidden = hidden != 0;
    scene.touch_triangles(mesh.kind);
}

rt_result add_guarded(rt_scene scene, const rt_mesh_desc* desc, rt_mesh* out_mesh,
                      MeshKind kind) noexcept {
    return guard([&] {
        HostScene& host = find_scene(scene);
        require_pointer(out_mesh, "out_mesh");
        *out_mesh = add(host.scene, read_struct(desc), kind);
    });
}

} // namespace
} // namespace peregrine::abi

using namespace peregrine::abi;
using peregrine::scene::MeshKind;

rt_result rt_add_static_mesh(rt_scene scene, const rt_mesh_desc* desc, rt_mesh* out_mesh) noexcept {
    return add_guarded(scene, desc, out_mesh, MeshKind::fixed);
}

rt_result rt_add_dynamic_mesh(rt_scene scene, const rt_mesh_desc* desc,
                              rt_mesh* out_mesh) noexcept {
    return add_guarded(scene, desc, out_mesh, MeshKind::deforming);
}

rt_result rt_add_rigid_mesh(rt_scene scene, const rt_mesh_desc* desc, rt_mesh* out_mesh) noexcept {
    return add_guarded(scene, desc, out_mesh, MeshKind::rigid);
}

rt_result rt_add_mesh_instance(rt_scene scene, rt_mesh mesh, rt_mesh* out_mesh) noexcept {
    return guard([&] {
        HostScene& host = find_scene(scene);
        require_pointer(out_mesh, "out_mesh");
        *out_mesh = add_instance(host.scene, mesh);
    });
}

rt_result rt_update_dynamic_mesh(rt_scene scene, rt_mesh mesh,
                                 const rt_mesh_update* mesh_update) noexcept {
    return guard([&] { update(find_scene(scene).scene, mesh, read_struct(mesh_update)); });
}

rt_result rt_set_mesh_transform(rt_scene scene, rt_mesh mesh,
                                const rt_transform* transform) noexcept {
    return guard([&] {
        HostScene& host = find_scene(scene);
        auto& rigid = find_rigid(host.scene, mesh);
        require_pointer(transform, "transform");
        rigid.stand(to_affine(*transform), host.scene.origin());
    });
}

rt_result rt_set_mesh_layer_mask(rt_scene scene, rt_mesh mesh, uint32_t layer_mask) noexcept {
    return guard([&] { find(find_scene(scene).scene, mesh).layer_mask = layer_mask; });
}

rt_result rt_set_mesh_user_data(rt_scene scene, rt_mesh mesh, uint64_t user_data) noexcept {
    return guard([&] { find(find_scene(scene).scene, mesh).user_data = user_data; });
}

rt_result rt_set_mesh_hidden(rt_scene scene, rt_mesh mesh, uint32_t hidden) noexcept {
    return guard([&] { set_hidden(find_scene(scene).scene, mesh, hidden); });
}

rt_result rt_remove_mesh(rt_scene scene, rt_mesh mesh) noexcept {
    return guard([&] {
        HostScene& host = find_scene(scene);
        const MeshKind kind = find(host.scene, mesh).kind;
        host.scene.meshes.erase(to_handle(mesh));
        host.scene.touch_triangles(kind);
    });
}
