#include "level_effects.h"

#include "effects/spray.h"
#include "upload.h"

namespace host {

void LevelEffects::add_particles(double seconds, std::vector<rt_particle>& particles) const {
    fires_.add(seconds, particles);
    add_spray(level_, seconds, particles);
}

bool LevelEffects::describe(double seconds, const glm::dvec3& eye) {
    for (const Fires::Fire& fire : fires_.all()) {
        Light light = fire.light;
        light.intensity *= flicker(fire, seconds);
        const rt_light_desc desc = describe_light(light);
        stage_.check(stage_.api().update_light(stage_.scene(), lights_[fire.lamp], &desc),
                     "a fire's light");
    }
    const bool changed = has_mist_ && mist_.show(eye);
    return changed || !fires_.all().empty();
}

} // namespace host
