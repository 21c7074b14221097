#include "container.h"

#include <cstdint>
#include <cstring>
#include <string>

#include "../error.h"

namespace host::gltf {

namespace {

constexpr size_t header_bytes = 12, chunk_header_bytes = 8;
constexpr uint32_t json_chunk = 0x4e4f534a, bin_chunk = 0x004e4942;

uint32_t read_u32(std::string_view bytes, size_t offset) {
    uint32_t value = 0;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

struct Chunk {
    uint32_t type;
    std::string_view bytes;
};

// Takes the first chunk of `rest` away.
Chunk take_chunk(std::string_view& rest) {
    if (rest.size() < chunk_header_bytes) throw InputError("it ends within the header of a chunk");
    const size_t length = read_u32(rest, 0);
    const uint32_t type = read_u32(rest, 4);
    rest.remove_prefix(chunk_header_bytes);
    if (length > rest.size()) throw InputError("a chunk is longer than the file");
    const Chunk chunk{type, rest.substr(0, length)};
    rest.remove_prefix(length);
    return chunk;
}

std::string_view checked_chunks(std::string_view bytes) {
    if (bytes.size() < header_bytes + chunk_header_bytes)
        throw InputError("it ends within its header");
    if (read_u32(bytes, 4) != 2) throw InputError("it is not glTF version 2");
    const size_t length = read_u32(bytes, 8);
    if (length > bytes.size())
        throw InputError("it is truncated: its header says " + std::to_string(length)
                         + " bytes, there are " + std::to_string(bytes.size()));
    if (length < header_bytes) throw InputError("its header says that it is shorter than that");
    return bytes.substr(header_bytes, length - header_bytes);
}

} // namespace

Container open_container(std::string_view bytes) {
    if (bytes.substr(0, 4) != "glTF") return {bytes, std::nullopt};
    std::string_view rest = checked_chunks(bytes);
    const Chunk first = take_chunk(rest);
    if (first.type != json_chunk) throw InputError("its first chunk is not JSON");
    Container container{first.bytes, std::nullopt};
    while (!container.bin && !rest.empty()) {
        const Chunk chunk = take_chunk(rest);
        if (chunk.type == bin_chunk) container.bin = chunk.bytes;
    }
    // The padding is spaces; old exporters wrote zeros.
    while (!container.json.empty() && container.json.back() == '\0')
        container.json.remove_suffix(1);
    return container;
}

} // namespace host::gltf
