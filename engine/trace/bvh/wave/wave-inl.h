// Incoherent rays in waves: rays of one octant go through the BVH together, node by node, with a
// list of the rays that enter it for each child (Tsakok, "Faster Incoherent Rays: Multi-BVH Ray
// Stream Tracing", HPG 2009). A ray meets the eight children at once; loops over rays have no
// branches that depend on them. Included once for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_WAVE_WAVE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_WAVE_WAVE_INL_H
#undef PEREGRINE_TRACE_BVH_WAVE_WAVE_INL_H
#else
#define PEREGRINE_TRACE_BVH_WAVE_WAVE_INL_H
#endif

#include <hwy/highway.h>

#include "simd/compress_table.h"
#include "trace/bvh/single/plain.h"
#include "trace/bvh/wave/blocks-inl.h"
#include "trace/bvh/wave/rays-inl.h"
#include "trace/bvh/wave/root-inl.h"

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

inline constexpr uint32_t kWaveRays = 256;
inline constexpr uint32_t kWaveStream = 1024; // rays set up at a time

// `Any`: the first hit found will do.
template <bool Any, bool Filtered>
class Wave {
public:
    HWY_ATTR Wave(const Target& target, const Filter& filter)
        : target_(target), filter_(filter),
          blocks_(tree_of(target).is_compact() ? decoded_ : tree_of(target).blocks) {}

    // `irregular(ray)` answers a ray that is not for floats; `hit(ray, ...)` is told of each better
    // hit; `done(ray, steps)` comes last.
    template <class Irregular, class OnHit, class OnDone>
    HWY_ATTR void trace(const RayStream& rays, uint32_t first, uint32_t count,
                        Irregular&& irregular, OnHit&& hit, OnDone&& done) {
        for (uint32_t& n : octant_count_) n = 0;
        Swept swept(target_.bounds);
        start(rays, first, count, swept, irregular);
        for (uint32_t octant = 0; octant < 8; ++octant) {
            if (octant_count_[octant] == 0) continue;
            WaveRoot root;
            const Node& entry = root.make(target_, swept, octant);
            for (uint32_t i = 0; i < octant_count_[octant]; i += kWaveRays)
                run(entry, octant, octant_[octant] + i,
                    std::min(kWaveRays, octant_count_[octant] - i), hit);
        }
        if (!Any)
            for (uint32_t i = 0; i < count; ++i) done(first + i, ray_[i].steps);
    }

private:
    using Id = uint16_t;
    static constexpr float kNever = -std::numeric_limits<float>::infinity();
    struct Entry {
        uint32_t link, begin, count;
    };
    struct Test {
        uint32_t block, ray;
    };
    static constexpr uint32_t kTests = 2 * kWaveRays;
    static constexpr uint32_t kLeafBlocks = accel::bvh::kMaxLeaf / accel::bvh::kBlockWidth;
    static constexpr uint32_t kDecoded = 4 * kLeafBlocks;
    // A list is written in whole vectors, and read in vectors of sixteen.
    static constexpr uint32_t kListSize = kWaveRays + 16;
    static constexpr uint32_t kEntries = accel::bvh::kStackSize + accel::bvh::kWidth;

    template <class Irregular>
    HWY_ATTR void start(const RayStream& rays, uint32_t first, uint32_t count, Swept& swept,
                        Irregular&& irregular) {
        for (uint32_t begin = 0; begin < count; begin += 8) {
            const Launched launched =
                launch(target_.bounds, rays, first + begin, ray_ + begin, swept);
            for (uint32_t i = 0; i < 8; ++i) {
                const uint32_t octant = ray_[begin + i].octant;
                octant_[octant][octant_count_[octant]] = Id(begin + i);
                octant_count_[octant] += launched.alive >> i & 1;
            }
            for (uint32_t bits = launched.irregular; bits; bits &= bits - 1)
                irregular(first + begin + uint32_t(__builtin_ctz(bits)));
        }
    }

    template <class OnHit>
    HWY_ATTR void run(const Node& root, uint32_t octant, const Id* ids, uint32_t count,
                      OnHit&& on_hit) {
        std::copy_n(ids, count, lists_);
        uint32_t depth = enter(root, octant, {0, 0, count}, 0, on_hit);
        while (depth > 0) {
            const Entry entry = entries_[--depth];
            const Link link{entry.link};
            if (depth > 0) prefetch(Link{entries_[depth - 1].link});
            if (!Any && link.is_leaf()) {
                meet(link, lists_ + entry.begin, entry.count, on_hit);
            } else {
                if (test_count_ > 0) settle(on_hit);
                const Node& node = fetch_node(target_, link.node(), node_);
                if (!Any && octant >= 4 && tree_of(target_).is_compact())
                    node_.order[octant] = accel::bvh::reversed_order(node_.order[7 - octant]);
                depth = enter(node, octant, entry, depth, on_hit);
            }
        }
        settle(on_hit);
    }

