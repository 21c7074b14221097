// A stream cut into beams, pencils and waves. Included once for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_STREAM_SPLITTER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_STREAM_SPLITTER_INL_H
#undef PEREGRINE_TRACE_BVH_STREAM_SPLITTER_INL_H
#else
#define PEREGRINE_TRACE_BVH_STREAM_SPLITTER_INL_H
#endif

#include <hwy/highway.h>

#include "trace/bvh/beam/beam-inl.h"
#include "trace/bvh/parallel/parallel-inl.h"
#include "trace/bvh/pencil/pencil-inl.h"
#include "trace/kernels.h"

#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

// A look at a few rays: whether they seem to have one and the same origin, or direction.
inline bool may_be_one(const float* const (&vector)[3], uint32_t first, uint32_t count) {
    const uint32_t others[2] = {first + count / 2, first + count - 1};
    for (const float* component : vector)
        for (const uint32_t i : others)
            if (component[i] != component[first]) return false;
    return true;
}

// ... whether neighbours point the same way.
inline bool may_be_pencil(const RayStream& rays, uint32_t first, uint32_t count) {
    if (rays.coherence == Coherence::coherent) return true; // gather() finds out the rest
    const auto direction = [&](uint32_t i) {
        return math::Vec3(rays.direction[0][i], rays.direction[1][i], rays.direction[2][i]);
    };
    for (uint32_t i = first; i + 1 < first + count; i += std::max(1u, count / 8)) {
        const math::Vec3 a = direction(i), b = direction(i + 1);
        const float across = glm::dot(a, b);
        if (!(across > 0 && across * across > 0.98f * glm::dot(a, a) * glm::dot(b, b)))
            return false;
    }
    return true;
}

// Of those who take no beams of parallel rays.
struct NoParallels {};

// Cuts a stream into beams, which share an origin or a direction, pencils, which are alike, and
// waves, which may be anything: as many rays at a time as make one, halves where they do not.
// beams(beam) and parallels(beam) return false if the rays should go in waves instead.
template <class Beams, class Parallels, class Pencils, class Waves>
class Splitter {
public:
    HWY_ATTR Splitter(const Target& target, const RayStream& rays, Beams beams, Parallels parallels,
                      Pencils pencils, Waves waves)
        : target_(target), rays_(rays), beams_(beams), parallels_(parallels), pencils_(pencils),
          waves_(waves) {
        if (rays.coherence != Coherence::incoherent)
            for (uint32_t first = 0; first < rays.count && !no_beams_; first += kBeamRays)
                split(first, std::min(kBeamRays, rays.count - first));
        flush(rays.count);
    }

private:
    static constexpr bool kTakesParallel = !std::is_same_v<Parallels, NoParallels>;
    // Fewer are not worth the preparations.
    static constexpr uint32_t kLeastBeam = kGroupRays / 2, kLeastPencil = 2 * kBundleRays;

    HWY_ATTR void split(uint32_t first, uint32_t count) {
        if (may_be_one(rays_.origin, first, count)) {
            if (count > kLeastBeam && beam_.gather(target_, rays_, first, count)) {
                trace(beams_, beam_);
                return;
            }
        } else if (takes_parallel(first, count)) {
            if constexpr (kTakesParallel) trace(parallels_, parallel_);
            return;
        } else if (count <= kPencilRays && count >= kLeastPencil
                   && may_be_pencil(rays_, first, count)
                   && pencil_.gather(target_, rays_, first, count)) {
            flush(first);
            pencils_(pencil_);
            waiting_ = first + count;
            return;
        }
        if (count <= kGroupRays) return;
        const uint32_t half = (count / 2 + kGroupRays - 1) / kGroupRays * kGroupRays;
        split(first, half);
        if (!no_beams_) split(first + half, count - half);
    }

    HWY_ATTR bool takes_parallel(uint32_t first, uint32_t count) {
        if constexpr (kTakesParallel)
            return count > kLeastBeam && may_be_one(rays_.direction, first, count)
                   && parallel_.gather(target_, rays_, first, count);
        else
            return false;
    }

    template <class Beam, class Trace>
    HWY_ATTR void trace(Trace& trace_beam, Beam& beam) {
        no_beams_ = !trace_beam(beam);
        if (no_beams_) return;
        flush(beam.first);
        waiting_ = beam.first + beam.count;
    }

    HWY_ATTR void flush(uint32_t end) {
        if (end > waiting_) waves_(waiting_, end - waiting_);
    }

    const Target& target_;
    const RayStream& rays_;
    Beams beams_;
    Parallels parallels_;
    Pencils pencils_;
    Waves waves_;
    uint32_t waiting_ = 0;  // first ray that was not traced yet
    bool no_beams_ = false; // one gave up: the rest goes in waves
    Beam beam_;
    std::conditional_t<kTakesParallel, ParallelBeam, NoParallels> parallel_;
    Pencil pencil_;
};

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
