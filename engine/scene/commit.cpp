#include "scene/commit.h"

#include "accel/instances/builder.h"
#include "base/error.h"
#include "scene/alpha_test.h"
#include "scene/build.h"
#include "scene/collect.h"
#include "scene/resolve.h"

namespace peregrine::scene {
namespace {

// What moves is built in no time or not at all.
constexpr BuildChoice kDeformingBuild = {trace::Structure::bih, accel::bvh::Quality::fast, 0};
constexpr BuildChoice kShapeBuild = {trace::Structure::bvh, accel::bvh::Quality::balanced, 0};

using Number = unsigned long long;

void check_count(uint64_t triangles, const char* of) {
    if (triangles > kMostTriangles)
        base::fail(base::Code::limit, "%s %llu triangles; at most 2^27 are supported", of,
                   Number(triangles));
}

} // namespace

void Commit::show_materials() {
    if (scene_.material_set_version_ != scene_.materials_version_) {
        scene_.material_set_ = resolve_materials(scene_);
        scene_.material_set_version_ = scene_.materials_version_;
    }
    snapshot_.material_set = scene_.material_set_;
}

void Commit::show_meshes() {
    auto& slots = scene_.meshes.slots();
    snapshot_.meshes.reserve(slots.size());
    snapshot_.layer_masks.reserve(slots.size());
    snapshot_.generations.reserve(slots.size());
    for (auto& slot : slots) {
        Snapshot::Mesh& shown = snapshot_.meshes.emplace_back();
        shown.generation = slot.generation;
        snapshot_.generations.push_back(slot.generation);
        snapshot_.layer_masks.push_back(slot.object ? slot.object->layer_mask : 0);
        if (!slot.object) continue;
        MeshDescription& mesh = *slot.object;
        if (mesh.materials_version != scene_.materials_version_) {
            mesh.materials =
                resolve_materials(scene_, *snapshot_.material_set, *mesh.data->surface);
            mesh.materials_version = scene_.materials_version_;
        }
        shown.data = mesh.data;
        shown.materials = mesh.materials;
        shown.user_data = mesh.user_data;
        if (mesh.kind == MeshKind::rigid) {
            shown.placement = uint32_t(snapshot_.placements.size());
            snapshot_.placements.push_back(mesh.placement);
        }
        if (mesh.hidden) continue;
        snapshot_.features |= mesh.materials->features;
        if (mesh.kind != MeshKind::fixed) snapshot_.features |= kDynamicMeshes;
    }
}

void Commit::show_lights() {
    for (const auto& slot : scene_.lights.slots())
        if (slot.object) {
            snapshot_.lights.push_back(*slot.object);
            snapshot_.features |= features_of(*slot.object);
        }
    snapshot_.environment = scene_.environment;
}

Commit::GeometryPointer Commit::build(MeshKind kind, const BuildChoice& choice,
                                      const base::Progress& progress) {
    const auto geometry = std::allocate_shared<Geometry>(
        std::pmr::polymorphic_allocator<Geometry>(&scene_.memory), &scene_.memory);
    const auto& slots = scene_.meshes.slots();
    uint64_t count = 0;
    for (const auto& slot : slots)
        if (slot.object && shows(*slot.object, kind))
            count += slot.object->data->triangles().size();
    check_count(count, kind == MeshKind::fixed ? "the scene's static meshes have"
                                               : "the scene's dynamic meshes have");
    geometry->triangles.reserve(count);
    geometry->infos.reserve(count);
    for (uint32_t i = 0; i < slots.size(); ++i)
        if (slots[i].object && shows(*slots[i].object, kind))
            collect_triangles(*slots[i].object->data, *slots[i].object->materials,
                              *snapshot_.material_set, i, *geometry);
    build_structure(choice, scene_.scheduler, progress, &scene_.memory, *geometry);
    return geometry;
}

void Commit::build_parts() {
    const auto keep = [&](MeshKind kind, const GeometryPointer& old) {
        return old && !scene_.changed_[uint32_t(kind)];
    };
    const bool keep_fixed =
        keep(MeshKind::fixed, scene_.fixed_) && scene_.fixed_build_ == options_.build.relevant();
    snapshot_.fixed =
        keep_fixed ? scene_.fixed_ : build(MeshKind::fixed, options_.build, options_.progress);
    snapshot_.deforming = keep(MeshKind::deforming, scene_.deforming_)
                              ? scene_.deforming_
                              : build(MeshKind::deforming, kDeformingBuild, {});
}

// Each once, whatever shows it.
void Commit::build_shapes() {
    for (auto& slot : scene_.meshes.slots()) {
        if (!slot.object || !slot.object->shape) continue;
        Shape& shape = *slot.object->shape;
        if (shape.geometry && shape.flags_version == scene_.flags_version_) continue;
        const MeshDescription& mesh = *slot.object;
        const auto geometry = std::allocate_shared<Geometry>(
            std::pmr::polymorphic_allocator<Geometry>(&scene_.memory), &scene_.memory);
        check_count(mesh.data->triangles().size(), "a rigid mesh has");
        geometry->triangles.reserve(mesh.data->triangles().size());
        geometry->infos.reserve(mesh.data->triangles().size());
        collect_triangles(*mesh.data, *mesh.materials, *snapshot_.material_set, 0, *geometry);
        build_structure(kShapeBuild, scene_.scheduler, options_.progress, &scene_.memory,
                        *geometry);
        shape.geometry = geometry;
        shape.flags_version = scene_.flags_version_;
    }
}

trace::Part Commit::part_of(const Geometry& geometry, uint64_t first) const {
    if (first + geometry.infos.size() >= geometry::kNoTriangle)
        base::fail(base::Code::limit,
                   "the triangles of all instances, counted each time, are more than 2^32");
    return {geometry.target(), trace::select_kernels(geometry.structure, scene_.isa_),
            uint32_t(first)};
}

void Commit::place_instances() {
    trace::World& world = snapshot_.world;
    world.fixed = part_of(*snapshot_.fixed, 0);
    uint64_t first = snapshot_.fixed->infos.size();
    world.deforming = part_of(*snapshot_.deforming, first);
    first += snapshot_.deforming->infos.size();

    snapshot_.instances.reserve(snapshot_.placements.size());
    if (snapshot_.features & kAlphaMask)
        snapshot_.instance_alphas.reserve(snapshot_.placements.size());
    scene_.extents_.clear();
    auto& slots = scene_.meshes.slots();
    for (uint32_t i = 0; i < slots.size(); ++i) {
        if (!slots[i].object || !slots[i].object->shape) continue;
        MeshDescription& mesh = *slots[i].object;
        const std::shared_ptr<const Geometry>& shape = mesh.shape->geometry;
        snapshot_.meshes[i].shape = shape;
        if (mesh.hidden || shape->infos.empty()) continue;
        if (!mesh.extent_is_known) {
            mesh.extent =
                trace::extent_of(mesh.placement.to_world, mesh.placement.to_local, shape->bounds());
            mesh.extent_is_known = true;
        }
        trace::AlphaTest alpha;
        if (snapshot_.features & kAlphaMask) {
            snapshot_.instance_alphas.push_back({&snapshot_, i});
            alpha = alpha_test(snapshot_.instance_alphas.back());
        }
        snapshot_.instances.push_back(
            {mesh.placement.to_local, part_of(*shape, first), i, mesh.layer_mask, alpha});
        first += shape->infos.size();
        scene_.extents_.push_back(mesh.extent);
    }
    if (snapshot_.instances.size() > accel::instances::kMaxInstances)
        base::fail(base::Code::limit,
                   "the scene has %zu rigid meshes and instances; at most %u "
                   "are supported",
                   snapshot_.instances.size(), accel::instances::kMaxInstances);
    accel::instances::build(scene_.extents_, scene_.order_, snapshot_.instance_nodes);
    world.instances = snapshot_.instances.data();
    world.instance_count = uint32_t(snapshot_.instances.size());
    world.nodes = snapshot_.instances.empty() ? nullptr : snapshot_.instance_nodes.data();
    world.moves = world.nodes || !world.deforming.empty();
}

void Commit::find_bounds() {
    trace::World& world = snapshot_.world;
    world.bounds = world.fixed.target.bounds;
    world.bounds.extend(world.deforming.target.bounds);
    if (world.nodes) world.bounds.extend(world.nodes[0].extent.box);
}

void Commit::prepare() {
    snapshot_.version = scene_.version_ + 1;
    show_materials();
    show_meshes();
    show_lights();
    build_parts();
    build_shapes();
    place_instances();
    find_bounds();
    if (options_.progress.cancels(1.0f))
        base::fail(base::Code::cancelled, "the commit was cancelled by its progress callback");
}

void Commit::remember() noexcept {
    scene_.fixed_ = snapshot_.fixed;
    scene_.deforming_ = snapshot_.deforming;
    scene_.fixed_build_ = options_.build.relevant();
    for (bool& changed : scene_.changed_) changed = false;
    ++scene_.version_;
}

} // namespace peregrine::scene
