#include "shade/program/program_batch.h"

#include "scene/texture_sampling.h"

#include <algorithm>
#include <cmath>

namespace peregrine::shade {

using scene::HostProgram;

BatchPacker::BatchPacker(const scene::Snapshot& snapshot, uint32_t features,
                         const SurfaceSpace& space, const RayHits& hits, const Scratch& scratch,
                         Surroundings from)
    : snapshot_(snapshot), features_(features), space_(space), hits_(hits), scratch_(scratch),
      memory_(*scratch.programs), from_(from) {}

scene::ProgramBatch BatchPacker::pack(const HostProgram& program) {
    program_ = &program;
    batch_ = {};
    batch_.count = memory_.count;
    batch_.padded_count = (memory_.count + 15) / 16 * 16;
    pack_place();
    pack_way();
    pack_texcoords();
    pack_names();
    pack_look();
    pack_light();
    clear_answers();
    return batch_;
}

// The last hit stands in all places beyond it, so that a program may compute there, too.
template <class Value>
const Value* BatchPacker::pad(Value* values) const {
    std::fill(values + batch_.count, values + batch_.padded_count, values[batch_.count - 1]);
    return values;
}

const float* BatchPacker::pack(const float* from, Lanes& to) const {
    float* end = to;
    for (uint32_t s = 0; s < memory_.span_count; ++s)
        end = std::copy(from + memory_.spans[s].begin, from + memory_.spans[s].end, end);
    return pad(to);
}

template <size_t Count>
void BatchPacker::pack(const Lanes (&from)[Count], Lanes (&to)[Count],
                       const float* (&out)[Count]) const {
    for (size_t k = 0; k < Count; ++k) out[k] = pack(from[k], to[k]);
}

void BatchPacker::pack_place() {
    const Surface& surface = scratch_.surface;
    if (program_->wants(HostProgram::kPosition)) {
        pack(surface.position, memory_.position, batch_.position);
        if (space_.is_elsewhere)
            for (int k = 0; k < 3; ++k)
                for (uint32_t i = 0; i < batch_.padded_count; ++i)
                    memory_.position[k][i] =
                        float(double(memory_.position[k][i]) + space_.origin[k]);
    }
    if (program_->wants(HostProgram::kGeometricNormal))
        pack(surface.geometric, memory_.geometric_normal, batch_.geometric_normal);
    if (program_->wants(HostProgram::kShadingNormal))
        pack(surface.normal, memory_.shading_normal, batch_.shading_normal);
    if (program_->wants(HostProgram::kBarycentrics)) {
        batch_.barycentric[0] = pack(hits_.u, memory_.barycentric[0]);
        batch_.barycentric[1] = pack(hits_.v, memory_.barycentric[1]);
    }
}

// In metres and as unit directions, whatever the lengths of the rays' own.
void BatchPacker::pack_way() {
    if (program_->wants(HostProgram::kFootprint)) {
        batch_.footprint = pack(hits_.t, memory_.footprint);
        for (uint32_t i = 0; i < batch_.padded_count; ++i) memory_.footprint[i] *= hits_.footprint;
    }
    const bool wants_direction = program_->wants(HostProgram::kDirection);
    const bool wants_distance = program_->wants(HostProgram::kDistance);
    if (!wants_direction && !wants_distance) return;
    auto& [x, y, z] = memory_.direction;
    const float* along[3];
    for (int k = 0; k < 3; ++k) along[k] = pack(hits_.direction[k], memory_.direction[k]);
    pack(hits_.t, memory_.distance);
    for (uint32_t i = 0; i < batch_.padded_count; ++i) {
        const float length = std::sqrt(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]);
        memory_.distance[i] *= length;
        const float inverse = 1.0f / length;
        x[i] *= inverse;
        y[i] *= inverse;
        z[i] *= inverse;
    }
    if (wants_direction) std::copy_n(along, 3, batch_.direction);
    if (wants_distance) batch_.distance = memory_.distance;
}

void BatchPacker::pack_texcoords() {
    if (!program_->wants(HostProgram::kTexcoord)) return;
    auto& [u, v] = memory_.texcoord;
    uint32_t at = 0;
    for (uint32_t r = 0; r < memory_.run_count; ++r) {
        const TriangleRun& run = scratch_.surface.runs[memory_.runs[r]];
        const geometry::TriangleInfo info = trace::info(snapshot_.world, hits_.triangle[run.begin]);
        const scene::MeshData& mesh = *snapshot_.meshes[info.mesh].data;
        for (uint32_t i = run.begin; i < run.end; ++i, ++at) {
            const math::Vec2 texcoord =
                scene::texcoord_at(mesh, info.primitive, 0, hits_.u[i], hits_.v[i]);
            u[at] = texcoord.x;
            v[at] = texcoord.y;
        }
    }
    batch_.texcoord[0] = pad(u);
    batch_.texcoord[1] = pad(v);
}

