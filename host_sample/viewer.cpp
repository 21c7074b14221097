#include "viewer.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>

#include "headless.h"
#include "image_file.h"
#include "presenter.h"

namespace host {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double longest_step = 0.1; // seconds: a slow frame must not carry anyone through a wall

class Viewer {
  public:
    Viewer(Session& session, Window& window)
        : m_session(session), m_window(window), m_presenter(window.modern_gl()),
          m_probe(session.stage), m_walker(m_probe), m_view(session.options.view) {
        m_walker.place(session.cameras[session.camera]);
    }

    void run() {
        auto before = Clock::now();
        while (!m_window.closing() && !done()) {
            const auto now = Clock::now();
            const double seconds = std::chrono::duration<double>(now - before).count();
            before = now;
            obey(m_window.take_presses());
            m_walker.step(m_window.controls(), std::min(seconds, longest_step));
            show_frame();
            update_title(now);
        }
    }

  private:
    bool done() const {
        const auto& frames = m_session.options.frames;
        return frames && m_session.log.count() >= *frames;
    }

    void obey(const Presses& presses) {
        if (presses.toggle_walking) m_walker.toggle_walking();
        if (presses.next_view) m_view = (m_view + 1) % (RT_VIEW_STEPS + 1);
        if (presses.next_camera) {
            m_session.camera = (m_session.camera + 1) % m_session.cameras.size();
            m_walker.place(m_session.cameras[m_session.camera]);
        }
        if (presses.screenshot) write_screenshot();
    }

    Frame frame_of(int window_width, int window_height) const {
        const auto scaled = [&](int side) {
            const float size = static_cast<float>(side) * m_session.options.scale;
            return static_cast<uint32_t>(std::clamp(size, 1.0f, 16384.0f));
        };
        Frame frame = m_session.frame(scaled(window_width), scaled(window_height));
        frame.view = m_view;
        return frame;
    }

    void show_frame() {
        int width = 0, height = 0;
        m_window.framebuffer_size(width, height);
        if (width < 1 || height < 1) { // minimised
            m_window.present();
            return;
        }
        Frame frame = frame_of(width, height);
        const bool radiance = m_presenter.wants_radiance();
        if (radiance) {
            frame.format = RT_FORMAT_RGBA32F;
            frame.tone_mapping = RT_TONE_NONE;
        }
        m_pixels.resize(size_t{frame.width} * frame.height * (radiance ? 4 : 1));
        m_last = m_session.stage.render(m_walker.viewpoint(), frame, m_pixels.data());
        m_session.log.add(m_last);
        m_session.width = frame.width;
        m_session.height = frame.height;
        m_presenter.show(m_pixels.data(), frame.width, frame.height, width, height, frame.exposure,
                         m_view == RT_VIEW_SHADED);
        m_window.present();
    }

    void update_title(Clock::time_point now) {
        if (now - m_titled < std::chrono::milliseconds(500)) return;
        m_titled = now;
        const double rays = static_cast<double>(m_last.rays_primary + m_last.rays_shadow);
        char title[160];
        std::snprintf(title, sizeof title, "Peregrine - %.1f ms - %ux%u - %.1f MRays/s - %s, %s",
                      m_last.frame_ms, m_session.width, m_session.height,
                      m_last.frame_ms > 0.0 ? rays / m_last.frame_ms * 1e-3 : 0.0,
                      view_name(m_view), m_walker.walking() ? "walking" : "flying");
        m_window.set_title(title);
    }

    // Rendered once more with the engine's own tone mapping.
    void write_screenshot() const {
        int width = 0, height = 0;
        m_window.framebuffer_size(width, height);
        if (width < 1 || height < 1) return;
        const auto names = NumberedName::parse("screenshot_%04d.png");
        uint32_t number = 0;
        while (std::filesystem::exists(names->at(number))) ++number;
        write_picture(m_session, m_walker.viewpoint(), frame_of(width, height), names->at(number));
        if (!m_session.options.quiet) std::cout << "wrote " << names->at(number) << std::endl;
    }

    Session& m_session;
    Window& m_window;
    Presenter m_presenter;
    Probe m_probe;
    Walker m_walker;
    rt_view m_view;
    std::vector<float> m_pixels; // four floats a pixel, or the bytes of four channels
    rt_frame_stats m_last = rt_default_frame_stats();
    Clock::time_point m_titled{};
};

} // namespace

void run_viewer(Session& session, Window& window) { Viewer(session, window).run(); }

} // namespace host
