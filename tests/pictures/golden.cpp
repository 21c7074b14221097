#include "golden.h"

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>

#include <gtest/gtest.h>
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

namespace peregrine::test {
namespace {

namespace fs = std::filesystem;

void write_png(const fs::path& path, uint32_t width, uint32_t height, const uint8_t* rgba) {
    fs::create_directories(path.parent_path());
    stbi_write_png_compression_level = 64; // how far back it looks for the same bytes
    if (!stbi_write_png(path.string().c_str(), int(width), int(height), 4, rgba, int(4 * width)))
        throw std::runtime_error("cannot write " + path.string());
}

void write_png(const fs::path& path, const Picture& picture) {
    write_png(path, picture.width * picture.units, picture.height, picture.bytes.data());
}

std::optional<Picture> read_png(const fs::path& path, uint32_t units) {
    int width = 0, height = 0, channels = 0;
    uint8_t* const rgba = stbi_load(path.string().c_str(), &width, &height, &channels, 4);
    if (!rgba) return std::nullopt;
    Picture picture{uint32_t(width) / units, uint32_t(height), units,
                    std::vector<uint8_t>(rgba, rgba + size_t(width) * size_t(height) * 4)};
    stbi_image_free(rgba);
    return picture;
}

// Red where the pictures differ, faded where they agree.
void write_difference(const fs::path& path, const Picture& golden, const Picture& found) {
    std::vector<uint8_t> rgba(found.bytes.size());
    for (size_t i = 0; i < rgba.size(); i += 4) {
        const uint8_t* const a = &golden.bytes[i];
        const bool differs = std::memcmp(a, &found.bytes[i], 4) != 0;
        const auto faded = uint8_t((a[0] + a[1] + a[2]) / 12);
        rgba[i] = differs ? 255 : faded;
        rgba[i + 1] = rgba[i + 2] = differs ? 0 : faded;
        rgba[i + 3] = 255;
    }
    write_png(path, found.width * found.units, found.height, rgba.data());
}

std::string hex(const uint8_t* bytes, size_t count) {
    std::ostringstream text;
    for (size_t i = 0; i < count; ++i) {
        constexpr char kDigits[] = "0123456789abcdef";
        if (i > 0 && i % 4 == 0) text << ' ';
        text << kDigits[bytes[i] >> 4] << kDigits[bytes[i] & 15];
    }
    return text.str();
}

// Where pictures of one size differ.
std::string describe_difference(const Picture& golden, const Picture& found) {
    const size_t size = 4 * found.units, count = size_t(found.width) * found.height;
    size_t different = 0, first = 0;
    int most = 0;
    for (size_t i = 0; i < count; ++i) {
        const uint8_t *a = &golden.bytes[i * size], *b = &found.bytes[i * size];
        if (std::memcmp(a, b, size) == 0) continue;
        if (different++ == 0) first = i;
        for (size_t k = 0; k < size; ++k) most = std::max(most, std::abs(a[k] - b[k]));
    }
    std::ostringstream text;
    text << different << " of " << count << " pixels differ";
    if (found.units == 1) text << ", by " << most << " of 255 at most";
    text << "; the first is at (" << first % found.width << ", " << first / found.width
         << "): " << hex(&found.bytes[first * size], size) << " instead of "
         << hex(&golden.bytes[first * size], size);
    return text.str();
}

bool is_renewed_now(const std::string& name) {
    static std::set<std::string> renewed;
    return std::getenv("PEREGRINE_RENEW_PICTURES") && renewed.insert(name).second;
}

} // namespace

void expect_golden(const std::string& name, const std::string& how, const Picture& found) {
    const fs::path path = fs::path(PEREGRINE_GOLDEN_PICTURES) / (name + ".png");
    if (is_renewed_now(name)) write_png(path, found);
    const std::optional<Picture> golden = read_png(path, found.units);
    if (golden && golden->width == found.width && golden->height == found.height
        && golden->bytes == found.bytes)
        return;
    const fs::path out(PEREGRINE_FAILED_PICTURES);
    const std::string stem = name + "_" + how;
    write_png(out / (stem + ".found.png"), found);
    std::string difference = "there is no such file of this size";
    if (golden && golden->bytes.size() == found.bytes.size()) {
        write_difference(out / (stem + ".difference.png"), *golden, found);
        difference = describe_difference(*golden, found);
    }
    ADD_FAILURE() << name << " by " << how << " is not " << path.string() << ": " << difference
                  << ". See " << (out / stem).string() << ".*.png; if the change is wanted: "
                  << "cmake --build --preset release --target renew_pictures";
}

} // namespace peregrine::test
