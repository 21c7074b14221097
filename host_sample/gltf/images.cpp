#include "images.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <string_view>

#include <stb/stb_image.h>

#include "../error.h"
#include "accessor.h"

namespace host::gltf {

namespace {

constexpr int max_side = 16384;
// A few bytes of PNG can unfold to a gigabyte.
constexpr uint64_t free_bytes = 64u << 20, unfolding = 256, max_total_bytes = uint64_t{2} << 30;

struct FreePixels {
    void operator()(stbi_uc* pixels) const { stbi_image_free(pixels); }
};

Image make_placeholder(const std::string& name) {
    Image image{name, 8, 8, {}};
    for (uint32_t i = 0; i < 64; ++i) {
        const bool bright = (i + i / 8) % 2 == 0;
        const uint8_t shade = bright ? 255 : 0;
        image.rgba.insert(image.rgba.end(), {shade, 0, shade, 255});
    }
    return image;
}

bool begins_with(Bytes bytes, std::string_view magic, size_t offset = 0) {
    return bytes.size() >= offset + magic.size()
           && std::memcmp(bytes.data() + offset, magic.data(), magic.size()) == 0;
}

// The two formats of glTF; stb_image's other decoders are no place for bytes of unknown origin.
bool is_png_or_jpeg(Bytes bytes) {
    return bytes.size() > 8
           && (begins_with(bytes, "\x89PNG") || begins_with(bytes, "\xff\xd8\xff"));
}

std::string format_of(Bytes bytes) {
    if (begins_with(bytes, "\xabKTX")) return "a KTX file";
    if (begins_with(bytes, "RIFF") && begins_with(bytes, "WEBP", 8)) return "a WebP file";
    if (begins_with(bytes, "ftypavif", 4)) return "an AVIF file";
    if (begins_with(bytes, "DDS ")) return "a DDS file";
    if (begins_with(bytes, "GIF8")) return "a GIF file";
    return "of an unknown format";
}

Image decode(const std::string& name, Bytes bytes, uint64_t bytes_left) {
    if (!is_png_or_jpeg(bytes))
        throw InputError("it is neither PNG nor JPEG, but " + format_of(bytes));
    const int size = static_cast<int>(std::min<size_t>(bytes.size(), 0x7fffffff));
    int width = 0, height = 0, channels = 0;
    if (!stbi_info_from_memory(bytes.data(), size, &width, &height, &channels))
        throw InputError("its header is damaged");
    if (width < 1 || height < 1 || width > max_side || height > max_side)
        throw InputError("its size is not supported");
    const auto needed = uint64_t{4} * static_cast<uint64_t>(width) * static_cast<uint64_t>(height);
    if (needed > free_bytes + unfolding * bytes.size() || needed > bytes_left)
        throw InputError("it would unfold to too many bytes");

    const std::unique_ptr<stbi_uc, FreePixels> pixels(
        stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, 4));
    if (!pixels) throw InputError("it is damaged");
    return {name, static_cast<uint32_t>(width), static_cast<uint32_t>(height),
            std::vector<uint8_t>(pixels.get(), pixels.get() + needed)};
}

} // namespace

ImageSource Images::find(int source) const {
    const bool exists = source >= 0 && static_cast<size_t>(source) < document_.images.size();
    if (!exists) return {"", -1, {}, "it does not exist"};
    return document_.images[static_cast<size_t>(source)];
}

uint32_t Images::add(Image image) {
    bytes_ = std::min(bytes_ + image.rgba.size(), max_total_bytes);
    level_.images.push_back(std::move(image));
    return static_cast<uint32_t>(level_.images.size() - 1);
}

uint32_t Images::replace(const std::string& name, const std::string& cause) {
    notes_.add(name + " is replaced by a magenta chequerboard: " + cause);
    const auto [it, added] = replaced_.emplace(name, 0);
    if (added) it->second = add(make_placeholder(name));
    return it->second;
}

uint32_t Images::open(int source) {
    const auto known = open_.find(source);
    if (known != open_.end()) return known->second;

    const ImageSource found = find(source);
    std::string name = "image " + std::to_string(source);
    if (!found.name.empty()) name += " (" + found.name + ")";
    uint32_t index = 0;
    try {
        if (!found.lack.empty()) throw InputError(found.lack);
        const Bytes bytes =
            found.buffer_view < 0 ? found.bytes : view_bytes(document_, found.buffer_view, "it");
        index = add(decode(name, bytes, max_total_bytes - bytes_));
    } catch (const InputError& error) {
        index = replace(name, error.what());
    }
    open_.emplace(source, index);
    return index;
}

} // namespace host::gltf