    template <class OnHit>
    HWY_INLINE HWY_ATTR uint32_t enter(const Node& node, uint32_t octant, const Entry& entry,
                                       uint32_t depth, OnHit&& on_hit) {
        const Id* ids = lists_ + entry.begin;
        for (uint32_t i = 0; i < entry.count; i += 16)
            _mm256_store_si256(reinterpret_cast<__m256i*>(ids_ + i),
                               _mm256_loadu_si256(reinterpret_cast<const __m256i*>(ids + i)));
        const uint32_t entered = test_children(node, octant, entry.count);
        if constexpr (Any)
            return meet_leaves(node, entered, entry, depth, on_hit);
        else
            return push_children(node, entered, octant, entry, depth);
    }

    // Returns the children that any ray enters: bits.
    HWY_INLINE HWY_ATTR uint32_t test_children(const Node& node, uint32_t octant, uint32_t count) {
        V8 enter_plane[3], leave_plane[3];
        for (uint32_t k = 0; k < 3; ++k) {
            const bool negative = octant >> k & 1;
            enter_plane[k] = hn::Load(k8, negative ? node.upper[k] : node.lower[k]);
            leave_plane[k] = hn::Load(k8, negative ? node.lower[k] : node.upper[k]);
        }
        uint32_t any = 0;
        for (uint32_t i = 0; i < count; ++i) {
            WaveRay& ray = ray_[ids_[i]];
            const auto enter = [&](int k) HWY_ATTR {
                return hn::MulAdd(enter_plane[k], hn::Set(k8, ray.inverse[k]),
                                  hn::Set(k8, ray.enter[k]));
            };
            const auto leave = [&](int k) HWY_ATTR {
                return hn::MulAdd(leave_plane[k], hn::Set(k8, ray.inverse[k]),
                                  hn::Set(k8, ray.leave[k]));
            };
            const V8 t_near =
                hn::Max(hn::Max(enter(0), enter(1)), hn::Max(enter(2), hn::Set(k8, ray.t_near)));
            const V8 t_far =
                hn::Min(hn::Min(leave(0), leave(1)), hn::Min(leave(2), hn::Set(k8, ray.t_limit)));
            const uint32_t entered = bits_of(k8, hn::Le(t_near, t_far));
            entered_[i] = uint8_t(entered);
            any |= entered;
            if (!Any) ++ray.steps;
        }
        // Beyond the list, up to a whole vector, nothing enters.
        __builtin_memset(entered_ + count, 0, 8);
        return any;
    }

    // Writes those of `values`, a vector of eight at a time, that enter the child to `out`; returns
    // how many they are.
    template <class Values>
    HWY_INLINE HWY_ATTR uint32_t gather(uint32_t child, uint32_t count, Id* out,
                                        Values&& values) const {
        const __m128i to_top = _mm_cvtsi32_si128(int(7 - child));
        Id* end = out;
        for (uint32_t i = 0; i < count; i += 8) {
            const __m128i entered = _mm_sll_epi16(
                _mm_loadl_epi64(reinterpret_cast<const __m128i*>(entered_ + i)), to_top);
            const uint32_t bits = uint32_t(_mm_movemask_epi8(entered)) & 255;
            const __m128i compress =
                _mm_load_si128(reinterpret_cast<const __m128i*>(simd::kCompressShorts.bytes[bits]));
            _mm_storeu_si128(reinterpret_cast<__m128i*>(end),
                             _mm_shuffle_epi8(values(i), compress));
            end += uint32_t(__builtin_popcount(bits));
        }
        return uint32_t(end - out);
    }
    HWY_INLINE HWY_ATTR uint32_t gather_rays(uint32_t child, uint32_t count, Id* out) const {
        return gather(child, count, out, [&](uint32_t i) HWY_ATTR {
            return _mm_load_si128(reinterpret_cast<const __m128i*>(ids_ + i));
        });
    }

