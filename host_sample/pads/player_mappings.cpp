#include "player_mappings.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>

#include "mapping.h"

namespace host::pads {

namespace {

bool parse_id(std::string_view text, uint16_t& id) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id, 16);
    return text.size() == 4 && error == std::errc() && end == text.data() + 4;
}

// "vvvv:pppp" and the rest.
std::string parse_line(std::string_view line, PlayerMappings& mappings) {
    const size_t blank = std::min(line.find_first_of(" \t"), line.size());
    uint16_t vendor = 0, product = 0;
    if (blank != 9 || line[4] != ':' || !parse_id(line.substr(0, 4), vendor)
        || !parse_id(line.substr(5, 4), product))
        return "a line begins with vendor and product, as 0079:0006";
    Mapping ignored;
    const std::string mistake = apply_mapping_text(line.substr(blank), ignored);
    if (mistake.empty()) mappings[{vendor, product}] = line.substr(blank);
    return mistake;
}

} // namespace

std::string parse_player_mappings(const std::string& text, PlayerMappings& mappings) {
    PlayerMappings result = mappings;
    std::istringstream lines(text);
    unsigned number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        std::string_view content = line;
        content = content.substr(0, content.find_first_of("#\r"));
        const size_t begin = content.find_first_not_of(" \t");
        if (begin == std::string_view::npos) continue;
        const std::string mistake = parse_line(content.substr(begin), result);
        if (!mistake.empty()) return "line " + std::to_string(number) + ": " + mistake;
    }
    mappings = std::move(result);
    return "";
}

std::string read_player_mappings(const std::string& file, PlayerMappings& mappings) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    if (stream) text << stream.rdbuf();
    if (!stream || std::filesystem::is_directory(file))
        return "the gamepad mappings " + file + " cannot be read";
    const std::string mistake = parse_player_mappings(text.str(), mappings);
    return mistake.empty() ? "" : "the gamepad mappings " + file + ": " + mistake;
}

} // namespace host::pads
