// One packet through the kd-tree. Included once for each instruction set by stream_kernels.cpp.
#if defined(PEREGRINE_TRACE_KDTREE_PACKET_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_KDTREE_PACKET_INL_H
#undef PEREGRINE_TRACE_KDTREE_PACKET_INL_H
#else
#define PEREGRINE_TRACE_KDTREE_PACKET_INL_H
#endif

#include <hwy/highway.h>

#include "accel/kdtree/tree.h"
#include "trace/eight_rays-inl.h"
#include "trace/kdtree/single.h"
#include "trace/kernels.h"
#include "trace/slabs.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::kdtree::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;
using namespace trace::HWY_NAMESPACE;

// The rays of a packet and what slabs() knows of them, in vectors.
struct Packet {
    V8 origin[3];
    V8 direction[3];
    V8 inverse[3];
    V8 margin[3];
    V8 t_min, t_max;
    V8 t_near, t_far;
    M8 present;              // lanes that hold a ray
    M8 fits;                 // ... whose numbers fit float: fits_float()
    bool mostly_leftward[3]; // most directions are negative, ...
    bool mixed[3];           // ... but not all, or the other way round

    HWY_ATTR Packet(const Target& target, const RayStream& rays, uint32_t first) {
        for (int k = 0; k < 3; ++k) {
            origin[k] = hn::Load(k8, rays.origin[k] + first);
            direction[k] = hn::Load(k8, rays.direction[k] + first);
        }
        t_min = hn::Max(hn::Load(k8, rays.t_min + first),
                        hn::Set(k8, std::numeric_limits<float>::lowest()));
        t_max = hn::Load(k8, rays.t_max + first);
        present = hn::FirstN(k8, rays.count - first);
        find_slabs(target.bounds);
    }

    HWY_ATTR void find_slabs(const math::Box& bounds) {
        V8 reach = hn::Zero(k8);
        V8 largest = hn::Zero(k8);
        for (int k = 0; k < 3; ++k) {
            const V8 lower = hn::Abs(hn::Sub(hn::Set(k8, bounds.lower[k]), origin[k]));
            const V8 upper = hn::Abs(hn::Sub(hn::Set(k8, bounds.upper[k]), origin[k]));
            reach = hn::Max(reach, hn::Max(lower, upper));
            largest = hn::Max(largest, hn::Abs(direction[k]));
        }
        fits = hn::And(
            hn::And(hn::Ge(largest, hn::Set(k8, 0x1p-32f)), hn::Le(largest, hn::Set(k8, 0x1p32f))),
            hn::And(hn::Ge(reach, hn::Set(k8, 0x1p-40f)), hn::Le(reach, hn::Set(k8, 0x1p60f))));
        const V8 error = hn::Add(hn::Mul(hn::Set(k8, 0x1p-20f), reach), hn::Set(k8, 0x1p-146f));
        const V8 smallest = hn::Mul(hn::Set(k8, 0x1p-26f), largest);
        t_near = t_min;
        t_far = t_max;
        for (int k = 0; k < 3; ++k) {
            const V8 d = direction[k];
            const V8 clamped =
                hn::IfThenElse(hn::Lt(hn::Abs(d), smallest), hn::CopySign(smallest, d), d);
            inverse[k] = hn::Div(hn::Set(k8, 1.0f), clamped);
            margin[k] = hn::Mul(error, hn::Abs(inverse[k]));
            const M8 leftward = hn::And(present, hn::Lt(inverse[k], hn::Zero(k8)));
            const size_t count = hn::CountTrue(k8, leftward);
            const size_t all = hn::CountTrue(k8, present);
            mostly_leftward[k] = 2 * count > all;
            mixed[k] = count != 0 && count != all;
            const V8 lower = hn::Mul(hn::Sub(hn::Set(k8, bounds.lower[k]), origin[k]), inverse[k]);
            const V8 upper = hn::Mul(hn::Sub(hn::Set(k8, bounds.upper[k]), origin[k]), inverse[k]);
            t_near = hn::Max(t_near, hn::Sub(hn::Min(lower, upper), margin[k]));
            t_far = hn::Min(t_far, hn::Add(hn::Max(lower, upper), margin[k]));
        }
    }

