#include "headless.h"

#include <algorithm>
#include <functional>
#include <iostream>

#include "error.h"
#include "exposure.h"
#include "flight.h"
#include "image_file.h"
#include "stop.h"

namespace host {

namespace {

constexpr uint32_t flight_frames = 24;
constexpr double flight_step = 0.2; // seconds that a frame of the flight stands for
constexpr double still_step = 1.0 / 30.0;

uint32_t scaled(const Options& options, uint32_t side) {
    return std::max(1u,
                    static_cast<uint32_t>(static_cast<float>(side) * options.scale.value_or(1.0f)));
}

class PictureMaker {
public:
    explicit PictureMaker(Session& session)
        : session_(session), frame_(session.frame(scaled(session.options, session.options.width),
                                                  scaled(session.options, session.options.height))),
          pixels_(size_t{4} * frame_.width * frame_.height) {
        session.width = frame_.width;
        session.height = frame_.height;
    }

    void expose(const Viewpoint& viewpoint) { frame_.exposure = exposure_.settle(viewpoint); }
    void drift(const Viewpoint& viewpoint) {
        frame_.exposure = exposure_.drift(viewpoint, flight_step);
    }

    void render(const Viewpoint& viewpoint) {
        frame_.particles = to_array(session_.particles);
        session_.log.add(session_.stage.render(viewpoint, frame_, pixels_.data()));
    }

    void write(const std::string& path) const {
        write_picture_file(path, frame_.width, frame_.height, pixels_);
    }

    void show_progress(uint32_t done, uint32_t count) const {
        if (session_.options.quiet || count == 1) return;
        std::cerr << "\rframe " << done << "/" << count << (done == count ? "\n" : "")
                  << std::flush;
    }

private:
    Session& session_;
    Exposure exposure_{session_};
    Frame frame_;
    std::vector<uint8_t> pixels_;
};

void say_result(const Session& session, const std::string& where) {
    if (session.options.quiet) return;
    std::cout << "wrote " << where << " (" << session.log.median_ms() << " ms a frame, "
              << session.log.mrays_per_second() << " million rays a second)\n";
}

// The first frame shows --time.
void advance(Session& session, uint32_t frame, double step, const glm::dvec3& eye) {
    const Options& options = session.options;
    session.show_moment(options.time + frame * options.time_step.value_or(step), eye);
}

void run_still(Session& session, uint32_t frames, const std::optional<NumberedName>& numbered) {
    PictureMaker maker(session);
    maker.expose(session.viewpoint());
    for (uint32_t i = 0; i < frames && !is_stopped(); ++i) {
        advance(session, i, still_step, session.viewpoint().position);
        maker.render(session.viewpoint());
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
    PictureMaker maker(session);
    glm::dvec3 eye = session.viewpoint().position; // of the last frame
    for (uint32_t i = 0; i < frames && !is_stopped(); ++i) {
        // A single stop comes full circle, so its last frame must not repeat the first.
        const uint32_t whole = session.cameras.size() == 1 ? frames : std::max(frames, 2u) - 1;
        advance(session, i, flight_step, eye);
        std::vector<Viewpoint> stops;
        for (const Viewpoint& camera : session.cameras)
            stops.push_back(session.player.follow(camera));
        const Flight flight(stops, session.level.bounds.center(), session.level.cameras.empty());
        const Viewpoint view = flight.at(static_cast<double>(i) / static_cast<double>(whole));
        eye = view.position;
        maker.drift(view);
        maker.render(view);
        maker.write(numbered->at(i));
        maker.show_progress(i + 1, frames);
    }
    say_result(session, std::to_string(frames) + " frames of a fly-through to " + numbered->at(0)
                            + " and on");
}

void run_headless(Session& session) {
    const Options& options = session.options;
    if (options.out.empty()) {
        run_flight(session, flight_pictures);
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
    write_picture_file(path, frame.width, frame.height, pixels);
}

} // namespace host
