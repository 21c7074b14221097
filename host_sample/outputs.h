#pragma once

#include "options.h"

namespace host {

// Whether the files that the options ask for can be written, before hours of play or of rendering
// go into them. Throws InputError.
void check_outputs(const Options& options);

} // namespace host
