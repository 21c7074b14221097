#pragma once

#include <filesystem>
#include <string>

namespace host {

// Where this program lies; the current folder if that cannot be told.
std::filesystem::path executable_folder();

// The scene that is shown when none is named. Throws InputError if it is nowhere to be found.
std::string default_scene();

} // namespace host
