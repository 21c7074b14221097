// The canonical tests of moving and resting shapes against one triangle, compared with distances
// found by search in long double.
//
//     PEREGRINE_RAYS=100000 build/release/bin/shape_geometry_test    # cases of each kind
#include "geometry/area.h"
#include "geometry/shapes/overlap.h"
#include "geometry/shapes/sweep.h"
#include "support/distance_reference.h"
#include "support/world.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace peregrine::test {
namespace {

using math::Vec3;
using math::Vec3d;

struct Case {
    Vec3 v[3];
    Vec3 center, axis, direction;
    float radius;
};

ReferenceTriangle triangle_of(const Case& c) {
    return {Point3(c.v[0]), Point3(c.v[1]), Point3(c.v[2])};
}

geometry::Corners corners_of(const Case& c) {
    return {Vec3d(c.v[0]), Vec3d(c.v[1]), Vec3d(c.v[2]), Vec3d(c.center)};
}

// The largest of all lengths that matter, in the 1-norm.
Real size_of(const Case& c) {
    const auto size = [](const Point3& v) {
        return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z);
    };
    Real largest = 0;
    for (const Vec3& v : c.v) largest = std::max(largest, size(Point3(v) - Point3(c.center)));
    return largest + Real(c.radius) + size(Point3(c.axis));
}

class Cases {
public:
    explicit Cases(uint32_t seed) : random_(seed) {}

    float unit() { return std::uniform_real_distribution<float>(-1, 1)(random_); }
    uint32_t pick(uint32_t count) { return uint32_t(random_() % count); }
    Vec3 point() { return {unit(), unit(), unit()}; }
    float tiny() { return std::exp2(-40 * std::fabs(unit())); }

    // In a unit cube or thereabouts, times `scale`.
    Case make(float scale, bool capsule) {
        Case c;
        do make_triangle(c);
        while (!geometry::has_area(c.v[0], c.v[1], c.v[2]));
        c.center = pick(8) == 0 ? on_triangle(c) + tiny() * point() : 2.0f * point();
        c.axis = Vec3(0);
        if (capsule) c.axis = make_direction(c) * (pick(4) == 0 ? tiny() : std::fabs(unit()));
        c.direction = make_direction(c) * (pick(4) == 0 ? 1e3f * tiny() : 1.0f);
        if (c.direction == Vec3(0)) c.direction = {0, 0, 1};
        make_radius(c);
        for (Vec3* p : {&c.v[0], &c.v[1], &c.v[2], &c.center, &c.axis}) *p *= scale;
        c.radius *= scale;
        return geometry::has_area(c.v[0], c.v[1], c.v[2]) ? c : make(scale, capsule);
    }

private:
    Vec3 on_triangle(const Case& c) {
        const float u = std::fabs(unit()), v = (1 - u) * std::fabs(unit());
        return c.v[0] + u * (c.v[1] - c.v[0]) + v * (c.v[2] - c.v[0]);
    }

    void make_triangle(Case& c) {
        for (Vec3& v : c.v) v = point();
        switch (pick(6)) {
        case 0: // a needle
            c.v[2] = c.v[pick(2)] + tiny() * point();
            break;
        case 1: // a sliver
            c.v[2] = 0.5f * (c.v[0] + c.v[1]) + tiny() * point();
            break;
        case 2: // in a plane of two axes
            for (Vec3& v : c.v) v.y = 0.25f;
            break;
        case 3: // tiny
            c.v[1] = c.v[0] + tiny() * point();
            c.v[2] = c.v[0] + tiny() * point();
            break;
        default:
            break;
        }
    }

    // Along an edge, in the plane, at a vertex, at an edge, at the face, nearly so, or anywhere.
    Vec3 make_direction(const Case& c) {
        Vec3 d = point();
        const uint32_t kind = pick(7), i = pick(3);
        if (kind == 0) d = c.v[(i + 1) % 3] - c.v[i];
        if (kind == 1) d = c.v[i] + 2.0f * point().x * (c.v[1] - c.v[0]) - c.v[2];
        if (kind == 2) d = c.v[i] - c.center;
        if (kind == 3) d = c.v[i] + std::fabs(unit()) * (c.v[(i + 1) % 3] - c.v[i]) - c.center;
        if (kind == 4) d = on_triangle(c) - c.center;
        if (kind == 5) d = {0, -1, 0};
        if (pick(3) == 0) d += tiny() * point();
        return pick(2) ? d : -d;
    }

