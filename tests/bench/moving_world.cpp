#include "moving_world.h"

#include <cmath>
#include <stdexcept>

namespace peregrine::bench {

Ball::Ball(uint32_t triangles, const math::Vec3& center_, float radius_)
    : center(center_), radius(radius_) {
    const uint32_t cells = triangles / 2;
    for (uint32_t i = 1; i * i <= cells; ++i)
        if (cells % i == 0) rows = i;
    columns = cells / rows;
    for (uint32_t y = 0; y < rows; ++y)
        for (uint32_t x = 0; x < columns; ++x) {
            const uint32_t a = y * (columns + 1) + x, b = a + 1, c = b + columns, d = c + 1;
            indices.insert(indices.end(), {a, b, c, b, d, c});
        }
}

std::vector<math::Vec3> Ball::pose(uint32_t step) const {
    constexpr float kPi = 3.14159265f;
    std::vector<math::Vec3> positions;
    for (uint32_t y = 0; y <= rows; ++y)
        for (uint32_t x = 0; x <= columns; ++x) {
            // Not quite to the poles, where triangles would have no area.
            const float polar = kPi * (float(y) + 0.25f) / (float(rows) + 0.5f);
            const float turn = 2 * kPi * float(x) / float(columns);
            const float wobble =
                radius * (1 + 0.1f * std::sin(5 * polar + 3 * turn + 0.3f * float(step)));
            positions.push_back(center
                                + wobble
                                      * math::Vec3(std::sin(polar) * std::cos(turn),
                                                   std::cos(polar),
                                                   std::sin(polar) * std::sin(turn)));
        }
    return positions;
}

MovingWorld::MovingWorld(const rt_api& api, uint32_t threads) : api_(api) {
    rt_scene_desc desc = rt_default_scene_desc();
    desc.worker_count = threads;
    require(api_.create_scene(&desc, &scene_));
}

void MovingWorld::require(rt_result result) const {
    if (result != RT_OK) throw std::runtime_error(api_.get_last_error());
}

void MovingWorld::add_level(std::span<const geometry::Triangle> triangles) {
    std::vector<math::Vec3> corners;
    for (const geometry::Triangle& triangle : triangles)
        corners.insert(corners.end(), {triangle.v0, triangle.v1, triangle.v2});
    rt_mesh_desc desc = rt_default_mesh_desc();
    desc.index_type = RT_INDEX_NONE;
    desc.positions = {corners.data(), corners.size(), 0, 0};
    rt_mesh mesh;
    require(api_.add_static_mesh(scene_, &desc, &mesh));
}

rt_mesh MovingWorld::add(const Ball& ball, AddMesh add_mesh) {
    const std::vector<math::Vec3> positions = ball.pose(0);
    rt_mesh_desc desc = rt_default_mesh_desc();
    desc.positions = {positions.data(), positions.size(), 0, 0};
    desc.indices = {ball.indices.data(), ball.indices.size(), 0, 0};
    rt_mesh mesh;
    require(add_mesh(scene_, &desc, &mesh));
    return mesh;
}

rt_mesh MovingWorld::add_deforming(const Ball& ball) {
    return add(ball, api_.add_dynamic_mesh);
}

rt_mesh MovingWorld::add_rigid(const Ball& ball) {
    return add(ball, api_.add_rigid_mesh);
}

rt_mesh MovingWorld::add_instance(rt_mesh of) {
    rt_mesh mesh;
    require(api_.add_mesh_instance(scene_, of, &mesh));
    return mesh;
}

void MovingWorld::deform(rt_mesh mesh, std::span<const math::Vec3> positions) {
    rt_mesh_update update = rt_default_mesh_update();
    update.positions = {positions.data(), positions.size(), 0, 0};
    require(api_.update_dynamic_mesh(scene_, mesh, &update));
}

void MovingWorld::place(rt_mesh mesh, const math::Vec3& at, float turn) {
    rt_transform transform = rt_default_transform();
    transform.m[0] = transform.m[10] = double(std::cos(turn));
    transform.m[2] = double(std::sin(turn));
    transform.m[8] = -transform.m[2];
    for (int row = 0; row < 3; ++row) transform.m[4 * row + 3] = double(at[row]);
    require(api_.set_mesh_transform(scene_, mesh, &transform));
}

rt_commit_report MovingWorld::commit() {
    rt_commit_report report = rt_default_commit_report();
    require(api_.commit_scene(scene_, nullptr, &report));
    return report;
}

rt_scene_stats MovingWorld::stats() const {
    rt_scene_stats stats = rt_default_scene_stats();
    require(api_.get_scene_stats(scene_, &stats));
    return stats;
}

} // namespace peregrine::bench
