// The kernels of the wide BVH, compiled once for each instruction set. The same operations in the
// same order as geometry/intersect.h wherever a hit is decided, so the same bits.
#include "base/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/bvh/simd_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "trace/bvh/simd_kernels.h"

#if HWY_TARGET != HWY_SCALAR // there the plain kernels do the work
#include "trace/bvh/beam_kernels-inl.h"
#include "trace/bvh/pencil_kernels-inl.h"
#include "trace/bvh/single-inl.h"
#include "trace/bvh/wave_kernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

HWY_ATTR Hit closest_hit(const Target& target, const math::Ray& ray, const Filter& filter) {
    if (target.bounds.empty()) return miss(0);
    return filter.trivial() ? closest<false>(target, ray, filter)
                            : closest<true>(target, ray, filter);
}

HWY_ATTR bool is_occluded(const Target& target, const math::Ray& ray, const Filter& filter) {
    if (target.bounds.empty()) return false;
    return filter.trivial() ? occluded<false>(target, ray, filter)
                            : occluded<true>(target, ray, filter);
}

inline RayStream part_of(const RayStream& rays, uint32_t first, uint32_t count) {
    RayStream part = rays;
    for (int k = 0; k < 3; ++k) {
        part.origin[k] += first;
        part.direction[k] += first;
    }
    part.t_min += first;
    part.t_max += first;
    part.count = count;
    return part;
}

inline HitStream part_of(const HitStream& hits, uint32_t first) {
    return {hits.t + first,         hits.u + first,
            hits.v + first,         hits.triangle + first,
            hits.back_face + first, hits.steps ? hits.steps + first : nullptr};
}

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
// be anything: as many rays at a time as make one, halves where they do not.
template <class Beams, class Pencils, class Waves>
class Splitter {
public:
    HWY_ATTR Splitter(const Target& target, const RayStream& rays, Beams beams, Pencils pencils,
                      Waves waves)
        : target_(target), rays_(rays), beams_(beams), pencils_(pencils), waves_(waves) {
        if (rays.coherence != Coherence::incoherent)
            for (uint32_t first = 0; first < rays.count; first += kBeamRays)
                split(first, std::min(kBeamRays, rays.count - first));
        flush(rays.count);
    }

private:
    // Fewer are not worth the preparations.
    static constexpr uint32_t kLeastBeam = kGroupRays / 2, kLeastPencil = 2 * kBundleRays;

    HWY_ATTR void split(uint32_t first, uint32_t count) {
        if (may_be_beam(rays_, first, count)) {
            if (count > kLeastBeam && beam_.gather(target_, rays_, first, count)) {
                flush(first);
                beams_(beam_);
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
        split(first + half, count - half);
    }

    HWY_ATTR void flush(uint32_t end) {
        if (end > waiting_) waves_(waiting_, end - waiting_);
    }

    const Target& target_;
    const RayStream& rays_;
    Beams beams_;
    Pencils pencils_;
    Waves waves_;
    uint32_t waiting_ = 0; // first ray that was not traced yet
    Beam beam_;
    Pencil pencil_;
};

template <bool Filtered>
HWY_ATTR void closest_stream(const Target& target, const RayStream& rays, const Filter& filter,
                             const HitStream& hits) {
    Splitter(
        target, rays,
        [&](Beam& beam)
            HWY_ATTR { ClosestBeam<Filtered>(target, beam, rays, filter, hits).trace(); },
        [&](Pencil& pencil)
            HWY_ATTR { ClosestPencil<Filtered>(target, pencil, rays, filter, hits).trace(); },
        [&](uint32_t first, uint32_t count) HWY_ATTR {
            closest_wave<Filtered>(target, part_of(rays, first, count), filter,
                                   part_of(hits, first));
        });
}

template <bool Filtered>
HWY_ATTR void occluded_stream(const Target& target, const RayStream& rays, const Filter& filter,
                              uint8_t* result) {
    Splitter(
        target, rays,
        [&](Beam& beam)
            HWY_ATTR { OccludedBeam<Filtered>(target, beam, rays, filter).trace(result); },
        [&](Pencil& pencil)
            HWY_ATTR { OccludedPencil<Filtered>(target, pencil, rays, filter).trace(result); },
        [&](uint32_t first, uint32_t count) HWY_ATTR {
            occluded_wave<Filtered>(target, part_of(rays, first, count), filter, result + first);
        });
}

HWY_ATTR void closest_hits(const Target& target, const RayStream& rays, const Filter& filter,
                           const HitStream& hits) {
    if (target.bounds.empty())
        for (uint32_t i = 0; i < rays.count; ++i) hits.store(i, miss(0));
    else
        filter.trivial() ? closest_stream<false>(target, rays, filter, hits)
                         : closest_stream<true>(target, rays, filter, hits);
}

HWY_ATTR void are_occluded(const Target& target, const RayStream& rays, const Filter& filter,
                           uint8_t* result) {
    if (target.bounds.empty())
        std::fill_n(result, rays.count, uint8_t(0));
    else
        filter.trivial() ? occluded_stream<false>(target, rays, filter, result)
                         : occluded_stream<true>(target, rays, filter, result);
}

template <base::Isa Set>
inline constexpr Kernels kKernels = {closest_hit, is_occluded, closest_hits, are_occluded, Set};

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
namespace peregrine::trace::bvh {

const Kernels* simd_kernels(base::Isa isa) {
    switch (isa) {
#if HWY_TARGETS & HWY_SSE4
    case base::Isa::sse4:
        return &N_SSE4::kKernels<base::Isa::sse4>;
#endif
#if HWY_TARGETS & HWY_AVX2
    case base::Isa::avx2:
        return &N_AVX2::kKernels<base::Isa::avx2>;
#endif
#if HWY_TARGETS & HWY_AVX3
    case base::Isa::avx512:
        return &N_AVX3::kKernels<base::Isa::avx512>;
#endif
#if HWY_TARGETS & HWY_NEON
    case base::Isa::neon:
        return &N_NEON::kKernels<base::Isa::neon>;
#endif
    default:
        return nullptr;
    }
}

} // namespace peregrine::trace::bvh
#endif
