#pragma once

#include <span>
#include <vector>

#include "../presenter.h"
#include "../session.h"
#include "../window.h"
#include "frame_detail.h"

namespace host::game {

// Renders frames and puts them on the window.
class Picture {
public:
    Picture(Session& session, Window& window)
        : session_(session), window_(window), presenter_(window.modern_gl()) {}

    // Looks at the window. Without anybody who sees it nothing is rendered.
    bool visible();

    // Both for a visible window: renders a frame, or shows the last one once more.
    void show(const Viewpoint& view, float exposure, rt_snapshot snapshot,
              std::span<const rt_particle> particles);
    void repeat();
    // Whether another view or size was shown last.
    bool is_outdated(const Viewpoint& view) const;

    void choose(Effects effects) { effects_ = effects; }

    // After the frame is presented. `chosen`: the scale that the player chose; 0: as fine as the
    // time allows.
    void adapt(double frame_ms, float chosen);

    int width() const { return width_; } // of the frame buffer
    int height() const { return height_; }

    // A file with the next free number. Returns its name.
    std::string write_screenshot(const Viewpoint& view, float exposure, rt_snapshot snapshot) const;

private:
    Frame describe(float exposure, rt_snapshot snapshot) const;

    Session& session_;
    Window& window_;
    Presenter presenter_;
    FrameDetail detail_;
    Effects effects_ = Effects::full;
    int width_ = 0, height_ = 0;
    Viewpoint view_;                                  // of the last frame
    uint32_t sides_[2] = {};                          // of the last frame; 0: there is none
    float exposure_ = 1.0f;                           // of the last frame
    rt_frame_stats stats_ = rt_default_frame_stats(); // of the last frame
    std::vector<float> pixels_; // four floats a pixel, or the bytes of four channels
};

} // namespace host::game