    // Often one that just grazes, or just touches at the start.
    void make_radius(Case& c) {
        c.radius = std::fabs(unit());
        const uint32_t kind = pick(6);
        if (kind == 0) c.radius = 0;
        if (kind == 1) c.radius *= tiny();
        if (kind > 3) return;
        const ReferenceTriangle triangle = triangle_of(c);
        if (kind == 2) c.radius = float(distance(Point3(c.center), Point3(c.axis), triangle));
        if (kind == 3)
            c.radius = float(find_minimum(0, 10, [&](Real t) {
                                 return distance(Point3(c.center) + t * Point3(c.direction),
                                                 Point3(0), triangle);
                             }).value);
    }

    std::mt19937 random_;
};

class Judge {
public:
    Judge(const Case& c, Real tolerance)
        : case_(c), triangle_(triangle_of(c)), tolerance_(tolerance * size_of(c)) {}

    // Empty: all is well.
    std::string check() const {
        const geometry::Sweep sweep(case_.center, case_.axis, case_.direction, case_.radius);
        geometry::Contact contact;
        const bool hit = geometry::sweep_triangle(sweep, corners_of(case_), contact);
        const Real radius = Real(case_.radius);
        const auto at = [&](Real t) { return distance_at(t); };
        if (!hit || !contact.initial) {
            if (at(0) < radius - tolerance_) return "an initial contact missed";
        }
        if (!hit) {
            const Minimum minimum = find_minimum(0, longest(), at);
            return minimum.value < radius - tolerance_ ? "a contact missed" : "";
        }
        if (contact.initial != (contact.initial && contact.t == 0)) return "t of initial contact";
        if (std::fabs(at(contact.t) - radius) > tolerance_ && !contact.initial)
            return "no contact at t";
        if (contact.initial && at(0) > radius + tolerance_) return "no initial contact";
        if (contact.initial && std::fabs(Real(contact.depth) - (radius - at(0))) > tolerance_)
            return "depth";
        if (!contact.initial && find_minimum(0, contact.t, at).value < radius - tolerance_)
            return "late";
        return check_place(contact);
    }

private:
    Real distance_at(Real t) const {
        return distance(Point3(case_.center) + t * Point3(case_.direction), Point3(case_.axis),
                        triangle_);
    }
    Real longest() const { return 8 * size_of(case_) / glm::length(Point3(case_.direction)); }

    std::string check_place(const geometry::Contact& contact) const {
        const Point3 point = Point3(case_.center) + Point3(contact.point);
        if (distance(point, triangle_) > tolerance_) return "the point is not on the triangle";
        const Point3 center = Point3(case_.center) + Real(contact.t) * Point3(case_.direction);
        Point3 nearest = center;
        const Point3 axis(case_.axis);
        if (const Real aa = glm::dot(axis, axis); aa > 0)
            nearest += axis * std::clamp(glm::dot(point - center, axis) / aa, Real(-1), Real(1));
        const Real gap = glm::length(point - nearest);
        const Real expected = contact.initial ? distance_at(0) : Real(case_.radius);
        if (std::fabs(gap - expected) > 2 * tolerance_) return "the point is not the contact's";
        if (std::fabs(glm::length(Point3(contact.normal)) - 1) > 1e-12L)
            return "the normal's length";
        if (gap > 1000 * tolerance_
            && glm::dot(Point3(contact.normal), nearest - point) < gap * 0.999L)
            return "the normal's direction";
        return "";
    }

    const Case& case_;
    ReferenceTriangle triangle_;
    Real tolerance_;
};

std::string words_of(const Case& c) {
    std::ostringstream out;
    out << std::hexfloat;
    const auto put = [&](const char* name, const Vec3& v) {
        out << "\n  " << name << " {" << v.x << "f, " << v.y << "f, " << v.z << "f}";
    };
    for (const Vec3& v : c.v) put("vertex", v);
    put("center", c.center);
    put("axis", c.axis);
    put("direction", c.direction);
    out << "\n  radius " << c.radius;
    return out.str();
}