    HWY_INLINE HWY_ATTR uint32_t push_children(const Node& node, uint32_t entered, uint32_t octant,
                                               const Entry& entry, uint32_t depth) {
        uint32_t end = entry.begin;
        const uint32_t order = node.order[octant];
        for (uint32_t shift = 24; shift > 0;) {
            shift -= 3;
            const uint32_t child = order >> shift & 7;
            if (entered >> child & 1) depth = push(node, child, entry, depth, end);
        }
        return depth;
    }
    HWY_INLINE HWY_ATTR uint32_t push(const Node& node, uint32_t child, const Entry& entry,
                                      uint32_t depth, uint32_t& end) {
        const uint32_t count = gather_rays(child, entry.count, lists_ + end);
        entries_[depth] = {node.child[child].bits, end, count};
        end += count;
        return depth + (count != 0);
    }

    // Leaves first, so that rays that hit something drop out of the other children.
    template <class OnHit>
    HWY_INLINE HWY_ATTR uint32_t meet_leaves(const Node& node, uint32_t entered, const Entry& entry,
                                             uint32_t depth, OnHit&& on_hit) {
        uint32_t leaves = entered & leaves_of(node);
        uint32_t inner = entered & ~leaves;
        for (uint32_t rest = leaves; rest; rest &= rest - 1)
            prefetch(node.child[std::countr_zero(rest)]);
        for (; leaves; leaves &= leaves - 1) {
            const uint32_t child = uint32_t(std::countr_zero(leaves));
            if constexpr (Filtered) {
                const uint32_t count = gather_rays(child, entry.count, leaf_);
                if (count) meet(node.child[child], leaf_, count, on_hit);
            } else {
                const __m128i first = _mm_setr_epi16(0, 1, 2, 3, 4, 5, 6, 7);
                const uint32_t count = gather(child, entry.count, leaf_, [&](uint32_t i) HWY_ATTR {
                    return _mm_add_epi16(first, _mm_set1_epi16(int16_t(i)));
                });
                if (count) occlude(node.child[child], count, on_hit);
            }
        }
        if (test_count_ > 0) settle(on_hit);
        uint32_t end = entry.begin;
        for (; inner; inner &= inner - 1)
            depth = push(node, uint32_t(std::countr_zero(inner)), entry, depth, end);
        return depth;
    }

    // The places in `ids_` that `leaf_` lists.
    template <class OnHit>
    HWY_INLINE HWY_ATTR void occlude(Link link, uint32_t count, OnHit&& on_hit) {
        const Leaf leaf = fetch_leaf(target_, link, decoded_);
        const Block* block = leaf.blocks;
        const Block* last = block + (leaf.count - 1) / accel::bvh::kBlockWidth;
        leaf_[count] = leaf_[count - 1];
        for (; block <= last; ++block)
            for (uint32_t i = 0; i < count; i += 2) {
                const uint32_t at_a = leaf_[i], at_b = leaf_[i + 1];
                WaveRay &a = ray_[ids_[at_a]], &b = ray_[ids_[at_b]];
                const Verdict verdict(a, b, *block);
                uint32_t hit_a = verdict.hit & 15, hit_b = verdict.hit >> 4;
                if (verdict.maybe != verdict.hit) [[unlikely]] {
                    if (!hit_a && (verdict.maybe & 15)) hit_a = is_hit(a, *block);
                    if (!hit_b && verdict.maybe >> 4) hit_b = is_hit(b, *block);
                }
                drop(a, at_a, hit_a != 0, on_hit);
                drop(b, at_b, hit_b != 0, on_hit);
            }
    }
    HWY_INLINE HWY_ATTR bool is_hit(const WaveRay& ray, const Block& block) const {
        BlockHits hits;
        return decide_block<Details::none>(relative_to(ray, block), hn::Set(kD, double(ray.dz)),
                                           ray.t_min, ray.t_max, hits);
    }
    template <class OnHit>
    HWY_INLINE HWY_ATTR void drop(WaveRay& ray, uint32_t at, bool hit, OnHit&& on_hit) {
        on_hit(ray.index, hit);
        ray.t_limit = hit ? kNever : ray.t_limit;
        entered_[at] = hit ? 0 : entered_[at];
    }

    // Leaves in a row share the decisions: what the float filter lets through waits in `tests_`,
    // and their blocks, if decoded, in `decoded_`.
    template <class OnHit>
    HWY_INLINE HWY_ATTR void meet(Link link, const Id* ids, uint32_t count, OnHit&& on_hit) {
        if (decoded_count_ > kDecoded - kLeafBlocks) settle(on_hit);
        if (test_count_ == 0) decoded_count_ = 0;
        const Leaf leaf = fetch_leaf(target_, link, decoded_ + decoded_count_);
        const auto first = uint32_t(leaf.blocks - blocks_);
        const uint32_t last = first + (leaf.count - 1) / accel::bvh::kBlockWidth;
        decoded_count_ += tree_of(target_).is_compact() ? last - first + 1 : 0;
        for (uint32_t block = first; block <= last; ++block) {
            if (test_count_ + count > kTests) settle(on_hit);
            filter_rays(block, ids, count);
        }
    }

