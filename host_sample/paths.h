#pragma once

#include <filesystem>
#include <string>

namespace host {

// Where this program lies; the current folder if that cannot be told.
std::filesystem::path executable_folder();

// A file of the folder "content". Throws InputError if it is nowhere to be found.
std::string content_file(const std::string& name);

} // namespace host
