// Incoherent rays in waves: many rays are under way at a time, in lists by what is next for them,
// and each list is worked off in a loop without branches that depend on the rays. So nothing is
// mispredicted, and the processor overlaps the steps of different rays. Included once for each
// instruction set.
#if defined(PEREGRINE_TRACE_BVH_WAVE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_WAVE_INL_H
#undef PEREGRINE_TRACE_BVH_WAVE_INL_H
#else
#define PEREGRINE_TRACE_BVH_WAVE_INL_H
#endif

#include <hwy/highway.h>

#include "trace/bvh/plain.h"
#include "trace/bvh/push-inl.h"
#include "trace/bvh/wave_blocks-inl.h"
#include "trace/bvh/wave_rays-inl.h"

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

#ifndef PEREGRINE_WAVE_RAYS
#define PEREGRINE_WAVE_RAYS 64
#endif
inline constexpr uint32_t kWaveRays = PEREGRINE_WAVE_RAYS;
inline constexpr uint32_t kDone = ~0u; // a link: the end of a stack

// A ray and its next node or block.
struct WaveStep {
    uint32_t link;
    uint32_t ray;
};

// Two entries at the bottom end it. The upper one is beyond every limit, as nodes see it; the lower
// one within all, for the search of `pop`, which looks at eight entries: below the bottom as well.
struct alignas(64) WaveStack {
    static constexpr uint32_t kBottom = 8;
    static constexpr uint32_t kSize = kBottom + 2 + accel::bvh::kStackSize + accel::bvh::kWidth;
    float t_near[(kSize + 15) / 16 * 16];
    uint32_t link[(kSize + 15) / 16 * 16];
};

// `Any` is whether the first hit found will do. Results::hit(ray, ...) is told of hits.
template <bool Any, bool Filtered>
class Wave {
public:
    HWY_ATTR Wave(const Target& target, const RayStream& rays, const Filter& filter)
        : target_(target), rays_(rays), filter_(filter) {
        for (uint32_t i = 0; i < kWaveRays; ++i) {
            idle_[i] = i;
            for (uint32_t j = 0; j <= WaveStack::kBottom; ++j) {
                stack_[i].t_near[j] = -std::numeric_limits<float>::infinity();
                stack_[i].link[j] = kDone;
            }
            stack_[i].t_near[WaveStack::kBottom + 1] = std::numeric_limits<float>::infinity();
            stack_[i].link[WaveStack::kBottom + 1] = kDone;
        }
    }

    // `irregular(ray)` answers a ray that is not for floats; `hit(ray, ...)` is told of each better
    // hit.
    template <class Irregular, class OnHit, class OnDone>
    HWY_ATTR void trace(Irregular&& irregular, OnHit&& hit, OnDone&& done) {
        for (;;) {
            while (idle_count_ >= 8 && next_ < rays_.count) start(irregular);
            if (node_count_ + leaf_count_ == 0) return;
            step_nodes();
            test_blocks();
            decide_blocks(hit);
            pop(done);
        }
    }

private:
    static constexpr uint32_t kTop = WaveStack::kBottom + 2;

    template <class Irregular>
    HWY_ATTR void start(Irregular&& irregular) {
        WaveRay* places[8];
        idle_count_ -= 8;
        uint32_t chosen[8];
        for (uint32_t i = 0; i < 8; ++i) {
            chosen[i] = idle_[idle_count_ + i];
            places[i] = ray_ + chosen[i];
        }
        const Launched launched = launch(target_.bounds, rays_, next_, kTop, places);
        for (uint32_t i = 0; i < 8; ++i) {
            const uint32_t alive = launched.alive >> i & 1;
            nodes_[node_count_] = {0, chosen[i]};
            node_count_ += alive;
            idle_[idle_count_] = chosen[i];
            idle_count_ += 1 - alive;
        }
        for (uint32_t bits = launched.irregular; bits; bits &= bits - 1)
            irregular(next_ + uint32_t(__builtin_ctz(bits)));
        next_ += 8;
    }

