#include "scene/scene.h"

#include "accel/bvh/builder.h"
#include "accel/kdtree/builder.h"
#include "base/error.h"
#include "scene/collect.h"

#include <chrono>

namespace peregrine::scene {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// A snapshot on its way; destroyed unless it was published.
class Draft {
public:
    explicit Draft(SnapshotStore& store) : store_(store), snapshot_(store.create()) {}
    ~Draft() {
        if (snapshot_) store_.destroy(snapshot_);
    }
    Draft(const Draft&) = delete;
    Draft& operator=(const Draft&) = delete;

    Snapshot& operator*() { return *snapshot_; }
    void publish() { store_.publish(std::exchange(snapshot_, nullptr)); }

private:
    SnapshotStore& store_;
    Snapshot* snapshot_;
};

// Resolves the handles of one commit to places in the snapshot.
class Resolver {
public:
    Resolver(Scene& scene, Snapshot& snapshot)
        : scene_(scene), snapshot_(snapshot), material_places_(&scene.memory) {}

    void textures() {
        for (const auto& slot : scene_.textures.slots())
            if (slot.object) snapshot_.textures.push_back(*slot.object);
    }

    void materials() {
        snapshot_.materials.emplace_back();
        snapshot_.materials[0].double_sided = true;
        const auto& slots = scene_.materials.slots();
        material_places_.assign(slots.size(), 0);
        for (uint32_t i = 0; i < slots.size(); ++i) {
            if (!slots[i].object) continue;
            material_places_[i] = uint32_t(snapshot_.materials.size());
            snapshot_.materials.push_back(resolve(*slots[i].object, {i, slots[i].generation}));
        }
    }

    void meshes() {
        const auto& slots = scene_.meshes.slots();
        snapshot_.meshes.reserve(slots.size());
        snapshot_.layer_masks.reserve(slots.size());
        for (const auto& slot : slots) {
            snapshot_.meshes.push_back(
                {nullptr, base::Vector<uint32_t>(&scene_.memory), 0, slot.generation, 0, false, 0});
            if (slot.object) resolve(*slot.object, snapshot_.meshes.back());
            snapshot_.layer_masks.push_back(snapshot_.meshes.back().layer_mask);
        }
    }

    void lights() {
        for (const auto& slot : scene_.lights.slots())
            if (slot.object) snapshot_.lights.push_back(*slot.object);
    }

private:
    Material resolve(const MaterialDescription& description, Handle handle) {
        Material material = description.material;
        material.slot = handle.index;
        material.generation = handle.generation;
        resolve(material.base_color_texture, description.base_color_texture, handle);
        resolve(material.normal_texture, description.normal_texture, handle);
        resolve(material.emissive_texture, description.emissive_texture, handle);
        return material;
    }

    void resolve(TextureUse& use, Handle texture, Handle material) {
        if (!texture) return;
        const auto* found = scene_.textures.find(texture);
        if (!found)
            base::fail(base::Code::invalid_argument,
                       "material {%u, %u} names texture {%u, %u}, which was removed",
                       material.index, material.generation, texture.index, texture.generation);
        use.texture = found->get();
    }

    void resolve(const MeshDescription& description, Snapshot::Mesh& mesh) {
        mesh.data = description.data;
        mesh.layer_mask = description.layer_mask;
        mesh.dynamic = description.dynamic;
        mesh.user_data = description.user_data;
        mesh.material = place(description.data->material);
        mesh.materials.reserve(description.data->materials.size());
        for (const auto& reference : description.data->materials)
            mesh.materials.push_back(place(reference));
    }

    // A material that was removed shows as the default one.
    uint32_t place(const MeshData::MaterialRef& reference) {
        return scene_.materials.find({reference.index, reference.generation})
                   ? material_places_[reference.index]
                   : 0;
    }

