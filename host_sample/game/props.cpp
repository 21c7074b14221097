#include "props.h"

#include <algorithm>

#include "gameplay/three_cores/rules.h"

#include "../animation/pose.h"
#include "../error.h"
#include "../gltf/import.h"
#include "../transform.h"
#include "../upload.h"
#include "aliases.h"

namespace host::game {

namespace {

constexpr const char* names[] = {"drone", "drone_off", "core", "grenade", "bolt"};

// The node of this name that the node is or hangs from; no_index: none.
uint32_t find_root(const Rig& rig, uint32_t node, const std::string& name) {
    while (node != no_index && rig.nodes[node].name != name) node = rig.nodes[node].parent;
    return node;
}

Prop find_prop(Stage& stage, const Level& level, const Uploaded& uploaded,
               const std::string& name) {
    const Pose rest(level.rig);
    Prop prop;
    for (size_t i = 0; i < level.rigid_meshes.size(); ++i)
        for (size_t k = 0; k < level.rigid_meshes[i].nodes.size(); ++k) {
            const uint32_t node = level.rigid_meshes[i].nodes[k];
            const uint32_t root = find_root(level.rig, node, name);
            if (root == no_index) continue;
            const rt_mesh mesh = uploaded.rigid_meshes[i][k];
            stage.check(stage.api().set_mesh_hidden(stage.scene(), mesh, 1), "hiding a mesh");
            prop.pieces.push_back({mesh, glm::inverse(rest.world(root)) * rest.world(node)});
        }
    if (prop.pieces.empty())
        throw InputError("the file " + level.name + " has no node \"" + name + "\" with a mesh");
    return prop;
}

} // namespace

Props find_props(Stage& stage, const Level& level) {
    const Uploaded uploaded = upload_rigid_meshes(stage, level, three_cores::kShown);
    Prop props[std::size(names)];
    for (size_t i = 0; i < std::size(names); ++i)
        props[i] = find_prop(stage, level, uploaded, names[i]);
    return {props[0], props[1], props[2], props[3], props[4]};
}

Props load_props(Stage& stage, const std::filesystem::path& path) {
    return find_props(
        stage, gltf::import_file(path, gltf::no_animation, [](const std::string& node) {
            return std::ranges::any_of(names, [&](const char* name) { return node == name; });
        }));
}

void PropPool::show(std::span<const glm::dmat4> places) {
    while (instances_.size() < places.size()) grow();
    for (size_t i = 0; i < instances_.size(); ++i) {
        set_shown(instances_[i], i < places.size());
        if (i >= places.size()) continue;
        for (size_t k = 0; k < prop_.pieces.size(); ++k) {
            const rt_transform place = to_transform(places[i] * prop_.pieces[k].place);
            stage_.check(
                stage_.api().set_mesh_transform(stage_.scene(), instances_[i].meshes[k], &place),
                "moving a mesh");
        }
    }
}

void PropPool::grow() {
    Instance& instance = instances_.emplace_back();
    for (const Prop::Piece& piece : prop_.pieces) {
        rt_mesh mesh{};
        stage_.check(stage_.api().add_mesh_instance(stage_.scene(), piece.mesh, &mesh),
                     "adding an instance of a mesh");
        stage_.check(stage_.api().set_mesh_hidden(stage_.scene(), mesh, 1), "hiding a mesh");
        instance.meshes.push_back(mesh);
    }
}

void PropPool::set_shown(Instance& instance, bool shown) {
    if (instance.shown == shown) return;
    instance.shown = shown;
    for (const rt_mesh mesh : instance.meshes)
        stage_.check(stage_.api().set_mesh_hidden(stage_.scene(), mesh, shown ? 0 : 1),
                     "showing or hiding a mesh");
}

} // namespace host::game
