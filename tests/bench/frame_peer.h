#pragma once

#include "geometry/triangle.h"
#include "image_size.h"
#include "trace_rays.h"
#include "trace_run.h"
#include "tracer.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace peregrine::bench {

// Peers that trace the primary rays of frames, each in all of its modes, of which the fastest for
// the scene counts. What is timed: the rays, which lie in memory as records, are brought into the
// peer's form; it finds its whole hits (t, primitive, mesh, u, v, normal); t, primitive and mesh
// are stored in arrays.
class FramePeer {
public:
    // Variants are those of make_embree_tracer().
    FramePeer(std::span<const std::string> variants, std::span<const geometry::Triangle> triangles,
              std::span<const host::Viewpoint> views, ImageSize size, TraceRunner& runner,
              uint32_t threads);

    // Every mode over all views; the fastest few stay in the race.
    void hold_trials();

    void run(size_t view);
    void end_pass(); // after run() with every view

    struct Best {
        std::string mode;
        double frame_ms; // the median pass, divided by the views
    };
    Best best() const;

private:
    struct Entrant {
        const Tracer* tracer;
        size_t mode;
        double seconds = 0;              // of the pass that runs
        std::vector<double> passes = {}; // seconds, all views
    };

    double trace(const Entrant& entrant, size_t view);

    TraceRunner& runner_;
    std::vector<std::unique_ptr<Tracer>> tracers_;
    std::vector<RaySet> sets_; // one a view
    std::vector<Entrant> entrants_;
    Results results_;
};

} // namespace peregrine::bench
