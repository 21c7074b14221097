#pragma once

#include <vector>

#include "../presenter.h"
#include "../session.h"
#include "../window.h"
#include "render_scale.h"

namespace host::game {

// Renders frames and puts them on the window.
class Picture {
public:
    Picture(Session& session, Window& window)
        : session_(session), window_(window), presenter_(window.modern_gl()) {}

    void show(const Viewpoint& view, float exposure, rt_snapshot snapshot);
    bool visible() const { return width_ > 0 && height_ > 0; } // not minimised

    // After the frame is presented. `chosen`: the scale that the player chose; 0: as large as the
    // time allows.
    void adapt(double frame_ms, float chosen);

    int width() const { return width_; } // of the frame buffer
    int height() const { return height_; }

    // A file with the next free number. Returns its name.
    std::string write_screenshot(const Viewpoint& view, float exposure, rt_snapshot snapshot) const;

private:
    Session& session_;
    Window& window_;
    Presenter presenter_;
    RenderScale scale_;
    int width_ = 0, height_ = 0;
    double render_ms_ = 0.0;
    std::vector<float> pixels_; // four floats a pixel, or the bytes of four channels
};

} // namespace host::game
