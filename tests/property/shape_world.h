#pragma once

#include "query/shapes.h"
#include "scene/scene.h"
#include "support/world.h"
#include "triangle_boxes.h"

#include <memory>
#include <random>
#include <vector>

// Worlds that shapes are asked in, and what brute force says: every triangle of every mesh that is
// not far away, through the canonical tests.
namespace peregrine::test {

// Records of a test as the queries take them.
template <class Record>
query::Strided<Record> strided(std::vector<Record>& records) {
    return {reinterpret_cast<std::byte*>(records.data()), records.size(), sizeof(Record)};
}
template <class Record>
query::Placed<Record> placed(std::vector<Record>& records,
                             const math::Vec3d& base = math::Vec3d(0)) {
    return {strided(records), {base}};
}

struct ShapeMesh {
    base::Handle handle;
    std::vector<geometry::Triangle> triangles; // in its own space, for rigid ones
    scene::MeshKind kind = scene::MeshKind::fixed;
    uint32_t layer_mask = ~0u;
    math::Affine to_world;
    TriangleBoxes boxes; // in the world; without them brute force visits every triangle

    math::Vec3d in_the_world(const math::Vec3& v) const {
        return kind == scene::MeshKind::rigid ? to_world.point(math::Vec3d(v)) : math::Vec3d(v);
    }
    // The triangle as a shape sees it from its centre.
    geometry::Corners around(const geometry::Triangle& t, const trace::Position& position) const {
        if (kind != scene::MeshKind::rigid)
            return {math::Vec3d(t.v0), math::Vec3d(t.v1), math::Vec3d(t.v2),
                    math::Vec3d(query::Shift{position.base}.applied(position.record))};
        const math::Vec3d offset = -position.from(to_world.offset);
        const auto seen = [&](const math::Vec3& v) {
            return to_world.vector(math::Vec3d(v)) + offset;
        };
        return {seen(t.v0), seen(t.v1), seen(t.v2), math::Vec3d(0)};
    }
    bool mirrored() const { return math::determinant(to_world) < 0; }
    // The largest coordinate that a vertex has in the mesh, as long as it is in the world.
    double coordinate(const geometry::Triangle& t) const;
};

class ShapeWorld {
public:
    ShapeWorld(base::Isa isa, trace::Structure structure, bool compact = false);

    void add(std::vector<geometry::Triangle> triangles, scene::MeshKind kind,
             uint32_t layer_mask = ~0u, const math::Affine& to_world = {});
    void commit();

    const scene::Snapshot& snapshot() const { return *pin_->get(); }
    const std::vector<ShapeMesh>& meshes() const { return meshes_; }

private:
    std::unique_ptr<scene::Scene> scene_;
    std::unique_ptr<scene::SnapshotStore::Pin> pin_;
    trace::Structure structure_;
    bool compact_;
    std::vector<ShapeMesh> meshes_;
};

// Through every triangle that counts and has its box near, in order. Records are relative to
// `base`; where that is not 0, through all of them.
query::SweepHit brute_sweep(const std::vector<ShapeMesh>& meshes, const query::Sweep& sweep,
                            const query::Selection& selection, const math::Vec3d& base);
std::vector<query::OverlapHit> brute_overlap(const std::vector<ShapeMesh>& meshes,
                                             const query::Shape& shape,
                                             const query::Selection& selection,
                                             const math::Vec3d& base);
query::NearestPoint brute_nearest(const std::vector<ShapeMesh>& meshes, const query::Point& point,
                                  const query::Selection& selection, const math::Vec3d& base);

// Shapes as games and adversaries ask for them, the same for the same seed.
class ShapeCases {
public:
    ShapeCases(std::vector<geometry::Triangle> triangles, uint32_t seed);

    query::Sweep sweep();
    query::Shape shape();
    query::Point point();

private:
    math::Vec3 direction();
    math::Vec3 inside();
    math::Vec3 place();
    float radius();
    float unit() { return std::uniform_real_distribution<float>(-1, 1)(random_); }
    size_t pick(size_t count) { return random_() % count; }

    std::vector<geometry::Triangle> triangles_;
    math::Box bounds_;
    float diagonal_;
    std::mt19937 random_;
};

} // namespace peregrine::test
