#include "accel/reference.h"

#include <algorithm>

namespace peregrine::accel {
namespace {

constexpr uint32_t kTrianglesPerTask = 16384;

// Calls use(i, bounds of triangle i) for all.
template <class Use>
Extent for_triangles(std::span<const geometry::Triangle> triangles, base::Scheduler& scheduler,
                     base::Memory* memory, const Use& use) {
    const uint32_t tasks = uint32_t((triangles.size() + kTrianglesPerTask - 1) / kTrianglesPerTask);
    base::Vector<Extent> extents(tasks, memory);
    scheduler.for_each(tasks, [&](uint32_t task) {
        const uint32_t end =
            uint32_t(std::min<size_t>(triangles.size(), size_t(task + 1) * kTrianglesPerTask));
        Extent extent;
        for (uint32_t i = task * kTrianglesPerTask; i < end; ++i) {
            const Bounds bounds = bounds_of(triangles[i]);
            use(i, bounds);
            extent.extend(bounds);
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

} // namespace

Extent extent_of(std::span<const Reference> references) {
    Extent extent;
    for (const Reference& reference : references) extent.extend(reference);
    return extent;
}

Extent extent_of(std::span<const geometry::Triangle> triangles, base::Scheduler& scheduler,
                 base::Memory* memory) {
    return for_triangles(triangles, scheduler, memory, [](uint32_t, const Bounds&) {});
}

Extent make_references(std::span<const geometry::Triangle> triangles, base::Scheduler& scheduler,
                       base::Memory* memory, Reference* references) {
    return for_triangles(triangles, scheduler, memory, [&](uint32_t i, const Bounds& bounds) {
        references[i] = Reference::make(i, bounds);
    });
}

} // namespace peregrine::accel
