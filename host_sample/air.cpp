#include "air.h"

namespace host {

void set_fog(Stage& stage, const Level& level, const Fog& fog, float ambient) {
    rt_fog desc = rt_default_fog();
    desc.density = fog.density;
    desc.bottom = level.bounds.empty() ? 0.0 : level.bounds.lower.y;
    desc.top = desc.bottom + double(fog.top);
    const glm::vec3 color = 2.0f * ambient * glm::vec3(0.9f, 0.95f, 1.1f);
    for (int k = 0; k < 3; ++k) desc.color[k] = color[k];
    stage.check(stage.api().set_fog(stage.scene(), &desc), "setting the fog");
}

} // namespace host