    HWY_INLINE HWY_ATTR void filter_rays(uint32_t index, const Id* ids, uint32_t count) {
        const Block& block = blocks_[index];
        uint32_t tests = test_count_;
        const auto waits = [&](const WaveRay& ray, uint32_t maybe) HWY_ATTR {
            return uint32_t(maybe != 0) & uint32_t(!Any || ray.t_limit >= ray.t_near);
        };
        for (uint32_t i = 0; i < count; i += 2) {
            const uint32_t second = i + 1 < count;
            const Id a = ids[i], b = ids[i + second];
            const uint32_t maybe = maybe_of_two(ray_[a], ray_[b], block);
            tests_[tests] = {index, a};
            tests += waits(ray_[a], maybe & 15);
            tests_[tests] = {index, b};
            tests += second & waits(ray_[b], maybe >> 4);
        }
        test_count_ = tests;
    }

    template <Details details>
    HWY_INLINE HWY_ATTR void decide(const WaveRay& ray, uint32_t block, BlockHits& hits) const {
        decide_block<details>(relative_to(ray, blocks_[block]), hn::Set(kD, double(ray.dz)),
                              ray.t_min, ray.t_max, hits);
    }

    template <class OnHit>
    HWY_INLINE HWY_ATTR void settle(OnHit&& on_hit) {
        uint32_t found = 0;
        for (uint32_t i = 0; i < test_count_; ++i) {
            const Test test = tests_[i];
            const WaveRay& ray = ray_[test.ray];
            BlockHits& hits = found_[found];
            decide<Details::all_at_once>(ray, test.block, hits);
            tests_[found] = test;
            found += hits.lanes != 0;
        }
        for (uint32_t i = 0; i < found; ++i)
            accept(ray_[tests_[i].ray], blocks_[tests_[i].block], found_[i], on_hit);
        test_count_ = 0;
    }

    template <class OnHit>
    HWY_INLINE HWY_ATTR void accept(WaveRay& ray, const Block& block, const BlockHits& hits,
                                    OnHit&& on_hit) {
        for (uint32_t lanes = hits.lanes; lanes; lanes &= lanes - 1) {
            const uint32_t lane = uint32_t(__builtin_ctz(lanes));
            const uint32_t index = block.triangle[lane];
            const float t = hits.t[lane];
            const bool back_face = hits.back_faces >> lane & 1;
            const uint32_t key = key_of(index, back_face);
            if (!Any && !comes_first(t, key, ray.t_max, ray.best)) continue;
            if (Filtered
                && !filter_.accepts(target_.infos[index], back_face, hits.u[lane], hits.v[lane]))
                continue;
            if constexpr (Any) {
                on_hit(ray.index, true);
                ray.t_limit = kNever;
                return;
            } else {
                on_hit(ray.index, Hit{t, hits.u[lane], hits.v[lane], index, back_face, 0});
                ray.best = key;
                ray.t_max = t;
                ray.t_limit = std::min(ray.t_limit, t);
            }
        }
    }

    HWY_INLINE HWY_ATTR void prefetch(Link link) const {
        if (tree_of(target_).is_compact()) {
            // Of a leaf the record and some of the pool before it.
            const uint32_t unit = link.bits & ~Link::kLeaf;
            if (link.is_leaf())
                prefetch_lines(tree_of(target_).compact_leaves + (unit > 16 ? unit - 16 : 0), 4);
            else
                prefetch_lines(tree_of(target_).compact_nodes + link.node(), 2);
        } else if (link.is_leaf()) {
            prefetch_lines(tree_of(target_).blocks + link.first_block(), 4);
        } else {
            prefetch_lines(tree_of(target_).nodes + link.node(), 4);
        }
    }

    const Target& target_;
    const Filter& filter_;
    const Block* const blocks_; // what `tests_` count in
    Node node_;                 // decoded
    uint32_t decoded_count_ = 0;
    Block decoded_[kDecoded];
    uint32_t octant_count_[8];
    Id octant_[8][kWaveStream + 16];
    alignas(32) Id ids_[kListSize];
    alignas(32) Id leaf_[kListSize];
    uint8_t entered_[kListSize];
    Entry entries_[kEntries];
    uint32_t test_count_ = 0;
    Test tests_[kTests + 2];
    alignas(64) BlockHits found_[kTests + 1];
    WaveRay ray_[kWaveStream];
    Id lists_[kEntries * kListSize];
};

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
