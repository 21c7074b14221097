#pragma once

#include "geometry/triangle.h"

#include <cstdint>
#include <peregrine/rt.h>
#include <span>
#include <vector>

namespace peregrine::bench {

// A ball that wobbles, of an even number of triangles.
struct Ball {
    Ball(uint32_t triangles, const math::Vec3& center_, float radius_);

    uint32_t triangle_count() const { return uint32_t(indices.size() / 3); }
    std::vector<math::Vec3> pose(uint32_t step) const;

    math::Vec3 center;
    float radius;
    uint32_t rows = 1, columns;
    std::vector<uint32_t> indices;
};

// A scene behind the door: a level, and what moves in it.
class MovingWorld {
public:
    MovingWorld(const rt_api& api, uint32_t threads);
    ~MovingWorld() { api_.destroy_scene(scene_); }
    MovingWorld(const MovingWorld&) = delete;
    MovingWorld& operator=(const MovingWorld&) = delete;

    void add_level(std::span<const geometry::Triangle> triangles);
    rt_mesh add_deforming(const Ball& ball);
    rt_mesh add_rigid(const Ball& ball);
    rt_mesh add_instance(rt_mesh of);
    void deform(rt_mesh mesh, std::span<const math::Vec3> positions);
    void place(rt_mesh mesh, const math::Vec3& at, float turn); // radians, about the vertical

    rt_commit_report commit();
    rt_scene_stats stats() const;
    void trace(const rt_query_desc& query) const { require(api_.trace_query(scene_, &query)); }

private:
    using AddMesh = rt_result (*)(rt_scene, const rt_mesh_desc*, rt_mesh*);

    rt_mesh add(const Ball& ball, AddMesh add_mesh);
    void require(rt_result result) const;

    const rt_api& api_;
    rt_scene scene_{};
};

} // namespace peregrine::bench
