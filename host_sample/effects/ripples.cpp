#include "ripples.h"

#include <cmath>

namespace host {

namespace {

struct Wave {
    float x, z;         // its way, times waves a metre
    float beat, height; // waves a second; how far it tilts the surface
};
constexpr Wave waves[] = {{1.9f, 0.7f, 0.9f, 0.05f},
                          {-0.8f, 2.3f, 1.2f, 0.04f},
                          {-3.1f, -1.9f, 1.7f, 0.03f},
                          {4.7f, -3.4f, 2.3f, 0.02f}};
constexpr float head_on = 0.02f; // what water mirrors head on, by its index of 1.33
constexpr float clarity = 0.5f;  // how much of a matt surface there is in it

// A wave from parabolas, of period 1 and height 1: without a library's sine it is the same on every
// machine.
float swing(float x) {
    const float part = x - std::floor(x);
    const float half = part < 0.5f ? part : part - 0.5f;
    const float hill = 16.0f * half * (0.5f - half);
    return part < 0.5f ? hill : -hill;
}

glm::vec3 at(const float* const (&lanes)[3], uint32_t i) {
    return {lanes[0][i], lanes[1][i], lanes[2][i]};
}

void put(const glm::vec3& value, float* const (&lanes)[3], uint32_t i) {
    for (int k = 0; k < 3; ++k) lanes[k][i] = value[k];
}

} // namespace

rt_program Ripples::add_to(const Stage& stage) {
    rt_program_desc desc = rt_default_program_desc();
    desc.fields = RT_PROGRAM_POSITION | RT_PROGRAM_GEOMETRIC_NORMAL | RT_PROGRAM_SHADING_NORMAL
                  | RT_PROGRAM_DIRECTION | RT_PROGRAM_BASE_COLOR | RT_PROGRAM_DIFFUSE
                  | RT_PROGRAM_HIGHLIGHT | RT_PROGRAM_RAYS;
    desc.shade = &Ripples::shade;
    desc.user = this;
    rt_program program{};
    stage.check(stage.api().add_program(stage.scene(), &desc, &program), "adding water");
    return program;
}

void Ripples::shade(void* user, const rt_program_batch* batch) {
    const auto seconds =
        static_cast<float>(std::fmod(static_cast<Ripples*>(user)->seconds_, 600.0));
    for (uint32_t i = 0; i < batch->count; ++i) {
        const glm::vec3 place = at(batch->position, i), way = at(batch->direction, i);
        glm::vec3 normal = at(batch->shading_normal, i);
        for (const Wave& wave : waves) {
            const float tilt =
                wave.height * swing(wave.x * place.x + wave.z * place.z - wave.beat * seconds);
            const float length = std::sqrt(wave.x * wave.x + wave.z * wave.z);
            normal += glm::vec3(wave.x, 0.0f, wave.z) * (tilt / length);
        }
        normal = normal / std::sqrt(glm::dot(normal, normal));
        const float cosine = std::max(-glm::dot(way, normal), 0.05f);
        glm::vec3 mirrored = way + (2.0f * cosine) * normal;
        const glm::vec3 side = at(batch->geometric_normal, i);
        const float below = glm::dot(mirrored, side);
        if (below < 0.02f) mirrored += (0.02f - below) * side; // never through the surface
        const float rest = 1.0f - cosine, square = rest * rest;
        const float part = head_on + (1.0f - head_on) * square * square * rest;
        const glm::vec3 matt = at(batch->base_color, i) * at(batch->diffuse, i);
        put((clarity * (1.0f - part)) * matt + at(batch->highlight, i), batch->radiance, i);
        put(mirrored, batch->ray_direction, i);
        put(glm::vec3(part), batch->ray_weight, i);
    }
}

} // namespace host
