#include "ui/ui.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <optional>

#include <backends/imgui_impl_opengl2.h>
#include <backends/imgui_impl_opengl3.h>

#include "error.h"
#include "ui/fixed_pipeline.h"
#include "ui/page.h"

namespace host::ui {

namespace {

enum class Screen { none, title, pause, options, end };
constexpr size_t screen_count = 5;

constexpr double toast_seconds = 4.0, appear_seconds = 0.22, font_patience = 0.2;
constexpr size_t most_toasts = 4;

struct Toast {
    std::string sentence;
    double age = 0.0;
};

const Device keyboard{"Keyboard and mouse", "Enter", "Esc", {}};

float unit_of(glm::vec2 size) {
    return std::max(0.3f, std::min(size.y / theme::design_height, size.x / theme::design_width));
}

Canvas fitted_to(const Canvas& canvas, const std::string& sentence) {
    return canvas.fitted(canvas.width(Face::small, sentence), canvas.size().x - canvas.px(100.0f));
}

} // namespace

struct Ui::State {
    bool modern = true;
    ImGuiContext* context = nullptr;
    Fonts fonts;
    std::vector<std::string> notes;
    Frame frame;
    float unit = 1.0f;
    double unit_age = 0.0; // seconds since the window's size changed
    double now = 0.0;
    Screen shown = Screen::none, shown_before = Screen::none;
    double shown_age = 0.0;
    std::array<Menu, screen_count> menus;
    std::deque<Toast> toasts;
    MenuSounds sounds;
    Box text_box;
    std::optional<Canvas> canvas;

