#include "ui/page.h"

#include <cmath>
#include <cstdio>

namespace host::ui {

namespace {

// A small triangle that points left (-1) or right (1).
void draw_arrow(const Canvas& canvas, glm::vec2 center, float side, const Color& color) {
    const float s = canvas.px(5.0f);
    const glm::vec2 corners[] = {center + glm::vec2(side * s, 0.0f),
                                 center + glm::vec2(-side * s, -1.2f * s),
                                 center + glm::vec2(-side * s, 1.2f * s)};
    canvas.polygon(corners, color);
}

EntryBoxes lay_out(const Canvas& canvas, const Column& column, size_t index) {
    const float high = canvas.px(column.row), wide = canvas.px(column.width);
    EntryBoxes boxes;
    boxes.row.lower = column.place + glm::vec2(0.0f, high * static_cast<float>(index));
    boxes.row.upper = boxes.row.lower + glm::vec2(wide, high);
    const float value = canvas.px(column.value_width);
    boxes.less = {{boxes.row.upper.x - value, boxes.row.lower.y},
                  {boxes.row.upper.x - 0.5f * value, boxes.row.upper.y}};
    boxes.more = {{boxes.row.upper.x - 0.5f * value, boxes.row.lower.y}, boxes.row.upper};
    const glm::vec2 arrow(canvas.px(26.0f), 0.0f);
    boxes.slider = {boxes.less.lower + arrow, boxes.more.upper - arrow};
    return boxes;
}

void draw_value(const Canvas& canvas, const Entry& entry, const EntryBoxes& boxes,
                const Color& color, bool selected) {
    const float middle = 0.5f * (boxes.row.lower.y + boxes.row.upper.y);
    const float high = canvas.height(Face::body);
    const bool bar = entry.level >= 0.0f;
    canvas.text({boxes.less.upper.x, middle - (bar ? 0.68f : 0.5f) * high}, Face::body, color,
                entry.value, Align::center);
    const float inset = canvas.px(10.0f);
    if (bar) {
        const glm::vec2 a(boxes.slider.lower.x, middle + 0.52f * high);
        const glm::vec2 b(boxes.slider.upper.x, a.y), at = a + entry.level * (b - a);
        const Color& lit = selected ? theme::core : theme::dim;
        canvas.line(a, b, theme::faint, 2.0f);
        canvas.line(a, at, lit, 2.0f);
        canvas.disc(at, 4.0f, lit);
    }
    if (!selected) return;
    if (entry.has_less)
        draw_arrow(canvas, {boxes.less.lower.x + inset, middle}, -1.0f, theme::core);
    if (entry.has_more) draw_arrow(canvas, {boxes.more.upper.x - inset, middle}, 1.0f, theme::core);
}

void draw_entry(const Canvas& canvas, const Entry& entry, const EntryBoxes& boxes, bool selected) {
    const Box& row = boxes.row;
    if (selected) {
        canvas.gradient_across(row.lower, row.upper, theme::faded(theme::core, 0.26f),
                               theme::faded(theme::core, 0.02f));
        canvas.rectangle(row.lower, {row.lower.x + canvas.px(3.0f), row.upper.y}, theme::core);
    }
    const Color& color = !entry.enabled ? theme::faint : selected ? theme::text : theme::dim;
    const float top = 0.5f * (row.lower.y + row.upper.y - canvas.height(Face::body));
    canvas.text({row.lower.x + canvas.px(18.0f), top}, Face::body, color, entry.label);
    if (!entry.value.empty()) draw_value(canvas, entry, boxes, color, selected);
}

} // namespace

void draw_backdrop(const Canvas& canvas, const Color& tint) {
    const glm::vec2 size = canvas.size();
    const Color night = theme::mixed(theme::night, tint, 0.08f);
    canvas.rectangle({0.0f, 0.0f}, size, theme::faded(night, 0.45f));
    canvas.gradient_across({0.0f, 0.0f}, {0.75f * size.x, size.y}, theme::faded(night, 0.88f),
                           theme::faded(night, 0.0f));
    canvas.gradient_down({0.0f, 0.72f * size.y}, size, theme::faded(night, 0.0f),
                         theme::faded(night, 0.8f));
    canvas.vignette(theme::faded(night, 0.8f), 0.35f);
}

Choice run_column(Page& page, const Column& column, const std::vector<Entry>& entries) {
    std::vector<EntryBoxes> boxes;
    for (size_t i = 0; i < entries.size(); ++i) boxes.push_back(lay_out(page.canvas, column, i));
    const Choice choice = page.menu.update(entries, boxes, page.input, page.pointer);
    for (size_t i = 0; i < entries.size(); ++i)
        draw_entry(page.canvas, entries[i], boxes[i], i == page.menu.selected());
    page.sounds.moved = page.sounds.moved || choice.moved;
    page.sounds.chosen =
        page.sounds.chosen || (choice.kind != Choice::Kind::none && !choice.dragged);
    return choice;
}

void draw_footer(const Page& page, bool has_back) {
    const Canvas& canvas = page.canvas;
    glm::vec2 place(canvas.px(72.0f), canvas.size().y - canvas.px(58.0f));
    const auto prompt = [&](const std::string& key, const char* what) {
        place.x += canvas.key_cap(place, key) + canvas.px(9.0f);
        const float top = place.y + 0.5f * (canvas.px(26.0f) - canvas.height(Face::small));
        place.x += canvas.text({place.x, top}, Face::small, theme::dim, what) + canvas.px(26.0f);
    };
    prompt(page.device.accept, "Select");
    if (has_back) prompt(page.device.back, "Back");
}

std::string clock_text(double seconds) {
    const auto tenths = static_cast<unsigned long long>(std::max(0.0, seconds) * 10.0 + 1e-6);
    char text[32];
    std::snprintf(text, sizeof text, "%02llu:%02llu.%llu", tenths / 600, tenths / 10 % 60,
                  tenths % 10);
    return text;
}

std::string score_text(uint32_t score) {
    std::string text = std::to_string(score);
    for (size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, 1, ' ');
    return text;
}

} // namespace host::ui
