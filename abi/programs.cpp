#include "check.h"
#include "guard.h"
#include "read_struct.h"
#include "scene_table.h"

#include <algorithm>
#include <limits>

namespace peregrine::abi {
namespace {

using scene::HostProgram;

static_assert(RT_PROGRAM_POSITION == int(HostProgram::kPosition));
static_assert(RT_PROGRAM_GEOMETRIC_NORMAL == int(HostProgram::kGeometricNormal));
static_assert(RT_PROGRAM_SHADING_NORMAL == int(HostProgram::kShadingNormal));
static_assert(RT_PROGRAM_DIRECTION == int(HostProgram::kDirection));
static_assert(RT_PROGRAM_DISTANCE == int(HostProgram::kDistance));
static_assert(RT_PROGRAM_FOOTPRINT == int(HostProgram::kFootprint));
static_assert(RT_PROGRAM_TEXCOORD == int(HostProgram::kTexcoord));
static_assert(RT_PROGRAM_BARYCENTRICS == int(HostProgram::kBarycentrics));
static_assert(RT_PROGRAM_IDS == int(HostProgram::kIds));
static_assert(RT_PROGRAM_BACK_FACE == int(HostProgram::kBackFace));
static_assert(RT_PROGRAM_USER_DATA == int(HostProgram::kUserData));
static_assert(RT_PROGRAM_BASE_COLOR == int(HostProgram::kBaseColor));
static_assert(RT_PROGRAM_EMISSIVE == int(HostProgram::kEmissiveColor));
static_assert(RT_PROGRAM_DIFFUSE == int(HostProgram::kDiffuse));
static_assert(RT_PROGRAM_HIGHLIGHT == int(HostProgram::kHighlight));
static_assert(RT_PROGRAM_OPENNESS == int(HostProgram::kOpenness));
static_assert(RT_PROGRAM_RAYS == int(HostProgram::kRays));

static_assert(sizeof(rt_mesh) == sizeof(base::Handle));
static_assert(offsetof(rt_mesh, index) == offsetof(base::Handle, index));
static_assert(offsetof(rt_mesh, generation) == offsetof(base::Handle, generation));

template <class Value, size_t Count>
void copy(Value* const (&from)[Count], Value* (&to)[Count]) {
    std::copy_n(from, Count, to);
}

rt_program_batch to_host(const scene::ProgramBatch& in) {
    rt_program_batch out{};
    out.struct_size = sizeof out;
    out.count = in.count;
    out.padded_count = in.padded_count;
    copy(in.position, out.position);
    copy(in.geometric_normal, out.geometric_normal);
    copy(in.shading_normal, out.shading_normal);
    copy(in.direction, out.direction);
    out.distance = in.distance;
    out.footprint = in.footprint;
    copy(in.texcoord, out.texcoord);
    copy(in.barycentric, out.barycentric);
    out.triangle = in.triangle;
    out.mesh = reinterpret_cast<const rt_mesh*>(in.mesh);
    out.back_face = in.back_face;
    out.mesh_user_data = in.mesh_user_data;
    out.material_user_data = in.material_user_data;
    copy(in.base_color, out.base_color);
    copy(in.emissive, out.emissive);
    copy(in.diffuse, out.diffuse);
    copy(in.highlight, out.highlight);
    out.openness = in.openness;
    copy(in.radiance, out.radiance);
    copy(in.ray_direction, out.ray_direction);
    copy(in.ray_weight, out.ray_weight);
    return out;
}

// A program that throws has said nothing: its hits count as faults.
void call(const HostProgram& program, const scene::ProgramBatch& batch) {
    const rt_program_batch hits = to_host(batch);
    try {
        reinterpret_cast<rt_program_function>(program.function)(program.user, &hits);
    } catch (...) {
        for (float* const lanes : batch.radiance)
            std::fill_n(lanes, batch.count, std::numeric_limits<float>::quiet_NaN());
        if (!batch.ray_weight[0]) return;
        for (float* const lanes : batch.ray_weight) std::fill_n(lanes, batch.count, 0.0f);
    }
}

HostProgram to_program(const rt_program_desc& desc) {
    require_bits(desc.fields, HostProgram::kAllFields, "rt_program_desc.fields");
    if (!desc.shade) base::fail(base::Code::invalid_argument, "rt_program_desc.shade is null");
    HostProgram program;
    program.fields = desc.fields;
    program.call = call;
    program.function = reinterpret_cast<void (*)()>(desc.shade);
    program.user = desc.user;
    return program;
}

void remove(scene::Scene& scene, base::Handle program) {
    require_object(scene.programs, program, "rt_program", "program");
    const auto& slots = scene.materials.slots();
    for (uint32_t i = 0; i < slots.size(); ++i)
        if (slots[i].object && slots[i].object->program == program)
            base::fail(base::Code::invalid_argument,
                       "rt_program is {%u, %u}, which material {%u, %u} has: give that another one",
                       program.index, program.generation, i, slots[i].generation);
    scene.programs.erase(program);
}

} // namespace
} // namespace peregrine::abi

using namespace peregrine::abi;

rt_result rt_add_program(rt_scene scene, const rt_program_desc* desc,
                         rt_program* out_program) noexcept {
    return guard([&] {
        HostScene& host = find_scene(scene);
        require_pointer(out_program, "out_program");
        *out_program =
            to_host<rt_program>(host.scene.programs.insert(to_program(read_struct(desc))));
    });
}

rt_result rt_remove_program(rt_scene scene, rt_program program) noexcept {
    return guard([&] { remove(find_scene(scene).scene, to_handle(program)); });
}
