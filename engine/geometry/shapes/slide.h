#pragma once

#include "geometry/shapes/sweep.h"

#include <algorithm>
#include <cmath>

// What stops a shape that slides over surfaces: what its motion gets deeper into, and not the seams
// of a surface that it is a bit inside of already.
//
//        .---.          The shape is in a flat floor by a hair. The next triangle begins at p,
//       /     \         ahead of the lowest point, and the normal there leans back. But that is
//      |   o   | ->     none of the surface, since the last triangle rises along it. Without what
//    ___\___/p_____     rises it is the floor's own, and along that the motion goes no deeper.
//         `-´
//
// The distance from one triangle is convex in time. So what is touched with a normal that the
// motion does not go against is not got into deeper later either: it stops nothing.
//
// A normal at a point p of a triangle's border is one of the surface there if no triangle that
// touches p rises along it, which is to say if it is in the polar of their tangent cones. Otherwise
// the shape is inside of one of them. The steepest rise is taken out of the normal (Moreau's
// decomposition for that cone), and again, until nothing rises: on a flat surface that leaves the
// normal of the face, on a ridge what is across the ridge, at the upper edge of a wall below a
// floor the floor's. If the triangle itself rises along what is left, it is the side of a hollow,
// and its own normal counts. Either way all of the triangle is behind a plane through p with the
// normal that counts; if the motion does not go into that plane, it gets no deeper than it is.
//
// Where a shape that is clear of everything first touches something the normal stays: what rises
// along it would have been touched before.
namespace peregrine::geometry {

// A motion that meets a plane at a smaller sine goes along it: several times what directions in
// float are off by.
inline constexpr double kAlong = 0x1p-18;
// Vertices were rounded to float, by 2^-24 of the largest coordinate A, which turns a triangle of
// height h by 2^-22 A / h or less. So much is allowed besides; where nothing but that triangle may
// stop the shape, not more than this.
inline constexpr double kMostTurn = 0x1p-10;
// But all that together may not take a shape through a floor on a long way: no deeper than this
// part of the radius, and what rounding moves the floor by, if that is less than some more. Points
// have nothing else.
inline double most_depth(double radius, double rounding) {
    return radius > 0 ? 0x1p-4 * radius + std::min(rounding, 0x1p-2 * radius) : rounding;
}
// What touches a contact is looked for around it, in so small a part of the radius that a shape
// that goes over it hardly notices, beside what rounding moves vertices by.
inline constexpr double kReach = 0x1p-14;

// A triangle that something slides along. `coordinate` is the largest that its vertices had when
// they were rounded to float, as long as it is in the world.
struct Tile {
    Corners corners;
    Face face;
    double length;   // of the face's normal
    double longest;  // edge
    double rounding; // what that may have moved points of it by
    double turn;     // ... and turned it, as a sine

    Tile(const Corners& corners_, double coordinate)
        : corners(corners_), face(face_of(corners)), length(std::sqrt(face.nn)),
          longest(length_of_longest()), rounding(0x1p-22 * coordinate),
          turn(rounding * longest / length) {}

    double slack() const { return kAlong + std::min(kMostTurn, turn); }

    // From a point that it is `gap` away from, the way on it that rises most along a unit normal,
    // as long as the sine of that: the normal's projection on the tangent cone, which is what the
    // edges at the point leave of the plane.
    Vec3d rise(const Vec3d& point, double gap, const Vec3d& normal) const {
        const double reach = 2 * gap + 0x1p-40 * longest;
        if (!face.solid) return Vec3d(0);
        struct Side {
            Vec3d along, inward;
        } sides[3];
        int count = 0;
        const Vec3d up = face.normal / length;
        const auto add = [&](const Vec3d& start, const Vec3d& along) {
            Nearest nearest;
            nearest.look_at(Edge(start - point, along));
            if (nearest.square > reach * reach) return;
            const Vec3d unit = unit_or_zero(along);
            sides[count++] = {unit, glm::cross(up, unit)};
        };
        add(corners.a, face.side0);
        add(corners.b, corners.c - corners.b);
        add(corners.c, corners.a - corners.c);
        const auto holds = [&](const Vec3d& way, int except) {
            for (int i = 0; i < count; ++i)
                if (i != except && glm::dot(way, sides[i].inward) < 0) return false;
            return true;
        };
        const Vec3d way = normal - up * glm::dot(normal, up);
        if (holds(way, -1)) return way;
        double most = 0;
        Vec3d best(0);
        for (int i = 0; i < count; ++i) {
            const double part = glm::dot(way, sides[i].along);
            if (std::fabs(part) <= most || !holds(sides[i].along * part, i)) continue;
            most = std::fabs(part);
            best = sides[i].along * part;
        }
        return best;
    }

private:
    double length_of_longest() const {
        const Vec3d third = corners.c - corners.b;
        const double aa = glm::dot(face.side0, face.side0), bb = glm::dot(face.side1, face.side1);
        return std::sqrt(std::max(std::max(aa, bb), glm::dot(third, third)));
    }
};

// A contact with a triangle, as a slider takes it.
class Slide {
public:
    // `tile`: relative to where the shape's centre starts. `t_max`: where the sweep ends.
    Slide(const Sweep& sweep, double t_max, const Tile& tile, const Contact& contact)
        : direction_(unit_or_zero(sweep.motion.direction)), point_(contact.point),
          normal_(contact.normal), tile_(tile),
          reach_(2 * tile.rounding + kReach * sweep.motion.radius),
          most_(most_depth(sweep.motion.radius, reach_)),
          distance_(sweep.motion.radius - contact.depth), core_(distance_ * normal_) {
        const double speed = std::sqrt(sweep.motion.dd);
        way_ = std::min(speed * t_max, speed * contact.t + tile.longest);
        const bool is_rounding = !(distance_ > 0x1p-32 * size(sweep)); // too short for a normal
        const bool is_edge = !is_own(kSame);
        if (is_edge && is_rounding && tile.face.solid) normal_ = own_normal(Vec3d(0));
        stops_ = goes_into(tile.slack());
        is_open_ = stops_ && is_edge && !is_rounding;
    }

