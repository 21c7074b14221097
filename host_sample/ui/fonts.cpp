#include "ui/fonts.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "ui/theme.h"

namespace host::ui {

namespace {

struct Typeface {
    const char* file;
    float size; // units
};

constexpr std::array<Typeface, face_count> typefaces = {{{"Jura-Bold.otf", theme::small_text},
                                                         {"Jura-SemiBold.otf", theme::body_text},
                                                         {"Jura-Medium.otf", theme::number_text},
                                                         {"Jura-Medium.otf", theme::heading_text},
                                                         {"Jura-Light.otf", theme::title_text}}};
constexpr std::array<const char*, 2> folders = {"/usr/share/fonts/opentype/jura/",
                                                "/usr/share/fonts/truetype/jura/"};
constexpr const char* second_choice = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

// Latin, and the dashes and quotation marks of our sentences.
constexpr ImWchar all_glyphs[] = {0x20, 0xff, 0x2010, 0x2027, 0};
constexpr ImWchar capitals[] = {0x20, 0x5f, 0}; // of the large title: keeps the atlas small

std::string find_file(const char* name) {
    std::error_code error;
    for (const char* folder : folders)
        if (const std::string path = std::string(folder) + name;
            std::filesystem::is_regular_file(path, error))
            return path;
    return std::filesystem::is_regular_file(second_choice, error) ? second_choice : "";
}

} // namespace

float face_size(Face face) {
    return typefaces[static_cast<size_t>(face)].size;
}

Fonts load_fonts(float unit, std::string& note) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    atlas.Clear();
    Fonts fonts;
    fonts.unit = unit;
    for (size_t i = 0; i < face_count; ++i) {
        const std::string path = find_file(typefaces[i].file);
        const ImWchar* glyphs = static_cast<Face>(i) == Face::title ? capitals : all_glyphs;
        ImFontConfig config;
        config.SizePixels = std::clamp(typefaces[i].size * unit, 8.0f, 400.0f);
        config.OversampleH = 2;
        if (!path.empty())
            fonts.faces[i] =
                atlas.AddFontFromFileTTF(path.c_str(), config.SizePixels, &config, glyphs);
        if (path.empty() || path == second_choice)
            note = "The typeface Jura (fonts-jura) is not installed: texts look plainer.";
        if (!fonts.faces[i]) fonts.faces[i] = atlas.AddFontDefault(&config);
    }
    atlas.Build();
    return fonts;
}

} // namespace host::ui
