#include "scene/light_passing.h"

#include "geometry/area.h"

#include <algorithm>

namespace peregrine::scene {
namespace {

using Boxes = base::Vector<math::Box>;

constexpr uint32_t kMostBoxes = 16; // of a mesh

struct Cluster {
    Boxes::iterator begin, end; // of triangles
    math::Box box;

    Cluster(Boxes::iterator begin_, Boxes::iterator end_) : begin(begin_), end(end_) {
        for (auto i = begin; i != end; ++i) box.extend(*i);
    }
    double size() const { return end - begin > 1 ? math::half_area(box) : -1; }

    // Where its triangles fall apart: in the middle of its longest side, or else of the list.
    Boxes::iterator cut() {
        const math::Vec3 side = box.upper - box.lower;
        const int axis = side.x >= side.y && side.x >= side.z ? 0 : side.y >= side.z ? 1 : 2;
        const float middle = box.lower[axis] + box.upper[axis];
        const auto found = std::partition(begin, end, [&](const math::Box& triangle) {
            return triangle.lower[axis] + triangle.upper[axis] < middle;
        });
        return found == begin || found == end ? begin + (end - begin) / 2 : found;
    }
};

Boxes boxes_of_triangles(const MaterialSet& set, const MeshMaterials& shown, const MeshData& mesh,
                         base::Memory* memory) {
    Boxes boxes(memory);
    const auto& triangles = mesh.triangles();
    for (uint32_t i = 0; i < triangles.size(); ++i) {
        if (!set.materials[shown.of(i)].may_pass_light()) continue;
        math::Box box;
        for (const uint32_t vertex : triangles[i])
            if (geometry::is_usable(mesh.positions[vertex])) box.extend(mesh.positions[vertex]);
        if (!box.empty()) boxes.push_back(box);
    }
    return boxes;
}

} // namespace

void add_light_passing(const MaterialSet& set, const MeshMaterials& shown, const MeshData& mesh,
                       base::Vector<math::Box>& out) {
    Boxes triangles = boxes_of_triangles(set, shown, mesh, out.get_allocator().resource());
    if (triangles.empty()) return;
    base::Vector<Cluster> clusters(out.get_allocator().resource());
    clusters.emplace_back(triangles.begin(), triangles.end());
    while (clusters.size() < kMostBoxes) {
        const auto largest = std::max_element(
            clusters.begin(), clusters.end(),
            [](const Cluster& a, const Cluster& b) { return a.size() < b.size(); });
        if (largest->size() < 0) break;
        const auto end = largest->end, middle = largest->cut();
        *largest = Cluster(largest->begin, middle);
        clusters.emplace_back(middle, end);
    }
    for (const Cluster& cluster : clusters) out.push_back(cluster.box);
}

void add_light_passing(const math::Box& box, base::Vector<math::Box>& boxes) {
    if (boxes.size() < kMostLightPassing)
        boxes.push_back(box);
    else
        boxes.back().extend(box);
}

} // namespace peregrine::scene
