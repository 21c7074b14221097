#pragma once

#include <tiny_gltf.h>

#include "../level.h"
#include "node_tree.h"
#include "notes.h"
#include "rig.h"

namespace host::gltf {

// The things that a node places besides its mesh: lights, cameras, spawn points (nodes without a
// mesh whose name begins with "spawn_") and other places with a name. Needs level.bounds. Throws
// InputError.
void import_placed(const tinygltf::Model& model, const NodeTree& tree, RigBuilder& rig,
                   Level& level, Notes& notes);

} // namespace host::gltf
