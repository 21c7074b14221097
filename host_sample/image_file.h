#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace host {

// By the end of its name a picture is a PNG, JPEG (.jpg, .jpeg), BMP or TGA file; without any it is
// a PNG. False for other ends.
bool is_picture_name(const std::filesystem::path& path);

// Writes RGBA, 8 bits each, top row first; folders that lack are made. Throws InputError if the
// file cannot be written; what was there before stays.
void write_picture_file(const std::filesystem::path& path, uint32_t width, uint32_t height,
                        const std::vector<uint8_t>& rgba);

// screenshot_NNNN.png in the current folder, with the first number that is free.
std::string free_screenshot_name();

// A file name with a place for a number: "shot_%04d.png". Nothing if there is none.
class NumberedName {
public:
    static std::optional<NumberedName> parse(const std::string& text);

    std::string at(uint32_t number) const;

private:
    std::string before_, after_;
    size_t digits_ = 0;
};

} // namespace host
