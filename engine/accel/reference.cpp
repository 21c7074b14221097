#include "accel/reference.h"

#include <algorithm>

namespace peregrine::accel {
namespace {

constexpr uint32_t kTrianglesPerTask = 16384;

} // namespace

Extent extent_of(std::span<const Reference> references) {
    Extent extent;
    for (const Reference& reference : references) extent.extend(reference);
    return extent;
}

Extent make_references(std::span<const geometry::Triangle> triangles, base::Scheduler& scheduler,
                       base::Memory* memory, Reference* references) {
    const uint32_t tasks = uint32_t((triangles.size() + kTrianglesPerTask - 1) / kTrianglesPerTask);
    base::Vector<Extent> extents(tasks, memory);
    scheduler.for_each(tasks, [&](uint32_t task) {
        const uint32_t end =
            uint32_t(std::min<size_t>(triangles.size(), size_t(task + 1) * kTrianglesPerTask));
        Extent extent;
        for (uint32_t i = task * kTrianglesPerTask; i < end; ++i) {
            Bounds bounds;
            for (const math::Vec3* v : {&triangles[i].v0, &triangles[i].v1, &triangles[i].v2})
                bounds.extend(load(*v));
            references[i] = Reference::make(i, bounds);
            extent.extend(references[i]);
        }
        extents[task] = extent;
    });
    Extent extent;
    for (const Extent& part : extents) {
        extent.bounds.extend(part.bounds);
        extent.centers.extend(part.centers);
    }
    return extent;
}

} // namespace peregrine::accel
