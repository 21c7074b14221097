#pragma once

#include "geometry/shapes/features.h"

// THE tests of shapes at rest against a triangle: what is nearest, and whether they touch.
namespace peregrine::geometry {

// Of a triangle, relative to a shape's centre.
struct Corners {
    Vec3d a, b, c;

    Corners(const Vec3d& v0, const Vec3d& v1, const Vec3d& v2, const Vec3d& center)
        : a(v0 - center), b(v1 - center), c(v2 - center) {}
};

inline Face face_of(const Corners& corners) {
    return {corners.a, corners.b - corners.a, corners.c - corners.a};
}

inline Nearest nearest_to_origin(const Corners& corners, const Face& face) {
    Nearest nearest;
    nearest.look_at(face);
    nearest.look_at(Edge(corners.a, face.side0));
    nearest.look_at(Edge(corners.b, corners.c - corners.b));
    nearest.look_at(Edge(corners.a, face.side1));
    return nearest;
}

// With the barycentrics of b and c.
struct NearestOnTriangle : Nearest {
    double u = 0, v = 0;

    NearestOnTriangle(const Corners& corners, const Face& face) {
        look_at(face);
        if (square < std::numeric_limits<double>::infinity()) {
            const Face::Place place = face.place(Vec3d(0));
            u = place.x / face.nn;
            v = place.y / face.nn;
        }
        const auto look = [&](const Edge& edge, const auto& remember) {
            const double before = square;
            const double s = look_at(edge);
            if (square < before) remember(s);
        };
        look(Edge(corners.a, face.side0), [&](double s) { u = s, v = 0; });
        look(Edge(corners.b, corners.c - corners.b), [&](double s) { u = 1 - s, v = s; });
        look(Edge(corners.a, face.side1), [&](double s) { u = 0, v = s; });
    }

private:
    using Nearest::look_at;
};

// The prism that the triangle makes when it is moved from -axis to axis.
// Its faces are the triangle moved by -axis and by axis, and these:
template <class Visit>
void for_each_side(const Corners& t, const Vec3d& axis, Visit&& visit) {
    const Vec3d along = 2.0 * axis;
    visit(Face(t.a - axis, t.b - t.a, along, true, -1, 2));
    visit(Face(t.b - axis, t.c - t.b, along, true, -1, 2));
    visit(Face(t.a - axis, t.c - t.a, along, true, -1, 2));
}

template <class Visit>
void for_each_edge(const Corners& t, const Vec3d& axis, Visit&& visit) {
    for (const double core : {-1.0, 1.0}) {
        visit(Edge(t.a + core * axis, t.b - t.a, core));
        visit(Edge(t.b + core * axis, t.c - t.b, core));
        visit(Edge(t.a + core * axis, t.c - t.a, core));
    }
    const Vec3d along = 2.0 * axis;
    for (const Vec3d& corner : {t.a, t.b, t.c}) visit(Edge(corner - axis, along, -1, 2));
}

// Whether the segment from -axis to axis goes through the triangle, and at which of its points.
inline bool crosses(const Face& face, const Vec3d& axis, double& part) {
    const double height = glm::dot(face.normal, face.corner);
    const double rise = glm::dot(face.normal, axis);
    if (!face.solid || rise == 0 || std::fabs(height) > std::fabs(rise)) return false;
    part = height / rise;
    return face.holds(part * axis);
}

// `at` is the nearest point of the prism, `core` says which of the segment's: -core * axis.
inline Nearest nearest_to_segment(const Corners& corners, const Face& face, const Vec3d& axis) {
    Nearest nearest;
    double part;
    if (crosses(face, axis, part)) return {0, Vec3d(0), -part};
    for (const double core : {-1.0, 1.0}) nearest.look_at(face.moved(core * axis, core));
    for_each_side(corners, axis, [&](const Face& side) { nearest.look_at(side); });
    for_each_edge(corners, axis, [&](const Edge& edge) { nearest.look_at(edge); });
    return nearest;
}

// A box around the origin: three axes of unit length, and half its size along each.
struct Cuboid {
    Vec3d axis[3];
    Vec3d half;
};

// By separating axes (Gottschalk, Lin, Manocha, "OBBTree", SIGGRAPH 1996). An axis of any length
// will do, so that no pair of parallel edges needs special care.
inline bool touches(const Cuboid& box, const Corners& corners) {
    Vec3d v[3];
    const Vec3d world[3] = {corners.a, corners.b, corners.c};
    for (int i = 0; i < 3; ++i)
        v[i] = {glm::dot(box.axis[0], world[i]), glm::dot(box.axis[1], world[i]),
                glm::dot(box.axis[2], world[i])};
    const double size = std::max(std::max(size_of(v[0]), size_of(v[1])), size_of(v[2]));
    const auto is_between = [&](const Vec3d& along) {
        const double p0 = glm::dot(along, v[0]), p1 = glm::dot(along, v[1]),
                     p2 = glm::dot(along, v[2]);
        // What rounding may part, touches.
        const double reach = glm::dot(glm::abs(along), box.half) + 0x1p-50 * size * size_of(along);
        return std::min(std::min(p0, p1), p2) > reach || std::max(std::max(p0, p1), p2) < -reach;
    };
    for (const Vec3d& along : {Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)})
        if (is_between(along)) return false;
    const Vec3d edges[3] = {v[1] - v[0], v[2] - v[1], v[0] - v[2]};
    if (is_between(glm::cross(edges[0], edges[1]))) return false;
    for (const Vec3d& e : edges)
        if (is_between({0, -e.z, e.y}) || is_between({e.z, 0, -e.x}) || is_between({-e.y, e.x, 0}))
            return false;
    return true;
}

} // namespace peregrine::geometry
