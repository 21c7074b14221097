#pragma once

#include "trace/kernels.h"
#include "trace/shapes/judge.h"
#include "trace/shapes/volume.h"

// The kernels for shapes in plain C++, given what a structure knows:
//     template <class Real, class Visit>
//     static uint32_t visit(const Target&, const Slabs<Real>&, Visit&&);
// calls visit(vertices, index, t_limit), which may lower t_limit, for each triangle of the leaves
// that the volume may touch, until that returns true, and returns the number of nodes visited. A
// triangle may come more than once.
namespace peregrine::trace {

template <class Structure>
class PlainShapes {
public:
    static void sweep(const Target& target, const Place& place, const Volume& volume,
                      const SweepQuery& query, FirstHit& best) {
        visit(target, volume, query.watch, best.initial ? 0 : best.limit(query.t_max),
              [&](const Vertices& vertices, uint32_t index, auto& t_limit) {
                  judge(query, place, vertices, target.infos, index, best);
                  using Real = std::remove_reference_t<decltype(t_limit)>;
                  t_limit = std::min(t_limit, Real(best.t));
                  return false;
              });
    }

    static bool overlaps(const Target& target, const Place& place, const Volume& volume,
                         const OverlapQuery& query) {
        bool found = false;
        visit(target, volume, query.watch, 0, [&](const Vertices& vertices, uint32_t index, auto&) {
            return found = judge(query, place, vertices, target.infos[index]);
        });
        return found;
    }

    static void collect(const Target& target, const Place& place, const Volume& volume,
                        const OverlapQuery& query, Touched& touched) {
        visit(target, volume, query.watch, 0, [&](const Vertices& vertices, uint32_t index, auto&) {
            const uint64_t key = key_of(place, target.infos[index]);
            if (touched.wants(key) && judge(query, place, vertices, target.infos[index]))
                touched.add(key);
            return false;
        });
    }

    // In balls that grow until one holds something.
    static void nearest(const Target& target, const Place& place, const Volume& volume,
                        const NearestQuery& query, NearestHit& best) {
        if (target.bounds.empty()) return;
        const double end = double(best.limit(query.radius));
        const double reach = reach_of(target.bounds, with_radius(volume, 0));
        for (double radius = first_radius(target.bounds, volume);; radius *= 4) {
            const Volume ball = with_radius(volume, std::min(radius, end));
            visit(target, ball, query.watch, 0,
                  [&](const Vertices& vertices, uint32_t index, auto&) {
                      judge(query, place, vertices, target.infos, index, best);
                      return false;
                  });
            const bool is_all = ball.radius > reach;
            if (!(radius < end) || double(best.distance) <= radius || is_all) return;
        }
    }

    static void surround(const Target& target, const Place& place, const Volume& volume,
                         const SeamQuery& query, geometry::Slide& slide) {
        visit(target, volume, query.watch, 0, [&](const Vertices& vertices, uint32_t index, auto&) {
            judge(query, place, vertices, target.infos[index], slide);
            return false;
        });
    }

private:
    template <class Visit>
    static void visit(const Target& target, const Volume& volume, const Watch* watch, float t_max,
                      Visit&& visit) {
        if (target.bounds.empty()) return;
        uint64_t triangles = 0;
        const auto counted = [&](const Vertices& vertices, uint32_t index, auto& t_limit) {
            ++triangles;
            return visit(vertices, index, t_limit);
        };
        const double reach = reach_of(target.bounds, volume);
        const uint32_t nodes =
            fits_float(volume, reach)
                ? Structure::visit(target, slabs<float>(volume, reach, t_max), counted)
                : Structure::visit(target, slabs<double>(volume, reach, t_max), counted);
        if (watch && watch->counters) *watch->counters += {nodes, triangles, 0};
    }
};

template <class Structure>
inline constexpr ShapeKernels kPlainShapes = {
    PlainShapes<Structure>::sweep, PlainShapes<Structure>::overlaps,
    PlainShapes<Structure>::collect, PlainShapes<Structure>::nearest,
    PlainShapes<Structure>::surround};

} // namespace peregrine::trace
