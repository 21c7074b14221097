#include "field.h"

#include <stdexcept>

namespace peregrine::bench {

Field::Field(const rt_api& api) : api_(api) {
    const rt_scene_desc desc = rt_default_scene_desc();
    require(api_.create_scene(&desc, &scene_));
}

Field::~Field() {
    api_.destroy_scene(scene_);
}

void Field::add_quad(const gameplay::Vec3& a, const gameplay::Vec3& b, const gameplay::Vec3& c,
                     const gameplay::Vec3& d) {
    for (const gameplay::Vec3& corner : {a, b, c, a, c, d}) corners_.emplace_back(corner);
}

void Field::add_level(const host::Level& level) {
    for (const host::Mesh& mesh : level.meshes)
        for (const uint32_t index : mesh.indices) corners_.push_back(mesh.positions[index]);
}

void Field::commit() {
    rt_mesh_desc mesh = rt_default_mesh_desc();
    mesh.index_type = RT_INDEX_NONE;
    mesh.positions = {corners_.data(), corners_.size(), 0, 0};
    rt_mesh handle;
    require(api_.add_static_mesh(scene_, &mesh, &handle));
    require(api_.commit_scene(scene_, nullptr, nullptr));
}

void Field::require(rt_result result) const {
    if (result != RT_OK) throw std::runtime_error(api_.get_last_error());
}

} // namespace peregrine::bench
