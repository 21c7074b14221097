#pragma once

#include "geometry/shapes/overlap.h"
#include "geometry/shapes/slide.h"
#include "geometry/shapes/sweep.h"
#include "geometry/triangle.h"
#include "math/affine.h"
#include "trace/filter.h"
#include "trace/visitor.h"

#include <cstdint>
#include <limits>

// What shapes are asked of triangles, and what comes first among the answers.
namespace peregrine::trace {

struct Target;

// How a target's triangles stand before a shape; for those that stand where they are, the default.
struct Place {
    const math::Affine* to_world = nullptr;
    bool mirrored = false;
    uint32_t mesh = geometry::kNoTriangle; // a slot; takes the place of that in the target's infos
    math::Vec3d center{0}; // with to_world: the shape's, as seen from the target's own origin

    // Relative to its own origin, turned as in the world.
    math::Vec3d point(const math::Vec3& v) const {
        return to_world ? to_world->vector(math::Vec3d(v)) : math::Vec3d(v);
    }

    // A vertex's largest coordinate in its own space, as long as it is in the world.
    double coordinate(const math::Vec3& v) const {
        const math::Vec3d size = glm::abs(math::Vec3d(v));
        const math::Vec3d image =
            to_world
                ? (glm::abs(to_world->column[0]) * size.x + glm::abs(to_world->column[1]) * size.y)
                      + glm::abs(to_world->column[2]) * size.z
                : size;
        return std::max(std::max(image.x, image.y), image.z);
    }
};

// In a target's own space: everything that a query can touch lies, along each axis, within `extent`
// of origin + t * direction for a t that counts.
struct Volume {
    math::Vec3d origin{0};
    math::Vec3d direction{0}; // 0: at rest
    math::Vec3d extent{0};
    // And all of it is within `radius` of the segment from -axis to axis around that point.
    math::Vec3d axis{0};
    double radius = 0;
    // How much of `extent` and `radius` is there for the sake of rounding, and what the rest is to
    // the radius that was asked for, for balls.
    double slack = 0;
    double stretch = 1;
};

// Whether the triangle counts, beyond its geometry: the one place that decides it for shapes.
// `facing` is positive where its front is seen, negative at its back.
inline bool counts(const Filter& filter, const geometry::TriangleInfo& triangle, double facing) {
    if (filter.faces == Faces::front && !(facing > 0)) return false;
    if (filter.faces == Faces::back && !(facing < 0)) return false;
    return filter.sees_mesh(triangle);
}

// What few queries want besides.
struct Watch {
    // Null: all triangles count that pass the rest.
    bool (*accepts)(void* context, uint32_t mesh, uint32_t primitive) = nullptr;
    void* context = nullptr;
    Counters* counters = nullptr; // null: not counted
};

// Shows a slide all triangles at its point that the filter of the sweep sees, in all of the world.
struct Surroundings {
    void (*show)(const Surroundings& self, geometry::Slide& slide);
};

struct SweepQuery {
    geometry::Sweep sweep;
    Filter filter;
    float t_max;
    const Watch* watch = nullptr;
    const Surroundings* surroundings = nullptr; // if there: a slide, else all contacts count
};

// What touches the point of a slide.
struct SeamQuery {
    math::Vec3d center; // the slide's point is relative to it
    Filter filter;
    const Watch* watch = nullptr;
};

// The contact that comes first: initial ones before others, the deepest of them; the smallest t of
// the others. What is equal goes by the smaller triangle.
struct FirstHit {
    float t = std::numeric_limits<float>::infinity();
    float depth = 0;
    bool initial = false;
    uint32_t triangle = geometry::kNoTriangle;
    geometry::Contact contact{};

    // Contacts after this do not matter.
    float limit(float t_max) const { return t < t_max ? t : t_max; }

    int compare(const FirstHit& other) const {
        if (initial != other.initial) return initial ? -1 : 1;
        if (initial && depth != other.depth) return depth > other.depth ? -1 : 1;
        return t < other.t ? -1 : t > other.t ? 1 : 0;
    }
    bool comes_before(const FirstHit& other) const {
        const int order = compare(other);
        return order < 0 || (order == 0 && triangle < other.triangle);
    }
};

struct Shape {
    enum Kind : uint32_t { sphere = 0, capsule = 1, box = 2 };

    Kind kind = sphere;
    math::Vec3d center{0};
    math::Vec3d axis{0}; // of a capsule
    double rr = 0;       // of spheres and capsules, the radius squared
    geometry::Cuboid cuboid{};

    bool touches(const geometry::Corners& corners, const geometry::Face& face) const {
        if (kind == box) return geometry::touches(cuboid, corners);
        const geometry::Nearest nearest = kind == capsule
                                              ? geometry::nearest_to_segment(corners, face, axis)
                                              : geometry::nearest_to_origin(corners, face);
        return nearest.square <= rr;
    }
};

struct OverlapQuery {
    Shape shape;
    Filter filter;
    const Watch* watch = nullptr;
};

struct NearestQuery {
    math::Vec3d point{0};
    Filter filter;
    float radius = 0;
    const Watch* watch = nullptr;
};

struct NearestHit {
    float distance = std::numeric_limits<float>::infinity();
    uint32_t triangle = geometry::kNoTriangle;
    math::Vec3d at{0}; // relative to the point that asks
    math::Vec3d normal{0};
    float u = 0, v = 0;

    float limit(float radius) const { return distance < radius ? distance : radius; }
    bool comes_before(const NearestHit& other) const {
        return distance < other.distance
               || (distance == other.distance && triangle < other.triangle);
    }
};

// Names of triangles that a shape touches, ascending and each once: as many of the smallest from
// `first` on as there is room for.
class Touched {
public:
    static constexpr uint32_t kRoom = 1024;

    static uint64_t key_of(uint32_t mesh, uint32_t primitive) {
        return uint64_t(mesh) << 32 | primitive;
    }

    // Forgets all; keys before `first` are of no interest any more.
    void restart(uint64_t first);
    void add(uint64_t key);
    // Sorts them. Afterwards there are more only if is_full().
    void finish();

    bool wants(uint64_t key) const { return key >= first_ && key < limit_; }
    bool is_full() const { return count_ == kRoom; }
    uint32_t count() const { return count_; }
    const uint64_t* begin() const { return keys_; }
    const uint64_t* end() const { return keys_ + count_; }

private:
    void compact();

    uint64_t first_ = 0;
    uint64_t limit_ = ~uint64_t(0); // no key from here on can be among the smallest
    uint32_t count_ = 0;
    uint64_t keys_[2 * kRoom]; // the upper half is for keys that may be there already
};

// One table for each structure and instruction set; all of them give the same bits. `best` comes
// and goes: what it holds at first limits the search, but must not name a triangle.
struct ShapeKernels {
    void (*sweep)(const Target& target, const Place& place, const Volume& volume,
                  const SweepQuery& query, FirstHit& best);
    bool (*overlaps)(const Target& target, const Place& place, const Volume& volume,
                     const OverlapQuery& query);
    void (*collect)(const Target& target, const Place& place, const Volume& volume,
                    const OverlapQuery& query, Touched& touched);
    void (*nearest)(const Target& target, const Place& place, const Volume& volume,
                    const NearestQuery& query, NearestHit& best);
    void (*surround)(const Target& target, const Place& place, const Volume& volume,
                     const SeamQuery& query, geometry::Slide& slide);
};

} // namespace peregrine::trace
