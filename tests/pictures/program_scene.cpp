#include "program_scene.h"

#include <cmath>

namespace peregrine::test {
namespace {

// A parabola over each unit of x: 0 at whole numbers, 1 between them.
float wave(float x) {
    const float part = x - std::floor(x);
    return 4 * part * (1 - part);
}

// Rings about a point of the floor bend the normal; what comes from above is mirrored the more, the
// flatter it is seen, and the rest is the pool's own colour.
void shade_pool(void* user, const rt_program_batch* hits) {
    const float phase = *static_cast<const float*>(user);
    const auto& [x, y, z] = hits->direction;
    for (uint32_t i = 0; i < hits->padded_count; ++i) {
        const float px = hits->position[0][i] - 0.2f, pz = hits->position[2][i] + 0.4f;
        const float distance = std::sqrt(px * px + pz * pz) + 1e-3f;
        const float slope = 0.25f * (wave(3 * distance - phase) - 0.5f) / (1 + distance);
        const float nx = slope * px / distance, nz = slope * pz / distance;
        const float length = std::sqrt(nx * nx + 1 + nz * nz);
        const float normal[3] = {nx / length, 1 / length, nz / length};
        const float facing = -(x[i] * normal[0] + y[i] * normal[1] + z[i] * normal[2]);
        const float rest = 1 - facing, square = rest * rest;
        const float mirrored = 0.1f + 0.9f * square * square * rest;
        for (int k = 0; k < 3; ++k) {
            hits->ray_direction[k][i] = hits->direction[k][i] + 2 * facing * normal[k];
            hits->ray_weight[k][i] = mirrored;
            hits->radiance[k][i] = (1 - mirrored) * hits->base_color[k][i] * hits->diffuse[k][i]
                                   + hits->highlight[k][i];
        }
    }
}

// Bands run along u; the mesh's user data says how many.
void shade_sign(void* user, const rt_program_batch* hits) {
    const float phase = *static_cast<const float*>(user);
    for (uint32_t i = 0; i < hits->padded_count; ++i) {
        const float bands = float(hits->mesh_user_data[i]);
        const float band = wave(bands * hits->texcoord[0][i] - phase);
        const float glow = 0.05f + band * band * wave(hits->texcoord[1][i]);
        for (int k = 0; k < 3; ++k) hits->radiance[k][i] = glow * hits->emissive[k][i];
    }
}

// Lines as fine as they may be, and a glance behind that is bent a little.
void shade_hologram(void* user, const rt_program_batch* hits) {
    const float phase = *static_cast<const float*>(user);
    for (uint32_t i = 0; i < hits->padded_count; ++i) {
        const float width = 0.05f + hits->footprint[i];
        const float line = wave((hits->position[1][i] + 0.1f * phase) / width);
        hits->radiance[0][i] = 0.1f * line;
        hits->radiance[1][i] = 0.9f * line;
        hits->radiance[2][i] = 0.6f * line * hits->openness[i];
        for (int k = 0; k < 3; ++k) {
            hits->ray_direction[k][i] =
                hits->direction[k][i] - 0.2f * hits->geometric_normal[k][i] * line;
            hits->ray_weight[k][i] = 0.5f;
        }
    }
}

} // namespace

ProgramScene::ProgramScene(host::Stage& stage, const glm::dvec3& origin)
    : stage_(stage), glass_(stage, origin) {
    rt_material_desc pool = rt_default_material_desc();
    pool.base_color[0] = 0.05f;
    pool.base_color[1] = 0.3f;
    pool.base_color[2] = 0.35f;
    pool.specular[0] = pool.specular[1] = pool.specular[2] = 0.2f;
    pool.program = add_program(RT_PROGRAM_POSITION | RT_PROGRAM_DIRECTION | RT_PROGRAM_BASE_COLOR
                                   | RT_PROGRAM_DIFFUSE | RT_PROGRAM_HIGHLIGHT | RT_PROGRAM_RAYS,
                               shade_pool);
    add(make_grid({-1.2f, 0.02f, 1}, {2.8f, 0, 0}, {0, 0, -2.2f}, 1), pool, 0);
    rt_material_desc sign = rt_default_material_desc();
    sign.double_sided = 1;
    sign.emissive[0] = 3;
    sign.emissive[1] = 0.4f;
    sign.emissive[2] = 2;
    sign.program =
        add_program(RT_PROGRAM_TEXCOORD | RT_PROGRAM_USER_DATA | RT_PROGRAM_EMISSIVE, shade_sign);
    add(make_grid({-3, 1.5f, -5.5f}, {2.4f, 0, 0}, {0, 0.5f, 0}, 1), sign, 6);
    rt_material_desc hologram = rt_default_material_desc();
    hologram.double_sided = 1;
    hologram.alpha_mode = RT_ALPHA_BLEND;
    hologram.base_color[3] = 0.75f;
    hologram.program =
        add_program(RT_PROGRAM_POSITION | RT_PROGRAM_GEOMETRIC_NORMAL | RT_PROGRAM_DIRECTION
                        | RT_PROGRAM_FOOTPRINT | RT_PROGRAM_OPENNESS | RT_PROGRAM_RAYS,
                    shade_hologram);
    add(make_ball({1.9f, 1.6f, -2.5f}, 0.6f, 6), hologram, 0);
}

rt_program ProgramScene::add_program(uint32_t fields, rt_program_function shade) {
    rt_program_desc desc = rt_default_program_desc();
    desc.fields = fields;
    desc.shade = shade;
    desc.user = &phase_;
    rt_program program;
    stage_.check(stage_.api().add_program(stage_.scene(), &desc, &program), "adding a program");
    return program;
}

void ProgramScene::add(const Shape& shape, const rt_material_desc& material, uint64_t user_data) {
    rt_mesh_desc desc = shape.desc();
    desc.user_data = user_data;
    rt_mesh mesh;
    stage_.check(stage_.api().add_material(stage_.scene(), &material, &desc.material),
                 "adding a material");
    stage_.check(stage_.api().add_static_mesh(stage_.scene(), &desc, &mesh), "adding a mesh");
}

} // namespace peregrine::test
