#include "trace/world/stream.h"

#include "trace/slabs.h"
#include "trace/world/merge.h"
#include "trace/world/ray_lists.h"
#include "trace/world/sub_stream.h"

#include <algorithm>
#include <limits>

namespace peregrine::trace {
namespace {

using accel::instances::Link;
using accel::instances::Node;

static_assert(kMaxStream + 16 <= kRoom);

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// The way of a stream through the moving parts; Kind says what is asked of each.
template <class Kind>
class Walk {
public:
    Walk(const World& world, const RayStream& rays, const Positions& positions,
         const Filter& filter, Kind& kind)
        : world_(world), rays_(rays), positions_(positions), filter_(filter), kind_(kind),
          lists_(*world.ray_lists), sub_(rays.coherence) {
        lists_.look_at(rays, gate_);
        for (uint32_t i = 0; i < rays.count; ++i) gate_.t_max[i] = kind.left(i);
        if (world.rests) [[unlikely]]
            find_rests();
    }

    void run() {
        const Node& root = world_.nodes[0];
        for_each_child(root, 0, [&](uint32_t i) {
            if (world_.rests) [[unlikely]]
                return lists_.enter_all_far(far_extent(root, world_.rests[0], i), gate_,
                                            rays_.count, list(0));
            return lists_.enter_all(root.extent(i), gate_, rays_.count, list(0));
        });
    }

private:
    RayNumber* list(uint32_t level) { return room_[level]; }

    void find_rests() {
        for (int k = 0; k < 3; ++k)
            for (uint32_t i = 0; i < rays_.count; ++i)
                gate_.rest[k][i] = positions_[i].rest(rays_.origin[k][i], k);
    }

    // Visits those children of which enter(i) finds rays, as many as it returns, in list(level).
    template <class Enter>
    void for_each_child(const Node& node, uint32_t level, Enter&& enter) {
        uint32_t order[accel::instances::kWidth];
        sort_children(node, level == 0 ? 0 : list(level - 1)[0], order);
        for (uint32_t k = 0; k < node.count; ++k) {
            const uint32_t count = enter(order[k]);
            if (count == 0) continue;
            const Link child = node.child[order[k]];
            if (child.is_leaf())
                visit_instance(world_.instances[child.instance()], level, count);
            else
                visit(child.node(), level, count);
        }
    }

    void visit(uint32_t at, uint32_t level, uint32_t count) {
        const Node& node = world_.nodes[at];
        std::fill_n(list(level) + count, 16, RayNumber(0));
        for_each_child(node, level + 1, [&](uint32_t i) {
            if (world_.rests) [[unlikely]]
                return lists_.enter_far(far_extent(node, world_.rests[at], i), gate_, list(level),
                                        count, list(level + 1));
            return lists_.enter(node.extent(i), gate_, list(level), count, list(level + 1));
        });
    }

    // As the ray goes through them, by their centres.
    void sort_children(const Node& node, uint32_t ray, uint32_t* order) const {
        float along[accel::instances::kWidth];
        for (uint32_t i = 0; i < node.count; ++i) {
            along[i] = 0;
            for (int k = 0; k < 3; ++k)
                along[i] += rays_.direction[k][ray] * (node.lower[k][i] + node.upper[k][i]);
            uint32_t place = i;
            for (; place > 0 && along[order[place - 1]] > along[i]; --place)
                order[place] = order[place - 1];
            order[place] = i;
        }
    }

    void visit_instance(const Instance& instance, uint32_t level, uint32_t count) {
        if (!sees(filter_, instance)) return;
        sub_.clear();
        for (uint32_t i = 0; i < count; ++i) add(list(level)[i], instance);
        if (sub_.count() != 0)
            kind_.ask(world_, instance.part, filter_within(filter_, instance), sub_, gate_);
    }

    void add(uint32_t number, const Instance& instance) {
        math::Ray ray = ray_at(rays_, number), local;
        ray.t_max = gate_.t_max[number];
        if (within(instance, ray, positions_[number], local)) sub_.add(local, number);
    }

    const World& world_;
    const RayStream& rays_;
    const Positions& positions_;
    const Filter& filter_;
    Kind& kind_;
    const RayLists& lists_;
    SubStream sub_;
    GateStream gate_;
    RayNumber room_[accel::instances::kMaxDepth][kRoom];
};

class Closest {
public:
    Closest(const RayStream& rays, const HitStream& hits) : rays_(rays), hits_(hits) {}

    float left(uint32_t i) const { return std::min(rays_.t_max[i], hits_.t[i]); }

    void ask(const World& world, const Part& part, const Filter& filter, SubStream& sub,
             GateStream& gate) {
        if (sub.is_few())
            for (uint32_t i = 0; i < sub.count(); ++i)
                found_.set(i, part.kernels->closest(part.target, sub.ray(i), filter));
        else
            part.kernels->closest_stream(part.target, sub.stream(), filter,
                                         found_.stream(hits_.steps != nullptr));
        for (uint32_t i = 0; i < sub.count(); ++i) {
            const uint32_t to = sub.number(i);
            if (hits_.steps) hits_.steps[to] += found_.steps[i];
            if (found_.triangle[i] == geometry::kNoTriangle) continue;
            const uint32_t triangle = found_.triangle[i] + part.first;
            if (!goes_before(world, found_.t[i], found_.back_face[i] != 0, triangle, hits_.t[to],
                             hits_.back_face[to] != 0, hits_.triangle[to]))
                continue;
            hits_.t[to] = gate.t_max[to] = found_.t[i];
            hits_.u[to] = found_.u[i];
            hits_.v[to] = found_.v[i];
            hits_.triangle[to] = triangle;
            hits_.back_face[to] = found_.back_face[i];
        }
    }

private:
    const RayStream& rays_;
    const HitStream& hits_;
    SubHits found_;
};

class Occluded {
public:
    Occluded(const RayStream& rays, uint8_t* occluded) : rays_(rays), occluded_(occluded) {}

    float left(uint32_t i) const { return occluded_[i] ? -kInfinity : rays_.t_max[i]; }

    void ask(const World&, const Part& part, const Filter& filter, SubStream& sub,
             GateStream& gate) {
        if (sub.is_few())
            for (uint32_t i = 0; i < sub.count(); ++i)
                found_[i] = part.kernels->occluded(part.target, sub.ray(i), filter);
        else
            part.kernels->occluded_stream(part.target, sub.stream(), filter, found_);
        for (uint32_t i = 0; i < sub.count(); ++i) {
            if (!found_[i]) continue;
            occluded_[sub.number(i)] = 1;
            gate.t_max[sub.number(i)] = -kInfinity;
        }
    }

private:
    const RayStream& rays_;
    uint8_t* occluded_;
    uint8_t found_[kRoom];
};

} // namespace

void closest_of_moving(const World& world, const RayStream& rays, const Positions& positions,
                       const Filter& filter, const HitStream& hits) {
    Closest kind(rays, hits);
    Walk<Closest>(world, rays, positions, filter, kind).run();
}

void occluded_by_moving(const World& world, const RayStream& rays, const Positions& positions,
                        const Filter& filter, uint8_t* occluded) {
    Occluded kind(rays, occluded);
    Walk<Occluded>(world, rays, positions, filter, kind).run();
}

} // namespace peregrine::trace
