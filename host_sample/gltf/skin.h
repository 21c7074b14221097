#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>
#include <tiny_gltf.h>

#include "../animation/rig.h"
#include "accessor.h"

namespace host::gltf {

struct Skin {
    std::vector<uint32_t> nodes; // one a joint
    std::vector<glm::dmat4> inverse_bind;
};

// Throws InputError.
Skin read_skin(const tinygltf::Model& model, Accessors& accessors, int skin);

// The joints of each vertex with the file's weights, those above zero.
struct Influences {
    std::vector<uint32_t> first; // one a vertex, and the end
    std::vector<Influence> list;
};

// Those of the given vertices; nothing if the primitive has no JOINTS_0 and WEIGHTS_0. Throws
// InputError for a joint that the skin does not have.
std::optional<Influences> read_influences(Accessors& accessors, const tinygltf::Primitive& source,
                                          std::span<const uint32_t> vertices, size_t joint_count);

} // namespace host::gltf
