#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace host {

// A small JSON file beside a plugin that says what it is and where to find it.
struct Manifest {
    std::string name;
    std::filesystem::path library; // relative to the manifest, or absolute
    uint32_t api_version = 0;
    std::string entry; // the symbol to look up
};

inline constexpr const char* manifest_name = "peregrine.plugin.json";

// Throws InputError with a sentence that says what to do.
Manifest read_manifest(const std::filesystem::path& path);

} // namespace host
