#include "upload.h"

#include <algorithm>
#include <vector>

#include "transform.h"

namespace host {

namespace {

template <class Vector>
void copy3(const Vector& from, auto* to) {
    for (int i = 0; i < 3; ++i) to[i] = from[i];
}

rt_wrap to_wrap(Wrap wrap) {
    if (wrap == Wrap::mirror) return RT_WRAP_MIRROR;
    return wrap == Wrap::clamp ? RT_WRAP_CLAMP : RT_WRAP_REPEAT;
}

class Uploader {
public:
    Uploader(Stage& stage, const Level& level, uint32_t layer_mask, rt_program water = {})
        : stage_(stage), level_(level), layer_mask_(layer_mask), water_(water) {
        for (const Texture& texture : level_.textures) add_texture(texture);
        for (const Material& material : level_.materials) add_material(material);
    }

    Uploaded run_rigid() {
        for (const RigidMesh& rigid : level_.rigid_meshes) add_rigid_mesh(rigid);
        return std::move(uploaded_);
    }

    Uploaded run(float ambient) {
        const rt_api& api = stage_.api();
        if (level_.origin != glm::dvec3(0.0))
            stage_.check(api.set_world_origin(stage_.scene(), &level_.origin.x),
                         "setting the origin of the world");
        for (const Mesh& mesh : level_.meshes) add_mesh(mesh, api.add_static_mesh);
        for (const RigidMesh& rigid : level_.rigid_meshes) add_rigid_mesh(rigid);
        for (const DeformingMesh& deforming : level_.deforming_meshes)
            uploaded_.deforming_meshes.push_back(add_mesh(deforming.mesh, api.add_dynamic_mesh));
        for (const Light& light : level_.lights) add_light(light);
        set_environment(ambient);
        return std::move(uploaded_);
    }

private:
    void add_texture(const Texture& texture) {
        const Image& image = level_.images[texture.image];
        rt_texture_desc desc = rt_default_texture_desc();
        desc.format = texture.srgb ? RT_FORMAT_RGBA8_SRGB : RT_FORMAT_RGBA8_LINEAR;
        desc.pixels = image.rgba.data();
        desc.width = image.width;
        desc.height = image.height;
        desc.wrap_u = to_wrap(texture.wrap_u);
        desc.wrap_v = to_wrap(texture.wrap_v);
        desc.filter = texture.nearest ? RT_FILTER_NEAREST : RT_FILTER_BILINEAR;
        rt_texture handle{};
        stage_.check(stage_.api().add_texture(stage_.scene(), &desc, &handle), "adding a texture");
        textures_.push_back(handle);
    }

    rt_texture_use to_use(const TextureUse& use) const {
        rt_texture_use result = rt_default_texture_use();
        if (use.texture == no_index) return result;
        result.texture = textures_[use.texture];
        std::copy(use.transform, use.transform + 6, result.transform);
        result.texcoord_set = use.texcoord_set;
        return result;
    }

    void add_material(const Material& material) {
        rt_material_desc desc = rt_default_material_desc();
        desc.alpha_mode = material.masked    ? RT_ALPHA_MASK
                          : material.blended ? RT_ALPHA_BLEND
                                             : RT_ALPHA_OPAQUE;
        desc.alpha_cutoff = material.alpha_cutoff;
        copy3(material.base_color, desc.base_color);
        desc.base_color[3] = material.base_color.a;
        copy3(material.emissive, desc.emissive);
        copy3(material.specular, desc.specular);
        desc.shininess = material.shininess;
        desc.normal_scale = material.normal_scale;
        desc.double_sided = material.double_sided ? 1 : 0;
        desc.reflectivity = material.reflectivity;
        copy3(material.reflection_color, desc.reflection_color);
        desc.transmission = material.transmission;
        desc.index_of_refraction = material.index_of_refraction;
        copy3(material.attenuation_color, desc.attenuation_color);
        desc.attenuation_distance = material.attenuation_distance;
        desc.thin = material.thin ? 1 : 0;
        desc.base_color_texture = to_use(material.base_color_texture);
        desc.normal_texture = to_use(material.normal_texture);
        desc.emissive_texture = to_use(material.emissive_texture);
        desc.occlusion_texture = to_use(material.occlusion_texture);
        desc.roughness_texture = to_use(material.roughness_texture);
        desc.occlusion_strength = material.occlusion_strength;
        desc.roughness = material.roughness;
        desc.metalness = material.metalness;
        desc.user_data = materials_.size();
        if (material.name == "water" && water_.generation != 0) {
            desc.program = water_;
            desc.reflectivity = desc.transmission = 0.0f; // it mirrors by itself
        }
        rt_material handle{};
        stage_.check(stage_.api().add_material(stage_.scene(), &desc, &handle),
                     "adding a material");
        materials_.push_back(handle);
    }

