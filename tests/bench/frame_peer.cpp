#include "frame_peer.h"

#include "embree_tracer.h"
#include "primary_rays.h"
#include "timing.h"

#include <algorithm>

namespace peregrine::bench {
namespace {

constexpr size_t kFinalists = 3; // modes that run in every pass
constexpr int kTrials = 2;

} // namespace

FramePeer::FramePeer(std::span<const std::string> variants,
                     std::span<const geometry::Triangle> triangles,
                     std::span<const host::Viewpoint> views, ImageSize size, TraceRunner& runner,
                     uint32_t threads)
    : runner_(runner) {
    for (const std::string& variant : variants)
        tracers_.push_back(make_embree_tracer(variant, triangles, threads));
    for (const host::Viewpoint& view : views)
        sets_.push_back(make_primary_rays({&view, 1}, size.width, size.height));
    for (const auto& tracer : tracers_) {
        tracer->prepare(sets_[0], results_);
        for (size_t mode = 0; mode < tracer->mode_count(); ++mode)
            if (tracer->suits(mode, sets_[0])) entrants_.push_back({tracer.get(), mode});
    }
}

double FramePeer::trace(const Entrant& entrant, size_t view) {
    return runner_.run(*entrant.tracer, entrant.mode, sets_[view], results_);
}

void FramePeer::hold_trials() {
    for (Entrant& entrant : entrants_)
        for (size_t view = 0; view < sets_.size(); ++view) {
            double fastest = trace(entrant, view);
            for (int i = 1; i < kTrials; ++i) fastest = std::min(fastest, trace(entrant, view));
            entrant.seconds += fastest;
        }
    std::ranges::sort(entrants_, {}, &Entrant::seconds);
    if (entrants_.size() > kFinalists)
        entrants_.erase(entrants_.begin() + kFinalists, entrants_.end());
    for (Entrant& entrant : entrants_) entrant.seconds = 0;
}

void FramePeer::run(size_t view) {
    for (Entrant& entrant : entrants_) entrant.seconds += trace(entrant, view);
}

void FramePeer::end_pass() {
    for (Entrant& entrant : entrants_) {
        entrant.passes.push_back(entrant.seconds);
        entrant.seconds = 0;
    }
}

FramePeer::Best FramePeer::best() const {
    const auto seconds = [](const Entrant& entrant) { return median(entrant.passes); };
    const Entrant& best = *std::ranges::min_element(entrants_, {}, seconds);
    return {best.tracer->name() + ", " + best.tracer->mode_name(best.mode),
            1e3 * seconds(best) / double(sets_.size())};
}

} // namespace peregrine::bench
