// A stream cut into beams, pencils and waves. Included once for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_STREAM_SPLITTER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_STREAM_SPLITTER_INL_H
#undef PEREGRINE_TRACE_BVH_STREAM_SPLITTER_INL_H
#else
#define PEREGRINE_TRACE_BVH_STREAM_SPLITTER_INL_H
#endif

#include <hwy/highway.h>

#include "trace/bvh/beam/beam-inl.h"
#include "trace/bvh/pencil/pencil-inl.h"
#include "trace/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

// A look at a few rays: whether they seem to start at one point.
inline bool may_be_beam(const RayStream& rays, uint32_t first, uint32_t count) {
    const uint32_t others[2] = {first + count / 2, first + count - 1};
    for (const float* origin : rays.origin)
        for (const uint32_t i : others)
            if (origin[i] != origin[first]) return false;
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

// Cuts a stream into beams, which share an origin, pencils, which are alike, and waves, which may
// be anything: as many rays at a time as make one, halves where they do not. beams(beam) returns
// false if the rays should go in waves instead.
template <class Beams, class Pencils, class Waves>
class Splitter {
public:
    HWY_ATTR Splitter(const Target& target, const RayStream& rays, Beams beams, Pencils pencils,
                      Waves waves)
        : target_(target), rays_(rays), beams_(beams), pencils_(pencils), waves_(waves) {
        if (rays.coherence != Coherence::incoherent)
            for (uint32_t first = 0; first < rays.count && !no_beams_; first += kBeamRays)
                split(first, std::min(kBeamRays, rays.count - first));
        flush(rays.count);
    }

private:
    // Fewer are not worth the preparations.
    static constexpr uint32_t kLeastBeam = kGroupRays / 2, kLeastPencil = 2 * kBundleRays;

    HWY_ATTR void split(uint32_t first, uint32_t count) {
        if (may_be_beam(rays_, first, count)) {
            if (count > kLeastBeam && beam_.gather(target_, rays_, first, count)) {
                no_beams_ = !beams_(beam_);
                if (no_beams_) return;
                flush(first);
                waiting_ = first + count;
                return;
            }
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

    HWY_ATTR void flush(uint32_t end) {
        if (end > waiting_) waves_(waiting_, end - waiting_);
    }

    const Target& target_;
    const RayStream& rays_;
    Beams beams_;
    Pencils pencils_;
    Waves waves_;
    uint32_t waiting_ = 0;  // first ray that was not traced yet
    bool no_beams_ = false; // one gave up: the rest goes in waves
    Beam beam_;
    Pencil pencil_;
};

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
