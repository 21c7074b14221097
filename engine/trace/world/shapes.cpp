#include "trace/world/shapes.h"

#include "trace/shapes/volume.h"
#include "trace/world/merge.h"
#include "trace/world/visit_instances.h"

namespace peregrine::trace {
namespace {

constexpr Place kWhereItIs;

template <class Query>
const ShapeKernels& kernels(const Part& part, const Query& query) {
    const bool counts = query.watch && query.watch->counters;
    return counts ? *part.kernels->plain_shapes : *part.kernels->shapes;
}

// An instance and the volume, each as the other sees it.
struct Meeting {
    Place place;
    Volume local;
};

// At least the length of the image of any unit vector: |W| = sqrt(|W^T W|), the latter in the
// maximum norm, which is exact for turned and scaled meshes.
double longest_image(const math::Affine& map) {
    double largest = 0;
    for (const math::Vec3d& row : map.column) {
        double sum = 0;
        for (const math::Vec3d& column : map.column) sum += std::fabs(glm::dot(row, column));
        largest = std::max(largest, sum);
    }
    return std::sqrt(largest) * (1 + 0x1p-40);
}

// The volume in the instance's space, its origin being o as seen from that of the space. To what
// the map to there, W, makes of it comes what is rounded: the local origin, if kernels want it in
// float, and the maps there and back in double: c 2^-44 (|W| |o| + R), where R is the largest
// |coordinate| of the mesh and c = |M| |W|; twice each, so that the corner of a cube of slack is
// within a ball of it.
Volume to_local(const Instance& instance, const Volume& volume, const math::Vec3d& seen) {
    const math::Affine& map = instance.to_local;
    Volume local;
    local.origin = map.vector(seen);
    local.direction = map.vector(volume.direction);
    const auto largest = [](const math::Vec3d& v) { return largest_component(v); };
    const math::Box& bounds = instance.part.target.bounds;
    const double shrinks = map.norm(), condition = shrinks * instance.to_world->norm();
    const double mesh =
        largest(glm::max(glm::abs(math::Vec3d(bounds.lower)), glm::abs(math::Vec3d(bounds.upper))));
    const double size = shrinks * (largest(seen) + largest(volume.extent)) + mesh;
    local.slack = 0x1p-21 * largest(local.origin) + condition * 0x1p-43 * size;
    local.extent =
        ((glm::abs(map.column[0]) * volume.extent.x + glm::abs(map.column[1]) * volume.extent.y)
         + glm::abs(map.column[2]) * volume.extent.z)
        + local.slack;
    local.axis = map.vector(volume.axis);
    local.stretch = longest_image(map);
    local.radius = volume.radius * local.stretch + local.slack;
    return local;
}

Meeting meet(const Instance& instance, const Volume& volume, const Position& position) {
    if (!instance.has_own_space()) return {{nullptr, false, instance.mesh}, volume};
    const math::Vec3d seen = position.from(instance.origin);
    return {{instance.to_world, instance.mirrored, instance.mesh, seen},
            to_local(instance, volume, seen)};
}

// A volume as the nodes over instances see it. Its origin counts as it was told, in double, for
// meshes with a space of their own, and rounded to float for others.
class VolumeGate {
public:
    VolumeGate(const World& world, const Volume& volume, const Position& position)
        : world_(world), volume_(volume),
          slabs_(slabs<double>(volume, reach_of(world.moving_bounds, volume), 0)) {
        if (position.base != math::Vec3d(0)) see_both(position);
    }

    void enter(uint32_t at, float t_max, EnteredNode& entered) const {
        const accel::instances::Node& node = world_.nodes[at];
        if (world_.rests) [[unlikely]]
            return enter_far(node, world_.rests[at], t_max, entered);
        entered.children = 0;
        for (uint32_t i = 0; i < node.count; ++i) {
            double t_near = 0, t_far = double(t_max);
            for (int k = 0; k < 3; ++k) {
                const double a = (double(node.lower[k][i]) - slabs_.origin[k]) * slabs_.inverse[k];
                const double b = (double(node.upper[k][i]) - slabs_.origin[k]) * slabs_.inverse[k];
                t_near = std::max(t_near, std::min(a, b) - slabs_.margin[k]);
                t_far = std::min(t_far, std::max(a, b) + slabs_.margin[k]);
            }
            entered.children |= uint32_t(t_near <= t_far) << i;
            entered.t_near[i] = float(t_near);
        }
    }

private:
    void see_both(const Position& position) {
        const double between = 0x1p-23 * largest_component(volume_.origin);
        for (int k = 0; k < 3; ++k)
            if (world_.rests)
                slabs_.origin[k] = double(position.record[k]) + position.base[k];
            else
                slabs_.margin[k] += between * std::fabs(slabs_.inverse[k]);
    }

