#include "ui/canvas.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/glm.hpp>

namespace host::ui {

namespace {

constexpr float pi = 3.14159265f;
constexpr Color shade{0.0f, 0.01f, 0.02f, 0.75f}; // behind texts

ImVec2 im(glm::vec2 v) {
    return {v.x, v.y};
}

float smooth(float t) {
    return t * t * (3.0f - 2.0f * t);
}

} // namespace

ImU32 Canvas::packed(const Color& color) const {
    return ImGui::ColorConvertFloat4ToU32({color.r, color.g, color.b, color.a * alpha_});
}

float Canvas::width(Face face, std::string_view text, float tracking) const {
    const ImFont& font = *(*fonts_)[face];
    const ImVec2 size = const_cast<ImFont&>(font).CalcTextSizeA(
        height(face), 1e9f, 0.0f, text.data(), text.data() + text.size());
    return size.x + px(tracking) * static_cast<float>(text.size());
}

// Spaced out letters are ASCII.
float Canvas::glyphs(glm::vec2 place, Face face, ImU32 color, std::string_view text,
                     float tracking) const {
    const ImFont* font = (*fonts_)[face];
    const glm::vec2 begin = place;
    if (tracking == 0.0f) {
        list_->AddText(font, height(face), im(place), color, text.data(),
                       text.data() + text.size());
        return width(face, text);
    }
    for (size_t i = 0; i < text.size(); ++i) {
        const std::string_view letter = text.substr(i, 1);
        list_->AddText(font, height(face), im(place), color, letter.data(), letter.data() + 1);
        place.x += width(face, letter, tracking);
    }
    return place.x - begin.x;
}

float Canvas::text(glm::vec2 place, Face face, const Color& color, std::string_view text,
                   Align align, float tracking) const {
    const float wide = width(face, text, tracking);
    if (align == Align::center) place.x -= 0.5f * (wide - px(tracking));
    if (align == Align::right) place.x -= wide - px(tracking);
    place = glm::round(place);
    const float below = std::max(1.0f, std::round(0.02f * height(face)));
    note_text(place, {wide - px(tracking), height(face)});
    glyphs(place + glm::vec2(below), face, packed(theme::faded(shade, color.a)), text, tracking);
    return glyphs(place, face, packed(color), text, tracking);
}

Canvas Canvas::fitted(float wide, float available) const {
    Canvas canvas = *this;
    if (wide > available) canvas.text_scale_ *= std::max(0.1f, available / wide);
    return canvas;
}

void Canvas::plain_text(glm::vec2 place, Face face, const Color& color,
                        std::string_view text) const {
    note_text(place, {width(face, text), height(face)});
    glyphs(glm::round(place), face, packed(color), text, 0.0f);
}

void Canvas::note_text(glm::vec2 place, glm::vec2 size) const {
    if (text_box_->lower == text_box_->upper) *text_box_ = {place, place};
    text_box_->lower = glm::min(text_box_->lower, place);
    text_box_->upper = glm::max(text_box_->upper, place + size);
}

float Canvas::paragraph(glm::vec2 place, float width, Face face, const Color& color,
                        std::string_view text) const {
    ImFont* font = const_cast<ImFont*>((*fonts_)[face]);
    const float top = place.y, scale = height(face) / font->FontSize;
    while (!text.empty()) {
        const char* end = text.data() + text.size();
        const char* wrapped = font->CalcWordWrapPositionA(scale, text.data(), end, width);
        if (wrapped == text.data()) ++wrapped; // narrower than a letter: one a line
        this->text(place, face, color, text.substr(0, size_t(wrapped - text.data())));
        text.remove_prefix(size_t(wrapped - text.data()));
        while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
        place.y += 1.25f * height(face);
    }
    return place.y - top;
}

void Canvas::line(glm::vec2 a, glm::vec2 b, const Color& color, float units) const {
    list_->AddLine(im(a), im(b), packed(color), std::max(1.0f, px(units)));
}

void Canvas::polyline(std::span<const glm::vec2> points, const Color& color, float units,
                      bool closed) const {
    for (const glm::vec2& point : points) list_->PathLineTo(im(point));
    list_->PathStroke(packed(color), closed ? ImDrawFlags_Closed : ImDrawFlags_None,
                      std::max(1.0f, px(units)));
}

// ImGui wants the corners clockwise, or it draws the soft edge inwards.
void Canvas::polygon(std::span<const glm::vec2> points, const Color& color) const {
    float area = 0.0f;
    for (size_t i = 0; i < points.size(); ++i) {
        const glm::vec2 a = points[i], b = points[(i + 1) % points.size()];
        area += a.x * b.y - a.y * b.x;
    }
    for (size_t i = 0; i < points.size(); ++i)
        list_->PathLineTo(im(points[area >= 0.0f ? i : points.size() - 1 - i]));
    list_->PathFillConvex(packed(color));
}

void Canvas::rectangle(glm::vec2 lower, glm::vec2 upper, const Color& color, float round) const {
    list_->AddRectFilled(im(lower), im(upper), packed(color), px(round));
}

void Canvas::frame(glm::vec2 lower, glm::vec2 upper, const Color& color, float units,
                   float round) const {
    list_->AddRect(im(lower), im(upper), packed(color), px(round), 0, std::max(1.0f, px(units)));
}

void Canvas::disc(glm::vec2 center, float units, const Color& color) const {
    list_->AddCircleFilled(im(center), px(units), packed(color));
}

void Canvas::circle(glm::vec2 center, float radius, const Color& color, float units) const {
    list_->AddCircle(im(center), px(radius), packed(color), 0, std::max(1.0f, px(units)));
}

void Canvas::arc(glm::vec2 center, float radius, float from, float to, const Color& color,
                 float units) const {
    list_->PathArcTo(im(center), px(radius), from - 0.5f * pi, to - 0.5f * pi, 32);
    list_->PathStroke(packed(color), ImDrawFlags_None, std::max(1.0f, px(units)));
}

void Canvas::gradient_across(glm::vec2 lower, glm::vec2 upper, const Color& left,
                             const Color& right) const {
    const ImU32 a = packed(left), b = packed(right);
    list_->AddRectFilledMultiColor(im(lower), im(upper), a, b, b, a);
}

void Canvas::gradient_down(glm::vec2 lower, glm::vec2 upper, const Color& top,
                           const Color& bottom) const {
    const ImU32 a = packed(top), b = packed(bottom);
    list_->AddRectFilledMultiColor(im(lower), im(upper), a, a, b, b);
}

// Rings of quads about the middle, out to beyond the corners.
void Canvas::vignette(const Color& color, float clear) const {
    constexpr int spokes = 48, rings = 10;
    const glm::vec2 center = 0.5f * size_, reach = 1.45f * center;
    list_->PrimReserve(6 * spokes * rings, (spokes + 1) * (rings + 1));
    const auto base = list_->_VtxCurrentIdx;
    const ImVec2 white = ImGui::GetFontTexUvWhitePixel();
    for (int ring = 0; ring <= rings; ++ring) {
        const float way = static_cast<float>(ring) / rings;
        const ImU32 tint = packed(theme::faded(color, smooth(way)));
        for (int spoke = 0; spoke <= spokes; ++spoke) {
            const float angle = 2.0f * pi * static_cast<float>(spoke) / spokes;
            const glm::vec2 out = reach * (clear + (1.0f - clear) * way)
                                  * glm::vec2(std::cos(angle), std::sin(angle));
            list_->PrimWriteVtx(im(center + out), white, tint);
        }
    }
    for (unsigned ring = 0; ring < rings; ++ring)
        for (unsigned spoke = 0; spoke < spokes; ++spoke) {
            const unsigned a = base + ring * (spokes + 1) + spoke, b = a + spokes + 1;
            for (const unsigned corner : {a, a + 1, b + 1, a, b + 1, b})
                list_->PrimWriteIdx(static_cast<ImDrawIdx>(corner));
        }
}

void Canvas::glow(glm::vec2 center, float units, const Color& color) const {
    constexpr int steps = 10;
    for (int i = 1; i <= steps; ++i)
        disc(center, units * static_cast<float>(i) / steps,
             theme::faded(color, 1.6f / (steps * static_cast<float>(i))));
}

void Canvas::panel(glm::vec2 lower, glm::vec2 upper) const {
    rectangle(lower, upper, theme::faded(theme::night, 0.62f), 6.0f);
    frame(lower, upper, theme::faded(theme::dim, 0.22f), 1.0f, 6.0f);
}

float Canvas::key_cap_width(std::string_view name) const {
    return std::max(px(26.0f), width(Face::small, name) + px(14.0f));
}

float Canvas::key_cap(glm::vec2 place, std::string_view name) const {
    const float wide = key_cap_width(name), high = px(26.0f);
    const glm::vec2 upper = place + glm::vec2(wide, high);
    rectangle(place, upper, {0.02f, 0.03f, 0.05f, 0.7f}, 5.0f);
    frame(place, upper, theme::faded(theme::text, 0.75f), 1.25f, 5.0f);
    text({place.x + 0.5f * wide, place.y + 0.5f * (high - height(Face::small))}, Face::small,
         theme::text, name, Align::center);
    return wide;
}

} // namespace host::ui
