#include "support/arena.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace peregrine::test {
namespace {

void append_box(std::vector<float>& out, const Vec3& lower, const Vec3& upper) {
    const auto corner = [&](int i) {
        return Vec3(i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y,
                    i & 4 ? upper.z : lower.z);
    };
    constexpr int faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                 {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& face : faces)
        for (const int k : {0, 1, 2, 0, 2, 3})
            for (int axis = 0; axis < 3; ++axis) out.push_back(float(corner(face[k])[axis]));
}

rt_mesh_desc describe(const std::vector<float>& positions) {
    rt_mesh_desc desc = rt_default_mesh_desc();
    desc.index_type = RT_INDEX_NONE;
    desc.positions = {positions.data(), positions.size() / 3, 0, 0};
    return desc;
}

} // namespace

Arena::Arena(rt_isa isa, uint32_t threads) : api_(rt_get_api(RT_API_VERSION)) {
    rt_scene_desc desc = rt_default_scene_desc();
    desc.isa = isa;
    desc.worker_count = threads;
    const rt_result result = api_->create_scene(&desc, &scene_);
    supported_ = result != RT_ERROR_UNSUPPORTED;
    if (!supported_) return;
    EXPECT_EQ(result, RT_OK) << api_->get_last_error();
}

Arena::~Arena() {
    if (supported_) api_->destroy_scene(scene_);
}

void Arena::add_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
    for (const Vec3& corner : {a, b, c})
        for (int axis = 0; axis < 3; ++axis) positions_.push_back(float(corner[axis]));
}

void Arena::add_quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    add_triangle(a, b, c);
    add_triangle(a, c, d);
}

void Arena::add_box(const Vec3& lower, const Vec3& upper) {
    append_box(positions_, lower, upper);
}

void Arena::add_floor(double half_size, double height) {
    const double s = half_size, y = height;
    add_quad({-s, y, -s}, {-s, y, s}, {s, y, s}, {s, y, -s});
}

void Arena::add_room(const Vec3& lower, const Vec3& upper) {
    add_box(lower, upper); // both sides of a triangle count
}

rt_mesh Arena::add_mover(const Vec3& lower, const Vec3& upper) {
    std::vector<float> positions;
    append_box(positions, lower, upper);
    const rt_mesh_desc desc = describe(positions);
    rt_mesh mesh{};
    EXPECT_EQ(api_->add_rigid_mesh(scene_, &desc, &mesh), RT_OK) << api_->get_last_error();
    movers_.push_back({mesh, rt_default_transform()});
    return mesh;
}

rt_transform& Arena::place_of(rt_mesh mover) {
    for (Mover& other : movers_)
        if (other.mesh.index == mover.index) return other.place;
    throw std::logic_error("not a mover of this arena");
}

gameplay::MeshMotion Arena::move(rt_mesh mover, const rt_transform& to) {
    rt_transform& place = place_of(mover);
    const gameplay::MeshMotion motion{mover, place, to};
    place = to;
    EXPECT_EQ(api_->set_mesh_transform(scene_, mover, &to), RT_OK) << api_->get_last_error();
    commit();
    return motion;
}

gameplay::MeshMotion Arena::shift(rt_mesh mover, const Vec3& offset) {
    rt_transform to = place_of(mover);
    for (int axis = 0; axis < 3; ++axis) to.m[4 * axis + 3] += offset[axis];
    return move(mover, to);
}

void Arena::commit() {
    if (!positions_.empty()) {
        const rt_mesh_desc desc = describe(positions_);
        rt_mesh mesh{};
        EXPECT_EQ(api_->add_static_mesh(scene_, &desc, &mesh), RT_OK) << api_->get_last_error();
        positions_.clear();
    }
    EXPECT_EQ(api_->commit_scene(scene_, nullptr, nullptr), RT_OK) << api_->get_last_error();
}

rt_transform turned(const Vec3& hinge, double sine, double cosine) {
    rt_transform transform = rt_default_transform();
    double* m = transform.m;
    m[0] = cosine;
    m[2] = sine;
    m[8] = -sine;
    m[10] = cosine;
    m[3] = hinge.x - cosine * hinge.x - sine * hinge.z;
    m[11] = hinge.z + sine * hinge.x - cosine * hinge.z;
    return transform;
}

void run(gameplay::Character& character, gameplay::CharacterInput input, int steps,
         double seconds) {
    for (int i = 0; i < steps; ++i) {
        character.update(input, seconds);
        input.jump = false;
        input.motions = {};
    }
}

gameplay::Character standing(const gameplay::World& world, const Vec3& position,
                             const gameplay::CharacterRules& rules) {
    gameplay::Character character(world, rules);
    character.place(position);
    run(character, {}, 30);
    return character;
}

uint64_t hash(const gameplay::CharacterState& state) {
    gameplay::StateHash hash;
    add(hash, state);
    return hash.value();
}

} // namespace peregrine::test
