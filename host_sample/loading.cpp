#include "loading.h"

#include <iostream>

#include "cameras.h"
#include "error.h"
#include "paths.h"

namespace host {

Level load_level(const Options& options, const std::string& animation,
                 const gltf::NodeFilter& moved) {
    Level level = gltf::import_file(
        options.scene.empty() ? content_file("hall.glb") : options.scene, animation, moved);
    if (level.triangle_count() == 0)
        throw InputError("the scene file " + level.name + " has no triangles to show");
    if (level.lights.empty()) {
        level.lights.push_back(default_light());
        level.notes.push_back("the scene has no lights and gets a sun");
    }
    if (!options.quiet)
        for (const std::string& note : level.notes) std::cerr << "note: " << note << "\n";
    return level;
}

} // namespace host
