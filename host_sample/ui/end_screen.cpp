#include "ui/icons.h"
#include "ui/page.h"

namespace host::ui {

namespace {

constexpr float table_width = 360.0f;

void draw_heading(const Canvas& canvas, const EndScreen& screen, float left, float top) {
    const Color tint = screen.won ? theme::core : theme::red;
    if (screen.won)
        for (int i = 0; i < 3; ++i) {
            const glm::vec2 center(left + canvas.px(12.0f + 30.0f * static_cast<float>(i)),
                                   top - canvas.px(16.0f));
            canvas.glow(center, 30.0f, theme::faded(tint, 0.3f));
            draw_diamond(canvas, center, 11.0f, tint, true);
        }
    canvas.text({left - canvas.px(4.0f), top}, Face::title,
                screen.won ? theme::text : theme::mixed(theme::text, theme::red, 0.55f),
                screen.won ? "AWAY" : "CAUGHT", Align::left, 5.0f);
    const std::string& words = screen.story;
    canvas.fitted(canvas.width(Face::body, words), canvas.size().x - left - canvas.px(40.0f))
        .text({left, top + canvas.px(104.0f)}, Face::body, theme::dim, words);
}

void draw_badge(const Canvas& canvas, glm::vec2 place, const char* text) {
    const float wide = canvas.width(Face::small, text) + canvas.px(16.0f), high = canvas.px(24.0f);
    canvas.rectangle(place, place + glm::vec2(wide, high), theme::faded(theme::amber, 0.9f), 4.0f);
    canvas.plain_text(place
                          + glm::vec2(canvas.px(8.0f), 0.5f * (high - canvas.height(Face::small))),
                      Face::small, theme::night, text);
}

// Time and score, large, with what is a record.
void draw_results(const Canvas& canvas, const EndScreen& screen, glm::vec2 place) {
    const auto result = [&](const char* label, const std::string& value, bool record) {
        canvas.text(place, Face::small, theme::dim, label);
        const float wide = canvas.text(place + glm::vec2(0.0f, canvas.px(20.0f)), Face::heading,
                                       theme::text, value);
        if (record)
            draw_badge(canvas, place + canvas.px(1.0f) * glm::vec2(0.0f, 72.0f), "NEW BEST");
        place.x += std::max(wide, canvas.px(150.0f)) + canvas.px(40.0f);
    };
    result("TIME", clock_text(screen.seconds), screen.new_best_time);
    result("SCORE", score_text(screen.score), screen.new_best_score);
}

void draw_lines(const Canvas& canvas, const EndScreen& screen, glm::vec2 place) {
    const float right = place.x + canvas.px(table_width);
    const float rows = static_cast<float>(screen.lines.size()) + (screen.best ? 1.5f : 0.0f);
    const glm::vec2 pad(canvas.px(18.0f), canvas.px(14.0f));
    canvas.panel(place - pad, {right + pad.x, place.y + canvas.px(36.0f + 25.0f * rows) + pad.y});
    canvas.text(place, Face::small, theme::dim,
                screen.level + "  \xc2\xb7  " + difficulty_name(screen.difficulty));
    place.y += canvas.px(26.0f);
    canvas.line(place, {right, place.y}, theme::faint, 1.0f);
    place.y += canvas.px(10.0f);
    for (const Line& line : screen.lines) {
        canvas.text(place, Face::small, theme::dim, line.label);
        canvas.text({right, place.y}, Face::small, theme::text, line.value, Align::right);
        place.y += canvas.px(25.0f);
    }
    if (!screen.best) return;
    canvas.line({place.x, place.y + canvas.px(3.0f)}, {right, place.y + canvas.px(3.0f)},
                theme::faint, 1.0f);
    place.y += canvas.px(13.0f);
    canvas.text(place, Face::small, theme::dim, "Best");
    canvas.text({right, place.y}, Face::small, theme::dim,
                clock_text(screen.best->seconds) + "    " + score_text(screen.best->score),
                Align::right);
}

} // namespace

Action show_end(Page& page, const EndScreen& screen) {
    const Canvas& canvas = page.canvas;
    const float left = canvas.px(72.0f), middle = 0.5f * canvas.size().y;
    draw_backdrop(canvas, screen.won ? theme::core : theme::red);
    if (!screen.won) canvas.vignette({0.25f, 0.01f, 0.01f, 0.55f}, 0.3f);
    draw_heading(canvas, screen, left, middle - canvas.px(270.0f));
    draw_results(canvas, screen, {left, middle - canvas.px(118.0f)});
    const float column = canvas.size().x - canvas.px(58.0f + table_width);
    draw_lines(canvas, screen, {column, middle - canvas.px(108.0f)});
    const Choice choice = run_column(page, {{left, middle + canvas.px(30.0f)}, 330.0f},
                                     {{.label = "Again"}, {.label = "To the title"}});
    draw_footer(page, true);
    if (choice.kind == Choice::Kind::back) return Action::to_title;
    if (choice.kind != Choice::Kind::accept) return Action::none;
    return choice.entry == 0 ? Action::restart : Action::to_title;
}

} // namespace host::ui