    // With the margins of volume.h for each child alone, and what world.h has for nodes with rests.
    void enter_far(const accel::instances::Node& node, const accel::instances::NodeRest& rest,
                   float t_max, EnteredNode& entered) const {
        const double distance = largest_component(volume_.origin);
        entered.children = 0;
        for (uint32_t i = 0; i < node.count; ++i) {
            double lower[3], upper[3], reach = 0;
            for (int k = 0; k < 3; ++k) {
                lower[k] = double(node.lower[k][i]) - slabs_.origin[k] + double(rest.lower[k][i]);
                upper[k] = double(node.upper[k][i]) - slabs_.origin[k] + double(rest.upper[k][i]);
                reach = std::max(reach, std::max(std::fabs(lower[k]), std::fabs(upper[k]))
                                            + volume_.extent[k]);
            }
            const double error =
                0x1p-17 * reach + double(rest.margin[i]) + 0x1p-46 * distance + 0x1p-146;
            double t_near = 0, t_far = double(t_max);
            for (int k = 0; k < 3; ++k) {
                const double a = lower[k] * slabs_.inverse[k], b = upper[k] * slabs_.inverse[k];
                const double margin =
                    (volume_.extent[k] + error) * std::fabs(slabs_.inverse[k]) + 0x1p-149;
                t_near = std::max(t_near, std::min(a, b) - margin);
                t_far = std::min(t_far, std::max(a, b) + margin);
            }
            entered.children |= uint32_t(t_near <= t_far) << i;
            entered.t_near[i] = float(t_near);
        }
    }

    const World& world_;
    const Volume& volume_;
    Slabs<double> slabs_;
};

// Calls visit(instance, meeting) for those that the filter sees and the volume may meet; as
// visit_instances.h has it.
template <class Visit>
bool visit_instances(const World& world, const Volume& volume, const Position& position,
                     const Filter& filter, const float& t_max, Visit&& visit) {
    const VolumeGate gate(world, volume, position);
    EnteredNode entered;
    gate.enter(0, t_max, entered);
    return visit_instances(world, gate, entered, t_max, [&](const Instance& instance) {
        return sees(filter, instance) && visit(instance, meet(instance, volume, position));
    });
}

// The same query for what is seen within an instance.
template <class Query>
Query within(const Query& query, const Instance& instance) {
    if (query.watch && query.watch->counters && instance.has_own_space())
        ++query.watch->counters->instances;
    Query inside = query;
    inside.filter = filter_within(query.filter, instance);
    return inside;
}

void take_first(const World& world, FirstHit hit, uint32_t first, FirstHit& best) {
    if (hit.triangle == geometry::kNoTriangle) return;
    hit.triangle += first;
    const int order = hit.compare(best);
    if (order < 0 || (order == 0 && is_named_before(world, hit.triangle, best.triangle)))
        best = hit;
}

void take_first(const World& world, NearestHit hit, uint32_t first, NearestHit& best) {
    if (hit.triangle == geometry::kNoTriangle) return;
    hit.triangle += first;
    if (hit.distance != best.distance ? hit.distance < best.distance
                                      : is_named_before(world, hit.triangle, best.triangle))
        best = hit;
}

// What limits the search of the next part: the best so far, without its triangle, so that equals
// are found too.
FirstHit limit_of(const FirstHit& best) {
    FirstHit limit = best;
    limit.triangle = geometry::kNoTriangle;
    return limit;
}
NearestHit limit_of(const NearestHit& best) {
    NearestHit limit = best;
    limit.triangle = geometry::kNoTriangle;
    return limit;
}

// The shape's centre is at `position`, which the triangles are seen from; the slide's point, which
// they are looked for around, is elsewhere.
void surround(const World& world, const Position& position, const SeamQuery& query,
              geometry::Slide& slide) {
    Volume point;
    point.origin = query.center + slide.point();
    const Volume ball = with_radius(point, slide.reach());
    kernels(world.fixed, query).surround(world.fixed.target, kWhereItIs, ball, query, slide);
    if (!world.nodes) return;
    const float at_rest = 0;
    const Position around{position.record, position.base + slide.point()};
    visit_instances(world, ball, around, query.filter, at_rest,
                    [&](const Instance& instance, const Meeting& meeting) {
                        Place place = meeting.place;
                        place.center = position.from(instance.origin);
                        kernels(instance.part, query)
                            .surround(instance.part.target, place, meeting.local,
                                      within(query, instance), slide);
                        return false;
                    });
}

struct SurroundingWorld : Surroundings {
    const World& world;
    const Position& position;
    const SweepQuery& query;

