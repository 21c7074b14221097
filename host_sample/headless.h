#pragma once

#include "session.h"

namespace host {

inline const std::string flight_pictures = "out/frame_%04d.png";

// Renders without a window what the options ask for: pictures of one camera to --out, or a
// fly-through of all cameras to out/. Throws InputError or EngineError.
void run_headless(Session& session);

// The fly-through, whatever --out says: what a session without a display falls back to.
void run_flight(Session& session, const std::string& pattern);

// Writes one frame of the viewpoint. Throws InputError or EngineError.
void write_picture(const Session& session, const Viewpoint& viewpoint, const Frame& frame,
                   const std::string& path);

} // namespace host