void BatchPacker::pack_names() {
    constexpr uint32_t kNames = HostProgram::kIds | HostProgram::kBackFace | HostProgram::kUserData;
    if (!(program_->fields & kNames)) return;
    uint32_t at = 0;
    for (uint32_t r = 0; r < memory_.run_count; ++r) {
        const TriangleRun& run = scratch_.surface.runs[memory_.runs[r]];
        const geometry::TriangleInfo info = trace::info(snapshot_.world, hits_.triangle[run.begin]);
        const scene::Snapshot::Mesh& mesh = snapshot_.meshes[info.mesh];
        const uint32_t count = run.end - run.begin;
        std::fill_n(memory_.triangle + at, count, uint32_t(info.primitive));
        std::fill_n(memory_.mesh + at, count, base::Handle{info.mesh, mesh.generation});
        std::fill_n(memory_.back_face + at, count, hits_.back_face[run.begin] != 0 ? 1u : 0u);
        std::fill_n(memory_.mesh_user_data + at, count, mesh.user_data);
        std::fill_n(memory_.material_user_data + at, count,
                    snapshot_.material_of(mesh, info.primitive).user_data);
        at += count;
    }
    if (program_->wants(HostProgram::kIds)) {
        batch_.triangle = pad(memory_.triangle);
        batch_.mesh = pad(memory_.mesh);
    }
    if (program_->wants(HostProgram::kBackFace)) batch_.back_face = pad(memory_.back_face);
    if (program_->wants(HostProgram::kUserData)) {
        batch_.mesh_user_data = pad(memory_.mesh_user_data);
        batch_.material_user_data = pad(memory_.material_user_data);
    }
}

void BatchPacker::pack_look() {
    const Surface& surface = scratch_.surface;
    if (program_->wants(HostProgram::kBaseColor))
        pack(surface.albedo, memory_.base_color, batch_.base_color);
    if (!program_->wants(HostProgram::kEmissiveColor)) return;
    if (features_ & scene::kEmissive)
        return pack(surface.emissive, memory_.emissive, batch_.emissive);
    for (int k = 0; k < 3; ++k) {
        std::fill_n(memory_.emissive[k], batch_.padded_count, 0.0f);
        batch_.emissive[k] = memory_.emissive[k];
    }
}

// The operations of find_radiance() (material/radiance-inl.h), in their order.
void BatchPacker::pack_light() {
    constexpr float kInversePi = 0.31830988618f;
    const Illumination& light = scratch_.light;
    const uint32_t end = batch_.padded_count;
    if (program_->wants(HostProgram::kOpenness) || program_->wants(HostProgram::kDiffuse)) {
        if (from_ != Surroundings::even)
            pack(light.openness, memory_.openness);
        else
            std::fill_n(memory_.openness, end, 1.0f);
        if (program_->wants(HostProgram::kOpenness)) batch_.openness = memory_.openness;
    }
    if (program_->wants(HostProgram::kDiffuse)) {
        pack(light.irradiance, memory_.diffuse, batch_.diffuse);
        for (int k = 0; k < 3; ++k) {
            const float ambient = snapshot_.environment.ambient[k];
            if (from_ == Surroundings::bright)
                pack(light.bounced[k], memory_.bounced);
            else
                std::fill_n(memory_.bounced, end, 0.0f);
            float* const lanes = memory_.diffuse[k];
            for (uint32_t i = 0; i < end; ++i)
                lanes[i] =
                    (ambient * memory_.openness[i] + memory_.bounced[i]) + lanes[i] * kInversePi;
        }
    }
    if (!program_->wants(HostProgram::kHighlight)) return;
    const bool has_lobes = features_ & scene::kSpecular;
    for (int k = 0; k < 3; ++k) {
        float* const lanes = memory_.highlight[k];
        batch_.highlight[k] = lanes;
        if (!has_lobes) {
            std::fill_n(lanes, end, 0.0f);
            continue;
        }
        pack(light.highlight[k], memory_.highlight[k]);
        pack(scratch_.surface.specular[k], memory_.specular);
        for (uint32_t i = 0; i < end; ++i) lanes[i] *= memory_.specular[i];
    }
}

// Black, and no ray.
void BatchPacker::clear_answers() {
    const auto clear = [&](Lanes(&lanes)[3], float*(&out)[3]) {
        for (int k = 0; k < 3; ++k) {
            std::fill_n(lanes[k], batch_.padded_count, 0.0f);
            out[k] = lanes[k];
        }
    };
    clear(memory_.radiance, batch_.radiance);
    if (!program_->wants(HostProgram::kRays)) return;
    clear(memory_.ray_direction, batch_.ray_direction);
    clear(memory_.ray_weight, batch_.ray_weight);
}

} // namespace peregrine::shade
