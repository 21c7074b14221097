// A leaf that few rays of a beam can hit: ray by ray, four triangles at a time. Included once for
// each instruction set.
#if defined(PEREGRINE_TRACE_BVH_BEAM_TINY_LEAF_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_BEAM_TINY_LEAF_INL_H
#undef PEREGRINE_TRACE_BVH_BEAM_TINY_LEAF_INL_H
#else
#define PEREGRINE_TRACE_BVH_BEAM_TINY_LEAF_INL_H
#endif

#include <hwy/highway.h>

#include "accel/bvh/tree.h"
#include "trace/bvh/beam/beam-inl.h"
#include "trace/bvh/tree/decode-inl.h"
#include "trace/canonical-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;
using namespace trace::HWY_NAMESPACE;
using accel::bvh::Block;
using accel::bvh::Link;

// A block relative to the beam's origin: what its rays share of the canonical test.
struct NearBlock {
    V4 x[3], y[3], z[3];

    HWY_INLINE HWY_ATTR NearBlock(const Beam& beam, const Block& block) {
        for (int i = 0; i < 3; ++i) {
            x[i] = hn::Sub(hn::Load(k4, block.vertex[i][beam.kx]), hn::Set(k4, beam.origin[0]));
            y[i] = hn::Sub(hn::Load(k4, block.vertex[i][beam.ky]), hn::Set(k4, beam.origin[1]));
            z[i] = hn::Sub(hn::Load(k4, block.vertex[i][beam.kz]), hn::Set(k4, beam.origin[2]));
        }
    }

    // Triangles that the float edge functions do not rule out.
    HWY_INLINE HWY_ATTR uint32_t maybe(float ray_sx, float ray_sy) const {
        const V4 sx = hn::Set(k4, ray_sx), sy = hn::Set(k4, ray_sy);
        const Sheared<V4> s = {shear(x[0], sx, z[0]), shear(y[0], sy, z[0]), z[0],
                               shear(x[1], sx, z[1]), shear(y[1], sy, z[1]), z[1],
                               shear(x[2], sx, z[2]), shear(y[2], sy, z[2]), z[2]};
        return ~bits_of(k4, outside(s)) & 15u;
    }
};

template <class Kernel>
HWY_INLINE HWY_ATTR void visit_tiny_leaf(const Target& target, Beam& beam, Link link,
                                         uint32_t groups, float z, const Window& window,
                                         Kernel& kernel) {
    uint32_t found = 0;
    uint32_t rays[kGroups];
    for (uint32_t left = groups; left; left &= left - 1) {
        const uint32_t group = uint32_t(__builtin_ctz(left));
        rays[group] = beam.find_rays(group, window, z);
        found |= rays[group] ? 1u << group : 0;
    }
    if (found == 0) return;
    LeafRoom room;
    const Leaf leaf = fetch_leaf(target, link, room);
    const uint32_t count = leaf.count;
    const Block* block = leaf.blocks;
    for (uint32_t first = 0; first < count; first += accel::bvh::kBlockWidth, ++block) {
        const NearBlock near(beam, *block);
        const uint32_t there = count - first < 4 ? (1u << (count - first)) - 1 : 15u;
        for (uint32_t left = found; left; left &= left - 1) {
            const uint32_t group = uint32_t(__builtin_ctz(left));
            bool changed = false;
            for (uint32_t bits = rays[group]; bits; bits &= bits - 1) {
                const uint32_t i = uint32_t(__builtin_ctz(bits));
                const uint32_t at = group * kGroupRays + i;
                uint32_t lanes = there;
                if (!(beam.foreign[group] >> i & 1)) lanes &= near.maybe(beam.sx[at], beam.sy[at]);
                for (; lanes; lanes &= lanes - 1)
                    changed |= kernel.test_one(*block, uint32_t(__builtin_ctz(lanes)), at);
            }
            if (changed) beam.update_limit(group);
        }
    }
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