    HWY_INLINE HWY_ATTR void step_nodes() {
        const hn::RebindToUnsigned<D8> u8;
        alignas(32) static constexpr uint32_t kBackToFront[8] = {21, 18, 15, 12, 9, 6, 3, 0};
        alignas(32) static constexpr uint32_t kInOrder[8] = {0, 3, 6, 9, 12, 15, 18, 21};
        const __m256i back_to_front = hn::Load(u8, kBackToFront).raw;
        const __m256i in_order = hn::Load(u8, kInOrder).raw;
        const char* nodes = reinterpret_cast<const char*>(target_.bvh_nodes);
        uint32_t kept = 0, leaves = leaf_count_, popped = pop_count_;
        const uint32_t count = node_count_;
        for (uint32_t i = 0; i < count; ++i) {
            const WaveStep step = nodes_[i];
            WaveRay& ray = ray_[step.ray];
            WaveStack& stack = stack_[step.ray];
            const char* node = nodes + size_t(step.link) * sizeof(Node);
            const auto plane = [&](uint32_t offset) HWY_ATTR {
                return hn::Load(k8, reinterpret_cast<const float*>(node + offset));
            };
            const auto enter = [&](int k) HWY_ATTR {
                return hn::MulAdd(plane(ray.enter_plane[k]), hn::Set(k8, ray.inverse[k]),
                                  hn::Set(k8, ray.enter[k]));
            };
            const auto leave = [&](int k) HWY_ATTR {
                return hn::MulAdd(plane(ray.leave_plane[k]), hn::Set(k8, ray.inverse[k]),
                                  hn::Set(k8, ray.leave[k]));
            };
            const V8 t_near =
                hn::Max(hn::Max(enter(0), enter(1)), hn::Max(enter(2), hn::Set(k8, ray.t_near)));
            const V8 t_far =
                hn::Min(hn::Min(leave(0), leave(1)), hn::Min(leave(2), hn::Set(k8, ray.t_limit)));
            const __m256i entered = hn::BitCast(u8, hn::VecFromMask(k8, hn::Le(t_near, t_far))).raw;
            uint32_t order_bits;
            __builtin_memcpy(&order_bits, node + ray.order, 4);
            const __m256i order =
                _mm256_srlv_epi32(_mm256_set1_epi32(int(order_bits)), back_to_front);
            const uint32_t bits = uint32_t(_mm256_movemask_ps(
                _mm256_castsi256_ps(_mm256_permutevar8x32_epi32(entered, order))));
            const __m256i packing =
                _mm256_srlv_epi32(_mm256_set1_epi32(int(kPacking[bits])), in_order);
            const __m256i packed = _mm256_permutevar8x32_epi32(order, packing);
            const __m256i link = hn::Load(u8, reinterpret_cast<const uint32_t*>(node + 192)).raw;
            uint32_t top = ray.top;
            _mm256_storeu_si256(reinterpret_cast<__m256i*>(stack.link + top),
                                _mm256_permutevar8x32_epi32(link, packed));
            if (!Any)
                _mm256_storeu_ps(stack.t_near + top, _mm256_permutevar8x32_ps(t_near.raw, packed));
            top += uint32_t(__builtin_popcount(bits)) - 1;
            ray.top = top;
            if (!Any) ++ray.steps;
            const WaveStep next{stack.link[top], step.ray};
            const uint32_t over = Any ? next.link == kDone : stack.t_near[top] > ray.t_limit;
            const uint32_t leaf = next.link >> 31 & ~over;
            nodes_[kept] = next;
            kept += 1 & ~(over | leaf);
            leaves_[leaves] = next;
            leaves += leaf;
            pops_[popped] = step.ray;
            popped += over;
        }
        node_count_ = kept;
        leaf_count_ = leaves;
        pop_count_ = popped;
    }

    // Rays of `leaves_` meet one block each; the rest of a leaf goes back to the stack.
    HWY_INLINE HWY_ATTR void test_blocks() {
        uint32_t tests = 0;
        const uint32_t count = leaf_count_, popped = pop_count_;
        for (uint32_t i = 0; i < count; ++i) {
            const WaveStep step = leaves_[i];
            WaveRay& ray = ray_[step.ray];
            WaveStack& stack = stack_[step.ray];
            const uint32_t index = Link{step.link}.first_block();
            const WaveBlock sheared(ray, target_.bvh_blocks[index]);
            stack.link[ray.top] = step.link + (1u << 5) - accel::bvh::kBlockWidth;
            if (!Any) stack.t_near[ray.top] = ray.t_near;
            ray.top += (step.link & 31) >= accel::bvh::kBlockWidth;
            tests_[tests] = {index, step.ray};
            tests += sheared.maybe() != 0;
            pops_[popped + i] = step.ray;
        }
        pop_count_ = popped + count;
        test_count_ = tests;
        leaf_count_ = 0;
    }

    template <class OnHit>
    HWY_INLINE HWY_ATTR void decide_blocks(OnHit&& on_hit) {
        for (uint32_t i = 0; i < test_count_; ++i) {
            const WaveStep step = tests_[i];
            WaveRay& ray = ray_[step.ray];
            const Block& block = target_.bvh_blocks[step.link];
            WaveHits hits;
            WaveBlock(ray, block).decide(ray, hits);
            for (uint32_t lanes = hits.lanes; lanes; lanes &= lanes - 1) {
                const uint32_t lane = uint32_t(__builtin_ctz(lanes));
                const uint32_t index = block.triangle[lane];
                const float t = hits.t[lane];
                if (!Any && !comes_first(t, index, ray.t_max, ray.best)) continue;
                const bool back_face = hits.back_faces >> lane & 1;
                if (Filtered
                    && !filter_.accepts(target_.infos[index], back_face, hits.u[lane],
                                        hits.v[lane]))
                    continue;
                on_hit(ray.index, Hit{t, hits.u[lane], hits.v[lane], index, back_face, 0});
                if (Any) {
                    ray.top = kTop;
                    break;
                }
                ray.best = index;
                ray.t_max = t;
                ray.t_limit = std::min(ray.t_limit, t);
            }
        }
    }

