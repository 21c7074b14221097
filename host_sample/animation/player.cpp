#include "player.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "../cameras.h"

namespace host {

namespace {

template <class Work>
auto timed(Durations& durations, const Work& work) {
    struct Stopwatch {
        using Clock = std::chrono::steady_clock;
        Durations& durations;
        Clock::time_point begin = Clock::now();
        ~Stopwatch() {
            durations.add(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
        }
    } stopwatch{durations};
    return work();
}

} // namespace

Player::Player(Stage& stage, const Level& level, Uploaded uploaded)
    : stage_(stage), level_(level), uploaded_(std::move(uploaded)), pose_(level.rig),
      deformed_(level.deforming_meshes.size()), lights_(level.lights) {
    for (size_t i = 0; i < level.rigid_meshes.size(); ++i)
        for (size_t k = 0; k < level.rigid_meshes[i].nodes.size(); ++k)
            placed_.push_back(
                {uploaded_.rigid_meshes[i][k], level.rigid_meshes[i].nodes[k], glm::dmat4(1.0)});
}

bool Player::describe(double seconds) {
    time_ = seconds;
    if (!animated() && placed_.empty()) return false;
    timed(log_.pose, [&] { pose_.set(seconds); });
    timed(log_.skinning, [&] { deform_meshes(); });
    return timed(log_.update, [&] {
        const bool moved = move_rigid(), deformed = update_deformed(), lit = move_lights();
        return moved || deformed || lit;
    });
}

void Player::show(double seconds, rt_structure structure, rt_build_quality quality, bool changed) {
    const bool moved = describe(seconds);
    if (!moved && !changed) return;
    timed(log_.commit, [&] { stage_.commit(structure, quality, nullptr); });
}

Viewpoint Player::follow(const Viewpoint& camera) const {
    Viewpoint now = camera;
    if (camera.node == no_index) return now;
    if (const auto place = look_along(pose_.world(camera.node))) {
        now.position = place->position;
        now.forward = place->forward;
        now.up = place->up;
    }
    return now;
}

void Player::deform_meshes() {
    std::vector<glm::mat4x3> joints;
    for (size_t i = 0; i < deformed_.size(); ++i) {
        const DeformingMesh& mesh = level_.deforming_meshes[i];
        Deformed& last = deformed_[i];
        joint_matrices(mesh, pose_, joints, level_.origin);
        const auto weights = pose_.weights(mesh.node);
        last.changed = joints != last.joints || !std::ranges::equal(weights, last.weights);
        if (!last.changed) continue;
        std::swap(joints, last.joints);
        last.weights.assign(weights.begin(), weights.end());
        deform(mesh, last.joints, last.weights, last.shape);
    }
}

bool Player::update_deformed() {
    bool changed = false;
    for (size_t i = 0; i < deformed_.size(); ++i) {
        if (!deformed_[i].changed) continue;
        const Shape& shape = deformed_[i].shape;
        rt_mesh_update update = rt_default_mesh_update();
        update.positions = to_array(shape.positions);
        update.normals = to_array(shape.normals);
        update.tangents = to_array(shape.tangents);
        stage_.check(stage_.api().update_dynamic_mesh(stage_.scene(), uploaded_.deforming_meshes[i],
                                                      &update),
                     "moving the vertices of a mesh");
        changed = true;
    }
    return changed;
}

bool Player::move_rigid() {
    bool changed = false;
    for (Placed& placed : placed_) {
        const glm::dmat4& world = pose_.world(placed.node);
        if (placed.told && placed.world == world) continue;
        placed.world = world;
        placed.told = true;
        move(placed);
        changed = true;
    }
    return changed;
}

// Animations often scale things to nothing to make them disappear: hidden for as long.
void Player::move(Placed& placed) const {
    const bool hidden = !place_mesh(stage_, placed.mesh, placed.world);
    if (hidden == placed.hidden) return;
    stage_.check(stage_.api().set_mesh_hidden(stage_.scene(), placed.mesh, hidden ? 1 : 0),
                 "hiding a mesh that is scaled to nothing");
    placed.hidden = hidden;
}

bool Player::move_lights() {
    bool changed = false;
    for (size_t i = 0; i < lights_.size(); ++i) {
        Light& light = lights_[i];
        if (light.node == no_index) continue;
        const auto place = look_along(pose_.world(light.node));
        if (!place || (place->position == light.position && place->forward == light.direction))
            continue;
        light.position = place->position;
        light.direction = place->forward;
        const rt_light_desc desc = describe_light(light);
        stage_.check(stage_.api().update_light(stage_.scene(), uploaded_.lights[i], &desc),
                     "moving a light");
        changed = true;
    }
    return changed;
}

} // namespace host