    // Whether it matters what else touches the point: then look_at() all triangles within the reach
    // of it, in any order, and settle(), until it does not.
    bool is_open() const { return is_open_; }
    double reach() const { return reach_; }
    const Vec3d& direction() const { return direction_; }
    const Vec3d& point() const { return point_; }

    // Whether a triangle, relative to the point, can matter: most do not.
    bool may_rise(const Corners& corners) const { return height(corners) > 0; }

    // `tile`: relative to the point.
    void look_at(const Tile& tile) {
        const Nearest nearest = nearest_to_origin(tile.corners, tile.face);
        const double gap = std::sqrt(nearest.square);
        if (!(gap <= reach_) || !is_nearer(tile)
            || !(height(tile.corners) - glm::dot(nearest.at, normal_) > gap))
            return;
        const Rise rise(tile.rise(Vec3d(0), gap, normal_), tile.turn);
        if (rise.square > kSame * kSame && rise.is_steeper(steepest_)) steepest_ = rise;
    }

    void settle() {
        is_open_ = false;
        if (steepest_.square == 0) return;
        const Vec3d before = normal_;
        const double part = glm::dot(normal_, steepest_.way) / steepest_.square;
        normal_ = unit_or_zero(normal_ - part * steepest_.way);
        const double turn = tile_.turn + steepest_.turn;
        steepest_ = {};
        if (tile_.face.solid && (is_own(kAlong + turn) || rises(turn))) {
            normal_ = own_normal(before);
            stops_ = goes_into(kAlong + tile_.turn);
        } else {
            stops_ = goes_into(tile_.slack());
            is_open_ = stops_ && ++clips_ < kMostClips;
        }
    }

    bool stops() const { return stops_; }
    const Vec3d& normal() const { return normal_; }

private:
    static constexpr double kSame = 0x1p-20; // sine
    static constexpr int kMostClips = 3;

    struct Rise {
        Vec3d way{0};
        double square = 0;
        double turn = 0; // of the triangle that rises

        Rise() = default;
        Rise(const Vec3d& way_, double turn_)
            : way(way_), square(glm::dot(way, way)), turn(turn_) {}

        // Of equal ones any order will do that is one.
        bool is_steeper(const Rise& other) const {
            if (square != other.square) return square > other.square;
            for (int k = 0; k < 3; ++k)
                if (way[k] != other.way[k]) return way[k] > other.way[k];
            return turn > other.turn;
        }
    };

    // Of the corner that is furthest along the normal.
    double height(const Corners& t) const {
        return std::max(std::max(glm::dot(t.a, normal_), glm::dot(t.b, normal_)),
                        glm::dot(t.c, normal_));
    }

    // Whether it is nearer to the core than the point is, as far as rounding lets on.
    bool is_nearer(const Tile& tile) const {
        const Corners t(tile.corners.a, tile.corners.b, tile.corners.c, core_);
        return std::sqrt(nearest_to_origin(t, face_of(t)).square) < distance_ + tile_.rounding;
    }

    // Whether the triangle does, by more than what its corners and those of its neighbour may be
    // off.
    bool rises(double turn) const {
        const Vec3d way = tile_.rise(point_, 0, normal_);
        const double sine = kAlong + std::min(kMostTurn, turn) + reach_ / tile_.longest;
        return glm::dot(way, way) > sine * sine;
    }

    double size(const Sweep& sweep) const {
        const Corners& t = tile_.corners;
        return std::max(std::max(size_of(t.a), size_of(t.b)), size_of(t.c)) + size_of(sweep.axis)
               + size_of(point_);
    }

    bool goes_into(double slack) const {
        const double sine = -glm::dot(direction_, normal_);
        return sine > slack || sine * way_ > most_;
    }

    // Whether the normal is the triangle's own but for an angle.
    bool is_own(double sine) const {
        const Vec3d across = glm::cross(normal_, tile_.face.normal);
        return tile_.face.solid && glm::dot(across, across) <= sine * sine * tile_.face.nn;
    }

    // On the side of another; against the motion if that is in the triangle's plane.
    Vec3d own_normal(const Vec3d& other) const {
        const Vec3d& normal = tile_.face.normal;
        const double side = glm::dot(normal, other);
        const bool is_beside = std::fabs(side) > kSame * tile_.length;
        const bool flips = is_beside ? side < 0 : glm::dot(normal, direction_) > 0;
        return (flips ? -normal : normal) / tile_.length;
    }

    Vec3d direction_;
    Vec3d point_, normal_;
    Tile tile_;
    double reach_;
    double most_;     // depth that it may get to by going along
    double way_ = 0;  // that it has gone by the end of the triangle
    double distance_; // of the shape's core from the point
    Vec3d core_;      // relative to that
    Rise steepest_;
    int clips_ = 0;
    bool stops_, is_open_;
};

} // namespace peregrine::geometry
