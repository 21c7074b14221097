#pragma once

#include <glm/glm.hpp>

#include "../level.h"
#include "accessor.h"
#include "node_tree.h"

namespace host::gltf {

// About where the scene's meshes lie, before any of them is read: boxes around boxes, without
// morphing, instances and the other joints of a skin than the first. Throws InputError.
Bounds estimate_extent(const Document& document, const NodeTree& tree, Accessors& accessors);

// The point that what is stored in floats is best relative to: (0, 0, 0) unless the scene lies so
// far from it, for its size, that floats would deform it.
glm::dvec3 choose_origin(const Bounds& extent);

} // namespace host::gltf
