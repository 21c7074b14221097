#pragma once

#include "trace/shapes/shapes.h"

// What the canonical tests say of one triangle, and what a query makes of it.
namespace peregrine::trace {

struct Vertices {
    math::Vec3 v0, v1, v2;

    geometry::Corners around(const Place& place, const math::Vec3d& center) const {
        return {place.point(v0), place.point(v1), place.point(v2),
                place.to_world ? place.center : center};
    }
    double coordinate(const Place& place) const {
        return std::max(std::max(place.coordinate(v0), place.coordinate(v1)), place.coordinate(v2));
    }
};

inline uint64_t key_of(const Place& place, const geometry::TriangleInfo& triangle) {
    return Touched::key_of(place.mesh == geometry::kNoTriangle ? triangle.mesh : place.mesh,
                           triangle.primitive);
}

// The host's word.
template <class Query>
bool is_accepted(const Query& query, const Place& place, const geometry::TriangleInfo& triangle) {
    if (!query.watch || !query.watch->accepts) return true;
    const uint32_t mesh = place.mesh == geometry::kNoTriangle ? triangle.mesh : place.mesh;
    return query.watch->accepts(query.watch->context, mesh, triangle.primitive);
}

// 1 where the centre is in front of the triangle or in its plane, else -1.
inline double facing(const Place& place, const geometry::Face& face) {
    const double height = -glm::dot(face.normal, face.corner);
    const double front = place.mirrored ? -height : height;
    return front < 0 ? -1 : 1;
}

// Whether a contact stops what slides, and with which normal.
inline bool stops(const SweepQuery& query, const Place& place, const Vertices& vertices,
                  geometry::Contact& contact) {
    const geometry::Tile tile(vertices.around(place, query.sweep.center),
                              vertices.coordinate(place));
    geometry::Slide slide(query.sweep, double(query.t_max), tile, contact);
    while (slide.is_open()) {
        query.surroundings->show(*query.surroundings, slide);
        slide.settle();
    }
    contact.normal = slide.normal();
    return slide.stops();
}

inline void judge(const SweepQuery& query, const Place& place, const Vertices& vertices,
                  const geometry::TriangleInfo* infos, uint32_t index, FirstHit& best) {
    FirstHit hit;
    geometry::Contact& contact = hit.contact;
    const double limit = double(best.limit(query.t_max)) * (1 + 0x1p-22) + 0x1p-148;
    if (!geometry::sweep_triangle(query.sweep, vertices.around(place, query.sweep.center), contact,
                                  limit))
        return;
    hit.t = float(contact.t);
    hit.initial = contact.initial;
    hit.depth = float(contact.depth);
    hit.triangle = index;
    if (!(hit.t <= query.t_max) || !hit.comes_before(best)) return;
    if (counts(query.filter, infos[index], place.mirrored ? contact.rate : -contact.rate)
        && (!query.surroundings || stops(query, place, vertices, contact))
        && is_accepted(query, place, infos[index]))
        best = hit;
}

// Of the faces that do not count, only those take no part that the motion clearly goes against or
// away from: along a floor that is a matter of rounding.
inline void judge(const SeamQuery& query, const Place& place, const Vertices& vertices,
                  const geometry::TriangleInfo& info, geometry::Slide& slide) {
    const geometry::Corners start = vertices.around(place, query.center);
    const geometry::Corners corners(start.a, start.b, start.c, slide.point());
    if (!slide.may_rise(corners)) return;
    const geometry::Tile tile(corners, vertices.coordinate(place));
    const double rate = glm::dot(tile.face.normal, slide.direction());
    const bool is_along = std::fabs(rate) <= tile.slack() * tile.length;
    const bool takes_part = is_along ? query.filter.sees_mesh(info)
                                     : counts(query.filter, info, place.mirrored ? rate : -rate);
    if (takes_part && is_accepted(query, place, info)) slide.look_at(tile);
}

inline bool judge(const OverlapQuery& query, const Place& place, const Vertices& vertices,
                  const geometry::TriangleInfo& info) {
    const geometry::Corners corners = vertices.around(place, query.shape.center);
    const geometry::Face face = geometry::face_of(corners);
    return query.shape.touches(corners, face) && counts(query.filter, info, facing(place, face))
           && is_accepted(query, place, info);
}

inline void judge(const NearestQuery& query, const Place& place, const Vertices& vertices,
                  const geometry::TriangleInfo* infos, uint32_t index, NearestHit& best) {
    const geometry::Corners corners = vertices.around(place, query.point);
    const geometry::Face face = geometry::face_of(corners);
    const geometry::NearestOnTriangle nearest(corners, face);
    NearestHit hit;
    hit.distance = float(std::sqrt(nearest.square));
    hit.triangle = index;
    if (!(hit.distance <= query.radius) || !hit.comes_before(best)
        || !counts(query.filter, infos[index], facing(place, face))
        || !is_accepted(query, place, infos[index]))
        return;
    hit.at = nearest.at;
    hit.u = float(nearest.u);
    hit.v = float(nearest.v);
    hit.normal = geometry::unit_or_zero(-nearest.at);
    if (hit.normal == math::Vec3d(0))
        hit.normal = geometry::unit_or_zero(place.mirrored ? -face.normal : face.normal);
    best = hit;
}

} // namespace peregrine::trace
