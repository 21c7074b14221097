#pragma once

#include <vector>

#include "level.h"
#include "stage.h"

namespace host {

// What of a level the engine knows and the host moves, in the level's order.
struct Uploaded {
    // One for each node that the mesh stands at, then one for each of its places.
    std::vector<std::vector<rt_mesh>> rigid_meshes;
    std::vector<rt_mesh> deforming_meshes;
    std::vector<rt_light> lights;
};

// Describes a level to the engine, with an ambient light of the given strength and a background
// that suits it. Materials that are called water get that program. Throws EngineError.
Uploaded upload_level(Stage& stage, const Level& level, float ambient, rt_program water = {});

// Only the rigid meshes and what they look like; in these layers. Throws EngineError.
Uploaded upload_rigid_meshes(Stage& stage, const Level& level, uint32_t layer_mask);

// Calls of the engine want arrays of components; GLM's vectors are exactly that.
template <class T>
rt_array to_array(const std::vector<T>& values) {
    return {values.empty() ? nullptr : values.data(), values.size(), 0, 0};
}

rt_light_desc describe_light(const Light& light);

// False for a transform without inverse, which the engine refuses: nothing of the mesh could be
// seen there. Throws EngineError.
bool place_mesh(const Stage& stage, rt_mesh mesh, const glm::dmat4& world);

} // namespace host