    void make_fonts();
    Box toast_box(size_t number) const;
    void draw_toasts();
    Page open(Screen screen);
};

void Ui::State::make_fonts() {
    std::string note;
    fonts = load_fonts(unit, note);
    if (!note.empty() && notes.empty()) notes.push_back(note);
    if (modern) {
        ImGui_ImplOpenGL3_DestroyFontsTexture();
        ImGui_ImplOpenGL3_CreateFontsTexture();
    } else {
        ImGui_ImplOpenGL2_DestroyFontsTexture();
        ImGui_ImplOpenGL2_CreateFontsTexture();
    }
}

Ui::Ui(bool modern) : state_(std::make_unique<State>()) {
    State& s = *state_;
    s.modern = modern;
    s.context = ImGui::CreateContext();
    ImGui::SetCurrentContext(s.context);
    ImGui::GetIO().IniFilename = nullptr;
    const bool ready =
        modern ? ImGui_ImplOpenGL3_Init("#version 330 core") : ImGui_ImplOpenGL2_Init();
    if (!ready) {
        ImGui::DestroyContext(s.context);
        throw InputError("OpenGL cannot draw the menus");
    }
}

Ui::~Ui() {
    ImGui::SetCurrentContext(state_->context);
    if (state_->modern)
        ImGui_ImplOpenGL3_Shutdown();
    else
        ImGui_ImplOpenGL2_Shutdown();
    ImGui::DestroyContext(state_->context);
}

void Ui::begin(const Frame& frame) {
    State& s = *state_;
    ImGui::SetCurrentContext(s.context);
    s.frame = frame;
    s.now += frame.seconds;
    const glm::vec2 size(std::max(frame.width, 1), std::max(frame.height, 1));
    // While the window is pulled to another size letters are stretched; then they are made anew.
    const float unit = unit_of(size);
    s.unit_age = unit == s.unit ? s.unit_age + frame.seconds : 0.0;
    s.unit = unit;
    if (s.fonts.unit == 0.0f || (s.fonts.unit != unit && s.unit_age > font_patience))
        s.make_fonts();
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {size.x, size.y};
    io.DeltaTime = std::max(1e-4f, static_cast<float>(frame.seconds));
    if (s.modern)
        ImGui_ImplOpenGL3_NewFrame();
    else
        ImGui_ImplOpenGL2_NewFrame();
    ImGui::NewFrame();
    s.text_box = {};
    s.canvas.emplace(*ImGui::GetBackgroundDrawList(), s.fonts, size, unit, s.text_box);
    s.shown_before = s.shown;
    s.shown = Screen::none;
    s.shown_age += frame.seconds;
}

Page Ui::State::open(Screen screen) {
    shown = screen;
    Menu& menu = menus[static_cast<size_t>(screen)];
    if (shown != shown_before) {
        shown_age = 0.0;
        if (shown_before != Screen::options) menu.select(0);
    }
    const auto appeared = static_cast<float>(std::min(1.0, shown_age / appear_seconds));
    canvas->set_alpha(0.15f + 0.85f * appeared);
    return {*canvas, menu, frame.menu, frame.pointer, frame.device ? *frame.device : keyboard,
            sounds,  now};
}

void Ui::hud(const Hud& hud) {
    std::vector<Box> toasts;
    for (size_t i = 0; i < state_->toasts.size(); ++i) toasts.push_back(state_->toast_box(i));
    show_hud(*state_->canvas, hud, state_->now, toasts);
}

Action Ui::title(TitleScreen& screen) {
    Page page = state_->open(Screen::title);
    return show_title(page, screen);
}

Action Ui::pause(const PauseScreen& screen) {
    Page page = state_->open(Screen::pause);
    return show_pause(page, screen);
}

Action Ui::options(OptionsScreen& screen) {
    Page page = state_->open(Screen::options);
    return show_options(page, screen);
}

Action Ui::end(const EndScreen& screen) {
    Page page = state_->open(Screen::end);
    return show_end(page, screen);
}

void Ui::loading(const std::string& text, float fraction) {
    const Canvas& canvas = *state_->canvas;
    const float left = canvas.px(72.0f), middle = 0.5f * canvas.size().y, wide = canvas.px(380.0f);
    canvas.rectangle({0.0f, 0.0f}, canvas.size(), theme::night);
    canvas.text({left - canvas.px(4.0f), middle - canvas.px(226.0f)}, Face::title, theme::text,
                "THREE CORES", Align::left, 5.0f);
    canvas.text({left, middle - canvas.px(60.0f)}, Face::body, theme::dim, text);
    const glm::vec2 a(left, middle - canvas.px(20.0f));
    canvas.line(a, a + glm::vec2(wide, 0.0f), theme::faint, 3.0f);
    canvas.line(a, a + glm::vec2(std::clamp(fraction, 0.0f, 1.0f) * wide, 0.0f), theme::core, 3.0f);
}

Box Ui::State::toast_box(size_t number) const {
    const std::string& sentence = toasts[number].sentence;
    const float wide =
        fitted_to(*canvas, sentence).width(Face::small, sentence) + canvas->px(28.0f);
    const glm::vec2 lower(canvas->size().x - canvas->px(theme::margin) - wide,
                          canvas->px(108.0f + 42.0f * static_cast<float>(number)));
    return {lower, lower + glm::vec2(wide, canvas->px(34.0f))};
}

void Ui::State::draw_toasts() {
    canvas->set_alpha(1.0f);
    for (size_t i = 0; i < toasts.size(); ++i) {
        Toast& toast = toasts[i];
        toast.age += frame.seconds;
        const double fading = std::min(toast.age / 0.25, (toast_seconds - toast.age) / 0.5);
        const auto alpha = static_cast<float>(std::clamp(fading, 0.0, 1.0));
        const auto [lower, upper] = toast_box(i);
        canvas->rectangle(lower, upper, theme::faded(theme::night, 0.75f * alpha), 5.0f);
        canvas->rectangle(lower, {lower.x + canvas->px(3.0f), upper.y},
                          theme::faded(theme::core, alpha));
        fitted_to(*canvas, toast.sentence)
            .text(lower + canvas->px(1.0f) * glm::vec2(15.0f, 8.0f), Face::small,
                  theme::faded(theme::text, alpha), toast.sentence);
    }
    std::erase_if(toasts, [](const Toast& toast) { return toast.age >= toast_seconds; });
}

void Ui::end_frame() {
    State& s = *state_;
    s.draw_toasts();
    ImGui::Render();
    glViewport(0, 0, std::max(s.frame.width, 1), std::max(s.frame.height, 1));
    if (s.modern) {
        ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
        return;
    }
    const FixedPipeline fixed;
    ImGui_ImplOpenGL2_RenderDrawData(ImGui::GetDrawData());
}

void Ui::toast(std::string sentence) {
    auto& toasts = state_->toasts;
    toasts.push_back({std::move(sentence)});
    if (toasts.size() > most_toasts) toasts.pop_front();
}

Ui::MenuSounds Ui::take_sounds() {
    return std::exchange(state_->sounds, {});
}

Box Ui::text_box() const {
    return state_->text_box;
}

const std::vector<std::string>& Ui::notes() const {
    return state_->notes;
}

} // namespace host::ui
