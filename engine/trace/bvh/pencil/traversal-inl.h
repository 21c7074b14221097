// A pencil through the wide BVH. Included once for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_PENCIL_TRAVERSAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_PENCIL_TRAVERSAL_INL_H
#undef PEREGRINE_TRACE_BVH_PENCIL_TRAVERSAL_INL_H
#else
#define PEREGRINE_TRACE_BVH_PENCIL_TRAVERSAL_INL_H
#endif

#include <hwy/highway.h>

#include "trace/bvh/pencil/pencil-inl.h"
#include "trace/bvh/single/plain.h"
#include "trace/bvh/tree/decode-inl.h"
#include "trace/eight_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;
using namespace trace::HWY_NAMESPACE;

// Boxes in the pencil's coordinates, widened; lanes are children or triangles.
template <class V>
struct Crates {
    V x0, x1, y0, y1, z0, z1;
};

// The bundles of `mask` whose rays may enter a crate, of which all lanes are the same.
HWY_INLINE HWY_ATTR uint32_t find_bundles(const Pencil& pencil, const Crates<V8>& crate,
                                          uint32_t mask) {
    uint32_t found = 0;
    for (uint32_t g = 0; g < kBundles; g += kLanes8) {
        if ((mask >> g & ((1u << kLanes8) - 1)) == 0) continue;
        const V8 limit = hn::Load(k8, pencil.bundle_limit + g);
        const V8 begin = hn::Max(crate.z0, hn::Set(k8, pencil.near));
        const V8 end = hn::Min(crate.z1, limit);
        const auto least = [&](const float* foot, const float* slope) HWY_ATTR {
            const V8 s = hn::Load(k8, slope + g);
            return hn::Add(hn::Load(k8, foot + g), hn::Min(hn::Mul(s, begin), hn::Mul(s, end)));
        };
        const auto most = [&](const float* foot, const float* slope) HWY_ATTR {
            const V8 s = hn::Load(k8, slope + g);
            return hn::Add(hn::Load(k8, foot + g), hn::Max(hn::Mul(s, begin), hn::Mul(s, end)));
        };
        const auto in_x = hn::And(hn::Ge(crate.x1, least(pencil.a0, pencil.p0)),
                                  hn::Le(crate.x0, most(pencil.a1, pencil.p1)));
        const auto in_y = hn::And(hn::Ge(crate.y1, least(pencil.b0, pencil.q0)),
                                  hn::Le(crate.y0, most(pencil.b1, pencil.q1)));
        found |= bits_of(k8, hn::And(hn::Le(begin, end), hn::And(in_x, in_y))) << g;
    }
    return found & mask;
}

// The crates that the rays of one bundle may enter.
template <class D>
HWY_INLINE HWY_ATTR uint32_t find_crates(D d, const Pencil& pencil, uint32_t bundle,
                                         const Crates<hn::Vec<D>>& crates) {
    const auto begin = hn::Max(crates.z0, hn::Set(d, pencil.near));
    const auto end = hn::Min(crates.z1, hn::Set(d, pencil.bundle_limit[bundle]));
    const auto least = [&](const float* foot, const float* slope) HWY_ATTR {
        const auto s = hn::Set(d, slope[bundle]);
        return hn::Add(hn::Set(d, foot[bundle]), hn::Min(hn::Mul(s, begin), hn::Mul(s, end)));
    };
    const auto most = [&](const float* foot, const float* slope) HWY_ATTR {
        const auto s = hn::Set(d, slope[bundle]);
        return hn::Add(hn::Set(d, foot[bundle]), hn::Max(hn::Mul(s, begin), hn::Mul(s, end)));
    };
    const auto in_x = hn::And(hn::Ge(crates.x1, least(pencil.a0, pencil.p0)),
                              hn::Le(crates.x0, most(pencil.a1, pencil.p1)));
    const auto in_y = hn::And(hn::Ge(crates.y1, least(pencil.b0, pencil.q0)),
                              hn::Le(crates.y0, most(pencil.b1, pencil.q1)));
    return bits_of(d, hn::And(hn::Le(begin, end), hn::And(in_x, in_y)));
}

// `lower` and `upper` by axis of the scene.
template <class D, class V>
HWY_INLINE HWY_ATTR Crates<V> to_crates(D d, const Pencil& pencil, const V (&lower)[3],
                                        const V (&upper)[3]) {
    const V margin = hn::Set(d, pencil.margin);
    const V plane = hn::Set(d, pencil.plane_z);
    const bool ahead = pencil.sign > 0;
    const V z0 = ahead ? hn::Sub(lower[pencil.kz], plane) : hn::Sub(plane, upper[pencil.kz]);
    const V z1 = ahead ? hn::Sub(upper[pencil.kz], plane) : hn::Sub(plane, lower[pencil.kz]);
    return {hn::Sub(lower[pencil.kx], margin),
            hn::Add(upper[pencil.kx], margin),
            hn::Sub(lower[pencil.ky], margin),
            hn::Add(upper[pencil.ky], margin),
            hn::Sub(z0, margin),
            hn::Add(z1, margin)};
}

