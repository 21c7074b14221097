#pragma once

#include "peregrine/rt.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <span>

// What the rules of a game ask the world, in doubles, through the door of the engine alone.
namespace peregrine::gameplay {

using Vec3 = glm::dvec3; // metres

// The points within `radius` of the segment from centre - axis to centre + axis; axis 0: a sphere.
struct Capsule {
    Vec3 center{0};
    double radius = 0;
    Vec3 axis{0};
};

struct Box {
    Vec3 center{0};
    Vec3 half_size{0};
    double rotation[4]{0, 0, 0, 1}; // a quaternion x, y, z, w
};

// Which meshes count.
struct Mask {
    uint32_t layers = ~0u;
    std::span<const rt_mesh> ignored; // borrowed for the call
};

struct Contact {
    double t;    // in lengths of the motion
    Vec3 point;  // on the surface
    Vec3 normal; // unit, from the surface to the shape
    double depth;
    bool initial; // it touched where it started; then t is 0 and depth how deep it was
    rt_mesh mesh;
    uint32_t triangle;
};

struct RayHit {
    double t; // in lengths of the direction
    Vec3 point;
    Vec3 normal; // of the face, towards where the ray came from
    rt_mesh mesh;
    uint32_t triangle;
};

struct Nearest {
    double distance;
    Vec3 point;
    Vec3 normal; // unit, from the surface to the point
    rt_mesh mesh;
    uint32_t triangle;
};

// Only a defect of the caller (a motion that is not finite, a scene without a commit) makes a query
// fail; it then throws std::runtime_error with the engine's sentence.
class World {
public:
    World(const rt_api& api, rt_scene scene) : api_(&api), scene_(scene) {}

    // What the shape meets first on its way along `motion`. With `leaving`, what it touches at the
    // start does not stop a motion that goes no deeper. A motion of 0 meets nothing.
    std::optional<Contact> sweep(const Capsule& shape, const Vec3& motion, const Mask& mask = {},
                                 bool leaving = true) const;
    std::optional<RayHit> closest(const Vec3& from, const Vec3& motion,
                                  const Mask& mask = {}) const;
    bool is_free(const Vec3& from, const Vec3& to, const Mask& mask = {}) const;
    bool overlaps(const Capsule& shape, const Mask& mask = {}) const;
    bool overlaps(const Box& shape, const Mask& mask = {}) const;
    std::optional<Nearest> nearest(const Vec3& point, double radius, const Mask& mask = {}) const;

    // Many lines of sight at once: clear[i] is 1 if nothing lies between from[i] and to[i]. Points
    // are taken relative to `origin`, so that they keep their precision near it.
    void lines_of_sight(const Vec3& origin, std::span<const Vec3> from, std::span<const Vec3> to,
                        const Mask& mask, std::span<uint8_t> clear) const;

private:
    bool overlaps(const Vec3& origin, const rt_shape& shape, const Mask& mask) const;

    // occluded[i]: whether anything lies on ray i, which is relative to `origin`.
    void any(const Vec3& origin, std::span<const rt_ray> rays, const Mask& mask,
             std::span<uint8_t> occluded) const;

    const rt_api* api_;
    rt_scene scene_;
};

} // namespace peregrine::gameplay
