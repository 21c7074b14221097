#include "picture.h"

#include "../headless.h"
#include "../image_file.h"

namespace host::game {

bool Picture::visible() {
    window_.framebuffer_size(width_, height_);
    return width_ > 0 && height_ > 0 && !window_.minimised();
}

Frame Picture::describe(float exposure, rt_snapshot snapshot) const {
    Frame frame = session_.frame(static_cast<uint32_t>(width_), static_cast<uint32_t>(height_));
    host::choose(effects_, frame);
    frame.exposure = exposure;
    frame.snapshot = snapshot;
    return frame;
}

void Picture::show(const Viewpoint& view, float exposure, rt_snapshot snapshot,
                   std::span<const rt_particle> particles) {
    const bool radiance = presenter_.wants_radiance();
    session_.particles.assign(particles.begin(), particles.end());
    Frame frame = describe(exposure, snapshot);
    if (radiance) {
        frame.format = RT_FORMAT_RGBA32F;
        frame.tone_mapping = RT_TONE_NONE;
    }
    pixels_.resize(size_t{frame.width} * frame.height * (radiance ? 4 : 1));
    detail_.describe(frame);
    stats_ = session_.stage.render(view, frame, pixels_.data());
    session_.log.add(stats_);
    session_.width = sides_[0] = frame.width;
    session_.height = sides_[1] = frame.height;
    view_ = view;
    exposure_ = exposure;
    presenter_.show(pixels_.data(), frame.width, frame.height, width_, height_, exposure,
                    frame.view == RT_VIEW_SHADED);
}

void Picture::repeat() {
    presenter_.repeat(width_, height_, exposure_, session_.options.view == RT_VIEW_SHADED);
}

bool Picture::is_outdated(const Viewpoint& view) const {
    return view.position != view_.position || view.forward != view_.forward || view.up != view_.up
           || view.vertical_fov != view_.vertical_fov || sides_[0] != static_cast<uint32_t>(width_)
           || sides_[1] != static_cast<uint32_t>(height_);
}

void Picture::adapt(double frame_ms, float chosen) {
    detail_.update(frame_ms, stats_, static_cast<double>(chosen));
}

std::string Picture::write_screenshot(const Viewpoint& view, float exposure,
                                      rt_snapshot snapshot) const {
    const std::string name = free_screenshot_name();
    const Frame frame = describe(exposure, snapshot);
    write_picture(session_, view, frame, name);
    return name;
}

} // namespace host::game
