#include "ui/icons.h"
#include "ui/page.h"

#include <cmath>

namespace host::ui {

namespace {

using three_cores::Difficulty;

enum : uint32_t { play_entry, difficulty_entry, options_entry, quit_entry };

void draw_lettering(const Page& page, float left, float top) {
    const Canvas& canvas = page.canvas;
    for (int i = 0; i < 3; ++i) {
        const float pulse =
            0.75f
            + 0.25f * std::sin(1.7f * static_cast<float>(page.now) - 0.9f * static_cast<float>(i));
        const glm::vec2 center(left + canvas.px(12.0f + 30.0f * static_cast<float>(i)),
                               top - canvas.px(16.0f));
        canvas.glow(center, 30.0f, theme::faded(theme::core, 0.30f * pulse));
        draw_diamond(canvas, center, 11.0f, theme::faded(theme::core, pulse), true);
    }
    canvas.text({left - canvas.px(4.0f), top}, Face::title, theme::text, "THREE CORES", Align::left,
                5.0f);
    canvas.text({left, top + canvas.px(104.0f)}, Face::body, theme::dim,
                "A dark hall, a few watchful machines, and three things worth taking.");
}

void draw_best(const Page& page, const TitleScreen& screen, float left, float top) {
    const Canvas& canvas = page.canvas;
    canvas.line({left, top}, {left + canvas.px(380.0f), top}, theme::faint, 1.0f);
    top += canvas.px(14.0f);
    canvas.text({left, top}, Face::small, theme::dim, screen.level);
    top += canvas.px(24.0f);
    if (!screen.best) {
        canvas.text({left, top}, Face::small, theme::dim, "Nobody has got away yet.");
        return;
    }
    canvas.text({left, top}, Face::small, theme::text,
                "Best time " + clock_text(screen.best->seconds) + "    Best score "
                    + score_text(screen.best->score));
}

void change_difficulty(Difficulty& difficulty, const Choice& choice) {
    const auto number = static_cast<uint32_t>(difficulty);
    const uint32_t step = choice.kind == Choice::Kind::less ? 2 : 1;
    difficulty = static_cast<Difficulty>((number + step) % 3);
}

} // namespace

Action show_title(Page& page, TitleScreen& screen) {
    const Canvas& canvas = page.canvas;
    const float left = canvas.px(72.0f), middle = 0.5f * canvas.size().y;
    draw_backdrop(canvas, theme::core);
    draw_lettering(page, left, middle - canvas.px(226.0f));
    const std::vector<Entry> entries = {
        {.label = "Play"},
        {.label = "Difficulty", .value = difficulty_name(*screen.difficulty)},
        {.label = "Options"},
        {.label = "Quit"}};
    const Column column{{left, middle - canvas.px(60.0f)}};
    const Choice choice = run_column(page, column, entries);
    draw_best(page, screen, left, middle + canvas.px(142.0f));
    if (!screen.note.empty())
        canvas.paragraph({left, middle + canvas.px(212.0f)}, canvas.size().x - 2.0f * left,
                         Face::small, theme::amber, screen.note);
    draw_footer(page, false);
    if (choice.kind == Choice::Kind::none || choice.kind == Choice::Kind::back) return Action::none;
    switch (choice.entry) {
    case play_entry:
        return Action::play;
    case options_entry:
        return Action::options;
    case quit_entry:
        return Action::quit;
    default:
        change_difficulty(*screen.difficulty, choice);
        return Action::changed;
    }
}

} // namespace host::ui
