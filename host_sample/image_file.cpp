#include "image_file.h"

#include <cctype>

#include <stb/stb_image_write.h>

#include "error.h"
#include "whole_file.h"

namespace host {

namespace {

constexpr int jpeg_quality = 92; // per cent

enum class Format { png, jpeg, bmp, tga };

std::optional<Format> format_of(const std::filesystem::path& path) {
    std::string end = path.extension().string();
    for (char& letter : end)
        letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    if (end.empty() || end == ".png") return Format::png;
    if (end == ".jpg" || end == ".jpeg") return Format::jpeg;
    if (end == ".bmp") return Format::bmp;
    if (end == ".tga") return Format::tga;
    return std::nullopt;
}

void append(void* context, void* data, int size) {
    static_cast<std::string*>(context)->append(static_cast<const char*>(data),
                                               static_cast<size_t>(size));
}

// To memory first: stb does not notice when a disk is full.
std::string encode(Format format, int width, int height, const uint8_t* rgba) {
    std::string bytes;
    switch (format) {
    case Format::png:
        stbi_write_png_to_func(append, &bytes, width, height, 4, rgba, 4 * width);
        break;
    case Format::jpeg:
        stbi_write_jpg_to_func(append, &bytes, width, height, 4, rgba, jpeg_quality);
        break;
    case Format::bmp:
        stbi_write_bmp_to_func(append, &bytes, width, height, 4, rgba);
        break;
    case Format::tga:
        stbi_write_tga_to_func(append, &bytes, width, height, 4, rgba);
        break;
    }
    return bytes;
}

} // namespace

bool is_picture_name(const std::filesystem::path& path) {
    return format_of(path).has_value();
}

void write_picture_file(const std::filesystem::path& path, uint32_t width, uint32_t height,
                        const std::vector<uint8_t>& rgba) {
    std::error_code error; // a failure shows when the file is written
    if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), error);
    const std::string bytes = encode(format_of(path).value_or(Format::png), static_cast<int>(width),
                                     static_cast<int>(height), rgba.data());
    const std::string cause =
        bytes.empty() ? "there is not enough memory" : write_whole_file(path, bytes);
    if (!cause.empty())
        throw InputError("the picture " + path.string() + " cannot be written: " + cause);
}

std::string free_screenshot_name() {
    const auto names = NumberedName::parse("screenshot_%04d.png");
    uint32_t number = 0;
    std::error_code error; // in a folder that cannot be searched the first one has to do
    while (std::filesystem::exists(names->at(number), error)) ++number;
    return names->at(number);
}

// Not by printf: the format comes from the command line.
std::optional<NumberedName> NumberedName::parse(const std::string& text) {
    const size_t percent = text.find('%');
    if (percent == std::string::npos) return std::nullopt;
    size_t end = percent + 1;
    while (end < text.size() && std::isdigit(static_cast<unsigned char>(text[end]))) ++end;
    if (end >= text.size() || text[end] != 'd' || end - percent > 3) return std::nullopt;
    NumberedName name;
    name.before_ = text.substr(0, percent);
    name.after_ = text.substr(end + 1);
    const std::string digits = text.substr(percent + 1, end - percent - 1);
    name.digits_ = digits.empty() ? 0 : std::stoul(digits);
    return name;
}

std::string NumberedName::at(uint32_t number) const {
    std::string digits = std::to_string(number);
    if (digits.size() < digits_) digits.insert(0, digits_ - digits.size(), '0');
    return before_ + digits + after_;
}

} // namespace host
