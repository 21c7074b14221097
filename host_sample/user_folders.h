#pragma once

#include <filesystem>

namespace host {

// Where the user's files of this program belong, after the XDG Base Directory Specification; empty
// if the environment names no home.
std::filesystem::path config_folder(); // $XDG_CONFIG_HOME/peregrine or ~/.config/peregrine
std::filesystem::path data_folder();   // $XDG_DATA_HOME/peregrine or ~/.local/share/peregrine

} // namespace host
