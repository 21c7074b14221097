#pragma once

#include <string>
#include <vector>

#include <tiny_gltf.h>

#include "../animation/track.h"
#include "accessor.h"
#include "budget.h"
#include "notes.h"

namespace host::gltf {

// The clips of `choice`: a name, else an index; empty for all, "none" for none. Their tracks name
// nodes by the file's numbers. A channel that cannot be used is left out with a note. Throws
// InputError if there is no such clip.
std::vector<Clip> import_clips(const tinygltf::Model& model, const std::string& choice,
                               Accessors& accessors, Budget& budget, Notes& notes);

} // namespace host::gltf
