#pragma once

#include "../level.h"
#include "accessor.h"
#include "budget.h"
#include "node_tree.h"
#include "notes.h"
#include "rig.h"

namespace host::gltf {

// Bakes every mesh of the scene's nodes that stands still to world space: a Level mesh a node (two
// or more where its primitives differ in the attributes that cannot be padded), materials by the
// file's numbers. The others become rigid or deforming meshes. Chooses the level's origin. Throws
// InputError.
void import_geometry(const Document& document, const NodeTree& tree, Accessors& accessors,
                     RigBuilder& rig, Budget& budget, Level& level, Notes& notes);

} // namespace host::gltf
