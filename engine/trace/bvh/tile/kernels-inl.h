// The closest hits of a tile's rays. Included once for each instruction set, where a vector has
// eight floats.
#if defined(PEREGRINE_TRACE_BVH_TILE_KERNELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_TILE_KERNELS_INL_H
#undef PEREGRINE_TRACE_BVH_TILE_KERNELS_INL_H
#else
#define PEREGRINE_TRACE_BVH_TILE_KERNELS_INL_H
#endif

#include <hwy/highway.h>

#include "simd/lanes-inl.h"
#include "trace/bvh/beam/judge-inl.h"
#include "trace/bvh/stream/hit_board-inl.h"
#include "trace/bvh/tile/candidates-inl.h"
#include "trace/bvh/tile/children-inl.h"
#include "trace/bvh/tree/decode-inl.h"
#include "trace/eight_rays-inl.h"

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;
using namespace trace::HWY_NAMESPACE;

struct TileEntry {
    Link link;
    uint32_t groups;
    float z;
};

template <bool Filtered>
class ClosestTile {
public:
    HWY_ATTR ClosestTile(const Target& target, Tile& tile, const RayStream& rays,
                         const Filter& filter, const HitStream& out)
        : target_(target), tile_(tile), direction_z_(rays.direction[tile.kz]), filter_(filter),
          board_(rays, out, 0, kTileRays) {}

    HWY_ATTR void trace() { board_.finish(visit()); }

private:
    // Goes through what the tile may hit, roughly from near to far. Returns the number of nodes
    // visited.
    HWY_ATTR uint32_t visit() {
        TileEntry stack[accel::bvh::kStackSize];
        Node room;
        uint32_t depth = 0, visited = 0;
        stack[depth++] = {Link::inner(0), kAllTileGroups, 0};
        while (depth > 0) {
            const TileEntry entry = stack[--depth];
            const uint32_t groups = tile_.reaching(entry.groups, entry.z);
            if (groups == 0) continue;
            if (entry.link.is_leaf()) {
                visit_leaf(entry.link, groups);
                if (changed_) tile_.update_limits(changed_, board_.all_t());
                changed_ = 0;
                continue;
            }
            ++visited;
            const Node& node = fetch_node(target_, entry.link.node(), room);
            const TileChildren children(tile_, node, tile_.limit);
            const uint32_t bottom = depth;
            for (uint32_t bits = children.entered; bits; bits &= bits - 1) {
                const uint32_t child = uint32_t(__builtin_ctz(bits));
                const uint32_t mask = children.groups(child) & groups;
                if (mask == 0) continue;
                const float z = children.z[child];
                uint32_t place = depth++;
                for (; place > bottom && stack[place - 1].z < z; --place)
                    stack[place] = stack[place - 1];
                stack[place] = {node.child[child], mask, z};
            }
        }
        return visited;
    }

    HWY_INLINE HWY_ATTR void visit_leaf(Link link, uint32_t groups) {
        LeafRoom room;
        const Leaf leaf = fetch_leaf(target_, link, room);
        const Block* block = leaf.blocks;
        for (uint32_t first = 0; first < leaf.count; first += accel::bvh::kBlockWidth, ++block) {
            TileFacets facets;
            uint32_t lanes = facets.project(tile_, *block, tile_.limit);
            if (leaf.count - first < accel::bvh::kBlockWidth)
                lanes &= (1u << (leaf.count - first)) - 1;
            for (; lanes; lanes &= lanes - 1) {
                const uint32_t lane = uint32_t(__builtin_ctz(lanes));
                const uint32_t mask = groups & groups_in_window(facets, lane);
                if (mask == 0) continue;
                if (facets.certain >> lane & 1)
                    meet_facet(facets, lane, block->triangle[lane], mask);
                else
                    meet_window(facets, lane, block->triangle[lane], mask);
            }
        }
    }

    HWY_INLINE HWY_ATTR void meet_facet(const TileFacets& facets, uint32_t lane, uint32_t index,
                                        uint32_t mask) {
        const TileEdges edges(facets, lane);
        uint32_t inside;
        uint32_t open = edges.find_groups(tile_, mask, inside);
        if (open == 0) return;
        if (Filtered) {
            const geometry::TriangleInfo& info = target_.infos[index];
            const bool faces =
                facets.back >> lane & 1 ? filter_.sees_back(info) : filter_.sees_front();
            if (!faces || !filter_.sees_mesh(info)) return;
        }
        const Judge judge(facets.vertex, lane);
        const TileSteps steps(edges);
        for (; open; open &= open - 1) {
            const uint32_t group = uint32_t(__builtin_ctz(open));
            const TileGroupEdges over(edges, group);
            bool changed = false;
            if (inside >> group & 1) {
                for (uint32_t eight = 0; eight < 8; ++eight)
                    changed |= meet_eight<true>(edges, steps, over, judge, index, group, eight);
            } else {
                uint32_t eights = over.open & eights_in_window(facets, lane, group);
                for (; eights; eights &= eights - 1)
                    changed |= meet_eight<false>(edges, steps, over, judge, index, group,
                                                 uint32_t(__builtin_ctz(eights)));
            }
            changed_ |= uint32_t(changed) << group;
        }
    }

    template <bool Inside>
    HWY_INLINE HWY_ATTR bool meet_eight(const TileEdges& edges, const TileSteps& steps,
                                        const TileGroupEdges& over, const Judge& judge,
                                        uint32_t index, uint32_t group, uint32_t eight) {
        const uint32_t at = group * kTileGroupRays + eight * 8;
        const M8 maybe = steps.find<Inside>(edges, over, eight, board_.best(at));
        if (hn::AllFalse(k8, maybe)) return false;
        return decide_eight<Inside>(judge, index, at, maybe);
    }

    // A facet of which the window alone is known.
    HWY_NOINLINE HWY_ATTR void meet_window(const TileFacets& facets, uint32_t lane, uint32_t index,
                                           uint32_t mask) {
        const Judge judge(facets.vertex, lane);
        for (; mask; mask &= mask - 1) {
            const uint32_t group = uint32_t(__builtin_ctz(mask));
            bool changed = false;
            uint32_t eights = eights_in_window(facets, lane, group);
            for (; eights; eights &= eights - 1) {
                const uint32_t eight = uint32_t(__builtin_ctz(eights));
                changed |= decide_eight<false>(judge, index, group * kTileGroupRays + eight * 8,
                                               hn::FirstN(k8, 8));
            }
            changed_ |= uint32_t(changed) << group;
        }
    }

    template <bool Inside>
    HWY_INLINE HWY_ATTR bool decide_eight(const Judge& facet, uint32_t index, uint32_t at,
                                          M8 maybe) {
        const V8 dz = hn::Load(k8, direction_z_ + at);
        const EightHits hits =
            judge<Inside>(facet, hn::Load(k8, tile_.sx + at), hn::Load(k8, tile_.sy + at), dz,
                          maybe, hn::Zero(k8), board_.best(at));
        const V8u keys = keys_of(index, hits);
        M8 wins = board_.find_wins(at, hits, keys);
        if (hn::AllFalse(k8, wins)) return false;
        if (Filtered) {
            wins = accepted(wins, filter_, target_.infos[index], hits);
            if (hn::AllFalse(k8, wins)) return false;
        }
        board_.record(at, wins, hits, keys);
        return true;
    }

    const Target& target_;
    Tile& tile_;
    const float* direction_z_;
    const Filter& filter_;
    HitBoard board_;
    uint32_t changed_ = 0; // groups with hits since their limits were known
};

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
