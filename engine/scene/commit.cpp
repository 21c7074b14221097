#include "scene/commit.h"

#include "accel/instances/builder.h"
#include "base/error.h"
#include "geometry/area.h"
#include "scene/alpha_test.h"
#include "scene/light_passing.h"
#include "scene/resolve.h"
#include "trace/world/ray_lists.h"

namespace peregrine::scene {
namespace {

// As triangles beyond 1e30, instances beyond it are in no snapshot.
bool is_usable(const accel::instances::Extent& extent) {
    return geometry::is_usable(extent.box.lower) && geometry::is_usable(extent.box.upper)
           && extent.margin <= 1e30f;
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
        ShownMaterials& materials = mesh.shape ? mesh.shape->shown : mesh.shown;
        if (materials.version != scene_.materials_version_) {
            materials.materials =
                resolve_materials(scene_, *snapshot_.material_set, *mesh.data, mesh.kind);
            materials.version = scene_.materials_version_;
        }
        shown.data = mesh.data;
        shown.materials = materials.materials;
        shown.user_data = mesh.user_data;
        moving_ += mesh.kind != MeshKind::fixed;
        if (mesh.kind == MeshKind::rigid) {
            shown.placement = uint32_t(snapshot_.placements.size());
            snapshot_.placements.push_back(mesh.placement);
        }
        if (mesh.hidden) continue;
        snapshot_.features |= shown.materials->features;
        for (const math::Box& box : shown.materials->light_passing)
            add_light_passing(box, snapshot_.light_passing);
        if (mesh.kind != MeshKind::fixed) snapshot_.features |= kDynamicMeshes;
    }
}

void Commit::show_lights() {
    lights_.reserve(scene_.lights.count());
    for (const auto& slot : scene_.lights.slots())
        if (slot.object) {
            lights_.push_back(*slot.object);
            lights_.back().position -= scene_.origin();
            snapshot_.features |= features_of(*slot.object);
        }
}

void Commit::show_environment() {
    snapshot_.environment = scene_.environment;
    snapshot_.features |= features_of(scene_.environment) | features_of(scene_.fog);
    snapshot_.fog = scene_.fog;
    if (!scene_.fog.any()) snapshot_.features &= ~uint32_t(kAirlight);
    snapshot_.fog.top -= scene_.origin().y;
    snapshot_.fog.bottom -= scene_.origin().y;
    Sky& sky = snapshot_.environment.sky;
    if (sky.kind != SkyKind::texture) return;
    const auto* found = scene_.textures.find(scene_.sky_texture);
    if (!found)
        base::fail(base::Code::invalid_argument,
                   "the environment names texture {%u, %u}, which was removed",
                   scene_.sky_texture.index, scene_.sky_texture.generation);
    sky.texture = found->get(); // which the material set keeps
}

// With the last snapshot, if they are the same.
void Commit::share_lights() {
    const math::Box& bounds = snapshot_.world.bounds;
    if (scene_.light_set_ && scene_.light_set_->is_of(lights_, light_views_, bounds))
        snapshot_.lights = scene_.light_set_;
    else
        snapshot_.lights = make_light_set(std::move(lights_), std::move(light_views_), bounds,
                                          scene_.scheduler, &scene_.recycled);
}

void Commit::show_light_map() {
    const std::lock_guard lock(scene_.light_map_mutex_);
    if (scene_.light_map_ && scene_.light_map_->geometry == snapshot_.fixed)
        snapshot_.light_map = scene_.light_map_;
}

trace::Part Commit::part_of(const Geometry& geometry, uint64_t first) const {
    if (first + geometry.infos.size() >= geometry::kNoTriangle)
        base::fail(base::Code::limit,
                   "the triangles of all instances, counted each time, are more than 2^32");
    return {geometry.target(),
            trace::select_kernels(geometry.structure, scene_.isa_, geometry.is_compact()),
            uint32_t(first)};
}

void Commit::place_instances() {
    trace::World& world = snapshot_.world;
    world.fixed = part_of(*snapshot_.fixed, 0);
    world.ray_lists = &trace::ray_lists(world.fixed.kernels->isa);
    uint64_t first = snapshot_.fixed->infos.size();
    world.first_moving = uint32_t(first);

    snapshot_.instances.reserve(moving_);
    const bool asks = snapshot_.features & (kAlphaMask | kLightPassingFeatures);
    if (asks) snapshot_.instance_alphas.reserve(moving_);
    scene_.extents_.clear();
    auto& slots = scene_.meshes.slots();
    for (uint32_t i = 0; i < slots.size(); ++i) {
        if (!slots[i].object || !slots[i].object->shape) continue;
        MeshDescription& mesh = *slots[i].object;
        const std::shared_ptr<const Geometry>& shape = mesh.shape->geometry;
        snapshot_.meshes[i].shape = shape;
        if (mesh.hidden || shape->infos.empty()) continue;
        if (!mesh.extent_is_known) {
            mesh.extent = mesh.kind == MeshKind::rigid ? trace::extent_of(
                              mesh.placement.to_world, mesh.placement.to_local, shape->bounds())
                                                       : trace::extent_of(shape->bounds());
            mesh.extent_is_known = true;
        }
        if (!is_usable(mesh.extent)) {
            unusable_ += shape->infos.size();
            continue;
        }
        trace::InstanceTests tests;
        if (asks) {
            snapshot_.instance_alphas.push_back({&snapshot_, i});
            const InstanceAlpha& alpha = snapshot_.instance_alphas.back();
            tests = {alpha_test(alpha), light_test(alpha), opacity_test(alpha)};
        }
        const bool is_rigid = mesh.kind == MeshKind::rigid;
        const Placement* const placement = snapshot_.placement_of(snapshot_.meshes[i]);
        snapshot_.instances.push_back({mesh.placement.to_local, mesh.placement.to_world.offset,
                                       part_of(*shape, first), i, mesh.layer_mask, tests,
                                       is_rigid ? &placement->to_world : nullptr,
                                       is_rigid && placement->mirrored});
        rigid_count_ += is_rigid;
        first += shape->infos.size();
        scene_.extents_.push_back(mesh.extent);
        if (snapshot_.meshes[i].materials->features & kLightPassingFeatures)
            add_light_passing(mesh.extent.box, snapshot_.light_passing);
    }
    if (snapshot_.instances.size() > accel::instances::kMaxInstances)
        base::fail(base::Code::limit,
                   "the scene has %zu dynamic and rigid meshes and instances; at most %u are "
                   "supported",
                   snapshot_.instances.size(), accel::instances::kMaxInstances);
    world.moving_bounds =
        accel::instances::build(scene_.extents_, scene_.places_, snapshot_.instance_nodes);
    world.instances = snapshot_.instances.data();
    world.instance_count = uint32_t(snapshot_.instances.size());
    world.nodes = snapshot_.instances.empty() ? nullptr : snapshot_.instance_nodes.data();
    if (accel::instances::are_far(scene_.extents_, world.moving_bounds)) place_far_instances();
}

void Commit::place_far_instances() {
    base::Vector<accel::instances::ExactExtent> extents(&scene_.recycled);
    extents.reserve(snapshot_.instances.size());
    for (const trace::Instance& instance : snapshot_.instances)
        extents.push_back(trace::exact_extent_of(instance));
    accel::instances::find_rests(snapshot_.instance_nodes, extents, &scene_.recycled,
                                 snapshot_.instance_rests);
    snapshot_.world.rests = snapshot_.instance_rests.data();
}

void Commit::find_bounds() {
    trace::World& world = snapshot_.world;
    world.bounds = world.fixed.target.bounds;
    if (world.nodes) world.bounds.extend(world.moving_bounds);
}

void Commit::prepare() {
    snapshot_.version = scene_.version_ + 1;
    snapshot_.origin = scene_.origin();
    snapshot_.displaced = snapshot_.origin != math::Vec3d(0);
    show_materials();
    show_meshes();
    show_lights();
    show_environment();
    build_structures();
    place_instances();
    find_bounds();
    prove_lights();
    share_lights();
    show_light_map();
    if (options_.progress.cancels(1.0f))
        base::fail(base::Code::cancelled, "the commit was cancelled by its progress callback");
}

void Commit::remember() noexcept {
    scene_.fixed_ = snapshot_.fixed;
    scene_.fixed_build_ = options_.build.relevant();
    scene_.fixed_changed_ = false;
    scene_.views_.swap(views_);
    if (proof_report_.waiting == 0) scene_.proofs_.reset();
    scene_.light_set_ = snapshot_.lights;
    ++scene_.version_;
    // One that was baked since show_light_map() stays for the next commit.
    const std::lock_guard lock(scene_.light_map_mutex_);
    if (scene_.light_map_ && scene_.light_map_->geometry != scene_.fixed_)
        scene_.light_map_.reset();
}

} // namespace peregrine::scene
