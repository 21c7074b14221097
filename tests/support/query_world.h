#pragma once

#include "geometry/triangle.h"
#include "math/affine.h"
#include "query/query.h"
#include "scene/scene.h"
#include "support/closed_meshes.h"

#include <functional>
#include <memory>
#include <random>
#include <vector>

namespace peregrine::test {

// A scene behind the door, with the oracle for its queries beside it: every triangle of every mesh,
// rigid ones in their own space.
class QueryWorld {
public:
    struct Part {
        base::Handle mesh;
        std::vector<geometry::Triangle> triangles; // in its own space
        scene::MeshKind kind;
        uint32_t layer_mask;
        math::Affine to_world, to_local;
    };

    // Which hits the oracle takes; a hit's place in the order is none of its business.
    using Takes = std::function<bool(const query::Hit& hit)>;

    explicit QueryWorld(base::Isa isa = base::Isa::best, uint32_t threads = 1)
        : scene(scene::SceneOptions{{}, {}, threads, isa}) {}

    // Returns the number of the part. With texture coordinates and normals, to resolve.
    size_t add(const std::vector<geometry::Triangle>& triangles, scene::MeshKind kind,
               uint32_t layer_mask = ~0u, base::Handle material = {});
    size_t add(const ClosedMesh& mesh, scene::MeshKind kind, const math::Vec3& offset = {},
               float scale = 1);
    size_t add_instance(size_t of);
    void place(size_t part, const math::Affine& to_world);
    void commit(trace::Structure structure = trace::Structure::bvh,
                accel::bvh::Quality quality = accel::bvh::Quality::balanced, bool compact = false);

    // The triangles as they stand in the world, for rays to aim at.
    std::vector<geometry::Triangle> triangles() const;

    // What the ray crosses, or hits, in the order of answers; its origin is relative to `base`.
    std::vector<query::Hit> crossings(const math::Ray& ray, const Takes& takes,
                                      const math::Vec3d& base = math::Vec3d(0)) const;
    std::vector<query::Hit> hits(const math::Ray& ray, const Takes& takes,
                                 const math::Vec3d& base = math::Vec3d(0)) const;

    scene::Scene scene;
    std::vector<Part> parts;

private:
    std::vector<query::Hit> collect(const math::Ray& record, const math::Vec3d& base,
                                    const Takes& takes, bool crossings) const;
};

// Turned, stretched and sheared at random; every other one mirrors.
math::Affine random_placement(std::mt19937& random, double spread);

// By bits.
bool same_hits(const query::Hit* a, const query::Hit* b, size_t count);

// Rays from records.
query::Rays rays_of(const std::vector<math::Ray>& rays);

} // namespace peregrine::test
