#include "precheck.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <set>
#include <string>

#include <nlohmann/json.hpp>

#include "../error.h"

namespace host::gltf {

namespace {

constexpr int max_json_depth = 128;
constexpr size_t header_bytes = 12, chunk_header_bytes = 8;

uint32_t read_u32(std::string_view bytes, size_t offset) {
    uint32_t value = 0;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

// tinygltf walks "extras" and "extensions" recursively.
void check_depth(std::string_view json) {
    int depth = 0;
    bool in_string = false;
    for (size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (in_string) {
            if (c == '\\') ++i;
            if (c == '"') in_string = false;
        } else if (c == '"') {
            in_string = true;
        } else if (c == '{' || c == '[') {
            if (++depth > max_json_depth) throw InputError("its JSON is nested too deeply");
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
}

void check_buffers(const nlohmann::json& root, bool binary) {
    const auto buffers = root.find("buffers");
    if (buffers == root.end() || !buffers->is_array()) return;
    std::set<std::string> uris;
    bool first = true;
    for (const nlohmann::json& buffer : *buffers) {
        const auto uri = buffer.is_object() ? buffer.find("uri") : buffer.end();
        const bool has_uri =
            buffer.is_object() && uri != buffer.end() && uri->is_string() && !uri->empty();
        if (!has_uri && !(binary && first))
            throw InputError("a buffer other than a .glb's first has no uri");
        if (has_uri && !uris.insert(uri->get<std::string>()).second)
            throw InputError("two buffers name the same uri");
        first = false;
    }
}

} // namespace

bool is_binary_gltf(std::string_view bytes) {
    return bytes.size() >= 4 && bytes.substr(0, 4) == "glTF";
}

std::string_view check_container(std::string_view bytes) {
    if (bytes.size() < header_bytes + chunk_header_bytes)
        throw InputError("it ends within its header");
    if (read_u32(bytes, 4) != 2) throw InputError("it is not glTF version 2");
    const size_t length = read_u32(bytes, 8);
    if (length > bytes.size())
        throw InputError("it is truncated: its header says " + std::to_string(length)
                         + " bytes, there are " + std::to_string(bytes.size()));
    std::string_view json;
    size_t offset = header_bytes;
    for (int chunk = 0; chunk < 2 && offset < length; ++chunk) {
        if (length - offset < chunk_header_bytes)
            throw InputError("it ends within the header of a chunk");
        const size_t chunk_bytes = read_u32(bytes, offset);
        offset += chunk_header_bytes;
        if (chunk_bytes > length - offset) throw InputError("a chunk is longer than the file");
        if (chunk == 0) json = bytes.substr(offset, chunk_bytes);
        offset += chunk_bytes;
    }
    return json;
}

void check_json(std::string_view json, bool binary) {
    check_depth(json);
    const auto root = nlohmann::json::parse(json.begin(), json.end(), nullptr, false);
    if (root.is_discarded()) throw InputError("its JSON is malformed");
    if (!root.is_object()) throw InputError("its JSON is not an object");
    check_buffers(root, binary);
}

} // namespace host::gltf
