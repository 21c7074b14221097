#include "track.h"

#include <algorithm>

#include <glm/gtc/quaternion.hpp>

namespace host {

namespace {

// Where a time lies: `part` of the way from one key to the next, `seconds` apart.
struct Span {
    size_t from = 0, to = 0;
    double part = 0.0, seconds = 0.0;
};

Span find_span(const std::vector<float>& times, double time) {
    const auto after = std::upper_bound(times.begin(), times.end(), time);
    if (after == times.begin()) return {};
    const auto from = static_cast<size_t>(after - times.begin()) - 1;
    if (after == times.end()) return {from, from, 0.0, 0.0};
    const auto begin = static_cast<double>(times[from]);
    const double seconds = static_cast<double>(*after) - begin;
    return {from, from + 1, (time - begin) / seconds, seconds};
}

glm::dquat to_unit(const glm::dquat& q) {
    const double length = glm::length(q);
    return length > 0.0 ? q / length : glm::dquat(1.0, 0.0, 0.0, 0.0);
}

glm::dquat read_rotation(const float* xyzw) {
    return to_unit(glm::dquat(static_cast<double>(xyzw[3]), static_cast<double>(xyzw[0]),
                              static_cast<double>(xyzw[1]), static_cast<double>(xyzw[2])));
}

void write_rotation(const glm::dquat& q, std::span<double> value) {
    value[0] = q.x;
    value[1] = q.y;
    value[2] = q.z;
    value[3] = q.w;
}

// glTF 2.0, appendix C.5: Hermite's cubic, with tangents in units a second.
void sample_cubic(const Track& track, const Span& span, std::span<double> value) {
    const double t = span.part, t2 = t * t, t3 = t2 * t;
    const double from = 2.0 * t3 - 3.0 * t2 + 1.0, leaving = (t3 - 2.0 * t2 + t) * span.seconds;
    const double to = 3.0 * t2 - 2.0 * t3, arriving = (t3 - t2) * span.seconds;
    const float* begin = track.values.data() + 3 * span.from * track.width;
    const float* end = track.values.data() + 3 * span.to * track.width;
    for (size_t i = 0; i < track.width; ++i)
        value[i] = from * static_cast<double>(begin[track.width + i])
                   + leaving * static_cast<double>(begin[2 * track.width + i])
                   + to * static_cast<double>(end[track.width + i])
                   + arriving * static_cast<double>(end[i]);
    if (track.property == Property::rotation)
        write_rotation(to_unit(glm::dquat(value[3], value[0], value[1], value[2])), value);
}

} // namespace

void sample(const Track& track, double time, std::span<double> value) {
    Span span = find_span(track.times, time);
    if (track.interpolation == Interpolation::cubic) {
        sample_cubic(track, span, value);
        return;
    }
    if (track.interpolation == Interpolation::step) span.to = span.from;
    const float* begin = track.values.data() + span.from * track.width;
    const float* end = track.values.data() + span.to * track.width;
    if (track.property == Property::rotation) { // glm::slerp takes the shorter way round
        write_rotation(glm::slerp(read_rotation(begin), read_rotation(end), span.part), value);
        return;
    }
    for (size_t i = 0; i < track.width; ++i)
        value[i] = glm::mix(static_cast<double>(begin[i]), static_cast<double>(end[i]), span.part);
}

} // namespace host
