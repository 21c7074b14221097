#include "shade/program/program_answers.h"

#include "shade/surface/triangle_shading.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace peregrine::shade {

using math::Vec3;
using scene::HostProgram;

namespace {

using Lanes = Surface::Lanes;

bool is_light(float value) {
    return value >= 0 && value <= std::numeric_limits<float>::max();
}

template <class Arrays>
Vec3 at(const Arrays& arrays, uint32_t i) {
    return {arrays[0][i], arrays[1][i], arrays[2][i]};
}

// Zeros for what is no light; clears `sane` there.
void make_light(Lanes& lanes, uint32_t count, uint32_t* sane) {
    for (uint32_t i = 0; i < count; ++i) {
        const float value = lanes[i];
        const bool fits = is_light(value);
        lanes[i] = fits ? value : 0.0f;
        sane[i] &= fits ? 1u : 0u;
    }
}

// Whether the square of a length is as exact in float as it is in double.
bool is_tame(float square) {
    return square >= 1e-30f && square <= 1e30f;
}

} // namespace

void ProgramAnswers::take(const HostProgram& program, float* const radiance[3]) const {
    const bool asks = program.wants(HostProgram::kRays);
    std::fill_n(memory_.sane, memory_.count, 1u);
    make_sane(asks);
    if (asks) aim();
    for (uint32_t i = 0; i < memory_.count; ++i) memory_.fault_count += memory_.sane[i] ^ 1u;
    memory_.hit_count += memory_.count;
    if (rays_ && rays_->split.any) cover();
    const bool any = asks && any_ray();
    if (any && !rays_) add_ambient();
    if (any && rays_) send();
    uint32_t first = 0;
    for (uint32_t s = 0; s < memory_.span_count; ++s) {
        const auto [begin, end] = memory_.spans[s];
        for (int k = 0; k < 3; ++k)
            std::copy_n(memory_.radiance[k] + first, end - begin, radiance[k] + begin);
        first += end - begin;
    }
}

// A ray of which one colour can't be has none. Weights end at 1, so that no path grows for ever.
void ProgramAnswers::make_sane(bool asks) const {
    const uint32_t count = memory_.count;
    for (Lanes& lanes : memory_.radiance) make_light(lanes, count, memory_.sane);
    if (!asks) return;
    std::fill_n(memory_.sane_ray, count, 1u);
    for (Lanes& lanes : memory_.ray_weight) make_light(lanes, count, memory_.sane_ray);
    for (Lanes& lanes : memory_.ray_weight)
        for (uint32_t i = 0; i < count; ++i)
            lanes[i] = memory_.sane_ray[i] ? std::min(lanes[i], 1.0f) : 0.0f;
}

// Makes directions as long as those of the rays that arrive, so that t goes on counting.
void ProgramAnswers::aim() const {
    uint32_t first = 0;
    for (uint32_t s = 0; s < memory_.span_count; ++s) {
        aim(memory_.spans[s], first);
        first += memory_.spans[s].end - memory_.spans[s].begin;
    }
    for (uint32_t i = 0; i < memory_.count; ++i) memory_.sane[i] &= memory_.sane_ray[i];
}

void ProgramAnswers::aim(const Span& span, uint32_t first) const {
    auto& [x, y, z] = memory_.ray_direction;
    float scale[kPadded];
    uint32_t odd = 0;
    for (uint32_t i = span.begin; i < span.end; ++i) {
        const uint32_t k = first + i - span.begin;
        const float* const* const own = hits_.direction;
        const float own_square =
            own[0][i] * own[0][i] + own[1][i] * own[1][i] + own[2][i] * own[2][i];
        const float square = x[k] * x[k] + y[k] * y[k] + z[k] * z[k];
        odd |= is_tame(square) ? 0u : 1u;
        scale[k] = std::sqrt(own_square / square);
    }
    for (uint32_t k = first; odd && k < first + (span.end - span.begin); ++k) {
        const Vec3 asked = at(memory_.ray_direction, k);
        if (is_tame(glm::dot(asked, asked)) || at(memory_.ray_weight, k) == Vec3(0)) continue;
        const math::Vec3d wide(asked);
        const double length = std::sqrt(glm::dot(wide, wide));
        const Vec3 own = at(hits_.direction, span.begin + (k - first));
        const bool has_way = length > 0 && std::isfinite(length);
        memory_.sane_ray[k] &= has_way ? 1u : 0u;
        const Vec3 unit = has_way ? Vec3(wide / length) : Vec3(0);
        for (int c = 0; c < 3; ++c) {
            memory_.ray_direction[c][k] = unit[c];
            if (!has_way) memory_.ray_weight[c][k] = 0;
        }
        scale[k] = std::sqrt(glm::dot(own, own));
    }
    for (Lanes& lanes : memory_.ray_direction)
        for (uint32_t k = first; k < first + (span.end - span.begin); ++k) lanes[k] *= scale[k];
}