    using AddMesh = rt_result (*)(rt_scene, const rt_mesh_desc*, rt_mesh*);

    rt_mesh add_mesh(const Mesh& mesh, AddMesh add) {
        std::vector<rt_material> materials;
        materials.reserve(mesh.materials.size());
        for (const uint32_t material : mesh.materials)
            materials.push_back(material == no_index ? rt_material{} : materials_[material]);
        rt_mesh_desc desc = rt_default_mesh_desc();
        desc.positions = to_array(mesh.positions);
        desc.normals = to_array(mesh.normals);
        desc.tangents = to_array(mesh.tangents);
        desc.texcoords = to_array(mesh.texcoords);
        desc.texcoords1 = to_array(mesh.texcoords1);
        desc.indices = to_array(mesh.indices);
        desc.materials = to_array(materials);
        desc.layer_mask = layer_mask_;
        rt_mesh handle{};
        stage_.check(add(stage_.scene(), &desc, &handle), "adding a mesh");
        return handle;
    }

    void add_rigid_mesh(const RigidMesh& rigid) {
        std::vector<rt_mesh> handles = {add_mesh(rigid.mesh, stage_.api().add_rigid_mesh)};
        while (handles.size() < rigid.count()) {
            rt_mesh handle{};
            stage_.check(stage_.api().add_mesh_instance(stage_.scene(), handles[0], &handle),
                         "adding an instance of a mesh");
            handles.push_back(handle);
        }
        for (size_t i = 0; i < rigid.places.size(); ++i) {
            const rt_mesh mesh = handles[rigid.nodes.size() + i];
            if (!place_mesh(stage_, mesh, rigid.places[i]))
                stage_.check(stage_.api().set_mesh_hidden(stage_.scene(), mesh, 1),
                             "hiding a mesh that is scaled to nothing");
        }
        uploaded_.rigid_meshes.push_back(std::move(handles));
    }

    void add_light(const Light& light) {
        const rt_light_desc desc = describe_light(light);
        rt_light handle{};
        stage_.check(stage_.api().add_light(stage_.scene(), &desc, &handle), "adding a light");
        uploaded_.lights.push_back(handle);
    }

    // By day the sky is bright; without a sun it is night.
    void set_environment(float ambient) {
        const bool day =
            std::any_of(level_.lights.begin(), level_.lights.end(),
                        [](const Light& light) { return light.type == LightType::directional; });
        rt_environment environment = rt_default_environment();
        copy3(glm::vec3(ambient), environment.ambient);
        copy3(day ? glm::vec3(0.30f, 0.40f, 0.55f) : glm::vec3(0.030f, 0.038f, 0.050f),
              environment.background);
        stage_.check(stage_.api().set_environment(stage_.scene(), &environment),
                     "setting the environment");
    }

    Stage& stage_;
    const Level& level_;
    uint32_t layer_mask_;
    rt_program water_; // null: water is what its material says
    std::vector<rt_texture> textures_;
    std::vector<rt_material> materials_;
    Uploaded uploaded_;
};

} // namespace

rt_light_desc describe_light(const Light& light) {
    rt_light_desc desc = rt_default_light_desc();
    desc.type = light.type == LightType::point  ? RT_LIGHT_POINT
                : light.type == LightType::spot ? RT_LIGHT_SPOT
                                                : RT_LIGHT_DIRECTIONAL;
    copy3(light.position, desc.position);
    copy3(light.direction, desc.direction);
    copy3(light.intensity, desc.intensity);
    desc.radius = light.radius; // with the fall-off of a new desc, which is glTF's
    desc.source_radius = light.source_radius;
    desc.fog_scatter = light.fog_scatter;
    desc.cone_inner_cos = light.cone_inner_cos;
    desc.cone_outer_cos = light.cone_outer_cos;
    return desc;
}

bool place_mesh(const Stage& stage, rt_mesh mesh, const glm::dmat4& world) {
    const rt_transform transform = to_transform(world);
    const rt_result result = stage.api().set_mesh_transform(stage.scene(), mesh, &transform);
    if (result == RT_ERROR_INVALID_ARGUMENT) return false;
    stage.check(result, "placing a mesh");
    return true;
}

Uploaded upload_level(Stage& stage, const Level& level, float ambient, rt_program water) {
    static_assert(sizeof(glm::vec2) == 8 && sizeof(glm::vec3) == 12 && sizeof(glm::vec4) == 16);
    return Uploader(stage, level, ~0u, water).run(ambient);
}

Uploaded upload_rigid_meshes(Stage& stage, const Level& level, uint32_t layer_mask) {
    return Uploader(stage, level, layer_mask).run_rigid();
}

} // namespace host
