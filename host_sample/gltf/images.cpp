#include "images.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <span>

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

// The two formats of glTF; stb_image's other decoders are no place for bytes of unknown origin.
bool is_png_or_jpeg(std::span<const unsigned char> bytes) {
    const unsigned char png[4] = {0x89, 'P', 'N', 'G'}, jpeg[3] = {0xff, 0xd8, 0xff};
    return bytes.size() > 8
           && (std::memcmp(bytes.data(), png, 4) == 0 || std::memcmp(bytes.data(), jpeg, 3) == 0);
}

std::span<const unsigned char> encoded_bytes(const tinygltf::Model& model,
                                             const tinygltf::Image& image) {
    if (image.bufferView >= 0) return view_bytes(model, image.bufferView, "it");
    if (image.image.empty()) throw InputError("its file cannot be read");
    return image.image;
}

Image decode(const std::string& name, std::span<const unsigned char> bytes, uint64_t bytes_left) {
    if (!is_png_or_jpeg(bytes)) throw InputError("it is neither PNG nor JPEG");
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

uint32_t Images::open(int source) {
    const auto known = open_.find(source);
    if (known != open_.end()) return known->second;

    const bool exists = source >= 0 && static_cast<size_t>(source) < model_.images.size();
    std::string name = "image " + std::to_string(source);
    Image image;
    try {
        if (!exists) throw InputError("it does not exist");
        const tinygltf::Image& file_image = model_.images[static_cast<size_t>(source)];
        if (!file_image.name.empty()) name += " (" + file_image.name + ")";
        image = decode(name, encoded_bytes(model_, file_image), max_total_bytes - bytes_);
    } catch (const InputError& error) {
        notes_.add(name + " is replaced by a magenta chequerboard: " + error.what());
        image = make_placeholder(name);
    }
    bytes_ = std::min(bytes_ + image.rgba.size(), max_total_bytes);
    const auto index = static_cast<uint32_t>(level_.images.size());
    level_.images.push_back(std::move(image));
    open_.emplace(source, index);
    return index;
}

} // namespace host::gltf
