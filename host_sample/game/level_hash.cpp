#include "level_hash.h"

#include "gameplay/state_hash.h"

#include <bit>

namespace host::game {

namespace {

using gameplay::StateHash;

void add(StateHash& hash, const Mesh& mesh) {
    hash.add(uint64_t{mesh.positions.size()});
    for (const glm::vec3& position : mesh.positions)
        for (int k = 0; k < 3; ++k) hash.add(std::bit_cast<uint32_t>(position[k]));
    hash.add(uint64_t{mesh.indices.size()});
    for (const uint32_t index : mesh.indices) hash.add(index);
}

void add(StateHash& hash, const three_cores::Part& part) {
    hash.add(uint64_t{part.meshes.size()});
    for (const double element : part.rest.m) hash.add(element);
    hash.add(part.lower);
    hash.add(part.upper);
}

void add(StateHash& hash, std::span<const gameplay::Vec3> places) {
    hash.add(uint64_t{places.size()});
    for (const gameplay::Vec3& place : places) hash.add(place);
}

void add(StateHash& hash, const three_cores::Lamp& lamp) {
    hash.add(static_cast<uint32_t>(lamp.kind));
    hash.add(lamp.position);
    hash.add(lamp.direction);
    for (const double number : {lamp.radius, lamp.candela, lamp.cos_inner, lamp.cos_outer})
        hash.add(number);
}

void add(StateHash& hash, const three_cores::Plan& plan) {
    for (const auto* parts : {&plan.doors, &plan.crates, &plan.gates})
        for (const three_cores::Part& part : *parts) add(hash, part);
    for (const three_cores::LiftPlan& lift : plan.lifts) {
        add(hash, lift.part);
        hash.add(lift.top);
    }
    for (const three_cores::Spawn& spawn : plan.spawns) {
        hash.add(spawn.feet);
        hash.add(spawn.forward);
    }
    add(hash, plan.cores);
    add(hash, plan.exits);
    for (const auto& way : plan.patrols) add(hash, way);
    for (const three_cores::Lamp& lamp : plan.lamps) add(hash, lamp);
}

} // namespace

uint64_t hash_of(const three_cores::Plan& plan, const Level& level) {
    StateHash hash;
    if (level.origin != glm::dvec3(0.0)) hash.add(level.origin);
    for (const Mesh& mesh : level.meshes) add(hash, mesh);
    for (const RigidMesh& rigid : level.rigid_meshes) {
        add(hash, rigid.mesh);
        for (const glm::dmat4& place : rigid.places)
            for (int column = 0; column < 4; ++column) hash.add(glm::dvec3(place[column]));
    }
    for (const DeformingMesh& deforming : level.deforming_meshes) add(hash, deforming.mesh);
    add(hash, plan);
    return hash.value();
}

} // namespace host::game
