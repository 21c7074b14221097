#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <tiny_gltf.h>

#include "resources.h"

namespace host::gltf {

struct Buffer {
    Bytes bytes;
    std::string lack; // why there are none; empty: there are
};

// Encoded.
struct ImageSource {
    std::string name; // of the image or of its file, for people
    int buffer_view = -1;
    Bytes bytes;      // without a buffer view
    std::string lack; // why there are none; empty: there are
};

struct Document {
    tinygltf::Model model; // all but the buffers and images
    std::vector<Buffer> buffers;
    std::vector<ImageSource> images;
    std::set<std::string> extensions; // that the file uses
    Resources resources;              // what the bytes above belong to
    uint64_t bytes_read = 0;
};

// Reads a .gltf or .glb with the buffers and images beside it. Throws InputError with a cause,
// without the file's name.
Document read_document(const std::filesystem::path& path);

// The same from memory; relative URIs are looked up in `folder`.
Document parse_document(const std::string& bytes, const std::filesystem::path& folder);

} // namespace host::gltf
