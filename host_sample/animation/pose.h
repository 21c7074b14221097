#pragma once

#include <span>

#include "rig.h"

namespace host {

// Where the nodes of a rig are at a time: at rest until the first set().
class Pose {
public:
    explicit Pose(const Rig& rig);

    void set(double seconds); // not negative

    const glm::dmat4& world(uint32_t node) const { return world_[node]; }
    std::span<const double> weights(uint32_t node) const { return weights_[node]; }

private:
    void apply(const Track& track, double seconds);
    void place_nodes();

    const Rig& rig_;
    std::vector<Local> local_;
    std::vector<glm::dmat4> world_;
    std::vector<std::vector<double>> weights_;
};

glm::dmat4 to_matrix(const Local& local);

// The same place, relative to a point of the world.
glm::dmat4 relative_to(const glm::dvec3& origin, glm::dmat4 world);

glm::mat4x3 to_affine(const glm::dmat4& matrix);

// The matrices of a deforming mesh's joints: from the space of its vertices to the world, relative
// to `origin`.
void joint_matrices(const DeformingMesh& mesh, const Pose& pose, std::vector<glm::mat4x3>& out,
                    const glm::dvec3& origin = glm::dvec3(0.0));

} // namespace host
