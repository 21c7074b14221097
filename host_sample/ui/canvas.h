#pragma once

#include <span>
#include <string_view>

#include <glm/vec2.hpp>

#include "ui/fonts.h"
#include "ui/menu.h"
#include "ui/theme.h"

namespace host::ui {

using theme::Color;

enum class Align { left, center, right };

// What HUD and menus are drawn with. Places are pixels; lengths that look the same on every window
// are units (theme.h): px() turns them into pixels.
class Canvas {
public:
    Canvas(ImDrawList& list, const Fonts& fonts, glm::vec2 size, float unit, Box& text_box)
        : list_(&list), fonts_(&fonts), size_(size), unit_(unit), text_box_(&text_box) {}

    glm::vec2 size() const { return size_; }
    float px(float units) const { return unit_ * units; }
    // All that follows is so much fainter.
    void set_alpha(float alpha) { alpha_ = alpha; }

    // `place` is the top at the left, in the middle or at the right. Returns the width in pixels.
    float text(glm::vec2 place, Face face, const Color& color, std::string_view text,
               Align align = Align::left, float tracking = 0.0f) const;
    // Without the shade that sets others off from the picture.
    void plain_text(glm::vec2 place, Face face, const Color& color, std::string_view text) const;
    float width(Face face, std::string_view text, float tracking = 0.0f) const;
    float height(Face face) const { return text_scale_ * px(face_size(face)); }
    // The same with smaller letters, so that what is `wide` fits into what is available.
    Canvas fitted(float wide, float available) const;
    // Breaks lines at blanks; returns their height.
    float paragraph(glm::vec2 place, float width, Face face, const Color& color,
                    std::string_view text) const;

    void line(glm::vec2 a, glm::vec2 b, const Color& color, float units) const;
    void polyline(std::span<const glm::vec2> points, const Color& color, float units,
                  bool closed = false) const;
    void polygon(std::span<const glm::vec2> points, const Color& color) const; // convex
    void rectangle(glm::vec2 lower, glm::vec2 upper, const Color& color, float round = 0.0f) const;
    void frame(glm::vec2 lower, glm::vec2 upper, const Color& color, float units,
               float round = 0.0f) const;
    void disc(glm::vec2 center, float units, const Color& color) const;
    void circle(glm::vec2 center, float radius, const Color& color, float units) const;
    // Angles clockwise from the top, in radians.
    void arc(glm::vec2 center, float radius, float from, float to, const Color& color,
             float units) const;

    void gradient_across(glm::vec2 lower, glm::vec2 upper, const Color& left,
                         const Color& right) const;
    void gradient_down(glm::vec2 lower, glm::vec2 upper, const Color& top,
                       const Color& bottom) const;
    // Clear in the middle, `color` in the corners; `clear` of the way is untouched.
    void vignette(const Color& color, float clear) const;
    // A soft light around a point.
    void glow(glm::vec2 center, float units, const Color& color) const;

    // What a table lies on.
    void panel(glm::vec2 lower, glm::vec2 upper) const;
    // A key or button as a cap with its name in it. Returns the width in pixels.
    float key_cap(glm::vec2 place, std::string_view name) const;
    float key_cap_width(std::string_view name) const;

private:
    void note_text(glm::vec2 place, glm::vec2 size) const;
    ImU32 packed(const Color& color) const;
    float glyphs(glm::vec2 place, Face face, ImU32 color, std::string_view text,
                 float tracking) const;

    ImDrawList* list_;
    const Fonts* fonts_;
    glm::vec2 size_;
    float unit_;
    Box* text_box_; // around all texts
    float alpha_ = 1.0f, text_scale_ = 1.0f;
};

} // namespace host::ui
