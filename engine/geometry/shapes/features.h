#pragma once

#include "math/vec.h"

#include <algorithm>
#include <cmath>
#include <limits>

// A ball against the faces, edges and vertices of a convex set: where it is nearest, and when it
// gets there. The ball's centre starts at the origin. All in double and in this order of
// operations, so the same bits everywhere; only + - * / sqrt and comparisons.
//
// The set is a triangle, or a triangle swept along a segment, from -axis to axis: a capsule that
// comes near the triangle is a ball that comes near that prism. A point of the prism is p + core *
// axis, p on the triangle; features carry `core` so that p can be had back.
//
// Errors, e = 2^-53, M the largest 1-norm of a corner or of the path up to the contact:
//   a face thinner than 2^-26 of its length is left out: its edges are within 2^-27 of the length
//   of all of it. A thicker one's normal is off by 2^26 e or less, its plane by 2^-26 M.
//   A face met at an angle below 2^-26, and an edge moved along at such an angle, are left out: the
//   ball gets deeper by 2^-26 M at most before it leaves them or meets the next feature.
//   At larger angles the path's distance from an edge is off by 8 e M 2^26, and the slack of a face
//   is at most 3 M * 3 * 2^-50 * 2^26.
// So a contact is real, and none is missed, but for 2^-20 M in the distance in the worst of cases,
// and some e M in the usual ones. That is what traversal allows for (trace/shapes/volume.h).
namespace peregrine::geometry {

using math::Vec3d;

inline constexpr double kSine = 0x1p-26; // the least sine of an angle that is told from 0

inline double size_of(const Vec3d& v) {
    return (std::fabs(v.x) + std::fabs(v.y)) + std::fabs(v.z);
}

inline Vec3d unit_or_zero(const Vec3d& v) {
    const double square = glm::dot(v, v);
    return square > 0 ? v / std::sqrt(square) : Vec3d(0);
}

// A triangle, or with `quad` a parallelogram, from its corner along two sides.
struct Face {
    Vec3d corner, side0, side1;
    Vec3d normal; // side0 x side1
    double nn;    // its square
    bool quad;
    bool solid;        // its normal is one
    double core, step; // at the corner, and the change along side1

    Face(const Vec3d& corner_, const Vec3d& side0_, const Vec3d& side1_, bool quad_ = false,
         double core_ = 0, double step_ = 0)
        : corner(corner_), side0(side0_), side1(side1_), normal(glm::cross(side0_, side1_)),
          nn(glm::dot(normal, normal)), quad(quad_), core(core_), step(step_) {
        const double aa = glm::dot(side0, side0), bb = glm::dot(side1, side1);
        const double longest = std::max(aa, bb);
        solid = nn > kSine * kSine * (quad ? aa * bb : longest * longest);
    }

    // The same one elsewhere.
    Face moved(const Vec3d& by, double core_) const {
        Face face = *this;
        face.corner += by;
        face.core = core_;
        return face;
    }

    // The part of each side, times nn, that leads to the foot of p.
    struct Place {
        double x, y;
    };
    Place place(const Vec3d& p) const {
        const Vec3d w = p - corner;
        return {along0(w), along1(w)};
    }

    // Whether the foot of p is on the face or, within its plane, `slack` outside of all edges. Each
    // edge is asked with the error of its own length; where two meet at a sharp angle the slack
    // would be long, so the extent along the longer side limits it.
    // Inlined by order: as a call it costs nearest points a fiftieth of their instructions.
    [[gnu::always_inline]] bool holds(const Vec3d& p, double slack = 0) const {
        const Vec3d w = p - corner;
        const double scale = slack * std::sqrt(nn);
        const double slack0 = scale * size_of(side0), slack1 = scale * size_of(side1);
        if (!(along0(w) >= -slack1 && along1(w) >= -slack0)) return false;
        if (quad) {
            if (!(along0(w - side0) <= slack1 && along1(w - side1) <= slack0)) return false;
        } else {
            const Vec3d third = side1 - side0;
            const double inside = glm::dot(glm::cross(third, w - side0), normal);
            if (!(inside >= -scale * size_of(third))) return false;
        }
        if (slack == 0) return true;
        const Vec3d& longer = size_of(side0) >= size_of(side1) ? side0 : side1;
        const double a = glm::dot(longer, side0), b = glm::dot(longer, side1);
        const double ab = quad ? a + b : 0;
        const double first = std::min(std::min(a, b), std::min(ab, 0.0));
        const double last = std::max(std::max(a, b), std::max(ab, 0.0));
        const double at = glm::dot(longer, w - foot(w)), more = slack * size_of(longer);
        return at >= first - more && at <= last + more;
    }

    // The core at a point that the face holds. Where the sides of a parallelogram are almost
    // parallel, rounding puts a point far beyond one and as far before the other: then it gets a
    // place on both that is as near.
    double core_at(const Vec3d& p) const {
        if (step == 0) return core;
        const auto [x, y] = place(p);
        if (x >= 0 && x <= nn && y >= 0 && y <= nn) return core + step * (y / nn);
        const Vec3d w = p - corner;
        const auto part = [](const Vec3d& v, const Vec3d& side) {
            return std::clamp(glm::dot(v, side) / glm::dot(side, side), 0.0, 1.0);
        };
        const double first = part(w - std::clamp(y / nn, 0.0, 1.0) * side1, side0);
        return core + step * part(w - first * side0, side1);
    }

    // What leads from the plane to corner + w.
    Vec3d foot(const Vec3d& w) const { return normal * (glm::dot(normal, w) / nn); }

private:
    double along0(const Vec3d& w) const { return glm::dot(glm::cross(w, side1), normal); }
    double along1(const Vec3d& w) const { return glm::dot(glm::cross(side0, w), normal); }
};

struct Edge {
    Vec3d start, along;
    double ee;         // the square of its length
    double core, step; // at the start, and the change along it

