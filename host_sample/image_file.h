#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace host {

// Writes RGBA, 8 bits each, top row first. Throws InputError if the file cannot be written.
void write_png(const std::filesystem::path& path, uint32_t width, uint32_t height,
               const std::vector<uint8_t>& rgba);

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
