#pragma once

#include <filesystem>
#include <string>
#include <string_view>

// Files that appear whole or not at all: what was there before stays if the disk is full.
namespace host {

enum class Durable { no, yes }; // yes: on the disk when it returns

// To a temporary file beside it that then takes its place. What is no regular file (a pipe, a
// device) and what stands in a folder that takes no new files is written in place. Returns why it
// cannot be written, as the system says it, or nothing.
std::string write_whole_file(const std::filesystem::path& path, std::string_view bytes,
                             Durable durable = Durable::no);

// Whether that would work now, for something that is written much later. Leaves nothing behind.
std::string try_whole_file(const std::filesystem::path& path);

} // namespace host