    // The axis of the largest |direction|, by the rule of geometry::shear.
    HWY_ATTR M8 dominant(int kz) const {
        const V8 x = hn::Abs(direction[0]), y = hn::Abs(direction[1]), z = hn::Abs(direction[2]);
        if (kz == 0) return hn::And(hn::Ge(x, y), hn::Ge(x, z));
        if (kz == 1) return hn::And(hn::Gt(y, x), hn::Ge(y, z));
        return hn::And(hn::Gt(z, x), hn::Gt(z, y));
    }
};

// The parts of the test that depend on the rays alone; all lanes share the main axis.
struct ShearedPacket {
    int kx, ky, kz;
    V8 ox, oy, oz;
    V8 sx, sy, dz;

    HWY_ATTR ShearedPacket(const V8 (&origin)[3], const V8 (&direction)[3], int axis) {
        kz = axis;
        kx = kz == 2 ? 0 : kz + 1;
        ky = kx == 2 ? 0 : kx + 1;
        ox = origin[kx];
        oy = origin[ky];
        oz = origin[kz];
        dz = direction[kz];
        sx = hn::Div(direction[kx], dz);
        sy = hn::Div(direction[ky], dz);
    }
};

// The lanes of `active` that the triangle is hit by within [t_min, t_max]; false if there are none.
HWY_INLINE HWY_ATTR bool intersect(const ShearedPacket& ray, const geometry::Triangle& triangle,
                                   M8 active, V8 t_min, V8 t_max, EightHits& hits) {
    const auto corner = [&](const geometry::Vec3& p, V8& x, V8& y, V8& z) HWY_ATTR
        __attribute__((always_inline)) {
        z = hn::Sub(hn::Set(k8, p[ray.kz]), ray.oz);
        x = shear(hn::Sub(hn::Set(k8, p[ray.kx]), ray.ox), ray.sx, z);
        y = shear(hn::Sub(hn::Set(k8, p[ray.ky]), ray.oy), ray.sy, z);
    };
    Sheared<V8> s;
    corner(triangle.v0, s.ax, s.ay, s.az);
    corner(triangle.v1, s.bx, s.by, s.bz);
    corner(triangle.v2, s.cx, s.cy, s.cz);
    const M8 maybe = hn::AndNot(outside(s), active);
    if (hn::AllFalse(k8, maybe)) return false;
    hits = decide(s, ray.dz, maybe, t_min, t_max);
    return !hn::AllFalse(k8, hits.lanes);
}

// Visits the leaves that lanes of `active` may touch. `leaf(first, count, lanes)` returns true to
// stop; it lowers `t_limit`. Returns the number of nodes visited.
template <class Leaf>
HWY_ATTR uint32_t visit_leaves(const Target& target, const Packet& packet, M8 active,
                               const V8& t_limit, Leaf&& leaf) {
    struct Entry {
        V8 t_near, t_far;
        uint32_t node;
    };
    Entry stack[accel::kdtree::kMaxDepth]; // one entry a level at most
    uint32_t depth = 0;
    uint32_t visited = 0;
    uint32_t index = 0;
    V8 t_near = hn::IfThenElse(active, packet.t_near, hn::Set(k8, 1.0f));
    V8 t_far = hn::IfThenElse(active, packet.t_far, hn::Set(k8, -1.0f));
    if (hn::AllFalse(k8, hn::Le(t_near, t_far))) return visited;

    for (;;) {
        accel::kdtree::Node node = tree_of(target).nodes[index];
        ++visited;
        while (!node.is_leaf()) {
            const uint32_t k = node.axis();
            const V8 t =
                hn::Mul(hn::Sub(hn::Set(k8, node.split), packet.origin[k]), packet.inverse[k]);
            const V8 t_first = hn::Sub(t, packet.margin[k]);
            const V8 t_last = hn::Add(t, packet.margin[k]);
            V8 near_begin = t_near, near_end = hn::Min(t_far, t_last);
            V8 far_begin = hn::Max(t_near, t_first), far_end = t_far;
            const bool from_right = packet.mostly_leftward[k];
            if (packet.mixed[k]) { // each lane gets its own interval in both children
                const M8 leftward = hn::Lt(packet.inverse[k], hn::Zero(k8));
                const M8 agrees = from_right ? leftward : hn::Not(leftward);
                const V8 begin = near_begin, end = near_end;
                near_begin = hn::IfThenElse(agrees, begin, far_begin);
                near_end = hn::IfThenElse(agrees, end, far_end);
                far_begin = hn::IfThenElse(agrees, far_begin, begin);
                far_end = hn::IfThenElse(agrees, far_end, end);
            }
            const bool any_near = !hn::AllFalse(k8, hn::Le(near_begin, near_end));
            const bool any_far = !hn::AllFalse(k8, hn::Le(far_begin, far_end));
            const uint32_t near_child = node.left_child() + from_right;
            const uint32_t far_child = node.left_child() + !from_right;
            if (any_near) {
                if (any_far) stack[depth++] = {far_begin, far_end, far_child};
                index = near_child;
                t_near = near_begin;
                t_far = near_end;
            } else {
                index = far_child;
                t_near = far_begin;
                t_far = far_end;
            }
            node = tree_of(target).nodes[index];
            ++visited;
        }
        if (leaf(node.first_reference, node.reference_count(), hn::Le(t_near, t_far)))
            return visited;
        do {
            if (depth == 0) return visited;
            const Entry& entry = stack[--depth];
            index = entry.node;
            t_near = entry.t_near;
            t_far = hn::Min(entry.t_far, t_limit);
        } while (hn::AllFalse(k8, hn::Le(t_near, t_far)));
    }
}

