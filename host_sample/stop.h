#pragma once

namespace host {

// From now on Ctrl-C, a hang-up and a request to terminate end the program as closing its window
// does: what was asked for is still written. A second one ends it at once.
void stop_on_signals();

bool is_stopped();

} // namespace host
