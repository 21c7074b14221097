#include "accel/spheres/builder.h"

#include "accel/morton_order.h"

#include <cmath>

namespace peregrine::accel::spheres {
namespace {

// Encloses all of them. Rounding is far below its margin.
Sphere enclose(std::span<const Sphere> spheres) {
    math::Box box;
    for (const Sphere& sphere : spheres) {
        box.extend(sphere.center - sphere.radius);
        box.extend(sphere.center + sphere.radius);
    }
    Sphere out{0.5f * box.lower + 0.5f * box.upper, 0};
    for (const Sphere& sphere : spheres) {
        const math::Vec3 offset = sphere.center - out.center;
        out.radius = std::max(out.radius, std::sqrt(glm::dot(offset, offset)) + sphere.radius);
    }
    out.radius *= 1.0001f;
    return out;
}

uint32_t count_levels(size_t count) {
    uint32_t levels = 1;
    for (; count > 1; count = (count + 3) / 4) ++levels;
    return levels;
}

} // namespace

void build(std::span<const Sphere> spheres, std::span<const uint32_t> items,
           base::Scheduler& scheduler, base::Memory* memory, Tree& out) {
    out.spheres.clear();
    out.items.clear();
    out.first = {};
    out.levels = 0;
    if (spheres.empty()) return;
    base::Vector<math::Vec3> centers(memory);
    centers.reserve(spheres.size());
    math::Box box;
    for (const Sphere& sphere : spheres) {
        centers.push_back(sphere.center);
        box.extend(sphere.center);
    }
    const Buffer<MortonKey> order =
        sort_along_morton_curve(centers, box, kMaxMortonBits, scheduler, memory);
    out.items.reserve(spheres.size());
    out.spheres.reserve(spheres.size() + (spheres.size() + 2) / 3 + Tree::kMostLevels);
    for (size_t i = 0; i < spheres.size(); ++i) {
        out.items.push_back(items[order[i].item]);
        out.spheres.push_back(spheres[order[i].item]);
    }
    const std::span<const Sphere> leaves(out.spheres.data(), spheres.size());
    out.levels = count_levels(spheres.size());
    // Each node from all of its leaves: a sphere around spheres would grow from level to level.
    size_t width = 1;
    for (uint32_t level = 1; level < out.levels; ++level) {
        width *= 4;
        out.first[level] = uint32_t(out.spheres.size());
        for (size_t begin = 0; begin < leaves.size(); begin += width)
            out.spheres.push_back(
                enclose(leaves.subspan(begin, std::min(width, leaves.size() - begin))));
    }
    out.first[out.levels] = uint32_t(out.spheres.size());
}

} // namespace peregrine::accel::spheres
