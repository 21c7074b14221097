#include "ui/page.h"

#include <array>

namespace host::ui {

Action show_pause(Page& page, const PauseScreen& screen) {
    const Canvas& canvas = page.canvas;
    const float left = canvas.px(72.0f), middle = 0.5f * canvas.size().y;
    draw_backdrop(canvas, theme::core);
    canvas.text({left - canvas.px(4.0f), middle - canvas.px(220.0f)}, Face::title, theme::text,
                "PAUSED", Align::left, 5.0f);
    canvas.text({left, middle - canvas.px(116.0f)}, Face::body, theme::dim,
                screen.level + "  \xc2\xb7  " + difficulty_name(screen.difficulty));
    const std::vector<Entry> entries = {
        {.label = "Resume"}, {.label = "Restart"}, {.label = "Options"}, {.label = "To the title"}};
    constexpr std::array actions = {Action::resume, Action::restart, Action::options,
                                    Action::to_title};
    const Choice choice = run_column(page, {{left, middle - canvas.px(60.0f)}}, entries);
    draw_footer(page, true);
    if (choice.kind == Choice::Kind::back) return Action::resume;
    return choice.kind == Choice::Kind::accept ? actions.at(choice.entry) : Action::none;
}

} // namespace host::ui
