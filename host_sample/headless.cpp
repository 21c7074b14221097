#include "headless.h"

#include <functional>
#include <iostream>

#include "error.h"
#include "flight.h"
#include "image_file.h"

namespace host {

namespace {

constexpr uint32_t flight_frames = 24;

class PictureMaker {
  public:
    explicit PictureMaker(Session& session)
        : m_session(session),
          m_frame(session.frame(session.options.width, session.options.height)),
          m_pixels(size_t{4} * m_frame.width * m_frame.height) {
        session.width = m_frame.width;
        session.height = m_frame.height;
    }

    void render(const Viewpoint& viewpoint) {
        m_session.log.add(m_session.stage.render(viewpoint, m_frame, m_pixels.data()));
    }

    void write(const std::string& path) const {
        write_png(path, m_frame.width, m_frame.height, m_pixels);
    }

    void show_progress(uint32_t done, uint32_t count) const {
        if (m_session.options.quiet || count == 1) return;
        std::cerr << "\rframe " << done << "/" << count << (done == count ? "\n" : "")
                  << std::flush;
    }

  private:
    Session& m_session;
    Frame m_frame;
    std::vector<uint8_t> m_pixels;
};

void say_result(const Session& session, const std::string& where) {
    if (session.options.quiet) return;
    std::cout << "wrote " << where << " (" << session.log.median_ms() << " ms a frame, "
              << session.log.mrays_per_second() << " million rays a second)\n";
}

void run_still(Session& session, uint32_t frames, const std::optional<NumberedName>& numbered) {
    PictureMaker maker(session);
    for (uint32_t i = 0; i < frames; ++i) {
        maker.render(session.cameras[session.camera]);
        if (numbered) maker.write(numbered->at(i));
        maker.show_progress(i + 1, frames);
    }
    if (!numbered) maker.write(session.options.out);
    say_result(session, session.options.out);
}

} // namespace

void run_flight(Session& session, const std::string& pattern) {
    const auto numbered = NumberedName::parse(pattern);
    if (!numbered) throw InputError("the picture name " + pattern + " has no place for a number");
    const uint32_t frames = session.options.frames.value_or(flight_frames);
    const Flight flight(session.cameras, session.level.bounds.center(),
                        session.level.cameras.empty());
    PictureMaker maker(session);
    for (uint32_t i = 0; i < frames; ++i) {
        // A single stop comes full circle, so its last frame must not repeat the first.
        const uint32_t whole = session.cameras.size() == 1 ? frames : std::max(frames, 2u) - 1;
        maker.render(flight.at(static_cast<double>(i) / static_cast<double>(whole)));
        maker.write(numbered->at(i));
        maker.show_progress(i + 1, frames);
    }
    say_result(session, std::to_string(frames) + " frames of a fly-through to "
                            + numbered->at(0) + " and on");
}

void run_headless(Session& session) {
    const Options& options = session.options;
    if (options.out.empty()) {
        run_flight(session, "out/frame_%04d.png");
        return;
    }
    const auto numbered = NumberedName::parse(options.out);
    if (numbered && options.camera.empty()) {
        run_flight(session, options.out);
        return;
    }
    run_still(session, options.frames.value_or(numbered ? flight_frames : 1), numbered);
}

void write_picture(const Session& session, const Viewpoint& viewpoint, const Frame& frame,
                   const std::string& path) {
    std::vector<uint8_t> pixels(size_t{4} * frame.width * frame.height);
    session.stage.render(viewpoint, frame, pixels.data());
    write_png(path, frame.width, frame.height, pixels);
}

} // namespace host
