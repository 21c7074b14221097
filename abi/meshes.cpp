#include "check.h"
#include "guard.h"
#include "mesh_data.h"
#include "read_struct.h"
#include "scene_table.h"

namespace peregrine::abi {
namespace {

rt_mesh add(scene::Scene& scene, const rt_mesh_desc& desc, bool dynamic) {
    MeshDataPointer data = make_mesh_data(scene, desc);
    const base::Handle mesh =
        scene.meshes.insert({std::move(data), desc.layer_mask, dynamic, desc.user_data});
    scene.touch_geometry();
    return to_host<rt_mesh>(mesh);
}

void update(scene::Scene& scene, rt_mesh handle, const rt_mesh_update& update) {
    auto& mesh = require_object(scene.meshes, to_handle(handle), "rt_mesh", "mesh");
    if (!mesh.dynamic)
        base::fail(base::Code::invalid_argument,
                   "rt_mesh {%u, %u} is static; rt_add_dynamic_mesh makes meshes that move",
                   handle.index, handle.generation);
    require_zero(update.reserved, "rt_mesh_update.reserved");
    mesh.data = update_mesh_data(scene, *mesh.data, update);
    if (update.positions.count != 0) scene.touch_geometry(); // the structure knows no normals
}

rt_result add_guarded(rt_scene scene, const rt_mesh_desc* desc, rt_mesh* out_mesh,
                      bool dynamic) noexcept {
    return guard([&] {
        HostScene& host = find_scene(scene);
        require_pointer(out_mesh, "out_mesh");
        *out_mesh = add(host.scene, read_struct(desc), dynamic);
    });
}

} // namespace
} // namespace peregrine::abi

using namespace peregrine::abi;

rt_result rt_add_static_mesh(rt_scene scene, const rt_mesh_desc* desc, rt_mesh* out_mesh) noexcept {
    return add_guarded(scene, desc, out_mesh, false);
}

rt_result rt_add_dynamic_mesh(rt_scene scene, const rt_mesh_desc* desc,
                              rt_mesh* out_mesh) noexcept {
    return add_guarded(scene, desc, out_mesh, true);
}

rt_result rt_update_dynamic_mesh(rt_scene scene, rt_mesh mesh,
                                 const rt_mesh_update* mesh_update) noexcept {
    return guard([&] { update(find_scene(scene).scene, mesh, read_struct(mesh_update)); });
}

rt_result rt_remove_mesh(rt_scene scene, rt_mesh mesh) noexcept {
    return guard([&] {
        HostScene& host = find_scene(scene);
        require_object(host.scene.meshes, to_handle(mesh), "rt_mesh", "mesh");
        host.scene.meshes.erase(to_handle(mesh));
        host.scene.touch_geometry();
    });
}