    template <class OnDone>
    HWY_INLINE HWY_ATTR void pop(OnDone&& done) {
        uint32_t nodes = node_count_, leaves = 0, idle = idle_count_;
        for (uint32_t i = 0; i < pop_count_; ++i) {
            const uint32_t slot = pops_[i];
            WaveRay& ray = ray_[slot];
            const WaveStack& stack = stack_[slot];
            uint32_t top = ray.top - 1;
            if (!Any) {
                const V8 limit = hn::Set(k8, ray.t_limit);
                uint32_t bits;
                while ((bits = bits_of(k8, hn::Le(hn::LoadU(k8, stack.t_near + top - 7), limit)))
                       == 0)
                    top -= 8;
                top -= uint32_t(__builtin_clz(bits << 24));
            }
            ray.top = top;
            const WaveStep next{stack.link[top], slot};
            const uint32_t over = next.link == kDone;
            const uint32_t leaf = next.link >> 31 & ~over;
            nodes_[nodes] = next;
            nodes += 1 & ~(over | leaf);
            leaves_[leaves] = next;
            leaves += leaf;
            idle_[idle] = slot;
            idle += over;
        }
        if (!Any)
            for (uint32_t i = idle_count_; i < idle; ++i)
                done(ray_[idle_[i]].index, ray_[idle_[i]].steps);
        node_count_ = nodes;
        leaf_count_ = leaves;
        idle_count_ = idle;
        pop_count_ = 0;
    }

    const Target& target_;
    const RayStream& rays_;
    const Filter& filter_;
    uint32_t next_ = 0; // ray of the stream
    uint32_t node_count_ = 0, leaf_count_ = 0, test_count_ = 0, pop_count_ = 0;
    uint32_t idle_count_ = kWaveRays;
    // One more than there are rays: places are written before it is known whether they are taken.
    WaveStep nodes_[kWaveRays + 1], leaves_[kWaveRays + 1], tests_[kWaveRays + 1];
    uint32_t pops_[kWaveRays + 1], idle_[kWaveRays + 1];
    WaveRay ray_[kWaveRays];
    WaveStack stack_[kWaveRays];
};

template <bool Filtered>
HWY_ATTR void closest_wave(const Target& target, const RayStream& rays, const Filter& filter,
                           const HitStream& hits) {
    const hn::RebindToUnsigned<D8> u8;
    for (uint32_t i = 0; i < rays.count; i += 8) {
        hn::StoreU(hn::Set(k8, std::numeric_limits<float>::infinity()), k8, hits.t + i);
        hn::StoreU(hn::Zero(k8), k8, hits.u + i);
        hn::StoreU(hn::Zero(k8), k8, hits.v + i);
        hn::StoreU(hn::Set(u8, geometry::kNoTriangle), u8, hits.triangle + i);
        hn::StoreU(hn::Zero(u8), u8, hits.back_face + i);
        if (hits.steps) hn::StoreU(hn::Zero(u8), u8, hits.steps + i);
    }
    Wave<false, Filtered> wave(target, rays, filter);
    wave.trace(
        [&](uint32_t i) HWY_ATTR {
            hits.store(i, closest_plain<Filtered, double>(target, ray_at(rays, i), filter));
        },
        [&](uint32_t i, const Hit& hit) HWY_ATTR {
            hits.t[i] = hit.t;
            hits.u[i] = hit.u;
            hits.v[i] = hit.v;
            hits.triangle[i] = hit.triangle;
            hits.back_face[i] = hit.back_face;
        },
        [&](uint32_t i, uint32_t steps) HWY_ATTR {
            if (hits.steps) hits.steps[i] = steps;
        });
}

template <bool Filtered>
HWY_ATTR void occluded_wave(const Target& target, const RayStream& rays, const Filter& filter,
                            uint8_t* occluded) {
    std::fill_n(occluded, rays.count, uint8_t(0));
    Wave<true, Filtered> wave(target, rays, filter);
    wave.trace(
        [&](uint32_t i) HWY_ATTR {
            occluded[i] = occluded_plain<Filtered, double>(target, ray_at(rays, i), filter);
        },
        [&](uint32_t i, const Hit&) HWY_ATTR { occluded[i] = 1; }, [](uint32_t, uint32_t) {});
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
