#pragma once

#include <vector>

#include <peregrine/rt.h>

#include "effects/fires.h"
#include "effects/mist.h"
#include "level.h"
#include "stage.h"

namespace host {

// What a level's names ask for beside its surfaces and lamps: fires that flicker, spray, mist.
class LevelEffects {
public:
    // `lights`: handles of the level's, in its order. All must outlive this.
    LevelEffects(Stage& stage, const Level& level, const std::vector<rt_light>& lights,
                 bool has_mist = true)
        : stage_(stage), level_(level), lights_(lights), fires_(level), mist_(stage, level),
          has_mist_(has_mist) {}

    // As it is after so many seconds.
    void add_particles(double seconds, std::vector<rt_particle>& particles) const;

    // Light of fires, and mist for an eye there, after the next commit. False if nothing changes.
    // Throws EngineError.
    bool describe(double seconds, const glm::dvec3& eye);
    void hide_mist() { mist_.hide(); }

private:
    Stage& stage_;
    const Level& level_;
    const std::vector<rt_light>& lights_;
    Fires fires_;
    Mist mist_;
    bool has_mist_;
};

} // namespace host