// The triangles that a packet was tested against lately (Amanatides and Woo 1987): a large one
// stands in many leaves. It works because a test takes all lanes, not only those in the leaf.
class Mailbox {
public:
    Mailbox() {
        for (uint32_t& entry : entries_) entry = geometry::kNoTriangle;
    }

    HWY_INLINE bool is_new(uint32_t triangle) {
        uint32_t& entry = entries_[triangle % kEntries];
        const bool is_new = entry != triangle;
        entry = triangle;
        return is_new;
    }

private:
    static constexpr uint32_t kEntries = 16;
    uint32_t entries_[kEntries];
};

template <bool Filtered>
class ClosestPacket {
public:
    HWY_ATTR ClosestPacket(const Target& target, const Filter& filter, const RayStream& rays,
                           uint32_t first)
        : target_(target), lists_(tree_of(target).lists), filter_(filter), rays_(rays),
          first_(first), packet_(target, rays, first) {
        t_ = packet_.t_max;
        u_ = v_ = hn::Zero(k8);
        key_ = hn::Set(k8u, geometry::kNoTriangle);
    }

    HWY_ATTR void trace(const HitStream& hits) {
        uint32_t steps = 0;
        if (target_.bounds.empty()) return store(hits, steps);
        const M8 regular = hn::And(packet_.present, packet_.fits);
        for (int kz = 0; kz < 3; ++kz) {
            const M8 lanes = hn::And(regular, packet_.dominant(kz));
            if (!hn::AllFalse(k8, lanes)) steps += trace(kz, lanes);
        }
        store(hits, steps);
        trace_irregular(hits);
    }

private:
    HWY_ATTR uint32_t trace(int kz, M8 lanes) {
        const ShearedPacket sheared(packet_.origin, packet_.direction, kz);
        Mailbox mailbox;
        return visit_leaves(target_, packet_, lanes, t_,
                            [&](uint32_t first, uint32_t count, M8) HWY_ATTR {
                                for (uint32_t i = first; i < first + count; ++i)
                                    if (mailbox.is_new(lists_.references[i]))
                                        test(sheared, lists_.references[i], lanes);
                                return false;
                            });
    }

    HWY_ATTR void test(const ShearedPacket& sheared, uint32_t index, M8 active) {
        const geometry::Triangle& triangle = lists_.triangles[index];
        EightHits hit;
        if (!intersect(sheared, triangle, active, packet_.t_min, t_, hit)) return;
        const V8u keys = keys_of(index, hit);
        M8 wins = hn::And(hit.lanes, comes_first(hit.t, keys, t_, key_));
        if (Filtered) wins = accepted(wins, filter_, triangle.info(), hit);
        t_ = hn::IfThenElse(wins, hit.t, t_);
        u_ = hn::IfThenElse(wins, hit.u, u_);
        v_ = hn::IfThenElse(wins, hit.v, v_);
        key_ = hn::IfThenElse(hn::RebindMask(k8u, wins), keys, key_);
    }

    HWY_ATTR void store(const HitStream& hits, uint32_t steps) const {
        const Named named(key_);
        const V8 infinity = hn::Set(k8, std::numeric_limits<float>::infinity());
        hn::Store(hn::IfThenElse(named.missed, infinity, t_), k8, hits.t + first_);
        hn::Store(u_, k8, hits.u + first_);
        hn::Store(v_, k8, hits.v + first_);
        hn::Store(named.triangle, k8u, hits.triangle + first_);
        hn::Store(named.back_face, k8u, hits.back_face + first_);
        if (hits.steps) hn::Store(hn::Set(k8u, steps), k8u, hits.steps + first_);
    }

