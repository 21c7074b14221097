#include "loading.h"

#include <cmath>
#include <iostream>

#include "cameras.h"
#include "emissive_lamps.h"
#include "error.h"
#include "paths.h"

namespace host {

namespace {

void add_emissive_lamps(Level& level, uint32_t most) {
    const EmissiveLamps found = find_emissive_lamps(level, most);
    level.lights.insert(level.lights.end(), found.lights.begin(), found.lights.end());
    if (found.left_out > 0.0)
        level.notes.push_back(
            std::to_string(std::lround(100.0 * found.left_out / found.power))
            + "% of the light of what glows is left out: there is more than --emissive-lamps");
}

} // namespace

Level load_level(const Options& options, const std::string& animation,
                 const gltf::NodeFilter& moved) {
    Level level = gltf::import_file(
        options.scene.empty() ? content_file("hall.glb") : options.scene, animation, moved);
    if (level.triangle_count() == 0)
        throw InputError("the scene file " + level.name + " has no triangles to show");
    if (options.emissive_lamps > 0 && !options.game())
        add_emissive_lamps(level, options.emissive_lamps);
    if (level.lights.empty()) {
        level.lights.push_back(default_light());
        level.notes.push_back("the scene has no lights and gets a sun");
    }
    if (!options.quiet)
        for (const std::string& note : level.notes) std::cerr << "note: " << note << "\n";
    return level;
}

} // namespace host