// the bound of features.h.
constexpr Real kTolerance = 0x1p-20L;

void sweep_cases(float scale, bool capsule, size_t count, uint32_t seed) {
    Cases cases(seed);
    size_t wrong = 0;
    for (size_t i = 0; i < count; ++i) {
        const Case c = cases.make(scale, capsule);
        const std::string what = Judge(c, kTolerance).check();
        if (!what.empty() && ++wrong == 1) ADD_FAILURE() << what << ", case " << i << words_of(c);
    }
    EXPECT_EQ(wrong, 0u) << "of " << count << ", scale " << scale;
}

TEST(SweepGeometry, SpheresOfAllScales) {
    for (const float scale : {1.0f, 1e-4f, 1e6f, 1e-15f, 1e20f})
        sweep_cases(scale, false, rays_per_set(1000), uint32_t(scale * 7));
}

TEST(SweepGeometry, CapsulesOfAllScales) {
    for (const float scale : {1.0f, 1e-4f, 1e6f})
        sweep_cases(scale, true, rays_per_set(1000) / 2, uint32_t(scale * 5));
}

// Sides of prisms that are so thin that rounding used to put the contact beyond the triangle.
TEST(SweepGeometry, ContactsOfCapsulesAlongEdges) {
    const Case along_a_needle{{{-0x1.48fb88p-2f, 0x1.00b5dp-1f, 0x1.efe888p-1f},
                               {0x1.c318e8p-2f, -0x1.52a94cp-1f, -0x1.8f81c4p-2f},
                               {0x1.e8757cp-5f, -0x1.47cdeep-4f, 0x1.2827a6p-2f}},
                              {0x1.1c753cp-3f, -0x1.9bb568p-3f, 0x1.2ec2a2p-3f},
                              {0x1.8f353cp-4f, -0x1.30aedp-3f, -0x1.6401b6p-3f},
                              {-0x1.6d2314p-24f, 0x1.16ade8p-23f, 0x1.459f74p-23f},
                              0};
    const Case in_its_plane{{{-0x1.df90aap-15f, -0x1.16fb8cp-16f, -0x1.bbc77p-15f},
                             {0x1.048a0cp-14f, 0x1.07706ep-14f, -0x1.b4b892p-15f},
                             {0x1.4c1b46p-19f, 0x1.836314p-16f, -0x1.b84p-15f}},
                            {0x1.66cb94p-16f, 0x1.2b56ccp-15f, -0x1.b7218cp-15f},
                            {-0x1.ef3d56p-14f, -0x1.49cce6p-14f, -0x1.bf2072p-21f},
                            {-0x1.ac57e6p-3f, -0x1.1d405cp-3f, -0x1.82b8p-10f},
                            0x1.a0a108p-41f};
    EXPECT_EQ(Judge(along_a_needle, kTolerance).check(), "");
    EXPECT_EQ(Judge(in_its_plane, kTolerance).check(), "");
}

// A limit takes contacts away, and changes none.
TEST(SweepGeometry, LimitsChangeNoContact) {
    Cases cases(6);
    const auto words = [](const geometry::Contact& contact) {
        return std::array{contact.t,        contact.point.x,  contact.point.y, contact.point.z,
                          contact.normal.x, contact.normal.y, contact.normal.z};
    };
    size_t contacts = 0;
    for (size_t i = 0; i < rays_per_set(1000); ++i) {
        const Case c = cases.make(1, i % 2 == 0);
        const geometry::Sweep sweep(c.center, c.axis, c.direction, c.radius);
        geometry::Contact free{}, limited{};
        const bool hit = geometry::sweep_triangle(sweep, corners_of(c), free);
        contacts += hit;
        const double at = hit ? free.t : 1;
        for (const double limit : {at * 0.5, at, std::nextafter(at, 1e300), at * 1.5, 1e300}) {
            const bool found = geometry::sweep_triangle(sweep, corners_of(c), limited, limit);
            if (hit && free.t < limit) {
                ASSERT_TRUE(found) << limit << words_of(c);
                ASSERT_EQ(words(free), words(limited)) << limit << words_of(c);
            } else if (found) {
                ASSERT_TRUE(hit && limited.t == free.t) << limit << words_of(c);
            }
        }
    }
    EXPECT_GT(contacts, 0u);
}

