#include "trace/world/stream.h"

#include "trace/slabs.h"
#include "trace/world/merge.h"
#include "trace/world/ray_lists.h"
#include "trace/world/sub_stream.h"

#include <algorithm>
#include <limits>

namespace peregrine::trace {
namespace {

using accel::instances::Extent;
using accel::instances::Node;

static_assert(kMaxStream + 16 <= kRoom);

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// The way of a stream through the moving parts; Kind says what is asked of each.
template <class Kind>
class Walk {
public:
    Walk(const World& world, const RayStream& rays, const Filter& filter, Kind& kind)
        : world_(world), rays_(rays), filter_(filter), kind_(kind),
          lists_(ray_lists(world.fixed.kernels->isa)), sub_(rays.coherence) {
        lists_.look_at(rays, gate_);
        for (uint32_t i = 0; i < rays.count; ++i) gate_.t_max[i] = kind.left(i);
    }

    void run() {
        const uint32_t count =
            lists_.enter_all(world_.nodes[0].extent, gate_, rays_.count, list(0));
        if (count != 0) visit(0, 0, count);
    }

private:
    RayNumber* list(uint32_t level) { return room_[level]; }

    void visit(uint32_t place, uint32_t level, uint32_t count) {
        const Node& node = world_.nodes[place];
        if (node.right == 0) return visit_instance(world_.instances[node.instance], level, count);
        uint32_t children[2] = {place + 1, node.right};
        if (!left_first(children, list(level)[0])) std::swap(children[0], children[1]);
        for (const uint32_t child : children) {
            RayNumber* const entering = list(level + 1);
            std::fill_n(list(level) + count, 16, RayNumber(0));
            const uint32_t entered =
                lists_.enter(world_.nodes[child].extent, gate_, list(level), count, entering);
            if (entered != 0) visit(child, level + 1, entered);
        }
    }

    bool left_first(const uint32_t (&children)[2], uint32_t ray) const {
        const math::Box& a = world_.nodes[children[0]].extent.box;
        const math::Box& b = world_.nodes[children[1]].extent.box;
        float order = 0;
        for (int k = 0; k < 3; ++k)
            order +=
                rays_.direction[k][ray] * ((b.lower[k] + b.upper[k]) - (a.lower[k] + a.upper[k]));
        return order >= 0;
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
        if (within(instance, ray, local)) sub_.add(local, number);
    }

    const World& world_;
    const RayStream& rays_;
    const Filter& filter_;
    Kind& kind_;
    const RayLists& lists_;
    SubStream sub_;
    GateStream gate_;
    RayNumber room_[accel::instances::kMaxDepth + 1][kRoom];
};

class Closest {
public:
    Closest(const RayStream& rays, const HitStream& hits) : rays_(rays), hits_(hits) {}

    float left(uint32_t i) const { return std::min(rays_.t_max[i], hits_.t[i]); }

    void ask(const World& world, const Part& part, const Filter& filter, SubStream& sub,
             GateStream& gate) {
        part.kernels->closest_stream(part.target, sub.stream(), filter,
                                     found_.stream(hits_.steps != nullptr));
        for (uint32_t i = 0; i < sub.count(); ++i) {
            const uint32_t to = sub.number(i);
            if (hits_.steps) hits_.steps[to] += found_.steps[i];
            if (found_.triangle[i] == geometry::kNoTriangle) continue;
            const uint32_t triangle = found_.triangle[i] + part.first;
            if (!goes_before(world, found_.t[i], triangle, hits_.t[to], hits_.triangle[to]))
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

void closest_of_moving(const World& world, const RayStream& rays, const Filter& filter,
                       const HitStream& hits) {
    Closest kind(rays, hits);
    Walk<Closest>(world, rays, filter, kind).run();
}

void occluded_by_moving(const World& world, const RayStream& rays, const Filter& filter,
                        uint8_t* occluded) {
    Occluded kind(rays, occluded);
    Walk<Occluded>(world, rays, filter, kind).run();
}

} // namespace peregrine::trace
