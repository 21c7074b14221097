#include "viewer.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>

#include "error.h"
#include "exposure.h"
#include "headless.h"
#include "image_file.h"
#include "presenter.h"
#include "probe.h"
#include "stop.h"
#include "walker.h"

namespace host {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double longest_step = 0.1; // seconds: a slow frame must not carry anyone through a wall
constexpr float radians_per_pixel = 0.0022f;
constexpr float arrow_turn = 1.8f; // radians a second

Controls controls_of(const Desk& desk) {
    Controls controls;
    controls.forward = desk.axis(Key::w, Key::s);
    controls.right = desk.axis(Key::d, Key::a);
    controls.up = desk.axis(Key::space, Key::control);
    controls.run = desk.held.has(Key::shift);
    controls.turn = -radians_per_pixel * desk.motion;
    controls.turn_rate =
        arrow_turn * glm::vec2(desk.axis(Key::left, Key::right), desk.axis(Key::up, Key::down));
    return controls;
}

class Viewer {
public:
    Viewer(Session& session, Window& window)
        : session_(session), window_(window), exposure_(session), presenter_(window.modern_gl()),
          probe_(session.stage), walker_(probe_), view_(session.options.view) {
        walker_.place(session.viewpoint());
        window.capture_mouse(true);
    }

    void run() {
        auto before = Clock::now();
        while (!window_.closing() && !is_stopped() && !done()) {
            const auto now = Clock::now();
            const double seconds = std::chrono::duration<double>(now - before).count();
            before = now;
            session_.show_moment(session_.player.time() + seconds, walker_.viewpoint().position);
            const Desk desk = window_.take_desk();
            obey(desk);
            move(controls_of(desk), std::min(seconds, longest_step));
            now_exposure_ = exposure_.drift(walker_.viewpoint(), std::min(seconds, longest_step));
            show_frame();
            update_title(now);
        }
    }

private:
    bool done() const {
        const auto& frames = session_.options.frames;
        return frames && session_.log.count() >= *frames;
    }

    void obey(const Desk& desk) {
        const Keys& pressed = desk.pressed;
        if (pressed.has(Key::mouse)) window_.capture_mouse(true);
        if (pressed.has(Key::f)) walker_.toggle_walking();
        if (pressed.has(Key::v)) view_ = (view_ + 1) % (RT_VIEW_OCCLUSION + 1);
        if (pressed.has(Key::c)) {
            session_.camera = (session_.camera + 1) % session_.cameras.size();
            walker_.place(session_.viewpoint());
            riding_ = true;
        }
        if (pressed.has(Key::p) || pressed.has(Key::f12)) write_screenshot();
        if (!pressed.has(Key::escape)) return;
        if (!desk.captured) window_.close();
        window_.capture_mouse(false);
    }

    // A camera that moves takes the viewer along until they move themselves.
    void move(const Controls& controls, double seconds) {
        riding_ = riding_ && controls.idle();
        if (riding_ && session_.cameras[session_.camera].node != no_index)
            walker_.place(session_.viewpoint());
        else
            walker_.step(controls, seconds);
    }

    Frame frame_of(int window_width, int window_height) const {
        const auto scaled = [&](int side) {
            const float size = static_cast<float>(side) * session_.options.scale.value_or(1.0f);
            return static_cast<uint32_t>(std::clamp(size, 1.0f, 16384.0f));
        };
        Frame frame = session_.frame(scaled(window_width), scaled(window_height));
        frame.view = view_;
        frame.exposure = now_exposure_;
        return frame;
    }

    void show_frame() {
        int width = 0, height = 0;
        window_.framebuffer_size(width, height);
        if (window_.minimised() || width < 1 || height < 1) {
            window_.rest(0.1);
            return;
        }
        Frame frame = frame_of(width, height);
        const bool radiance = presenter_.wants_radiance();
        if (radiance) {
            frame.format = RT_FORMAT_RGBA32F;
            frame.tone_mapping = RT_TONE_NONE;
        }
        pixels_.resize(size_t{frame.width} * frame.height * (radiance ? 4 : 1));
        last_ = session_.stage.render(walker_.viewpoint(), frame, pixels_.data());
        session_.log.add(last_);
        session_.width = frame.width;
        session_.height = frame.height;
        presenter_.show(pixels_.data(), frame.width, frame.height, width, height, frame.exposure,
                        view_ == RT_VIEW_SHADED);
        window_.present();
    }

    void update_title(Clock::time_point now) {
        if (now - titled_ < std::chrono::milliseconds(500)) return;
        titled_ = now;
        const double rays = static_cast<double>(last_.rays_primary + last_.rays_shadow);
        char title[160];
        std::snprintf(title, sizeof title, "Peregrine - %.1f ms - %ux%u - %.1f MRays/s - %s, %s",
                      last_.frame_ms, session_.width, session_.height,
                      last_.frame_ms > 0.0 ? rays / last_.frame_ms * 1e-3 : 0.0, view_name(view_),
                      walker_.walking() ? "walking" : "flying");
        window_.set_title(title);
    }

    // Rendered once more with the engine's own tone mapping. The viewer goes on if it cannot be
    // written.
    void write_screenshot() const {
        int width = 0, height = 0;
        window_.framebuffer_size(width, height);
        if (width < 1 || height < 1) return;
        try {
            const std::string name = free_screenshot_name();
            write_picture(session_, walker_.viewpoint(), frame_of(width, height), name);
            if (!session_.options.quiet) std::cout << "wrote " << name << std::endl;
        } catch (const InputError& error) {
            std::cerr << "peregrine_play: " << error.what() << std::endl;
        }
    }

    Session& session_;
    Window& window_;
    Exposure exposure_;
    Presenter presenter_;
    Probe probe_;
    Walker walker_;
    bool riding_ = true;
    rt_view view_;
    float now_exposure_ = 1.0f;
    std::vector<float> pixels_; // four floats a pixel, or the bytes of four channels
    rt_frame_stats last_ = rt_default_frame_stats();
    Clock::time_point titled_{};
};

} // namespace

void run_viewer(Session& session, Window& window) {
    Viewer(session, window).run();
}

} // namespace host
