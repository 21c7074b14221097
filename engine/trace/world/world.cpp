#include "trace/world/world.h"

#include <algorithm>

namespace peregrine::trace {
namespace {

double largest_coordinate(const math::Box& box) {
    const math::Vec3 most = glm::max(glm::abs(box.lower), glm::abs(box.upper));
    return double(std::max({most.x, most.y, most.z}));
}

double largest_coordinate(const math::Vec3d& v) {
    return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
}

float round_up(double value) {
    return std::nextafter(float(value), HUGE_VALF);
}

// What a ray in an own space may be off, back in the world, in parts of the local distance.
double local_error(double grows, double shrinks) {
    return grows * (0x1p-20 + grows * shrinks * 0x1p-48);
}

} // namespace

geometry::TriangleInfo moving_info(const World& world, uint32_t triangle) {
    const Instance* const end = world.instances + world.instance_count;
    const Instance& instance =
        std::upper_bound(world.instances, end, triangle, [](uint32_t number, const Instance& i) {
            return number < i.part.first;
        })[-1];
    geometry::TriangleInfo info = instance.part.target.infos[triangle - instance.part.first];
    info.mesh = instance.mesh;
    return info;
}

accel::instances::Extent extent_of(const math::Affine& to_world, const math::Affine& to_local,
                                   const math::Box& local) {
    accel::instances::Extent extent;
    extent.box = math::bounds(to_world, local);
    const double grows = to_world.norm(), shrinks = to_local.norm();
    const double error = local_error(grows, shrinks);
    const double reach = largest_coordinate(to_local.offset) + largest_coordinate(local);
    extent.margin = round_up(error * reach + 0x1p-20 * largest_coordinate(extent.box) + 0x1p-140);
    extent.slope = round_up(error * shrinks + 0x1p-20);
    return extent;
}

accel::instances::Extent extent_of(const math::Box& bounds) {
    const math::Vec3 most = glm::max(glm::abs(bounds.lower), glm::abs(bounds.upper));
    accel::instances::Extent extent;
    extent.box = bounds;
    extent.margin = 0x1p-19f * std::max({most.x, most.y, most.z}) + 0x1p-140f;
    extent.slope = 0x1p-19f;
    return extent;
}

bool moving_may_meet(const World& world, const math::Box& box) {
    const math::Vec3 most = glm::max(glm::abs(box.lower), glm::abs(box.upper));
    const float distance = std::max({most.x, most.y, most.z});
    uint32_t stack[accel::instances::kStackSize];
    uint32_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const accel::instances::Node& node = world.nodes[stack[--depth]];
        for (uint32_t i = 0; i < node.count; ++i) {
            const float wider = 2 * (node.margin[i] + node.slope[i] * distance);
            bool meets = true;
            for (int k = 0; k < 3; ++k)
                meets = meets && node.lower[k][i] <= box.upper[k] + wider
                        && node.upper[k][i] >= box.lower[k] - wider;
            if (!meets) continue;
            if (node.child[i].is_leaf()) return true;
            stack[depth++] = node.child[i].node();
        }
    }
    return false;
}

accel::instances::ExactExtent exact_extent_of(const Instance& instance) {
    const math::Box& local = instance.part.target.bounds;
    accel::instances::ExactExtent extent;
    if (!instance.has_own_space()) { // its rays are rounded to float in the world
        extent.lower = math::Vec3d(local.lower);
        extent.upper = math::Vec3d(local.upper);
        extent.margin = extent_of(local).margin;
        return extent;
    }
    math::find_bounds(*instance.to_world, local, extent.lower, extent.upper);
    const double error = local_error(instance.to_world->norm(), instance.to_local.norm());
    const double coordinate =
        std::max(largest_coordinate(extent.lower), largest_coordinate(extent.upper));
    extent.margin =
        round_up(error * 2 * largest_coordinate(local) + 0x1p-46 * coordinate + 0x1p-140);
    return extent;
}

} // namespace peregrine::trace