    Scene& scene_;
    Snapshot& snapshot_;
    base::Vector<uint32_t> material_places_; // by slot
};

uint32_t features_of(const Material& material) {
    uint32_t features = material.masked ? uint32_t(kAlphaMask) : 0;
    if (!material.double_sided) features |= kSingleSidedMaterials;
    if (material.base_color_texture.texture) features |= kTextures;
    if (material.normal_texture.texture) features |= kNormalMaps | kTextures;
    if (material.emissive_texture.texture) features |= kTextures;
    if (material.emissive != math::Vec3(0)) features |= kEmissive;
    if (material.specular != math::Vec3(0)) features |= kSpecular;
    return features;
}

// Of the materials that meshes show, not of those that are merely described.
uint32_t features_of(const Snapshot& snapshot) {
    uint32_t features = 0;
    for (const Snapshot::Mesh& mesh : snapshot.meshes) {
        if (!mesh.data) continue;
        if (mesh.dynamic) features |= kDynamicMeshes;
        if (mesh.materials.empty()) features |= features_of(snapshot.materials[mesh.material]);
        for (const uint32_t material : mesh.materials)
            features |= features_of(snapshot.materials[material]);
    }
    for (const Light& light : snapshot.lights)
        features |= kLights | (light.casts_shadow ? uint32_t(kShadows) : 0);
    return features;
}

template <class T>
uint64_t bytes_of(const base::Vector<T>& vector) {
    return vector.size() * sizeof(T);
}

uint64_t attribute_bytes(const Snapshot& snapshot) {
    uint64_t bytes = 0;
    for (const Snapshot::Mesh& mesh : snapshot.meshes) {
        if (!mesh.data) continue;
        const MeshData& data = *mesh.data;
        bytes += bytes_of(data.positions) + bytes_of(data.normals) + bytes_of(data.tangents)
                 + bytes_of(data.texcoords) + bytes_of(data.texcoords1) + bytes_of(data.triangles)
                 + bytes_of(data.materials) + bytes_of(mesh.materials);
    }
    return bytes;
}

uint64_t texture_bytes(const Snapshot& snapshot) {
    uint64_t bytes = 0;
    for (const auto& texture : snapshot.textures) bytes += bytes_of(texture->texels);
    return bytes;
}

} // namespace

std::shared_ptr<const Geometry> Scene::current_geometry(const Snapshot& snapshot,
                                                        const CommitOptions& options) {
    if (geometry_ && !geometry_changed_ && geometry_build_ == options.build) return geometry_;
    const auto geometry =
        std::allocate_shared<Geometry>(std::pmr::polymorphic_allocator<Geometry>(&memory), &memory);
    collect_triangles(snapshot, *geometry);
    geometry->structure = options.build.structure;
    if (geometry->structure == trace::Structure::kdtree) {
        accel::kdtree::BuildOptions build;
        build.empty_bonus = options.build.empty_bonus;
        geometry->kdtree =
            accel::kdtree::build(geometry->triangles, build, scheduler, options.progress, &memory);
    } else {
        accel::bvh::BuildOptions build;
        build.quality = options.build.quality;
        geometry->bvh =
            accel::bvh::build(geometry->triangles, build, scheduler, options.progress, &memory);
        geometry->triangles = base::Vector<geometry::Triangle>(&memory);
    }
    return geometry;
}

CommitReport Scene::commit(const CommitOptions& options) {
    const Clock::time_point start = Clock::now();
    snapshots.reserve();
    Draft draft(snapshots);
    Snapshot& snapshot = *draft;
    Resolver resolver(*this, snapshot);
    resolver.textures();
    resolver.materials();
    resolver.meshes();
    resolver.lights();
    snapshot.environment = environment;
    snapshot.version = version_ + 1;
    snapshot.features = features_of(snapshot);
    snapshot.geometry = current_geometry(snapshot, options);
    snapshot.target = snapshot.geometry->target();
    snapshot.kernels = trace::select_kernels(snapshot.geometry->structure, isa_);
    if (options.progress.cancels(1.0f))
        base::fail(base::Code::cancelled, "the commit was cancelled by its progress callback");

    CommitReport report;
    report.geometry = snapshot.geometry;
    report.features = snapshot.features;
    report.bytes_attributes = attribute_bytes(snapshot);
    report.bytes_textures = texture_bytes(snapshot);
    report.light_count = uint32_t(snapshot.lights.size());
    report.rebuilt = snapshot.geometry != geometry_;

    // Nothing below can fail.
    geometry_ = snapshot.geometry;
    geometry_changed_ = false;
    geometry_build_ = options.build;
    ++version_;
    draft.publish();
    report.commit_ms = ms_since(start);
    return report;
}

} // namespace peregrine::scene
