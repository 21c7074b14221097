// A Beam or a ParallelBeam through the wide BVH. Included once for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_BEAM_TRAVERSAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_BEAM_TRAVERSAL_INL_H
#undef PEREGRINE_TRACE_BVH_BEAM_TRAVERSAL_INL_H
#else
#define PEREGRINE_TRACE_BVH_BEAM_TRAVERSAL_INL_H
#endif

#include <hwy/highway.h>

#include "trace/bvh/beam/candidates-inl.h"
#include "trace/bvh/beam/groups-inl.h"
#include "trace/bvh/tree/decode-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

using accel::bvh::Link;
using accel::bvh::Node;

struct BeamEntry {
    Link link;
    uint32_t groups;
    float z;
    bool tiny; // a leaf that few rays can hit
};

inline constexpr uint32_t kGaveUp = ~0u;

template <class Beam, class Kernel>
HWY_INLINE HWY_ATTR void visit_leaf(const Target& target, const Beam& beam, Link link,
                                    uint32_t mask, const Window& window, float limit,
                                    Kernel& kernel) {
    LeafRoom room;
    const Leaf leaf = fetch_leaf(target, link, room);
    const uint32_t count = leaf.count;
    const Block* block = leaf.blocks;
    for (uint32_t first = 0; first < count; first += accel::bvh::kBlockWidth, ++block) {
        typename Beam::SeenFacets facets;
        uint32_t lanes = facets.project(beam, *block, window, limit);
        if (count - first < accel::bvh::kBlockWidth) lanes &= (1u << (count - first)) - 1;
        for (; lanes; lanes &= lanes - 1) {
            const uint32_t lane = uint32_t(__builtin_ctz(lanes));
            const uint32_t meeting = find_meeting(beam, facets, lane, mask);
            if (meeting == 0) continue;
            const GroupsOfFacet groups = uint32_t(__builtin_popcount(meeting)) <= Kernel::kFewGroups
                                             ? GroupsOfFacet{meeting, 0}
                                             : find_groups(beam, facets, lane, meeting);
            for (uint32_t left = groups.open; left; left &= left - 1) {
                const uint32_t group = uint32_t(__builtin_ctz(left));
                const Candidates rays =
                    find_candidates(beam, facets, lane, group, groups.inside >> group & 1);
                if (rays.open) kernel.judge(facets, *block, lane, group, rays);
            }
        }
    }
}

// Goes through what the beam may hit, roughly from near to far. `kernel.judge(facets, block, lane,
// group, candidates)` decides for the rays of a group and a facet, `kernel.take(at, index, hit)`
// hears of the hit of a ray that was tested alone. A kernel that looks for rays has groups drop out
// of tiny children without any. Returns the number of nodes visited, or kGaveUp after more than
// kernel.most_nodes() of them, or kernel.most_tiny() tiny leaves.
template <class Beam, class Kernel>
HWY_ATTR uint32_t visit_beam(const Target& target, Beam& beam, Kernel& kernel) {
    BeamEntry stack[accel::bvh::kStackSize];
    Window windows[accel::bvh::kStackSize]; // of those entries that are tiny
    Node room;
    uint32_t depth = 0;
    uint32_t visited = 0;
    const uint32_t most_nodes = kernel.most_nodes();
    uint32_t tiny_left = kernel.most_tiny();
    stack[depth++] = {Link::inner(0), beam.groups, beam.near, false};
    Window window = beam.window;
    uint32_t window_groups = beam.groups;
    while (depth > 0) {
        const BeamEntry entry = stack[--depth];
        const uint32_t groups = beam.reaching(entry.groups, entry.z);
        if (groups == 0) continue;
        if (entry.tiny) {
            if (tiny_left-- == 0) return kGaveUp;
            visit_tiny_leaf(target, beam, entry.link, groups, entry.z, windows[depth], kernel);
            continue;
        }
        if (groups != window_groups) {
            window = groups == beam.groups ? beam.window : beam.window_of(groups);
            window_groups = groups;
        }
        const float limit = beam.limit_of(groups);
        if (entry.link.is_leaf()) {
            visit_leaf(target, beam, entry.link, groups, window, limit, kernel);
            continue;
        }
        if (visited++ == most_nodes) return kGaveUp;
        const Node& node = fetch_node(target, entry.link.node(), room);
        typename Beam::Children children;
        children.find(beam, node, window, limit, Kernel::kTinySide);
        const uint32_t bottom = depth;
        for (uint32_t bits = children.entered; bits; bits &= bits - 1) {
            const uint32_t child = uint32_t(__builtin_ctz(bits));
            uint32_t mask = groups;
            if (children.narrow >> child & 1) {
                mask = children.find_groups(beam, child, groups);
                if (mask == 0) continue;
            }
            const Link link = node.child[child];
            const bool tiny =
                (children.tiny >> child & 1) && (Kernel::kLooksForRays || link.is_leaf());
            Window in = window;
            if (tiny) {
                in = children.window_of(beam, child);
                if (Kernel::kLooksForRays) mask = beam.groups_in(mask, in, children.near[child]);
                if (mask == 0) continue;
            }
            uint32_t place = depth++;
            for (; place > bottom && stack[place - 1].z < children.near[child]; --place) {
                stack[place] = stack[place - 1];
                windows[place] = windows[place - 1];
            }
            stack[place] = {link, mask, children.near[child], tiny && link.is_leaf()};
            if (tiny) windows[place] = in;
        }
    }
    return visited;
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
