#include "scene/commit.h"

#include "base/error.h"
#include "scene/build.h"
#include "scene/collect.h"

namespace peregrine::scene {
namespace {

// What deforms is built at every commit that follows a change, a rigid mesh once.
constexpr BuildChoice kDeformingBuild = {trace::Structure::bih, accel::bvh::Quality::fast, 0};
constexpr BuildChoice kShapeBuild = {trace::Structure::bvh, accel::bvh::Quality::balanced, 0};

bool is_seen(const std::optional<MeshDescription>& mesh, MeshKind kind) {
    return mesh && mesh->kind == kind && !mesh->hidden;
}

void check_count(uint64_t triangles, MeshKind kind) {
    constexpr const char* kNames[] = {"the static meshes have", "the dynamic meshes have",
                                      "a rigid mesh has"};
    if (triangles > kMostTriangles)
        base::fail(base::Code::limit, "%s %llu triangles; at most 2^27 are supported",
                   kNames[uint32_t(kind)], static_cast<unsigned long long>(triangles));
}

} // namespace

Commit::Work Commit::work_for(MeshKind kind, const BuildChoice& choice) const {
    uint64_t triangles = 0;
    for (const auto& slot : scene_.meshes.slots())
        if (is_seen(slot.object, kind)) triangles += slot.object->data->triangles().size();
    return {kind, nullptr, 0, choice, triangles};
}

Commit::GeometryPointer Commit::build(const Work& work, const base::Progress& progress) const {
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
            if (is_seen(slots[i].object, work.kind)) collect(i, i);
    build_structure(work.choice, scene_.scheduler, progress, memory, *geometry);
    return geometry;
}

void Commit::build_structures() {
    base::Vector<Work> works(&scene_.recycled);
    snapshot_.fixed = scene_.fixed_;
    snapshot_.deforming = scene_.deforming_;
    if (!scene_.fixed_ || scene_.fixed_changed_ || scene_.fixed_build_ != options_.build.relevant())
        works.push_back(work_for(MeshKind::fixed, options_.build));
    if (!scene_.deforming_ || scene_.deforming_changed_)
        works.push_back(work_for(MeshKind::deforming, kDeformingBuild));
    auto& slots = scene_.meshes.slots();
    for (uint32_t i = 0; i < slots.size(); ++i) {
        Shape* const shape = slots[i].object ? slots[i].object->shape.get() : nullptr;
        if (!shape || (shape->geometry && shape->flags_version == scene_.flags_version_)) continue;
        if (shape->awaited_by == number_) continue; // by another instance
        shape->awaited_by = number_;
        works.push_back(
            {MeshKind::rigid, shape, i, kShapeBuild, slots[i].object->data->triangles().size()});
    }

    uint64_t total = 0, done = 0;
    for (const Work& work : works) total += work.triangles;
    const auto fraction = [&](uint64_t part) {
        return total == 0 ? 0.0f : float(double(part) / double(total));
    };
    for (const Work& work : works) {
        base::PartProgress part(options_.progress, fraction(done), fraction(work.triangles));
        GeometryPointer geometry = build(work, part.progress());
        done += work.triangles;
        if (work.shape) {
            work.shape->geometry = std::move(geometry);
            work.shape->flags_version = scene_.flags_version_;
        } else {
            (work.kind == MeshKind::fixed ? snapshot_.fixed : snapshot_.deforming) =
                std::move(geometry);
        }
    }
}

} // namespace peregrine::scene
