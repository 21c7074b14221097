#include "ui/page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <span>

namespace host::ui {

namespace {

using WindowSize = std::array<int, 2>;
constexpr std::array<WindowSize, 8> window_sizes = {{{640, 480},
                                                     {960, 540},
                                                     {1024, 768},
                                                     {1280, 720},
                                                     {1600, 900},
                                                     {1920, 1080},
                                                     {2560, 1440},
                                                     {3840, 2160}}};
constexpr std::array<int, 7> render_scales = {0, 25, 33, 50, 67, 75, 100};

struct Option {
    Entry entry;
    std::function<void(int step)> change;      // 1 or -1
    std::function<void(float level)> set = {}; // 0 to 1; of a slider
};

// The nearest one of the values in that direction, round to the other end where there is none.
int stepped(std::span<const int> values, int value, int step) {
    if (step > 0) {
        const auto next = std::upper_bound(values.begin(), values.end(), value);
        return next == values.end() ? values.front() : *next;
    }
    const auto next = std::lower_bound(values.begin(), values.end(), value);
    return next == values.begin() ? values.back() : *(next - 1);
}

Option toggle(const char* label, bool& value, bool enabled = true) {
    return {{.label = label, .value = value ? "On" : "Off", .enabled = enabled},
            [&value](int) { value = !value; }};
}

Option range(const char* label, int& value, int lower, int upper, int by, std::string text) {
    Entry entry{.label = label, .value = std::move(text)};
    entry.has_less = value > lower;
    entry.has_more = value < upper;
    entry.level = static_cast<float>(value - lower) / static_cast<float>(upper - lower);
    return {entry,
            [&value, lower, upper, by](int step) {
                value = std::clamp(value + step * by, lower, upper);
            },
            [&value, lower, upper, by](float level) {
                const auto steps = static_cast<float>((upper - lower) / by);
                value = lower + by * static_cast<int>(std::lround(level * steps));
            }};
}

// Those that fit the screen; the smallest in any case.
std::vector<WindowSize> sizes_for(const OptionsScreen& screen) {
    std::vector<WindowSize> sizes = {window_sizes[0]};
    for (const WindowSize& size : window_sizes)
        if (size[0] > sizes[0][0] && size[0] <= screen.most_width && size[1] <= screen.most_height)
            sizes.push_back(size);
    return sizes;
}

Option window_size(const OptionsScreen& screen) {
    PlayerSettings& settings = *screen.settings;
    const std::string text =
        std::to_string(settings.width) + " \xc3\x97 " + std::to_string(settings.height);
    return {{.label = "Window", .value = text, .enabled = !settings.fullscreen},
            [&settings, sizes = sizes_for(screen)](int step) {
                std::vector<int> widths;
                for (const WindowSize& size : sizes) widths.push_back(size[0]);
                settings.width = stepped(widths, settings.width, step);
                for (const WindowSize& size : sizes)
                    if (size[0] == settings.width) settings.height = size[1];
            }};
}

Option render_scale(PlayerSettings& settings) {
    const int scale = settings.render_scale;
    return {{.label = "Detail", .value = scale == 0 ? "Automatic" : std::to_string(scale) + " %"},
            [&settings, scale](int step) {
                settings.render_scale = stepped(render_scales, scale, step);
            }};
}

Option effects(PlayerSettings& settings) {
    constexpr std::array<const char*, 3> names = {"Plain", "Full", "Rich"};
    const auto chosen = static_cast<uint32_t>(settings.effects);
    return {{.label = "Effects", .value = names[chosen]}, [&settings, chosen](int step) {
                settings.effects = static_cast<Effects>((chosen + (step > 0 ? 1u : 2u)) % 3u);
            }};
}

Option sensitivity(PlayerSettings& settings) {
    const auto tenths = static_cast<int>(std::lround(10.0 * settings.sensitivity));
    Entry entry{.label = "Look speed",
                .value = std::to_string(tenths / 10) + "." + std::to_string(tenths % 10)};
    entry.has_less = tenths > 2;
    entry.has_more = tenths < 30;
    entry.level = static_cast<float>(tenths - 2) / 28.0f;
    return {entry,
            [&settings, tenths](int step) {
                settings.sensitivity = std::clamp(tenths + step, 2, 30) / 10.0;
            },
            [&settings](float level) {
                settings.sensitivity = static_cast<double>(2 + std::lround(28.0f * level)) / 10.0;
            }};
}

std::vector<Option> all_options(OptionsScreen& screen) {
    PlayerSettings& settings = *screen.settings;
    std::vector<Option> options = {
        window_size(screen),
        toggle("Full screen", settings.fullscreen),
        render_scale(settings),
        effects(settings),
        range("Field of view", settings.field_of_view, 45, 90, 5,
              std::to_string(settings.field_of_view) + "\xc2\xb0"),
        sensitivity(settings),
        toggle("Invert look", settings.invert_look),
        range("Volume", settings.volume, 0, 100, 10, std::to_string(settings.volume) + " %"),
        toggle("Vibration", settings.vibration, screen.has_vibration)};
    if (!screen.has_sound) {
        Entry& volume = options[7].entry;
        volume.value = "No device";
        volume.enabled = false;
        volume.level = -1.0f;
    }
    return options;
}

void draw_bindings(const Page& page, glm::vec2 lower, glm::vec2 upper) {
    const Canvas& canvas = page.canvas;
    const float pad = canvas.px(20.0f);
    canvas.panel(lower, upper);
    glm::vec2 place = lower + glm::vec2(pad);
    canvas.text(place, Face::body, theme::text, page.device.name);
    place.y += canvas.px(36.0f);
    const size_t count = page.device.bindings.size();
    const float room = upper.y - pad - place.y;
    const float row =
        std::min(canvas.px(31.0f), room / static_cast<float>(std::max<size_t>(count, 1)));
    for (const Binding& binding : page.device.bindings) {
        canvas.line(place, {upper.x - pad, place.y}, theme::faded(theme::dim, 0.14f), 1.0f);
        const float wide = canvas.width(Face::small, binding.action)
                           + canvas.width(Face::small, binding.input) + canvas.px(16.0f);
        const Canvas fitted = canvas.fitted(wide, upper.x - lower.x - 2.0f * pad);
        const float top = place.y + 0.5f * (row - fitted.height(Face::small));
        fitted.text({place.x, top}, Face::small, theme::dim, binding.action);
        fitted.text({upper.x - pad, top}, Face::small, theme::text, binding.input, Align::right);
        place.y += row;
    }
}

} // namespace

Action show_options(Page& page, OptionsScreen& screen) {
    const Canvas& canvas = page.canvas;
    const float left = canvas.px(72.0f), middle = 0.5f * canvas.size().y;
    draw_backdrop(canvas, theme::core);
    canvas.rectangle({0.0f, 0.0f}, canvas.size(), theme::faded(theme::night, 0.45f));
    canvas.text({left, middle - canvas.px(312.0f)}, Face::heading, theme::text, "OPTIONS",
                Align::left, 3.0f);
    std::vector<Option> options = all_options(screen);
    std::vector<Entry> entries;
    for (const Option& option : options) entries.push_back(option.entry);
    entries.push_back({.label = "Back"});
    const float top = middle - canvas.px(238.0f);
    const Choice choice = run_column(page, {{left, top}, 420.0f, 50.0f, 200.0f}, entries);
    const float panel = left + canvas.px(446.0f);
    const float right = std::min(canvas.size().x - canvas.px(32.0f), panel + canvas.px(560.0f));
    draw_bindings(page, {panel, top}, {right, top + canvas.px(450.0f)});
    draw_footer(page, true);
    if (choice.kind == Choice::Kind::none) return Action::none;
    if (choice.kind == Choice::Kind::back || choice.entry >= options.size()) return Action::back;
    const Option& option = options[choice.entry];
    const PlayerSettings before = *screen.settings;
    if (choice.kind == Choice::Kind::set)
        option.set(choice.level);
    else
        option.change(choice.kind == Choice::Kind::less ? -1 : 1);
    return *screen.settings == before ? Action::none : Action::changed;
}

} // namespace host::ui
