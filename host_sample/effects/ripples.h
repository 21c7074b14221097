#pragma once

#include <peregrine/rt.h>

#include "stage.h"

namespace host {

// Water whose waves run: a shading program (rt_program_desc), as any host may have. It mirrors by
// Fresnel's law about a normal that the waves tilt. Must outlive the stage that it is added to.
class Ripples {
public:
    // Throws EngineError.
    rt_program add_to(const Stage& stage);

    // Before frames, not during them.
    void set_time(double seconds) { seconds_ = seconds; }

private:
    static void shade(void* user, const rt_program_batch* batch);

    double seconds_ = 0.0;
};

} // namespace host
