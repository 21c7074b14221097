#include "image_file.h"

#include <cctype>

#include <stb/stb_image_write.h>

#include "error.h"

namespace host {

void write_png(const std::filesystem::path& path, uint32_t width, uint32_t height,
               const std::vector<uint8_t>& rgba) {
    std::error_code error;
    if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), error);
    const int written =
        stbi_write_png(path.string().c_str(), static_cast<int>(width), static_cast<int>(height), 4,
                       rgba.data(), static_cast<int>(width) * 4);
    if (written == 0) throw InputError("the picture " + path.string() + " cannot be written");
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
