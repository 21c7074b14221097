// Where a wave enters the BVH: a node put together for it from those children, levels down, that
// its rays can reach. Included once for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_WAVE_ROOT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_WAVE_ROOT_INL_H
#undef PEREGRINE_TRACE_BVH_WAVE_ROOT_INL_H
#else
#define PEREGRINE_TRACE_BVH_WAVE_ROOT_INL_H
#endif

#include <hwy/highway.h>

#include "accel/bvh/tree.h"
#include "trace/bvh/tree/push-inl.h"
#include "trace/bvh/wave/rays-inl.h"

#include <limits>

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

class WaveRoot {
public:
    // For rays of `octant` among those of `swept`.
    HWY_ATTR const Node& make(const Target& target, const Swept& swept, uint32_t octant) {
        for (uint32_t k = 0; k < 3; ++k) {
            lower_[k] = hn::Set(k8, swept.lower(k, octant));
            upper_[k] = hn::Set(k8, swept.upper(k, octant));
        }
        count_ = 0;
        const Node& top = fetch_node(target, 0, room_);
        take(top, reached(top));
        while (const Place* place = largest()) {
            const Node& node = fetch_node(target, place->link.node(), room_);
            const uint32_t children = reached(node);
            const uint32_t index = uint32_t(place - places_);
            if (count_ - 1 + uint32_t(std::popcount(children)) > accel::bvh::kWidth) {
                places_[index].area = kClosed;
                continue;
            }
            places_[index] = places_[--count_];
            take(node, children);
        }
        write(octant);
        return root_;
    }

private:
    static constexpr float kClosed = -1; // leaves, and what does not fit
    struct Place {
        float lower[3], upper[3];
        Link link;
        float area;
    };

    HWY_INLINE HWY_ATTR uint32_t reached(const Node& node) const {
        M8 apart = hn::Lt(hn::Load(k8, node.upper[0]), lower_[0]);
        for (uint32_t k = 0; k < 3; ++k) {
            apart = hn::Or(apart, hn::Lt(hn::Load(k8, node.upper[k]), lower_[k]));
            apart = hn::Or(apart, hn::Gt(hn::Load(k8, node.lower[k]), upper_[k]));
        }
        return ~bits_of(k8, apart) & 255u;
    }

    HWY_INLINE HWY_ATTR void take(const Node& node, uint32_t children) {
        for (; children; children &= children - 1) {
            const uint32_t child = uint32_t(std::countr_zero(children));
            Place& place = places_[count_++];
            float size[3];
            for (uint32_t k = 0; k < 3; ++k) {
                place.lower[k] = node.lower[k][child];
                place.upper[k] = node.upper[k][child];
                size[k] = place.upper[k] - place.lower[k];
            }
            place.link = node.child[child];
            place.area = place.link.is_leaf()
                             ? kClosed
                             : size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
        }
    }

    const Place* largest() const {
        const Place* best = nullptr;
        for (uint32_t i = 0; i < count_; ++i)
            if (places_[i].area > (best ? best->area : kClosed)) best = places_ + i;
        return best;
    }

    // In the order from front to back.
    HWY_INLINE HWY_ATTR void write(uint32_t octant) {
        float along[accel::bvh::kWidth];
        const Place* sorted[accel::bvh::kWidth];
        for (uint32_t i = 0; i < count_; ++i) {
            const Place& place = places_[i];
            float key = 0;
            for (uint32_t k = 0; k < 3; ++k) {
                const float middle = place.lower[k] + place.upper[k];
                key += octant >> k & 1 ? -middle : middle;
            }
            uint32_t at = i;
            for (; at > 0 && along[at - 1] > key; --at) {
                along[at] = along[at - 1];
                sorted[at] = sorted[at - 1];
            }
            along[at] = key;
            sorted[at] = &place;
        }
        constexpr float kInfinity = std::numeric_limits<float>::infinity();
        for (uint32_t i = 0; i < accel::bvh::kWidth; ++i) {
            for (uint32_t k = 0; k < 3; ++k) {
                root_.lower[k][i] = i < count_ ? sorted[i]->lower[k] : kInfinity;
                root_.upper[k][i] = i < count_ ? sorted[i]->upper[k] : -kInfinity;
            }
            root_.child[i] = i < count_ ? sorted[i]->link : Link{0};
        }
        root_.order[octant] = 0xFAC688; // 7 6 5 4 3 2 1 0
    }

    V8 lower_[3], upper_[3];
    Place places_[2 * accel::bvh::kWidth];
    uint32_t count_;
    Node room_;
    Node root_;
};

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
