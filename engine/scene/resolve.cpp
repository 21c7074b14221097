#include "scene/resolve.h"

#include "base/error.h"

namespace peregrine::scene {
namespace {

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
        snapshot_.generations.reserve(slots.size());
        for (const auto& slot : slots) {
            snapshot_.meshes.push_back(
                {nullptr, base::Vector<uint32_t>(&scene_.memory), 0, slot.generation, 0, false, 0});
            if (slot.object) resolve(*slot.object, snapshot_.meshes.back());
            snapshot_.layer_masks.push_back(snapshot_.meshes.back().layer_mask);
            snapshot_.generations.push_back(slot.generation);
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

} // namespace

void resolve(Scene& scene, Snapshot& snapshot) {
    Resolver resolver(scene, snapshot);
    resolver.textures();
    resolver.materials();
    resolver.meshes();
    resolver.lights();
    snapshot.environment = scene.environment;
}

} // namespace peregrine::scene
