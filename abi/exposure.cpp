#include "check.h"
#include "guard.h"
#include "read_struct.h"

#include <algorithm>
#include <cmath>

namespace peregrine::abi {
namespace {

void check(const rt_exposure& in) {
    require_positive(in.key, "rt_exposure.key");
    if (!(in.adaptation >= 0 && in.adaptation <= 1))
        base::fail(base::Code::invalid_argument, "rt_exposure.adaptation is %g; it must be 0 to 1",
                   double(in.adaptation));
    require_positive(in.least, "rt_exposure.least");
    require_positive(in.most, "rt_exposure.most");
    if (in.least > in.most)
        base::fail(base::Code::invalid_argument, "rt_exposure.least is %g, above its most, %g",
                   double(in.least), double(in.most));
    require_least_zero(in.brighten_seconds, "rt_exposure.brighten_seconds");
    require_least_zero(in.darken_seconds, "rt_exposure.darken_seconds");
    require_least_zero(in.exposure, "rt_exposure.exposure");
}

float wanted(const rt_exposure& in, float mean) {
    const double goal = std::pow(double(in.key) / double(mean), double(in.adaptation));
    return std::clamp(float(std::min(goal, double(in.most))), in.least, in.most);
}

float adapted(const rt_exposure& in, float mean, float seconds) {
    if (mean == 0) return std::clamp(in.exposure > 0 ? in.exposure : 1.0f, in.least, in.most);
    const float goal = wanted(in, mean);
    const float constant = goal > in.exposure ? in.brighten_seconds : in.darken_seconds;
    if (in.exposure == 0 || constant == 0) return goal;
    const double rest = std::exp(-double(seconds) / double(constant));
    const double now = double(goal) * std::pow(double(in.exposure) / double(goal), rest);
    return std::clamp(float(now), in.least, in.most);
}

} // namespace
} // namespace peregrine::abi

using namespace peregrine::abi;

rt_result rt_adapt_exposure(rt_exposure* exposure, float mean_luminance, float seconds) noexcept {
    return guard([&] {
        rt_exposure state = read_struct(exposure);
        check(state);
        require_least_zero(mean_luminance, "mean_luminance");
        require_least_zero(seconds, "seconds");
        state.exposure = adapted(state, mean_luminance, seconds);
        Output(exposure).write(state);
    });
}
