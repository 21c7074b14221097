#include "ui/icons.h"
#include "ui/page.h"

#include <cmath>

namespace host::ui {

namespace {

constexpr float pi = 3.14159265f;
constexpr uint32_t most_icons = 8; // more are a number

void draw_shades(const Canvas& canvas, const Hud& hud, double now) {
    const glm::vec2 size = canvas.size();
    const Color night = theme::faded(theme::night, 0.6f), clear = theme::faded(theme::night, 0.0f);
    canvas.gradient_down({0.0f, 0.0f}, {size.x, canvas.px(104.0f)}, night, clear);
    canvas.gradient_down({0.0f, size.y - canvas.px(112.0f)}, size, clear, night);
    if (hud.alarm > 0.3f) {
        const float pulse =
            hud.alarmed ? 0.8f + 0.2f * std::sin(7.0f * static_cast<float>(now)) : 1.0f;
        const float strength = 0.85f * (hud.alarm - 0.3f) / 0.7f * pulse;
        const Color glow =
            theme::mixed(theme::mood(hud.alarm, hud.alarmed), {0.35f, 0.0f, 0.0f, 1.0f}, 0.6f);
        canvas.vignette(theme::faded(glow, strength), 0.5f);
    }
    if (hud.hurt > 0.0f) {
        canvas.rectangle({0.0f, 0.0f}, size, theme::faded(theme::red, 0.2f * hud.hurt));
        canvas.vignette({0.5f, 0.0f, 0.0f, 0.95f * hud.hurt}, 0.25f);
    }
}

void draw_cores(const Canvas& canvas, const Hud& hud) {
    const glm::vec2 place(canvas.px(theme::margin), canvas.px(24.0f));
    canvas.text(place, Face::small, hud.gate_open ? theme::core : theme::dim,
                hud.gate_open ? "THE GATE IS OPEN" : "CORES", Align::left, 1.5f);
    for (uint32_t i = 0; i < hud.cores_total; ++i) {
        const glm::vec2 center =
            place + canvas.px(1.0f) * glm::vec2(10.0f + 30.0f * static_cast<float>(i), 40.0f);
        if (i < hud.cores) {
            canvas.glow(center, 24.0f, theme::faded(theme::core, 0.5f));
            draw_diamond(canvas, center, 12.0f, theme::core, true);
        } else {
            draw_diamond(canvas, center, 12.0f, {0.0f, 0.0f, 0.0f, 0.35f}, true);
            draw_diamond(canvas, center, 12.0f, theme::faded(theme::text, 0.55f), false);
        }
    }
}

void draw_clock_and_alarm(const Canvas& canvas, const Hud& hud) {
    const float middle = 0.5f * canvas.size().x;
    canvas.text({middle, canvas.px(18.0f)}, Face::number, theme::text, clock_text(hud.seconds),
                Align::center);
    const float y = canvas.px(62.0f), half = canvas.px(120.0f);
    canvas.line({middle - half, y}, {middle + half, y}, {0.0f, 0.0f, 0.0f, 0.55f}, 5.0f);
    canvas.line({middle - half, y}, {middle + half, y}, theme::faded(theme::text, 0.3f), 1.0f);
    if (hud.alarm <= 0.0f) return;
    const Color color = theme::mood(hud.alarm, hud.alarmed);
    canvas.line({middle - half * hud.alarm, y}, {middle + half * hud.alarm, y}, color, 5.0f);
    if (hud.alarm < 0.3f && !hud.alarmed) return;
    const char* word = hud.alarmed ? "ALARM" : "SUSPICIOUS";
    const glm::vec2 size(canvas.width(Face::small, word) + canvas.px(20.0f), canvas.px(25.0f));
    const glm::vec2 lower(middle - 0.5f * size.x, y + canvas.px(9.0f));
    canvas.rectangle(lower, lower + size, color, 4.0f);
    canvas.plain_text(lower + canvas.px(1.0f) * glm::vec2(10.0f, 3.0f), Face::small, theme::night,
                      word);
}

void draw_score(const Canvas& canvas, const Hud& hud) {
    const float right = canvas.size().x - canvas.px(theme::margin);
    canvas.text({right, canvas.px(18.0f)}, Face::number, theme::text, score_text(hud.score),
                Align::right);
    canvas.text({right, canvas.px(56.0f)}, Face::small, theme::dim,
                std::to_string(hud.drones) + " of " + std::to_string(hud.drones_total)
                    + (hud.drones_total == 1 ? " drone" : " drones"),
                Align::right);
    if (hud.speed >= 0.95) return;
    canvas.text({right, canvas.px(80.0f)}, Face::small, theme::amber,
                "time at " + std::to_string(std::lround(100.0 * hud.speed)) + " %", Align::right);
}

void draw_lives(const Canvas& canvas, const Hud& hud) {
    const glm::vec2 place(canvas.px(theme::margin + 11.0f),
                          canvas.size().y - canvas.px(theme::margin + 8.0f));
    for (uint32_t i = 0; i < std::min(std::max(hud.lives, hud.lives_total), most_icons); ++i) {
        const glm::vec2 center = place + glm::vec2(canvas.px(31.0f * static_cast<float>(i)), 0.0f);
        draw_heart(canvas, center, 12.0f,
                   i < hud.lives ? theme::mixed(theme::red, theme::text, 0.12f)
                                 : Color(0.25f, 0.28f, 0.31f, 0.75f));
    }
}

void draw_grenades(const Canvas& canvas, const Hud& hud) {
    glm::vec2 place(canvas.size().x - canvas.px(theme::margin + 9.0f),
                    canvas.size().y - canvas.px(theme::margin + 8.0f));
    const uint32_t total = std::max(hud.grenades, hud.grenades_total);
    if (total > most_icons) {
        draw_grenade(canvas, place, 12.5f, theme::text);
        canvas.text(place + canvas.px(1.0f) * glm::vec2(-20.0f, -13.0f), Face::body, theme::text,
                    std::to_string(hud.grenades), Align::right);
        return;
    }
    for (uint32_t i = 0; i < total; ++i) {
        const bool left = i < hud.grenades;
        draw_grenade(canvas, place, 12.5f, left ? theme::text : Color(0.3f, 0.33f, 0.36f, 0.7f));
        place.x -= canvas.px(28.0f);
    }
}

// Five bars away from the eye to one side.
void draw_bars(const Canvas& canvas, glm::vec2 from, float side, float level, const Color& color) {
    constexpr int count = 5;
    for (int i = 0; i < count; ++i) {
        const float part = std::min(1.0f, std::max(0.0f, level * count - static_cast<float>(i)));
        const glm::vec2 a =
            from + canvas.px(1.0f) * glm::vec2(side * (17.0f * static_cast<float>(i)), -3.0f);
        const glm::vec2 b = a + canvas.px(1.0f) * glm::vec2(side * 13.0f, 6.0f);
        const glm::vec2 lower = glm::min(a, b), upper = glm::max(a, b);
        canvas.rectangle(lower, upper, {0.0f, 0.0f, 0.0f, 0.45f}, 2.0f);
        canvas.rectangle(lower, upper, theme::faded(theme::text, 0.22f), 2.0f);
        if (part > 0.0f) canvas.rectangle(lower, upper, theme::faded(color, part), 2.0f);
    }
}

void draw_visibility(const Canvas& canvas, const Hud& hud) {
    const glm::vec2 center(0.5f * canvas.size().x,
                           canvas.size().y - canvas.px(theme::margin + 12.0f));
    const Color eye = hud.seen > 0.0f ? theme::danger(0.35f + 0.65f * hud.seen)
                                      : theme::mixed(theme::dim, theme::text, hud.light);
    draw_eye(canvas, center, 27.0f, std::max(hud.light, hud.seen), std::max(hud.light, hud.seen),
             eye);
    const glm::vec2 out(canvas.px(42.0f), 0.0f);
    draw_bars(canvas, center - out, -1.0f, hud.light, theme::text);
    draw_bars(canvas, center + out, 1.0f, hud.seen, theme::danger(0.35f + 0.65f * hud.seen));
    const float below = canvas.px(8.0f);
    canvas.text(center - out + glm::vec2(0.0f, below), Face::small, theme::dim, "light",
                Align::right);
    canvas.text(center + out + glm::vec2(0.0f, below), Face::small, theme::dim, "seen");
}

void draw_crosshair(const Canvas& canvas, const Hud& hud) {
    const glm::vec2 center = 0.5f * canvas.size();
    for (const glm::vec2 way :
         {glm::vec2(1, 0), glm::vec2(-1, 0), glm::vec2(0, 1), glm::vec2(0, -1)}) {
        const glm::vec2 a = center + canvas.px(6.0f) * way, b = center + canvas.px(13.0f) * way;
        canvas.line(a - canvas.px(1.0f) * way, b + canvas.px(1.0f) * way, {0.0f, 0.0f, 0.0f, 0.6f},
                    4.0f);
        canvas.line(a, b, theme::text, 2.0f);
    }
    canvas.disc(center, 2.4f, {0.0f, 0.0f, 0.0f, 0.6f});
    canvas.disc(center, 1.4f, theme::text);
    if (hud.cooking <= 0.0f) return;
    const Color color = theme::danger(hud.cooking);
    canvas.circle(center, 27.0f, {0.0f, 0.0f, 0.0f, 0.45f}, 6.0f);
    canvas.circle(center, 27.0f, theme::faded(theme::text, 0.25f), 3.0f);
    canvas.arc(center, 27.0f, 0.0f, 2.0f * pi * hud.cooking, color, 4.0f);
}

void draw_hint(const Canvas& canvas, const Hint& hint) {
    if (hint.text.empty()) return;
    const float gap = canvas.px(10.0f), high = canvas.px(26.0f);
    const float cap = hint.key.empty() ? 0.0f : canvas.key_cap_width(hint.key) + gap;
    const float room = canvas.size().x - canvas.px(2.0f * theme::margin) - cap;
    const Canvas fitted = canvas.fitted(canvas.width(Face::body, hint.text), room);
    const float wide = cap + fitted.width(Face::body, hint.text);
    const glm::vec2 place(0.5f * (canvas.size().x - wide), canvas.size().y - canvas.px(136.0f));
    const glm::vec2 pad(canvas.px(16.0f), canvas.px(9.0f));
    canvas.rectangle(place - pad, place + glm::vec2(wide, high) + pad,
                     theme::faded(theme::night, 0.62f), 8.0f);
    if (!hint.key.empty()) canvas.key_cap(place, hint.key);
    fitted.text(place + glm::vec2(cap, 0.5f * (high - fitted.height(Face::body))), Face::body,
                theme::text, hint.text);
}

// What of it marks must not cover.
std::vector<Box> boxes_of(const Canvas& canvas, const Hud& hud) {
    const glm::vec2 size = canvas.size(), center = 0.5f * size;
    const float unit = canvas.px(1.0f), margin = canvas.px(theme::margin);
    const float cores = std::max(150.0f, 30.0f * static_cast<float>(hud.cores_total)) * unit;
    std::vector<Box> boxes = {
        {{0.0f, 0.0f}, {margin + cores, 88.0f * unit}},
        {{center.x - 130.0f * unit, 0.0f}, {center.x + 130.0f * unit, 102.0f * unit}},
        {{size.x - margin - 150.0f * unit, 0.0f}, {size.x, 104.0f * unit}},
        {{0.0f, size.y - 84.0f * unit}, size}};
    if (!hud.hint.text.empty()) boxes.push_back({{0.0f, size.y - 148.0f * unit}, size});
    return boxes;
}

} // namespace

void show_hud(const Canvas& canvas, const Hud& hud, double now, std::span<const Box> taken) {
    draw_shades(canvas, hud, now);
    show_arc(canvas, hud.arc);
    std::vector<Box> boxes = boxes_of(canvas, hud);
    boxes.insert(boxes.end(), taken.begin(), taken.end());
    show_marks(canvas, hud, std::move(boxes));
    draw_crosshair(canvas, hud);
    draw_cores(canvas, hud);
    draw_clock_and_alarm(canvas, hud);
    draw_score(canvas, hud);
    draw_lives(canvas, hud);
    draw_grenades(canvas, hud);
    draw_visibility(canvas, hud);
    draw_hint(canvas, hud.hint);
}

} // namespace host::ui
