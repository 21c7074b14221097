#include "scene/resolve.h"

#include "base/error.h"
#include "scene/features.h"
#include "scene/light_passing.h"

namespace peregrine::scene {
namespace {

template <class T>
std::shared_ptr<T> allocate(Scene& scene) {
    return std::allocate_shared<T>(std::pmr::polymorphic_allocator<T>(&scene.recycled),
                                   &scene.recycled);
}

void resolve(Scene& scene, TextureUse& use, Handle texture, Handle material) {
    if (!texture) return;
    const auto* found = scene.textures.find(texture);
    if (!found)
        base::fail(base::Code::invalid_argument,
                   "material {%u, %u} names texture {%u, %u}, which was removed", material.index,
                   material.generation, texture.index, texture.generation);
    use.texture = found->get();
}

Material resolve(Scene& scene, const MaterialDescription& description, Handle handle) {
    Material material = description.material;
    material.slot = handle.index;
    material.generation = handle.generation;
    resolve(scene, material.base_color_texture, description.base_color_texture, handle);
    resolve(scene, material.normal_texture, description.normal_texture, handle);
    resolve(scene, material.emissive_texture, description.emissive_texture, handle);
    resolve(scene, material.occlusion_texture, description.occlusion_texture, handle);
    resolve(scene, material.roughness_texture, description.roughness_texture, handle);
    if (const HostProgram* const program = scene.programs.find(description.program)) {
        material.program = (description.program.index + 1) & 0x7fffffffu;
        material.asks_rays = program->wants(HostProgram::kRays) ? 1 : 0;
    }
    return material;
}

Material default_material() {
    Material material;
    material.double_sided = true;
    return material;
}

} // namespace

std::shared_ptr<const MaterialSet> resolve_materials(Scene& scene) {
    const auto set = allocate<MaterialSet>(scene);
    for (const auto& slot : scene.textures.slots())
        if (slot.object) set->textures.push_back(*slot.object);
    if (scene.programs.count() > 0) {
        set->programs.resize(scene.programs.slots().size() + 1);
        for (size_t i = 0; i < scene.programs.slots().size(); ++i)
            if (const auto& program = scene.programs.slots()[i].object)
                set->programs[i + 1] = *program;
    }
    const auto& slots = scene.materials.slots();
    set->materials.assign(slots.size() + 1, default_material());
    for (uint32_t i = 0; i < slots.size(); ++i)
        if (slots[i].object)
            set->materials[i + 1] = resolve(scene, *slots[i].object, {i, slots[i].generation});
    return set;
}

std::shared_ptr<const MeshMaterials> resolve_materials(Scene& scene, const MaterialSet& set,
                                                       const MeshData& mesh, MeshKind kind) {
    const MeshSurface& surface = *mesh.surface;
    const auto shown = allocate<MeshMaterials>(scene);
    const auto place = [&](const MeshSurface::MaterialRef& reference) {
        return scene.materials.find({reference.index, reference.generation}) ? reference.index + 1
                                                                             : 0;
    };
    shown->all = place(surface.material);
    shown->each.reserve(surface.materials.size());
    for (const auto& reference : surface.materials) {
        shown->each.push_back(place(reference));
        shown->features |= features_of(set.materials[shown->each.back()]);
    }
    if (shown->each.empty()) shown->features = features_of(set.materials[shown->all]);
    if (kind == MeshKind::fixed && (shown->features & kLightPassingFeatures))
        add_light_passing(set, *shown, mesh, shown->light_passing);
    return shown;
}

} // namespace peregrine::scene
