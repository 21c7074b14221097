#include "exposure.h"

#include <vector>

namespace host {

namespace {

constexpr uint32_t probe_width = 64, probe_height = 36;
constexpr double patience = 0.1; // seconds between two measurements

} // namespace

Exposure::Exposure(const Session& session, const Sight& sight) : session_(session) {
    eye_.key = sight.key;
    eye_.adaptation = sight.adaptation;
    eye_.least = 0.5f;
    eye_.brighten_seconds = eye_.darken_seconds = 0.5f;
}

void Exposure::measure(const Viewpoint& viewpoint) {
    Frame frame = session_.frame(probe_width, probe_height);
    frame.view = RT_VIEW_SHADED;
    frame.measures_luminance = true;
    std::vector<uint32_t> pixels(size_t{probe_width} * probe_height);
    mean_ =
        static_cast<float>(session_.stage.render(viewpoint, frame, pixels.data()).mean_luminance);
    age_ = 0.0;
}

float Exposure::adapt(double seconds) {
    session_.stage.check(
        session_.stage.api().adapt_exposure(&eye_, mean_, static_cast<float>(seconds)),
        "adapting the exposure");
    return eye_.exposure;
}

float Exposure::settle(const Viewpoint& viewpoint) {
    if (session_.options.exposure) return *session_.options.exposure;
    measure(viewpoint);
    eye_.exposure = 0.0f;
    return adapt(0.0);
}

float Exposure::drift(const Viewpoint& viewpoint, double seconds) {
    if (session_.options.exposure || eye_.exposure == 0.0f) return settle(viewpoint);
    age_ += seconds;
    if (age_ >= patience) measure(viewpoint);
    return adapt(seconds);
}

} // namespace host
