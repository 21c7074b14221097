#pragma once

#include "level.h"
#include "stage.h"
#include "support/frame_look.h"

#include <vector>

namespace peregrine::bench {

using test::FrameMemory;
using test::Look;

// Processor time of the whole process, and time on the wall, in seconds.
struct Seconds {
    double processor = 0, wall = 0;

    static Seconds now();
    Seconds operator-(const Seconds& other) const {
        return {processor - other.processor, wall - other.wall};
    }
    Seconds& operator+=(const Seconds& other) {
        processor += other.processor;
        wall += other.wall;
        return *this;
    }
};

struct RenderedFrame {
    rt_frame_stats stats;
    Seconds seconds;
};

// A level behind the header, committed, of which no frame has been rendered yet.
class FrameStage {
public:
    // `proofs`: whether the commit proves what a shaded frame would trace.
    FrameStage(const rt_api& api, const host::Level& level, uint32_t threads,
               rt_light_proofs proofs, rt_isa isa = RT_ISA_BEST);

    RenderedFrame render(Look look, const host::Viewpoint& view, FrameMemory& memory) const {
        return render(memory.frame(look), view);
    }
    RenderedFrame render(const rt_frame_desc& desc, const host::Viewpoint& view) const;
    const rt_commit_report& report() const { return report_; }
    host::Stage& stage() { return stage_; }

private:
    host::Stage stage_;
    rt_commit_report report_;
};

// The level's cameras at the start of its animations.
std::vector<host::Viewpoint> standing_cameras(const host::Level& level);

} // namespace peregrine::bench
