#include "render/exposure.h"

#include "check.h"
#include "guard.h"
#include "read_struct.h"

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

} // namespace
} // namespace peregrine::abi

using namespace peregrine::abi;

rt_result rt_adapt_exposure(rt_exposure* exposure, float mean_luminance, float seconds) noexcept {
    return guard([&] {
        rt_exposure state = read_struct(exposure);
        check(state);
        require_least_zero(mean_luminance, "mean_luminance");
        require_least_zero(seconds, "seconds");
        const peregrine::render::Eye eye = {
            state.key,     state.adaptation,       state.least,
            state.most,    state.brighten_seconds, state.darken_seconds,
            state.exposure};
        state.exposure = peregrine::render::adapt(eye, mean_luminance, seconds);
        Output(exposure).write(state);
    });
}