struct PencilEntry {
    Link link;
    uint32_t bundles;
    float z;
};

template <class Kernel>
HWY_INLINE HWY_ATTR void visit_leaf(const Target& target, const Pencil& pencil, Link link,
                                    uint32_t bundles, Kernel& kernel) {
    LeafRoom room;
    const Leaf leaf = fetch_leaf(target, link, room);
    const uint32_t count = leaf.count;
    const Block* block = leaf.blocks;
    for (uint32_t first = 0; first < count; first += accel::bvh::kBlockWidth, ++block) {
        V4 lower[3], upper[3];
        for (int k = 0; k < 3; ++k) {
            const V4 a = hn::Load(k4, block->vertex[0][k]), b = hn::Load(k4, block->vertex[1][k]),
                     c = hn::Load(k4, block->vertex[2][k]);
            lower[k] = hn::Min(a, hn::Min(b, c));
            upper[k] = hn::Max(a, hn::Max(b, c));
        }
        const Crates<V4> crates = to_crates(k4, pencil, lower, upper);
        const uint32_t there = count - first < 4 ? (1u << (count - first)) - 1 : 15u;
        for (uint32_t left = bundles; left; left &= left - 1) {
            const uint32_t bundle = uint32_t(__builtin_ctz(left));
            uint32_t lanes = find_crates(k4, pencil, bundle, crates) & there;
            for (; lanes; lanes &= lanes - 1)
                kernel.test(*block, uint32_t(__builtin_ctz(lanes)), bundle);
        }
    }
}

// Goes through the triangles that the pencil may hit, roughly from near to far:
// `kernel.test(block, lane, bundle)`. Returns the number of nodes visited.
template <class Kernel>
HWY_ATTR uint32_t visit_pencil(const Target& target, Pencil& pencil, Kernel& kernel) {
    PencilEntry stack[accel::bvh::kStackSize];
    Node room;
    uint32_t depth = 0;
    uint32_t visited = 0;
    stack[depth++] = {Link::inner(0), pencil.bundles, 0};
    while (depth > 0) {
        const PencilEntry entry = stack[--depth];
        const uint32_t bundles = pencil.reaching(entry.bundles, entry.z);
        if (bundles == 0) continue;
        if (entry.link.is_leaf()) {
            visit_leaf(target, pencil, entry.link, bundles, kernel);
            continue;
        }
        ++visited;
        const Node& node = fetch_node(target, entry.link.node(), room);
        pencil.update_limit_of_all();
        uint32_t entered = 0;
        alignas(32) float x0[8], x1[8], y0[8], y1[8], z0[8], z1[8];
        for (size_t i = 0; i < accel::bvh::kWidth; i += kLanes8) {
            V8 lower[3], upper[3];
            for (int k = 0; k < 3; ++k) {
                lower[k] = hn::Load(k8, node.lower[k] + i);
                upper[k] = hn::Load(k8, node.upper[k] + i);
            }
            const Crates<V8> crates = to_crates(k8, pencil, lower, upper);
            entered |= find_crates(k8, pencil, kBundles, crates) << i;
            hn::Store(crates.x0, k8, x0 + i);
            hn::Store(crates.x1, k8, x1 + i);
            hn::Store(crates.y0, k8, y0 + i);
            hn::Store(crates.y1, k8, y1 + i);
            hn::Store(crates.z0, k8, z0 + i);
            hn::Store(crates.z1, k8, z1 + i);
        }
        const uint32_t bottom = depth;
        for (; entered; entered &= entered - 1) {
            const uint32_t child = uint32_t(__builtin_ctz(entered));
            const Crates<V8> crate = {hn::Set(k8, x0[child]), hn::Set(k8, x1[child]),
                                      hn::Set(k8, y0[child]), hn::Set(k8, y1[child]),
                                      hn::Set(k8, z0[child]), hn::Set(k8, z1[child])};
            const uint32_t mask = find_bundles(pencil, crate, bundles);
            if (mask == 0) continue;
            const float z = std::max(z0[child], pencil.near);
            uint32_t place = depth++;
            for (; place > bottom && stack[place - 1].z < z; --place)
                stack[place] = stack[place - 1];
            stack[place] = {node.child[child], mask, z};
        }
    }
    return visited;
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
