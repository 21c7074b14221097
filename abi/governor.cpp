#include "render/governor.h"

#include "guard.h"
#include "peregrine/rt.h"
#include "read_struct.h"

#include <algorithm>

namespace peregrine::abi {
namespace {

static_assert(std::size(rt_governor().costs) == render::Governor::kMostLevels);

render::Governor to_governor(const rt_governor& in) {
    render::Governor out;
    out.target_ms = in.target_ms;
    out.level = in.level;
    out.frames = in.frames;
    out.patience = in.patience;
    out.previous = in.previous_level;
    out.previous_ms = in.previous_ms;
    out.smooth_ms = in.smooth_ms;
    out.mean_ms = in.mean_ms;
    std::copy(std::begin(in.recent_ms), std::end(in.recent_ms), out.recent_ms);
    std::copy(std::begin(in.costs), std::end(in.costs), out.cost);
    std::copy(std::begin(in.seen_at), std::end(in.seen_at), out.seen_at);
    return out;
}

void store(const render::Governor& in, rt_governor& out) {
    out.level = in.level;
    out.level_count = uint32_t(render::governor_levels().size());
    out.frames = in.frames;
    out.patience = in.patience;
    out.previous_level = in.previous;
    out.previous_ms = in.previous_ms;
    out.smooth_ms = in.smooth_ms;
    out.mean_ms = in.mean_ms;
    std::copy(std::begin(in.recent_ms), std::end(in.recent_ms), out.recent_ms);
    std::copy(std::begin(in.cost), std::end(in.cost), out.costs);
    std::copy(std::begin(in.seen_at), std::end(in.seen_at), out.seen_at);
    out.text = render::governor_levels()[in.level].text;
}

void store(const render::GovernorLevel& level, rt_frame_desc& frame) {
    render::Approximations options;
    level.apply_to(options, {frame.width, frame.height});
    frame.light_block = options.light_block;
    frame.light_tolerance = options.light_tolerance;
    frame.edge_samples = options.edge_samples;
    frame.edge_budget = options.edge_budget;
    frame.render_width = options.render_width;
    frame.render_height = options.render_height;
}

constexpr uint32_t kGovernable = 160; // rt_frame_desc's first size with all the fields

} // namespace
} // namespace peregrine::abi

using namespace peregrine::abi;

rt_result rt_govern_frame(rt_governor* governor, rt_frame_desc* frame,
                          const rt_frame_stats* last) noexcept {
    return guard([&] {
        rt_governor state = read_struct(governor);
        rt_frame_desc desc = read_struct(frame);
        if (frame->struct_size < kGovernable)
            peregrine::base::fail(
                peregrine::base::Code::invalid_struct,
                "rt_frame_desc.struct_size is %u; a frame to govern has at least %u bytes",
                frame->struct_size, kGovernable);
        auto engine_governor = to_governor(state);
        if (last)
            engine_governor.observe(read_struct(last).frame_ms);
        else
            engine_governor.begin();
        store(engine_governor, state);
        store(peregrine::render::governor_levels()[state.level], desc);
        Output(governor).write(state);
        Output(frame).write(desc);
    });
}
