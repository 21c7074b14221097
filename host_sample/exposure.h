#pragma once

#include "level.h"
#include "session.h"

namespace host {

// Exposure as an eye adapts: a small picture of the view is rendered and its mean brightness
// measured. Adapts in part only, so that a dark hall stays darker than a courtyard. --exposure
// fixes it.
class Exposure {
public:
    explicit Exposure(const Session& session) : session_(session) {}

    // Adapted to this view at once.
    float settle(const Viewpoint& viewpoint);

    // Drifts to what this view asks for, over about a second.
    float drift(const Viewpoint& viewpoint, double seconds);

private:
    float wanted(const Viewpoint& viewpoint) const;

    const Session& session_;
    float current_ = 0.0f; // 0: not yet settled
};

} // namespace host