    SurroundingWorld(const World& world_, const Position& position_, const SweepQuery& query_)
        : Surroundings{show_all}, world(world_), position(position_), query(query_) {}

    static void show_all(const Surroundings& self, geometry::Slide& slide) {
        const auto& all = static_cast<const SurroundingWorld&>(self);
        surround(all.world, all.position,
                 {all.query.sweep.center, all.query.filter, all.query.watch}, slide);
    }
};

} // namespace

FirstHit slide(const World& world, const Volume& volume, const Position& position,
               const SweepQuery& query) {
    const SurroundingWorld surroundings(world, position, query);
    SweepQuery asked = query;
    asked.surroundings = &surroundings;
    return sweep(world, volume, position, asked);
}

FirstHit sweep(const World& world, const Volume& volume, const Position& position,
               const SweepQuery& query) {
    FirstHit best;
    kernels(world.fixed, query).sweep(world.fixed.target, kWhereItIs, volume, query, best);
    if (!world.nodes) return best;
    const auto look = [&](const Part& part, const Place& place, const Volume& there,
                          const SweepQuery& asked) {
        FirstHit hit = limit_of(best);
        kernels(part, query).sweep(part.target, place, there, asked, hit);
        take_first(world, hit, part.first, best);
    };
    float t_max = best.limit(query.t_max);
    visit_instances(world, volume, position, query.filter, t_max,
                    [&](const Instance& instance, const Meeting& meeting) {
                        look(instance.part, meeting.place, meeting.local, within(query, instance));
                        t_max = best.limit(query.t_max);
                        return false;
                    });
    return best;
}

bool overlaps(const World& world, const Volume& volume, const Position& position,
              const OverlapQuery& query) {
    if (kernels(world.fixed, query).overlaps(world.fixed.target, kWhereItIs, volume, query))
        return true;
    if (!world.nodes) return false;
    const float at_rest = 0;
    return visit_instances(world, volume, position, query.filter, at_rest,
                           [&](const Instance& instance, const Meeting& meeting) {
                               const Part& part = instance.part;
                               return kernels(part, query)
                                   .overlaps(part.target, meeting.place, meeting.local,
                                             within(query, instance));
                           });
}

void collect(const World& world, const Volume& volume, const Position& position,
             const OverlapQuery& query, Touched& touched) {
    kernels(world.fixed, query).collect(world.fixed.target, kWhereItIs, volume, query, touched);
    if (!world.nodes) return;
    const float at_rest = 0;
    visit_instances(world, volume, position, query.filter, at_rest,
                    [&](const Instance& instance, const Meeting& meeting) {
                        const Part& part = instance.part;
                        kernels(part, query)
                            .collect(part.target, meeting.place, meeting.local,
                                     within(query, instance), touched);
                        return false;
                    });
}

NearestHit nearest(const World& world, const Volume& volume, const Position& position,
                   const NearestQuery& query) {
    NearestHit best;
    kernels(world.fixed, query).nearest(world.fixed.target, kWhereItIs, volume, query, best);
    if (!world.nodes) return best;
    const auto look = [&](const Part& part, const Place& place, const Volume& there,
                          const NearestQuery& asked) {
        NearestHit hit = limit_of(best);
        kernels(part, query).nearest(part.target, place, there, asked, hit);
        take_first(world, hit, part.first, best);
    };
    const float at_rest = 0;
    visit_instances(world, with_radius(volume, double(best.limit(query.radius))), position,
                    query.filter, at_rest, [&](const Instance& instance, const Meeting& meeting) {
                        look(instance.part, meeting.place, meeting.local, within(query, instance));
                        return false;
                    });
    return best;
}

} // namespace peregrine::trace
