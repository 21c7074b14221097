#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include <tiny_gltf.h>

namespace host::gltf {

struct Document {
    tinygltf::Model model; // images hold their encoded bytes, or nothing
    uint64_t bytes_read = 0;
};

// Reads a .gltf or .glb (told apart by their content) with the buffers and images beside it.
// Throws InputError with a cause, without the file's name.
Document read_document(const std::filesystem::path& path);

// The same from memory; relative URIs are looked up in `folder`.
Document parse_document(const std::string& bytes, const std::filesystem::path& folder);

} // namespace host::gltf
