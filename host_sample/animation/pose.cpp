#include "pose.h"

#include <algorithm>
#include <cmath>

#include <glm/ext/matrix_transform.hpp>

namespace host {

Pose::Pose(const Rig& rig) : rig_(rig), world_(rig.nodes.size()) {
    for (const RigNode& node : rig.nodes) {
        local_.push_back(node.rest);
        weights_.push_back(node.weights);
    }
    place_nodes();
}

void Pose::set(double seconds) {
    for (const Clip& clip : rig_.clips) {
        const double time = clip.duration > 0.0 ? std::fmod(seconds, clip.duration) : 0.0;
        for (const Track& track : clip.tracks) apply(track, time);
    }
    place_nodes();
}

void Pose::apply(const Track& track, double seconds) {
    if (track.property == Property::weights) {
        std::vector<double>& weights = weights_[track.node];
        weights.resize(std::max<size_t>(weights.size(), track.width));
        sample(track, seconds, weights);
        return;
    }
    double value[4] = {};
    sample(track, seconds, value);
    Local& local = local_[track.node];
    if (track.property == Property::rotation)
        local.rotation = glm::dquat(value[3], value[0], value[1], value[2]);
    else
        (track.property == Property::scale ? local.scale : local.translation) =
            glm::dvec3(value[0], value[1], value[2]);
}

void Pose::place_nodes() {
    for (size_t i = 0; i < rig_.nodes.size(); ++i) {
        const RigNode& node = rig_.nodes[i];
        world_[i] = node.parent == no_index ? node.before : world_[node.parent] * node.before;
        if (node.driven) world_[i] = world_[i] * to_matrix(local_[i]);
    }
}

glm::dmat4 to_matrix(const Local& local) {
    glm::dmat4 matrix = glm::mat4_cast(local.rotation);
    for (int axis = 0; axis < 3; ++axis) matrix[axis] *= local.scale[axis];
    matrix[3] = glm::dvec4(local.translation, 1.0);
    return matrix;
}

glm::dmat4 relative_to(const glm::dvec3& origin, glm::dmat4 world) {
    world[3] -= glm::dvec4(origin, 0.0);
    return world;
}

glm::mat4x3 to_affine(const glm::dmat4& matrix) {
    return glm::mat4x3(glm::vec3(matrix[0]), glm::vec3(matrix[1]), glm::vec3(matrix[2]),
                       glm::vec3(matrix[3]));
}

void joint_matrices(const DeformingMesh& mesh, const Pose& pose, std::vector<glm::mat4x3>& out,
                    const glm::dvec3& origin) {
    out.clear();
    for (const Joint& joint : mesh.joints)
        out.push_back(to_affine(relative_to(origin, pose.world(joint.node) * joint.inverse_bind)));
}

} // namespace host
