#include "picture.h"

#include <filesystem>

#include "../headless.h"
#include "../image_file.h"

namespace host::game {

void Picture::show(const Viewpoint& view, float exposure, rt_snapshot snapshot) {
    window_.framebuffer_size(width_, height_);
    if (!visible()) return;
    const bool radiance = presenter_.wants_radiance();
    Frame frame = session_.frame(scale_.side(width_), scale_.side(height_));
    frame.exposure = exposure;
    frame.snapshot = snapshot;
    if (radiance) {
        frame.format = RT_FORMAT_RGBA32F;
        frame.tone_mapping = RT_TONE_NONE;
    }
    pixels_.resize(size_t{frame.width} * frame.height * (radiance ? 4 : 1));
    const rt_frame_stats stats = session_.stage.render(view, frame, pixels_.data());
    session_.log.add(stats);
    session_.width = frame.width;
    session_.height = frame.height;
    render_ms_ = stats.frame_ms;
    presenter_.show(pixels_.data(), frame.width, frame.height, width_, height_, exposure,
                    frame.view == RT_VIEW_SHADED);
}

void Picture::adapt(double frame_ms, float chosen) {
    scale_.update(frame_ms, render_ms_, static_cast<double>(chosen));
}

std::string Picture::write_screenshot(const Viewpoint& view, float exposure,
                                      rt_snapshot snapshot) const {
    const auto names = NumberedName::parse("screenshot_%04d.png");
    uint32_t number = 0;
    while (std::filesystem::exists(names->at(number))) ++number;
    Frame frame = session_.frame(static_cast<uint32_t>(width_), static_cast<uint32_t>(height_));
    frame.exposure = exposure;
    frame.snapshot = snapshot;
    write_picture(session_, view, frame, names->at(number));
    return names->at(number);
}

} // namespace host::game