TEST(OverlapGeometry, NearestPoints) {
    Cases cases(3);
    for (size_t i = 0; i < rays_per_set(1000); ++i) {
        const Case c = cases.make(1, i % 16 == 0);
        const geometry::Corners corners = corners_of(c);
        const geometry::Face face = geometry::face_of(corners);
        const Real expected = distance(Point3(c.center), Point3(c.axis), triangle_of(c));
        const geometry::Nearest nearest =
            c.axis == Vec3(0) ? geometry::nearest_to_origin(corners, face)
                              : geometry::nearest_to_segment(corners, face, Vec3d(c.axis));
        ASSERT_NEAR(double(expected), std::sqrt(nearest.square), 1e-7 * double(size_of(c)))
            << words_of(c);
    }
}

// A way that no single triangle leads: rays, as spheres without a radius, at seams of closed fans.
//
//     a sphere of radius 0 falls on the common edges and vertex of a fan
//          \ | /
//         -- * --
//          / | \'
TEST(SweepGeometry, NothingFallsThroughSeams) {
    Cases cases(4);
    for (size_t i = 0; i < rays_per_set(1000); ++i) {
        const float scale = std::exp2(10 * cases.unit());
        Vec3 rim[6];
        for (int k = 0; k < 6; ++k) {
            const float angle = float(k) * 1.0471976f;
            rim[k] = scale * (Vec3(std::cos(angle), 0, std::sin(angle)) + 0.3f * cases.point());
        }
        const Vec3 middle = 0.1f * scale * cases.point();
        const Vec3 target = middle + (rim[0] - middle) * std::max(0.0f, 0.9f * cases.unit());
        const Vec3 start = target + scale * (Vec3(0, 3, 0) + 2.0f * cases.point());
        const geometry::Sweep sweep(start, Vec3(0), target - start, 0);
        bool hit = false;
        for (int k = 0; k < 6; ++k) {
            geometry::Contact contact;
            hit |= geometry::sweep_triangle(
                sweep, {Vec3d(middle), Vec3d(rim[k]), Vec3d(rim[(k + 1) % 6]), Vec3d(start)},
                contact);
        }
        ASSERT_TRUE(hit) << i;
    }
}

// What separates a box from a triangle leaves no common point; what does not has one. Common
// points are searched by alternating projections, which converge for convex sets.
TEST(OverlapGeometry, Boxes) {
    Cases cases(5);
    size_t touching = 0, apart = 0;
    for (size_t i = 0; i < rays_per_set(1000); ++i) {
        const Case c = cases.make(1, false);
        geometry::Cuboid box{};
        Vec3d x = glm::normalize(Vec3d(cases.point())), y(cases.point());
        y = glm::normalize(y - x * glm::dot(x, y));
        box.axis[0] = x, box.axis[1] = y, box.axis[2] = glm::cross(x, y);
        box.half = glm::abs(Vec3d(cases.point())) * (i % 5 == 0 ? 0.0 : 1.0);
        const geometry::Corners corners = corners_of(c);
        Point3 p(0), q(0);
        for (int step = 0; step < 20000; ++step) {
            const Vec3d here(p);
            const geometry::Corners moved(corners.a, corners.b, corners.c, here);
            q = p + Point3(geometry::nearest_to_origin(moved, geometry::face_of(moved)).at);
            Point3 clamped(0);
            for (int k = 0; k < 3; ++k)
                clamped += Point3(box.axis[k])
                           * std::clamp(glm::dot(Point3(box.axis[k]), q), -Real(box.half[k]),
                                        Real(box.half[k]));
            if (glm::length(clamped - p) < 1e-9L) break;
            p = clamped;
        }
        const Real gap = glm::length(p - q);
        if (gap < 1e-7L) ++touching;
        if (gap > 1e-3L) ++apart;
        if (geometry::touches(box, corners))
            ASSERT_LT(gap, 1e-3L) << words_of(c);
        else
            ASSERT_GT(gap, 1e-12L) << words_of(c);
    }
    EXPECT_GT(touching, 0u);
    EXPECT_GT(apart, 0u);
}

} // namespace
} // namespace peregrine::test
