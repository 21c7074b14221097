#pragma once

#include <charconv>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace peregrine::bench {

struct ImageSize {
    uint32_t width = 0, height = 0;

    size_t pixels() const { return size_t(width) * height; }
    std::string text() const { return std::to_string(width) + "x" + std::to_string(height); }
};

// "1280x720"; "1024" means 1024x1024.
inline ImageSize parse_image_size(const std::string& text) {
    ImageSize size;
    const auto read = [end = text.data() + text.size()](const char* from, uint32_t& number) {
        const auto [rest, error] = std::from_chars(from, end, number);
        return error == std::errc() && number >= 1 && number <= 16384 ? rest : nullptr;
    };
    const char* rest = read(text.data(), size.width);
    size.height = size.width;
    if (rest && *rest == 'x') rest = read(rest + 1, size.height);
    if (!rest || *rest != '\0')
        throw std::runtime_error("\"" + text + "\" is no size of a frame such as 1280x720");
    return size;
}

} // namespace peregrine::bench
