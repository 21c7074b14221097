// What a scene is described by.
#include "fuzzer.h"

namespace peregrine::test {

void Fuzzer::add_texture() {
    if (textures_.size() > 12) return;
    rt_texture_desc desc = rt_default_texture_desc();
    desc.format = rt_pixel_format(random_.below(5));
    desc.width = 1 + random_.below(6);
    desc.height = 1 + random_.below(6);
    desc.wrap_u = rt_wrap(random_.below(3));
    desc.wrap_v = rt_wrap(random_.below(3));
    desc.filter = rt_filter(random_.below(2));
    const uint64_t row = desc.width * (desc.format == RT_FORMAT_RGBA32F ? 16u : 4u);
    desc.row_stride = random_.one_in(2) ? 0 : row + random_.below(5);
    const uint64_t stride = desc.row_stride ? desc.row_stride : row;
    std::vector<unsigned char> pixels(stride * (desc.height - 1) + row);
    for (auto& byte : pixels) byte = uint8_t(random_.bits());
    desc.pixels = pixels.data();
    spoil(desc, offsetof(rt_texture_desc, wrap_u));
    rt_texture texture;
    if (check(rt_add_texture(scene_, &desc, &texture)) == RT_OK) textures_.push_back(texture);
}

rt_material_desc Fuzzer::material() {
    rt_material_desc desc = rt_default_material_desc();
    desc.alpha_mode = rt_alpha_mode(random_.below(3));
    desc.double_sided = random_.below(2);
    for (float& c : desc.base_color) c = random_.unit() * 2;
    for (float& c : desc.emissive) c = random_.one_in(3) ? random_.unit() : 0;
    for (float& c : desc.specular) c = random_.one_in(3) ? random_.unit() : 0;
    desc.shininess = 1 + 50 * random_.unit();
    if (random_.one_in(3)) desc.reflectivity = random_.unit();
    if (random_.one_in(3)) {
        desc.transmission = random_.unit();
        desc.index_of_refraction = 1 + random_.unit();
        desc.attenuation_distance = random_.unit();
        for (float& c : desc.attenuation_color) c = random_.unit();
        desc.thin = random_.below(2);
    }
    for (rt_texture_use* use :
         {&desc.base_color_texture, &desc.normal_texture, &desc.emissive_texture,
          &desc.occlusion_texture, &desc.roughness_texture}) {
        if (random_.one_in(2)) continue;
        use->texture = random_.pick(textures_);
        use->texcoord_set = random_.below(2);
        for (float& value : use->transform) value = random_.number();
    }
    for (float* value : {&desc.occlusion_strength, &desc.roughness, &desc.metalness})
        *value = random_.unit();
    if (random_.one_in(3)) {
        desc.program = random_.pick(programs_);
        if (!random_.one_in(9)) desc.reflectivity = desc.transmission = 0;
    }
    spoil(desc, 4);
    return desc;
}

// Reads all that it asked for, and says anything that it can: bits of what it was given.
void Fuzzer::shade(void* user, const rt_program_batch* b) {
    const uint32_t fields = *static_cast<const uint32_t*>(user);
    const float* const floats[] = {
        b->position[0], b->geometric_normal[1], b->shading_normal[2], b->direction[0],
        b->distance,    b->footprint,           b->texcoord[0],       b->barycentric[1]};
    const float* const light[] = {b->base_color[0], b->emissive[1], b->diffuse[2], b->highlight[0],
                                  b->openness};
    const bool has_rays = (fields & RT_PROGRAM_RAYS) != 0;
    require(b->count > 0 && b->padded_count % 16 == 0, "an odd batch");
    require(has_rays == (b->ray_weight[0] != nullptr), "rays that were not asked for");
    for (uint32_t i = 0; i < b->padded_count; ++i) {
        float sum = 0;
        for (uint32_t k = 0; k < std::size(floats); ++k)
            if (fields >> k & 1) sum += floats[k][i];
        for (uint32_t k = 0; k < std::size(light); ++k)
            if (fields >> (11 + k) & 1) sum += light[k][i];
        if (fields & RT_PROGRAM_IDS) sum += float(b->triangle[i] + b->mesh[i].index);
        if (fields & RT_PROGRAM_BACK_FACE) sum -= float(b->back_face[i]);
        if (fields & RT_PROGRAM_USER_DATA)
            sum += float(b->mesh_user_data[i] ^ b->material_user_data[i]);
        for (int k = 0; k < 3; ++k) {
            b->radiance[k][i] = sum;
            if (!has_rays) continue;
            b->ray_direction[k][i] = k == 1 ? sum : sum - 1;
            b->ray_weight[k][i] = sum * 0.5f;
        }
    }
}

void Fuzzer::add_program() {
    if (programs_.size() > 12) return;
    rt_program_desc desc = rt_default_program_desc();
    desc.fields = uint32_t(random_.bits()) & (2 * RT_PROGRAM_RAYS - 1);
    fields_.push_back(std::make_unique<uint32_t>());
    desc.user = fields_.back().get();
    desc.shade = random_.one_in(20) ? nullptr : shade;
    if (random_.one_in(20)) desc.fields = uint32_t(random_.bits());
    spoil(desc, 4, 8);
    *fields_.back() = desc.fields;
    rt_program program;
    if (check(rt_add_program(scene_, &desc, &program)) == RT_OK) programs_.push_back(program);
}

void Fuzzer::add_material() {
    if (materials_.size() > 12) return;
    const rt_material_desc desc = material();
    rt_material handle;
    if (check(rt_add_material(scene_, &desc, &handle)) == RT_OK) materials_.push_back(handle);
}

void Fuzzer::update_material() {
    const rt_material_desc desc = material();
    check(rt_update_material(scene_, random_.pick(materials_), &desc));
}

void Fuzzer::add_mesh() {
    if (meshes_.size() > 12) return;
    const uint32_t vertices = 3 + random_.below(30), corners = 3 * (1 + random_.below(40));
    const std::vector<float> positions = numbers(vertices * 3), normals = numbers(vertices * 3),
                             tangents = numbers(vertices * 4), uv = numbers(vertices * 2);
    std::vector<uint32_t> indices(corners);
    for (uint32_t& index : indices) index = random_.below(vertices);
    if (random_.one_in(20)) indices[random_.below(corners)] = uint32_t(random_.bits());
    std::vector<uint16_t> narrow(indices.begin(), indices.end());
    std::vector<rt_material> materials(corners / 3);
    for (rt_material& m : materials) m = materials_.empty() ? rt_material{} : materials_[0];
    rt_mesh_desc desc = rt_default_mesh_desc();
    desc.positions = {positions.data(), vertices, 0, 0};
    if (random_.one_in(2)) desc.normals = {normals.data(), vertices, 12, 0};
    if (random_.one_in(2)) desc.tangents = {tangents.data(), vertices, 0, 0};
    if (random_.one_in(2)) desc.texcoords = {uv.data(), vertices, 0, 0};
    if (random_.one_in(2)) desc.texcoords1 = {uv.data(), vertices, 8, 0};
    if (random_.one_in(2)) desc.materials = {materials.data(), corners / 3, 0, 0};
    desc.index_type = rt_index_type(random_.below(2));
    desc.indices = {desc.index_type ? static_cast<const void*>(narrow.data()) : indices.data(),
                    corners, 0, 0};
    desc.material = random_.one_in(2) ? rt_material{} : random_.pick(materials_);
    desc.layer_mask = uint32_t(random_.bits());
    spoil(desc, offsetof(rt_mesh_desc, material));
    if (random_.one_in(30)) desc.positions.count = random_.bits(); // more than there are
    if (random_.one_in(30)) desc.normals.count = random_.bits();
    if (desc.positions.count != vertices) desc.positions.count |= uint64_t(1) << 40;
    constexpr decltype(rt_add_static_mesh)* kAdd[] = {rt_add_static_mesh, rt_add_dynamic_mesh,
                                                      rt_add_rigid_mesh};
    const uint32_t kind = random_.below(3);
    rt_mesh mesh;
    if (check(kAdd[kind](scene_, &desc, &mesh)) != RT_OK) return;
    meshes_.push_back(mesh);
    if (kind == 1) moving_.push_back({mesh, vertices});
}

void Fuzzer::move_mesh() {
    rt_transform transform = rt_default_transform();
    for (double& m : transform.m)
        if (random_.one_in(2)) m = double(random_.number());
    check(rt_set_mesh_transform(scene_, random_.pick(meshes_), &transform));
    check(rt_set_mesh_layer_mask(scene_, random_.pick(meshes_), uint32_t(random_.bits())));
    check(rt_set_mesh_user_data(scene_, random_.pick(meshes_), random_.bits()));
    check(rt_set_mesh_hidden(scene_, random_.pick(meshes_), random_.below(3)));
}

void Fuzzer::add_instance() {
    if (meshes_.size() > 40) return;
    rt_mesh mesh;
    if (check(rt_add_mesh_instance(scene_, random_.pick(meshes_), &mesh)) == RT_OK)
        meshes_.push_back(mesh);
}

void Fuzzer::update_mesh() {
    if (moving_.empty()) return;
    const Moving mesh = moving_[random_.below(uint32_t(moving_.size()))];
    const std::vector<float> positions = numbers(mesh.vertices * 3);
    rt_mesh_update update = rt_default_mesh_update();
    update.positions = {positions.data(), mesh.vertices, 0, 0};
    if (random_.one_in(3)) update.normals = update.positions;
    if (random_.one_in(20)) update.positions.count -= 1;
    check(rt_update_dynamic_mesh(scene_, mesh.handle, &update));
}

void Fuzzer::add_light() {
    if (lights_.size() > 6) return;
    rt_light_desc desc = rt_default_light_desc();
    desc.type = rt_light_type(random_.below(3));
    desc.falloff = rt_falloff(random_.below(6)); // one too many
    for (double& p : desc.position) p = double(random_.number());
    for (float& d : desc.direction) d = random_.number();
    desc.casts_no_shadow = random_.below(2);
    if (random_.one_in(3)) desc.source_radius = random_.number();
    desc.shadow_samples = random_.below(20);
    if (random_.one_in(3)) desc.fog_scatter = random_.unit();
    spoil(desc, 4);
    rt_light light;
    if (check(rt_add_light(scene_, &desc, &light)) == RT_OK) lights_.push_back(light);
    if (!lights_.empty()) check(rt_update_light(scene_, random_.pick(lights_), &desc));
}

void Fuzzer::set_environment() {
    rt_environment environment = rt_default_environment();
    for (float& c : environment.background) c = random_.number();
    environment.sky = rt_sky(random_.below(3));
    for (float& c : environment.zenith) c = random_.unit();
    environment.sky_texture = random_.pick(textures_);
    environment.sky_rotation = random_.number();
    spoil(environment, 4);
    check(rt_set_environment(scene_, &environment));
    rt_fog fog = rt_default_fog();
    fog.density = random_.one_in(2) ? 0 : random_.unit();
    fog.top = 9.0 * double(random_.unit());
    fog.bottom = 9.0 * double(random_.unit()) - 4.5;
    spoil(fog, 4);
    check(rt_set_fog(scene_, &fog));
}

} // namespace peregrine::test