    Edge(const Vec3d& start_, const Vec3d& along_, double core_ = 0, double step_ = 0)
        : start(start_), along(along_), ee(glm::dot(along_, along_)), core(core_), step(step_) {}

    // A parallel one.
    Edge moved(const Vec3d& by, double core_) const {
        Edge edge = *this;
        edge.start += by;
        edge.core = core_;
        return edge;
    }
};

// The nearest point to the origin so far.
struct Nearest {
    double square = std::numeric_limits<double>::infinity(); // of the distance
    Vec3d at{0};
    double core = 0;

    void look_at(const Face& face) {
        if (!face.solid) return;
        if (!face.holds(Vec3d(0))) return;
        const double depth = glm::dot(face.normal, face.corner);
        const double d = depth * depth / face.nn;
        if (d < square) {
            *this = {d, face.normal * (depth / face.nn), face.core_at(Vec3d(0))};
        }
    }

    // Returns how far along the edge, 0 to 1.
    double look_at(const Edge& edge) {
        const double part = -glm::dot(edge.start, edge.along) / edge.ee;
        const double s = part > 0 ? std::min(part, 1.0) : 0.0;
        const Vec3d p = edge.start + s * edge.along;
        const double d = glm::dot(p, p);
        if (d < square) *this = {d, p, edge.core + edge.step * s};
        return s;
    }
};

// A ball whose centre is at t * direction.
struct Motion {
    Vec3d direction;
    double dd;
    double radius, rr;

    Motion(const Vec3d& direction_, double radius_)
        : direction(direction_), dd(glm::dot(direction_, direction_)), radius(radius_),
          rr(radius_ * radius_) {}
};

// The motion seen along an edge; the same for all parallel ones of a length.
struct Across {
    Vec3d across;
    double cc;

    Across(const Motion& motion, const Vec3d& along)
        : across(glm::cross(motion.direction, along)), cc(glm::dot(across, across)) {}
};

// The first contact so far.
struct FirstContact {
    double t = std::numeric_limits<double>::infinity();
    Vec3d at{0};     // on the set
    Vec3d normal{0}; // towards the centre, of any length; 0: the centre is on the set
    double core = 0;
    bool is_one = false;

    FirstContact() = default;
    FirstContact(double t_, const Vec3d& at_, const Vec3d& normal_, double core_)
        : t(t_), at(at_), normal(normal_), core(core_), is_one(true) {}

    // From now on, what comes later does not count.
    void limit_to(double limit) {
        if (t < limit) return;
        t = limit;
        is_one = false;
    }

    void meet(const Motion& motion, const Face& face) {
        if (!face.solid) return;
        const double rate = -glm::dot(face.normal, motion.direction);
        if (!(rate * rate > kSine * kSine * (face.nn * motion.dd))) return;
        const Vec3d outward = rate > 0 ? face.normal : -face.normal;
        const double height = -glm::dot(outward, face.corner);
        if (height < 0) return;
        const double length = std::sqrt(face.nn), speed = std::fabs(rate);
        const double when = std::max(0.0, (height - motion.radius * length) / speed);
        if (!(when < t)) return;
        // What the foot is off by because `when` is, so that a point finds no way between two
        // faces.
        const Vec3d p = when * motion.direction;
        const double longest = std::max(size_of(face.side0), size_of(face.side1));
        const double slack =
            0x1p-50 * (size_of(p) + longest) * (length * (size_of(motion.direction) / speed));
        if (!face.holds(p, slack)) return;
        *this = {when, p - face.foot(p - face.corner), outward, face.core_at(p)};
    }

    // With the vertices at its ends: a cylinder that is entered beyond them is none.
    void meet(const Motion& motion, const Edge& edge) {
        const Across seen(motion, edge.along);
        meet(motion, edge, seen, glm::dot(edge.start, seen.across));
    }
    // `apart`: the distance of the two lines, times the length of `across`.
    void meet(const Motion& motion, const Edge& edge, const Across& seen, double apart) {
        const auto& [across, cc] = seen;
        if (!(cc > kSine * kSine * (motion.dd * edge.ee))) {
            meet(motion, edge.start, edge.core);
            meet(motion, edge.start + edge.along, edge.core + edge.step);
            return;
        }
        if (apart * apart > motion.rr * cc) return;
        const double closest = glm::dot(glm::cross(edge.start, edge.along), across) / cc;
        const double room = std::max(0.0, motion.rr - apart * apart / cc);
        const double inside = std::sqrt(room * (edge.ee / cc));
        if (closest + inside < 0) return;
        const double when = std::max(0.0, closest - inside);
        if (!(when < t)) return;
        const Vec3d p = when * motion.direction;
        const double s = glm::dot(p - edge.start, edge.along) / edge.ee;
        if (s < 0) {
            meet(motion, edge.start, edge.core);
        } else if (s > 1) {
            meet(motion, edge.start + edge.along, edge.core + edge.step);
        } else if (closest > 0) {
            const Vec3d q = edge.start + s * edge.along;
            *this = {when, q, p - q, edge.core + edge.step * s};
        }
    }

    void meet(const Motion& motion, const Vec3d& vertex, double vertex_core) {
        const double along = glm::dot(vertex, motion.direction);
        if (!(along > 0)) return;
        const Vec3d across = glm::cross(vertex, motion.direction);
        const double room = motion.rr * motion.dd - glm::dot(across, across);
        if (room < 0) return;
        const double when = std::max(0.0, (along - std::sqrt(room)) / motion.dd);
        if (!(when < t)) return;
        *this = {when, vertex, when * motion.direction - vertex, vertex_core};
    }
};

} // namespace peregrine::geometry
