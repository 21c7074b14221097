#pragma once

#include "session.h"
#include "window.h"

namespace host {

// Shows the session in the window until it is closed or --frames are shown. Throws EngineError or
// InputError.
void run_viewer(Session& session, Window& window);

} // namespace host
