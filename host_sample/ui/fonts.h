#pragma once

#include <string>

#include <imgui.h>

namespace host::ui {

enum class Face { small, body, number, heading, title };
constexpr int face_count = 5;

struct Fonts {
    ImFont* faces[face_count] = {};
    float unit = 0.0f; // pixels that they were made for
    const ImFont* operator[](Face face) const { return faces[static_cast<int>(face)]; }
};

float face_size(Face face); // units

// Makes the atlas of the current ImGui context anew. `note` becomes a sentence if the typeface of
// the game is not installed.
Fonts load_fonts(float unit, std::string& note);

} // namespace host::ui
