#pragma once

#include "peregrine/rt.h"
#include "scene/scene.h"

#include <memory>

namespace peregrine::abi {

using MeshDataPointer = std::shared_ptr<const scene::MeshData>;

// The arrays of a mesh, checked and copied. Throws base::Error that names the field and, of an
// array, the first element that is wrong.
MeshDataPointer make_mesh_data(scene::Scene& scene, const rt_mesh_desc& desc);

// A copy of `old` with the vertices of the update.
MeshDataPointer update_mesh_data(scene::Scene& scene, const scene::MeshData& old,
                                 const rt_mesh_update& update);

} // namespace peregrine::abi
