#include "plan_from_level.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "level_hash.h"
#include "node_names.h"

#include "../animation/pose.h"
#include "../transform.h"

namespace host::game {

namespace {

using three_cores::Lamp;
using three_cores::Part;
using three_cores::Vec3;

using Numbered = std::map<uint32_t, Vec3>;

// What has a role, by number; of two with the same name the first.
struct Named {
    std::map<uint32_t, Part> doors, lifts, gates, crates;
    Numbered cores, tops, exits;
    std::map<uint32_t, Numbered> patrols;
    std::map<uint32_t, three_cores::Spawn> spawns;

    std::map<uint32_t, Part>* parts(Role role) {
        switch (role) {
        case Role::door:
            return &doors;
        case Role::lift:
            return &lifts;
        case Role::gate:
            return &gates;
        case Role::crate:
            return &crates;
        default:
            return nullptr;
        }
    }

    Numbered* places(const NodeName& name) {
        switch (name.role) {
        case Role::core:
            return &cores;
        case Role::lift_top:
            return &tops;
        case Role::gate_exit:
            return &exits;
        case Role::patrol:
            return &patrols[name.number];
        default:
            return nullptr;
        }
    }
};

void grow(Part& part, const Mesh& mesh) {
    const bool first = part.meshes.empty();
    if (first && !mesh.positions.empty()) part.lower = part.upper = Vec3(mesh.positions[0]);
    for (const glm::vec3& position : mesh.positions) {
        part.lower = glm::min(part.lower, Vec3(position));
        part.upper = glm::max(part.upper, Vec3(position));
    }
}

// A node whose mesh became several (mesh_parts.h) is one part. `owners` tells nodes with the same
// name apart.
void gather_parts(const Level& level, const Uploaded& uploaded, Named& named) {
    const Pose rest(level.rig);
    std::map<const Part*, uint32_t> owners;
    for (size_t i = 0; i < level.rigid_meshes.size(); ++i) {
        const RigidMesh& rigid = level.rigid_meshes[i];
        for (size_t k = 0; k < rigid.nodes.size(); ++k) {
            const uint32_t node = rigid.nodes[k];
            const auto name = parse_node_name(level.rig.nodes[node].name);
            auto* parts = name ? named.parts(name->role) : nullptr;
            if (!parts) continue;
            Part& part = (*parts)[name->number];
            if (owners.try_emplace(&part, node).first->second != node) continue;
            grow(part, rigid.mesh);
            part.meshes.push_back(uploaded.rigid_meshes[i][k]);
            part.rest = to_transform(rest.world(node));
        }
    }
}

void gather_places(const Level& level, Named& named) {
    for (const Viewpoint& place : level.places) {
        const auto name = parse_node_name(place.name);
        Numbered* places = name ? named.places(*name) : nullptr;
        const uint32_t number = name && name->role == Role::patrol ? name->step : name->number;
        if (places) places->try_emplace(number, place.position);
    }
    for (const Viewpoint& place : level.spawns) {
        const auto name = parse_node_name(place.name);
        if (!name) continue;
        three_cores::Spawn spawn;
        spawn.feet = place.position - Vec3(0, spawn_eye_height, 0);
        const Vec3 ahead(place.forward.x, 0, place.forward.z);
        if (glm::dot(ahead, ahead) > 1e-6) spawn.forward = glm::normalize(ahead);
        named.spawns.try_emplace(name->number, spawn);
    }
}

double rounded(double value) {
    return std::round(value * 4096) / 4096;
}

Lamp lamp_of(const Light& light) {
    Lamp lamp;
    lamp.kind = light.type == LightType::point  ? Lamp::Kind::point
                : light.type == LightType::spot ? Lamp::Kind::spot
                                                : Lamp::Kind::sun;
    lamp.position = light.position;
    lamp.direction = glm::normalize(Vec3(light.direction));
    lamp.radius = static_cast<double>(light.radius);
    lamp.candela = three_cores::luminance(Vec3(light.intensity));
    lamp.cos_outer = rounded(static_cast<double>(light.cone_outer_cos));
    lamp.cos_inner =
        std::max(rounded(static_cast<double>(light.cone_inner_cos)), lamp.cos_outer + 1e-3);
    return lamp;
}

template <class T>
std::vector<T> values_of(const std::map<uint32_t, T>& numbered) {
    std::vector<T> values;
    for (const auto& [number, value] : numbered) values.push_back(value);
    return values;
}

Vec3 origin_of(const Part& part) {
    return {part.rest.m[3], part.rest.m[7], part.rest.m[11]};
}

const Vec3& find_or(const Numbered& places, uint32_t number, const Vec3& otherwise) {
    const auto found = places.find(number);
    return found == places.end() ? otherwise : found->second;
}

} // namespace

three_cores::Plan plan_from_level(const Level& level, const Uploaded& uploaded) {
    Named named;
    gather_parts(level, uploaded, named);
    gather_places(level, named);

    three_cores::Plan plan;
    plan.spawns = values_of(named.spawns);
    plan.cores = values_of(named.cores);
    for (const auto& [drone, way] : named.patrols) plan.patrols.push_back(values_of(way));
    plan.doors = values_of(named.doors);
    plan.crates = values_of(named.crates);
    for (const auto& [number, part] : named.lifts)
        plan.lifts.push_back({part, find_or(named.tops, number, origin_of(part))});
    for (const auto& [number, part] : named.gates) {
        plan.gates.push_back(part);
        named.exits.try_emplace(number, origin_of(part));
    }
    plan.exits = values_of(named.exits);
    for (const Light& light : level.lights) plan.lamps.push_back(lamp_of(light));
    plan.lower = level.bounds.lower;
    plan.upper = level.bounds.upper;
    plan.level = hash_of(plan, level);
    return plan;
}

} // namespace host::game
