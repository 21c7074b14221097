#pragma once

#include "level.h"
#include "options.h"
#include "stage.h"

namespace host {

// A layer over the scene's lowest place, of a grey that goes with the ambient light. Throws
// EngineError.
void set_fog(Stage& stage, const Level& level, const Fog& fog, float ambient);

// Lets fog scatter so much of what it takes from the lamps' light: of those that end somewhere.
void light_fog(Level& level, float part);

// Of those alone that shine where a level's mist lies.
void light_mist(Level& level);

// Mist that lies about the places mist_N of a level, whose heights are its top. The engine's fog is
// a layer without sides: it is as dense as the mist is near to the eye.
class Mist {
public:
    Mist(Stage& stage, const Level& level) : stage_(stage), level_(level) {}

    // As it is for an eye there, after the next commit. False if that is as it was. Throws
    // EngineError.
    bool show(const glm::dvec3& eye);
    void hide();

private:
    Stage& stage_;
    const Level& level_;
    float density_ = 0.0f; // as it was shown
};

} // namespace host
