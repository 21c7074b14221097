#pragma once

#include "accel/bih/builder.h"
#include "accel/bvh/builder.h"
#include "accel/bvh/compact.h"
#include "accel/kdtree/builder.h"
#include "base/memory.h"
#include "base/scheduler.h"
#include "geometry/triangle.h"
#include "support/ray_sets.h"
#include "trace/bih/target.h"
#include "trace/bvh/target.h"
#include "trace/kdtree/target.h"
#include "trace/kernels.h"

#include <optional>
#include <string>
#include <vector>

namespace peregrine::test {

// Triangles with each structure over them, as the kernels want them.
struct World {
    explicit World(std::vector<geometry::Triangle> list, uint32_t threads = 2);

    trace::Target target(trace::Structure structure = trace::Structure::bvh,
                         bool compact = false) const {
        switch (structure) {
        case trace::Structure::kdtree:
            return trace::kdtree::target_of(infos.data(), triangles.data(), kdtree.bounds, kdtree);
        case trace::Structure::bih:
            return trace::bih::target_of(infos.data(), triangles.data(), kdtree.bounds, bih);
        default:
            return compact ? trace::bvh::target_of(infos.data(), kdtree.bounds, compact_bvh)
                           : trace::bvh::target_of(infos.data(), kdtree.bounds, bvh);
        }
    }

    base::HostMemory memory{{}};
    std::vector<geometry::Triangle> triangles; // ascending in (mesh, primitive)
    std::vector<geometry::TriangleInfo> infos;
    accel::bvh::Tree bvh{&memory};
    accel::bvh::CompactTree compact_bvh{&memory};
    accel::kdtree::Tree kdtree{&memory};
    accel::bih::Tree bih{&memory};
};

// Number `index` of a list, from vertices; degenerate triangles are left out as by a commit.
class TriangleList {
public:
    void add(const math::Vec3& v0, const math::Vec3& v1, const math::Vec3& v2);
    std::vector<geometry::Triangle> triangles;

private:
    uint32_t next_ = 0;
};

// Triangles at random places of a cube of side 2, with corners up to `size` from there, all times
// `scale`.
std::vector<geometry::Triangle> soup(uint32_t seed, size_t count, float size, float scale = 1);

// A scene file of those that are lent to tests, with its cameras and point lights.
struct SceneFile {
    std::vector<geometry::Triangle> triangles;
    std::vector<Eye> eyes;
    std::vector<math::Vec3> lights;
};

// Where scenes made by others lie: $PEREGRINE_SCENES, or ../shared/scenes beside the checkout.
// Empty if there are none.
std::string scenes_folder();

// The .glb files there, by name without ending.
std::vector<std::string> scene_names();
SceneFile load_scene(const std::string& name);
SceneFile load_file(const std::string& path);

// Our hall and the .glb files there, as paths.
std::vector<std::string> scene_files();

// How many rays a set gets: $PEREGRINE_RAYS, or this default.
size_t rays_per_set(size_t otherwise);

} // namespace peregrine::test
