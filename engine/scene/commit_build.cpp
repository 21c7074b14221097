#include "scene/commit.h"

#include "base/error.h"
#include "scene/build.h"
#include "scene/collect.h"

#include <algorithm>

namespace peregrine::scene {
namespace {

// What deforms is built again after each change, a rigid mesh once.
constexpr BuildChoice kDeformingBuild = {trace::Structure::bih, accel::bvh::Quality::fast, 0,
                                         false};

constexpr uint64_t kFewTriangles = 4096; // not worth more than one thread

void check_count(uint64_t triangles, MeshKind kind) {
    constexpr const char* kNames[] = {"the static meshes have", "a dynamic mesh has",
                                      "a rigid mesh has"};
    if (triangles > kMostTriangles)
        base::fail(base::Code::limit, "%s %llu triangles; at most 2^27 are supported",
                   kNames[uint32_t(kind)], static_cast<unsigned long long>(triangles));
}

BuildChoice rigid_build(const BuildChoice& fixed) {
    return {trace::Structure::bvh, accel::bvh::Quality::balanced, 0, fixed.compact};
}

bool is_fixed(const std::optional<MeshDescription>& mesh) {
    return mesh && mesh->kind == MeshKind::fixed && !mesh->hidden;
}

} // namespace

uint64_t Commit::fixed_triangles() const {
    uint64_t triangles = 0;
    for (const auto& slot : scene_.meshes.slots())
        if (is_fixed(slot.object)) triangles += slot.object->data->triangles().size();
    return triangles;
}

Commit::Works Commit::find_works() {
    Works works(&scene_.recycled);
    if (!scene_.fixed_ || scene_.fixed_changed_ || scene_.fixed_build_ != options_.build.relevant())
        works.push_back({MeshKind::fixed, nullptr, 0, options_.build, fixed_triangles()});
    auto& slots = scene_.meshes.slots();
    for (uint32_t i = 0; i < slots.size(); ++i) {
        if (!slots[i].object || !slots[i].object->shape) continue;
        const MeshDescription& mesh = *slots[i].object;
        Shape& shape = *mesh.shape;
        if (shape.geometry && shape.flags_version == scene_.flags_version_) continue;
        if (mesh.kind == MeshKind::deforming && mesh.hidden) continue;
        if (shape.awaited_by == number_) continue; // by another instance
        shape.awaited_by = number_;
        works.push_back(
            {mesh.kind, &shape, i,
             mesh.kind == MeshKind::rigid ? rigid_build(options_.build) : kDeformingBuild,
             mesh.data->triangles().size()});
    }
    return works;
}

Commit::GeometryPointer Commit::build(const Work& work, base::Scheduler& scheduler,
                                      const base::Progress& progress) const {
    check_count(work.triangles, work.kind);
    // What is built once is not to leave its memory idle.
    base::Memory* const memory = work.kind == MeshKind::deforming
                                     ? static_cast<base::Memory*>(&scene_.recycled)
                                     : &scene_.memory;
    const auto geometry =
        std::allocate_shared<Geometry>(std::pmr::polymorphic_allocator<Geometry>(memory), memory);
    geometry->triangles.reserve(work.triangles);
    geometry->infos.reserve(work.triangles);
    const auto collect = [&](uint32_t slot, uint32_t name) {
        const Snapshot::Mesh& mesh = snapshot_.meshes[slot];
        collect_triangles(*mesh.data, *mesh.materials, *snapshot_.material_set, name, *geometry);
    };
    const auto& slots = scene_.meshes.slots();
    if (work.shape)
        collect(work.slot, 0); // instances have names of their own
    else
        for (uint32_t i = 0; i < slots.size(); ++i)
            if (is_fixed(slots[i].object)) collect(i, i);
    build_structure(work.choice, scheduler, progress, memory, *geometry);
    return geometry;
}

void Commit::keep(const Work& work, GeometryPointer geometry) {
    if (!work.shape) {
        snapshot_.fixed = std::move(geometry);
        return;
    }
    work.shape->geometry = std::move(geometry);
    work.shape->flags_version = scene_.flags_version_;
}

// A thread each, and no progress to tell.
void Commit::build_small_ones(Works& works) {
    const auto small = std::partition(works.begin(), works.end(), [](const Work& work) {
        return work.kind != MeshKind::deforming || work.triangles > kFewTriangles;
    });
    const auto count = uint32_t(works.end() - small);
    scene_.scheduler.for_each(count, [&](uint32_t i) {
        base::Scheduler alone(1, {}, &scene_.recycled);
        keep(small[i], build(small[i], alone, {}));
    });
    works.erase(small, works.end());
}

void Commit::build_structures() {
    snapshot_.fixed = scene_.fixed_;
    Works works = find_works();
    deforming_built_ = std::ranges::any_of(
        works, [](const Work& work) { return work.kind == MeshKind::deforming; });
    build_small_ones(works);
    uint64_t total = 0, done = 0;
    for (const Work& work : works) total += work.triangles;
    const auto fraction = [&](uint64_t part) {
        return total == 0 ? 0.0f : build_share() * float(double(part) / double(total));
    };
    for (const Work& work : works) {
        base::PartProgress part(options_.progress, fraction(done), fraction(work.triangles));
        keep(work, build(work, scene_.scheduler, part.progress()));
        done += work.triangles;
    }
}

} // namespace peregrine::scene
