#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace host::gltf {

// tinygltf counts bytes in 32 bits.
inline constexpr uint64_t max_file_bytes = uint64_t{1} << 31;

// Reads a regular file whole: a pipe or a device could block or never end. Throws InputError with
// a cause, without the file's name.
std::string read_regular_file(const std::filesystem::path& path);

} // namespace host::gltf
