#pragma once

#include <peregrine/rt.h>

#include "level.h"
#include "session.h"

namespace host {

// How an eye takes a view.
struct Sight {
    float key = 0.11f;       // where the mean is to be: below middle grey, for lamps to glow
    float adaptation = 0.7f; // 0: none, 1: every view gets the same mean
};
constexpr Sight night_sight{0.075f, 0.4f}; // what is dark stays dark

// Exposure as an eye adapts (rt_adapt_exposure), by small pictures of the view. Adapts in part
// only, so that a dark hall stays darker than a courtyard. --exposure fixes it.
class Exposure {
public:
    explicit Exposure(const Session& session, const Sight& sight = {});

    // Adapted to this view at once.
    float settle(const Viewpoint& viewpoint);

    // Drifts to what this view, or that of a moment ago, asks for, over about a second.
    float drift(const Viewpoint& viewpoint, double seconds);

private:
    void measure(const Viewpoint& viewpoint);
    float adapt(double seconds);

    const Session& session_;
    rt_exposure eye_ = rt_default_exposure();
    float mean_ = 0.0f; // luminance, when it was measured
    double age_ = 0.0;  // seconds since
};

} // namespace host
