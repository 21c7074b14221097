#pragma once

#include "scene/scene.h"

namespace peregrine::scene {

// Copies the materials that `scene` describes, with handles resolved to places. Throws base::Error
// invalid_argument if a material names a texture that was removed.
std::shared_ptr<const MaterialSet> resolve_materials(Scene& scene);

// What a mesh shows of them. A material that was removed shows as the default one.
std::shared_ptr<const MeshMaterials> resolve_materials(Scene& scene, const MaterialSet& set,
                                                       const MeshData& mesh, MeshKind kind);

} // namespace peregrine::scene
