#pragma once

#include "geometry/lift.h"
#include "math/box.h"
#include "trace/visibility/triangle_tree.h"

#include <cmath>
#include <limits>

// The segments between a lamp and a patch of a triangle, and what is provably in their way.
//
// What is to be proved is what a frame would find by tracing: from a point p of the patch, as the
// shader computes it, to the lamp L, or the other way. Let e = 2^-24, C the triangle's largest
// |coordinate|, B a triangle that may be in the way, D the largest |b - o|_inf over its corners b,
// o being the ray's origin (L or p), and l = |p - L|_inf.
//   - p is a point of the patch, lifted along the triangle's normal n by 9 e |n|.C + E, E being
//     geometry::intersection_error(); computing it errs by 9 e C an axis at most.
//   - The ray's direction is rounded: its far end is off by e l an axis.
//   - If B is hit at t, the ray's point at t is closer than 8.1 e D, in the maximum norm, to a
//     point of B (geometry/intersect.h).
// A distance in the maximum norm is at most sqrt(3) times that along any unit vector. So:
//   *Lit*: if a plane has the lamp and the lifted patch on one side, and B on the other, farther
//   than
//     sqrt(3) (8.1 e D + e l + 9 e C)  <=  17 e (D' + C),  D' = max |b - L|_inf + l
//   apart, no segment hits B. For the triangle's own plane this would be too much: coplanar
//   neighbours are only E below. There the computed points are no lower than E (their error is what
//   the rest of the lift is for), so B may be as high as E - sqrt(3) (8.1 e D + e l). Where D is at
//   most S, the largest side of the fixed triangles' bounds, that is 4 e S, as E is 20 e S or more.
//   Elsewhere E is at least 20 e times any D and l of a frame, so 4 e D is left, which is 2 e S.
//   *Hidden*: the canonical test moves B's corners by 6 e D along each of two axes across the ray.
//   A ray that passes B's edges, inside, at a distance above sqrt(2) 6 e D (and what p and the
//   direction are off) is inside the moved triangle, too: its three edge functions agree, it hits.
//   17 e (D' + C) is more than that. The point of B that it hits is as near to the ray, so t is as
//   wanted if L and p are on different sides of B's plane and farther than that from it; rays end
//   2^-12 of their length before the lamp.
// Points of the grid are off by a few e of the edges (point_visibility.h): hence 4 e times the
// longest side more. E depends on the bounds of the world, and so on what moves: proofs hold from
// E(fixed bounds) to twice that. All of this is computed in double, whose rounding is 2^-29 of e.
namespace peregrine::trace::visibility {

using math::Vec3;
using math::Vec3d;

// A lamp at a point, or infinitely far away.
struct Lamp {
    Vec3 position;  // of a point
    Vec3 direction; // of one that is far away: the way its light travels
    float reach;    // of a point: nothing beyond matters; may be infinite
    bool is_far;
};

// What all proofs for a lamp have in common.
struct Setting {
    Lamp lamp;
    Vec3d position;
    Vec3d toward;         // of a far one: unit, to the lamp
    double lift;          // E, at least; twice that at most
    double size;          // S
    double far;           // of a far one: its segments need be no longer
    double most_distance; // D is no larger; +infinity: not known
};

Setting make_setting(const Lamp& lamp, const math::Box& fixed_bounds);

// A triangle that receives light, and what of its patches does not depend on the patch.
struct Receiver {
    Vec3d v[3];
    Vec3d normal;   // unit, to the lamp's side
    double plane;   // points p of its plane: normal . p
    double height;  // of the lamp above it
    double error;   // 17 e C and the error of the grid
    double lift[2]; // of computed points, the least and the most
    double longest; // side
    bool is_seen;   // its side that the lamp is on may be seen in frames
    bool is_usable; // neither a sliver nor seen edge-on
};

Receiver make_receiver(const Setting& setting, const Corners& corners,
                       const TreeTriangle& triangle);

class Shaft {
public:
    // The patch between three points of the receiver's plane.
    Shaft(const Setting& setting, const Receiver& receiver, const Vec3d (&corners)[3]);

    // Whether no point of the patch is within the lamp's reach.
    bool is_out_of_reach() const;

    // Whether something in the box may be in the way.
    bool meets(const math::Box& box) const;

    enum class Verdict { apart, in_the_way, covers };
    Verdict judge(const TreeTriangle& b) const;

private:
    bool is_covered_by(const TreeTriangle& b, const Vec3d& normal, double lamp_height,
                       double margin) const;
    // D', or D where rays start at the patch alone; `lower`, `upper`: bounds of B.
    double distance_to(const Vec3d& lower, const Vec3d& upper) const;
    // How high above the receiver's plane B may reach and not be in the way.
    double harmless_height(double distance) const;

    const Setting& setting_;
    const Receiver& receiver_;
    Vec3d low_[3];        // the patch, lifted least,
    Vec3d high_[3];       // ... and most
    Vec3d top_[3];        // the far ends of the segments, all of them the lamp if that is a point
    int tops_;            // how many of them differ
    Vec3d lower_, upper_; // bounds of all
    Vec3d side_[3];       // unit normals of the sides, outward, ...
    double reach_[3];     // ... and how far out the shaft reaches along them
    double length_;       // l; 0 of a far lamp, whose rays all have its own direction
};

// As a shaft, of a box's points: for what is seen together.
class BoxShaft {
public:
    BoxShaft(const Setting& setting, const math::Box& box);
    bool meets(const math::Box& box) const;

private:
    void add_lines(const Setting& setting, const math::Box& box, int i, int j);

    Vec3d lower_, upper_;
    struct Line { // a x_i + b x_j <= c for all points of the shaft
        int i, j;
        double a, b, c;
    };
    Line lines_[6];
    int count_ = 0;
};

} // namespace peregrine::trace::visibility
