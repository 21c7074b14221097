#pragma once

#include "geometry/shapes/features.h"
#include "geometry/shapes/overlap.h"
#include "geometry/shapes/prism.h"

// THE test of a moving sphere or capsule against a triangle. Every traversal gives the bits of this
// file.
//
//        ( )  . . . .  ( )      The sphere's centre meets the triangle rounded by the radius: faces
//         o ------->  __o___    moved out by it, cylinders around edges, balls around vertices. A
//                    /______\   capsule's centre meets the prism that the triangle makes when it is
//                               moved along the axis, rounded alike.
namespace peregrine::geometry {

// A capsule, the points within `radius` of the segment center - axis to center + axis, that moves
// by t * direction. Without an axis: a sphere.
struct Sweep {
    Vec3d center;
    Vec3d axis;
    Motion motion;
    bool is_capsule;

    Sweep(const math::Vec3& center_, const math::Vec3& axis_, const math::Vec3& direction,
          float radius)
        : center(center_), axis(axis_), motion(Vec3d(direction), double(radius)),
          is_capsule(axis_ != math::Vec3(0)) {}
};

struct Contact {
    double t;
    Vec3d point;  // of the triangle, relative to where the shape's centre starts
    Vec3d normal; // unit, towards the shape
    double depth; // at an initial contact
    double rate;  // the motion along the triangle's own normal, of any length
    bool initial; // they touch at the start
};

namespace sweep_detail {

// Towards the start, or against the motion if the centre starts in the triangle's plane.
inline Vec3d normal_of_plane(const Face& face, double rate) {
    const double height = -glm::dot(face.normal, face.corner);
    const bool flips = height != 0 ? height < 0 : rate > 0;
    return unit_or_zero(flips ? -face.normal : face.normal);
}

// A face that is met from outside is the first contact with a convex set.
inline FirstContact meet_triangle(const Motion& motion, const Corners& corners, const Face& face,
                                  double limit) {
    FirstContact first;
    first.meet(motion, face);
    if (first.is_one) return first;
    first.limit_to(limit);
    first.meet(motion, Edge(corners.a, face.side0));
    first.meet(motion, Edge(corners.b, corners.c - corners.b));
    first.meet(motion, Edge(corners.a, face.side1));
    return first;
}

// Whether the shape's box at the start is beside the triangle's.
inline bool is_far(const Sweep& sweep, const Corners& corners) {
    for (int k = 0; k < 3; ++k) {
        const double reach = sweep.motion.radius + std::fabs(sweep.axis[k]);
        if (std::min(std::min(corners.a[k], corners.b[k]), corners.c[k]) > reach
            || std::max(std::max(corners.a[k], corners.b[k]), corners.c[k]) < -reach)
            return true;
    }
    return false;
}

} // namespace sweep_detail

// False if they do not touch; contacts from `limit` on may be missing, or not.
inline bool sweep_triangle(const Sweep& sweep, const Corners& corners, Contact& contact,
                           double limit = std::numeric_limits<double>::infinity()) {
    using namespace sweep_detail;
    const Motion& motion = sweep.motion;
    const Face face = face_of(corners);
    const double rate = glm::dot(face.normal, motion.direction);
    const double height = glm::dot(face.normal, face.corner);
    const double gap = std::fabs(height) - std::fabs(glm::dot(face.normal, sweep.axis));
    const bool is_beside = face.solid && gap > 0 && gap * gap > motion.rr * face.nn;
    if (is_beside && !(height * rate > 0)) return false; // and does not come nearer

    Nearest nearest;
    if (!is_beside && !is_far(sweep, corners))
        nearest = sweep.is_capsule ? nearest_to_segment(corners, face, sweep.axis)
                                   : nearest_to_origin(corners, face);
    const bool initial = nearest.square <= motion.rr;
    const FirstContact first = initial ? FirstContact(0, nearest.at, -nearest.at, nearest.core)
                               : sweep.is_capsule
                                   ? meet_prism(motion, corners, face, rate, sweep.axis, limit)
                                   : meet_triangle(motion, corners, face, limit);
    if (!first.is_one) return false;
    contact.t = first.t;
    contact.point = first.at - first.core * sweep.axis;
    contact.normal = unit_or_zero(first.normal);
    if (contact.normal == Vec3d(0)) contact.normal = normal_of_plane(face, rate);
    contact.depth = initial ? motion.radius - std::sqrt(nearest.square) : 0;
    contact.rate = rate;
    contact.initial = initial;
    return true;
}

} // namespace peregrine::geometry