    HWY_ATTR void trace_irregular(const HitStream& hits) const {
        const uint32_t lanes = bits_of(k8, hn::AndNot(packet_.fits, packet_.present));
        for (size_t i = 0; lanes >> i; ++i) {
            if (!(lanes >> i & 1)) continue;
            const size_t at = first_ + i;
            const math::Ray ray = ray_at(rays_, at);
            const Hit hit = Single::closest<Filtered>(target_, ray, filter_,
                                                      reach<double>(target_.bounds, ray.origin));
            hits.t[at] = hit.t;
            hits.u[at] = hit.u;
            hits.v[at] = hit.v;
            hits.triangle[at] = hit.triangle;
            hits.back_face[at] = hit.back_face;
            if (hits.steps) hits.steps[at] = hit.steps;
        }
    }

    const Target& target_;
    const ReferenceLists& lists_;
    const Filter& filter_;
    const RayStream& rays_;
    size_t first_;
    Packet packet_;
    V8 t_, u_, v_;
    V8u key_; // of the best triangles
};

template <bool Filtered>
class OccludedPacket {
public:
    HWY_ATTR OccludedPacket(const Target& target, const Filter& filter, const RayStream& rays,
                            uint32_t first)
        : target_(target), lists_(tree_of(target).lists), filter_(filter), rays_(rays),
          first_(first), packet_(target, rays, first) {}

    HWY_ATTR void trace(uint8_t* occluded) {
        uint64_t blocked = 0;
        if (!target_.bounds.empty()) {
            const M8 regular = hn::And(packet_.present, packet_.fits);
            for (int kz = 0; kz < 3; ++kz) {
                const M8 lanes = hn::And(regular, packet_.dominant(kz));
                if (!hn::AllFalse(k8, lanes)) blocked |= trace(kz, lanes);
            }
            blocked |= trace_irregular();
        }
        for (uint64_t i = 0, n = bits_of(k8, packet_.present); n >> i; ++i)
            occluded[first_ + i] = blocked >> i & 1;
    }

private:
    HWY_ATTR uint64_t trace(int kz, M8 lanes) {
        const ShearedPacket sheared(packet_.origin, packet_.direction, kz);
        // A blocked lane gets a limit below every t, which takes it out of the traversal.
        V8 t_limit = packet_.t_far;
        uint64_t blocked = 0;
        const uint64_t all = bits_of(k8, lanes);
        Mailbox mailbox;
        visit_leaves(
            target_, packet_, lanes, t_limit, [&](uint32_t first, uint32_t count, M8) HWY_ATTR {
                M8 open = hn::And(lanes, hn::Gt(t_limit, hn::Set(k8, kNever)));
                for (uint32_t i = first; i < first + count; ++i) {
                    if (!mailbox.is_new(lists_.references[i])) continue;
                    const auto& triangle = lists_.triangles[lists_.references[i]];
                    EightHits hit;
                    if (!intersect(sheared, triangle, open, packet_.t_min, packet_.t_max, hit))
                        continue;
                    if (Filtered) hit.lanes = accepted(hit.lanes, filter_, triangle.info(), hit);
                    open = hn::AndNot(hit.lanes, open);
                    t_limit = hn::IfThenElse(hit.lanes, hn::Set(k8, kNever), t_limit);
                    blocked |= bits_of(k8, hit.lanes);
                    if (hn::AllFalse(k8, open)) break;
                }
                return blocked == all;
            });
        return blocked;
    }

    HWY_ATTR uint64_t trace_irregular() const {
        uint64_t blocked = 0;
        const uint32_t lanes = bits_of(k8, hn::AndNot(packet_.fits, packet_.present));
        for (uint64_t i = 0; lanes >> i; ++i) {
            if (!(lanes >> i & 1)) continue;
            const math::Ray ray = ray_at(rays_, first_ + i);
            if (Single::occluded<Filtered>(target_, ray, filter_,
                                           reach<double>(target_.bounds, ray.origin)))
                blocked |= uint64_t(1) << i;
        }
        return blocked;
    }

    static constexpr float kNever = std::numeric_limits<float>::lowest();

    const Target& target_;
    const ReferenceLists& lists_;
    const Filter& filter_;
    const RayStream& rays_;
    size_t first_;
    Packet packet_;
};

} // namespace peregrine::trace::kdtree::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
