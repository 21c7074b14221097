#include "render/exposure.h"

#include <algorithm>
#include <cmath>

namespace peregrine::render {

float adapt(const Eye& eye, float mean, float seconds) {
    const auto in_limits = [&](float exposure) {
        return std::clamp(exposure, eye.least, eye.most);
    };
    if (mean == 0) return in_limits(eye.exposure > 0 ? eye.exposure : 1.0f);
    const double wanted = std::pow(double(eye.key) / double(mean), double(eye.adaptation));
    const float goal = in_limits(float(std::min(wanted, double(eye.most))));
    const float constant = goal > eye.exposure ? eye.brighten_seconds : eye.darken_seconds;
    if (eye.exposure == 0 || constant == 0) return goal;
    const double rest = std::exp(-double(seconds) / double(constant));
    return in_limits(float(double(goal) * std::pow(double(eye.exposure) / double(goal), rest)));
}

} // namespace peregrine::render
