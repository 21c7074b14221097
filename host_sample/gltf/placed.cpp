#include "placed.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "../cameras.h"
#include "../error.h"
#include "value.h"

namespace host::gltf {

namespace {

LightType to_type(const std::string& type) {
    if (type == "spot") return LightType::spot;
    return type == "directional" ? LightType::directional : LightType::point;
}

// Or lux. Lamps of a thousand metres away, or of a model in centimetres, have millions.
float to_candela(double intensity) {
    if (!std::isfinite(intensity) || intensity < 0.0) return 0.0f;
    return static_cast<float>(std::min(intensity, 1e30));
}

// Without a range a light has no end.
float to_radius(double range) {
    constexpr auto shortest = static_cast<double>(std::numeric_limits<float>::min());
    constexpr auto longest = static_cast<double>(std::numeric_limits<float>::max());
    if (!(range > 0.0) || std::isinf(range)) return std::numeric_limits<float>::infinity();
    return static_cast<float>(std::clamp(range, shortest, longest));
}

void add_light(const tinygltf::Light& source, const Viewpoint& place, Level& level) {
    Light light;
    light.name = place.name;
    light.type = to_type(source.type);
    light.position = place.position;
    light.direction = place.forward;
    light.node = place.node;
    glm::vec3 color(1.0f);
    if (source.color.size() >= 3)
        color = {to_factor(source.color[0]), to_factor(source.color[1]),
                 to_factor(source.color[2])};
    light.intensity = color * to_candela(source.intensity);
    if (light.intensity == glm::vec3(0.0f)) return;
    light.radius = to_radius(source.range);
    const auto angle = [](double a) {
        return std::isfinite(a) ? std::clamp(a, 0.0, 1.5707963) : 0.0;
    };
    light.cone_outer_cos = static_cast<float>(std::cos(angle(source.spot.outerConeAngle)));
    light.cone_inner_cos = std::max(static_cast<float>(std::cos(angle(source.spot.innerConeAngle))),
                                    light.cone_outer_cos);
    level.lights.push_back(light);
}

void add_camera(const tinygltf::Camera& source, Viewpoint view, Level& level, Notes& notes) {
    if (source.type != "perspective") {
        notes.add("orthographic cameras are left out");
        return;
    }
    const double fov = source.perspective.yfov;
    if (fov > 0.01 && fov < 3.1) view.vertical_fov = static_cast<float>(fov);
    if (view.name.empty()) view.name = source.name;
    if (view.name.empty()) view.name = "camera_" + std::to_string(level.cameras.size());
    level.cameras.push_back(view);
}

template <class T>
const T& checked(const std::vector<T>& items, int index, const char* what) {
    if (index < 0 || static_cast<size_t>(index) >= items.size())
        throw InputError(std::string(what) + " " + std::to_string(index)
                         + " is named but does not exist");
    return items[static_cast<size_t>(index)];
}

void import_node(const tinygltf::Model& model, const tinygltf::Node& node, const glm::dmat4& world,
                 uint32_t rig_node, Level& level, Notes& notes) {
    const auto* punctual = find_extension(node.extensions, "KHR_lights_punctual");
    const bool spawn = node.mesh < 0 && node.name.rfind("spawn_", 0) == 0;
    const bool bare = !punctual && node.camera < 0 && node.mesh < 0 && node.children.empty();
    const bool named = bare && !spawn && !node.name.empty();
    if (!punctual && node.camera < 0 && !spawn && !named) return;
    auto place = look_along(world);
    if (!place) {
        if (!named)
            notes.add("a light, camera or spawn point without a usable transform is left out");
        return;
    }
    place->name = node.name;
    place->node = rig_node;
    if (punctual)
        add_light(checked(model.lights, read_index(*punctual, "light"), "light"), *place, level);
    if (node.camera >= 0)
        add_camera(checked(model.cameras, node.camera, "camera"), *place, level, notes);
    if (spawn) level.spawns.push_back(*place);
    if (named) level.places.push_back(*place);
}

} // namespace

void import_placed(const tinygltf::Model& model, const NodeTree& tree, RigBuilder& rig,
                   Level& level, Notes& notes) {
    for (const uint32_t node : tree.scene_nodes)
        import_node(model, model.nodes[node], tree.world[node], rig.find(node), level, notes);
}

} // namespace host::gltf