// Of translucent surfaces a program shades a part.
void ProgramAnswers::cover() const {
    uint32_t first = 0;
    for (uint32_t r = 0; r < memory_.run_count; ++r) {
        const TriangleRun& run = scratch_.surface.runs[memory_.runs[r]];
        const geometry::TriangleInfo info = trace::info(snapshot_.world, hits_.triangle[run.begin]);
        const scene::Snapshot::Mesh& mesh = snapshot_.meshes[info.mesh];
        const uint32_t count = run.end - run.begin;
        if (snapshot_.material_of(mesh, info.primitive).is_translucent())
            for (int k = 0; k < 3; ++k)
                for (uint32_t i = 0; i < count; ++i) {
                    memory_.radiance[k][first + i] *= rays_->split.cover[run.begin + i];
                    memory_.ray_weight[k][first + i] *= rays_->split.cover[run.begin + i];
                }
        first += count;
    }
}

bool ProgramAnswers::any_ray() const {
    float most = 0;
    for (const Lanes& lanes : memory_.ray_weight)
        for (uint32_t i = 0; i < memory_.count; ++i) most = std::max(most, lanes[i]);
    return most > 0;
}

void ProgramAnswers::add_ambient() const {
    for (int k = 0; k < 3; ++k)
        for (uint32_t i = 0; i < memory_.count; ++i)
            memory_.radiance[k][i] += memory_.ray_weight[k][i] * snapshot_.environment.ambient[k];
}

// Beside what mirrors send on: a surface with a program is none.
void ProgramAnswers::send() const {
    if (!rays_->split.any) rays_->split.clear();
    SplitRays::Branch& out = rays_->split.mirrored;
    uint32_t first = 0;
    for (uint32_t s = 0; s < memory_.span_count; ++s) {
        const auto [begin, end] = memory_.spans[s];
        const uint32_t count = end - begin;
        for (int k = 0; k < 3; ++k) {
            std::copy_n(scratch_.surface.position[k] + begin, count, out.origin[k] + begin);
            std::copy_n(memory_.ray_direction[k] + first, count, out.direction[k] + begin);
            std::copy_n(memory_.ray_weight[k] + first, count, out.weight[k] + begin);
        }
        std::copy_n(rays_->media + begin, count, out.media + begin);
        first += count;
    }
    send_through();
}

// Those begin beyond the surface that go through it: as surface.position, on the far side.
void ProgramAnswers::send_through() const {
    SplitRays::Branch& out = rays_->split.mirrored;
    TriangleShading triangle;
    for (uint32_t r = 0; r < memory_.run_count; ++r) {
        const TriangleRun& run = scratch_.surface.runs[memory_.runs[r]];
        bool is_known = false;
        for (uint32_t i = run.begin; i < run.end; ++i) {
            if (!(glm::dot(at(out.direction, i), at(scratch_.surface.geometric, i)) < 0)) continue;
            if (!is_known)
                gather(snapshot_, 0, hits_.triangle[i], hits_.back_face[i] != 0, space_, triangle);
            is_known = true;
            const float u = hits_.u[i], v = hits_.v[i];
            const Vec3 place = triangle.vertex[0] * (1.0f - u - v) + triangle.vertex[1] * u
                               + triangle.vertex[2] * v;
            for (int k = 0; k < 3; ++k) out.origin[k][i] = place[k] - triangle.lift[k];
        }
    }
}

} // namespace peregrine::shade
