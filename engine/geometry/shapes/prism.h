#pragma once

#include "geometry/shapes/overlap.h"

#include <cstdint>

// A moving ball against the prism that a triangle makes when it is moved from -axis to axis.
//
// The ball comes from outside, so what it touches first faces it: the contact's normal, which is
// against the motion, is made of normals of the faces that meet there, with factors that are not
// negative, so one of these is against the motion, too. Faces that look away, and edges between two
// such, are left out where that is certain.
namespace peregrine::geometry {

namespace prism_detail {

// Whether a product of vectors has the sign that it seems to have, given the product of their
// squares: normals and what lies across an edge are off by 2^-25 or less (features.h).
inline bool is_certain(double product, double squares) {
    return product * product > 0x1p-48 * squares;
}

enum class Facing : uint8_t { away, unknown, towards };

// An edge of the triangle, and the side of the prism over it.
struct Rim {
    Edge edge;
    Across seen;
    double apart; // of the edge and the path, times the length of seen.across
    double lift;  // what the axis adds to that; also the rate of side x axis
    Facing side = Facing::unknown;

    Rim(const Motion& motion, const Vec3d& axis, const Vec3d& start, const Vec3d& along)
        : edge(start, along), seen(motion, along), apart(glm::dot(start, seen.across)),
          lift(glm::dot(axis, seen.across)) {}

    // Where only the ends of the edge count.
    bool is_parallel(const Motion& motion) const {
        return !(seen.cc > kSine * kSine * (motion.dd * edge.ee));
    }

    // `turn` is positive where along x axis looks out of the prism.
    void find_side(const Motion& motion, double aa, double turn) {
        if (is_parallel(motion) || !is_certain(lift, aa * seen.cc)) return;
        side = (turn > 0) == (lift > 0) ? Facing::away : Facing::towards;
    }
};

} // namespace prism_detail

// `rate` is the motion along the face's normal.
inline FirstContact meet_prism(const Motion& motion, const Corners& corners, const Face& face,
                               double rate, const Vec3d& axis, double limit) {
    using namespace prism_detail;
    FirstContact first;
    const double rise = glm::dot(face.normal, axis), aa = glm::dot(axis, axis);
    const double outer = (rate > 0) == (rise > 0) ? -1 : 1;
    first.meet(motion, face.moved(outer * axis, outer));
    if (first.is_one) return first;

    Rim rims[] = {{motion, axis, corners.a, face.side0},
                  {motion, axis, corners.b, corners.c - corners.b},
                  {motion, axis, corners.a, face.side1}};
    const bool knows_caps = face.solid && is_certain(rate, face.nn * motion.dd);
    const bool is_flat = !is_certain(rise, face.nn * aa); // everything lies in one plane
    if (is_flat && face.solid) {
        for (Rim& rim : rims) rim.side = Facing::towards;
    } else if (face.solid) {
        rims[0].find_side(motion, aa, rise);
        rims[1].find_side(motion, aa, rise);
        rims[2].find_side(motion, aa, -rise); // the one that goes the other way round
    }
    const Vec3d along = 2.0 * axis;
    for (const Rim& rim : rims) {
        if (rim.side == Facing::away) continue;
        first.meet(motion, Face(rim.edge.start - axis, rim.edge.along, along, true, -1, 2));
        if (first.is_one && rim.side == Facing::towards) return first;
    }
    if (!knows_caps || is_flat) first.meet(motion, face.moved(-outer * axis, -outer));
    // Only now: whether a face is met must not depend on what else there is.
    first.limit_to(limit);

    for (const Rim& rim : rims)
        for (const double core : {outer, -outer}) {
            if (core != outer && knows_caps && rim.side == Facing::away) break;
            const double apart = rim.apart + core * rim.lift;
            // What meet() would find, too, but before the edge is moved: half of them end here.
            if (apart * apart > motion.rr * rim.seen.cc && !rim.is_parallel(motion)) continue;
            first.meet(motion, rim.edge.moved(core * axis, core), rim.seen, apart);
        }
    const Across across(motion, along);
    const auto meet_lateral = [&](const Vec3d& corner, const Rim& before, const Rim& after) {
        if (before.side == Facing::away && after.side == Facing::away) return;
        first.meet(motion, Edge(corner - axis, along, -1, 2), across,
                   glm::dot(corner, across.across));
    };
    meet_lateral(corners.a, rims[2], rims[0]);
    meet_lateral(corners.b, rims[0], rims[1]);
    meet_lateral(corners.c, rims[1], rims[2]);
    return first;
}

} // namespace peregrine::geometry
