#pragma once

#include <optional>
#include <vector>

#include <glm/glm.hpp>
#include <tiny_gltf.h>

#include "accessor.h"
#include "budget.h"
#include "notes.h"

namespace host::gltf {

// EXT_mesh_gpu_instancing: where the node's mesh stands, relative to the node. Nothing if the node
// has no such extension. Throws InputError if its accessors are missing or disagree.
std::optional<std::vector<glm::dmat4>>
read_instances(const tinygltf::Node& node, Accessors& accessors, Budget& budget, Notes& notes);

} // namespace host::gltf
