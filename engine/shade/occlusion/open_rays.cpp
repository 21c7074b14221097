#include "shade/occlusion/open_rays.h"

#include <cmath>

namespace peregrine::shade {
namespace {

using math::Vec3;

// Turns and lengths go on by 1 / p and 1 / p^2, p^3 = p + 1.
struct Turn {
    double cosine, sine;
};
constexpr Turn kTurn{0.030642483513659977, -0.9995304088441307}; // 1 / p
constexpr double kLengthStep = 0.5698402909980532;

// Where lengths do not count, by the golden ratio, which is the farthest from all fractions: 1 / p
// is near 37 / 49, and so leaves spiral arms (Vogel, "A better way to construct the sunflower
// head", 1979).
constexpr Turn kGoldenTurn{-0.7373688780783197, -0.6754902942615238};

// Whom the frames turn with.
constexpr Vec3 kPole{-19.0f / 39, 26.0f / 39, 22.0f / 39};
constexpr Vec3 kAcross{-34.0f / 39, -13.0f / 39, -14.0f / 39};
constexpr Vec3 kAlong{-2.0f / 39, -26.0f / 39, 29.0f / 39};
constexpr float kOpposite = -0.99f; // cosine: nearer to that, as opposite normals

} // namespace

// Even on a disc, and from there up to the half of a sphere (Malley's method).
OpenRays::OpenRays(uint32_t count, bool has_end) : count_(count) {
    const Turn turn = has_end ? kTurn : kGoldenTurn;
    double cosine = 1, sine = 0, at = 0.5, places[kMostOpenRays];
    for (uint32_t k = 0; k < count; ++k) {
        const double square = (k + 0.5) / count, radius = std::sqrt(square);
        rays_[k].direction = {float(radius * cosine), float(radius * sine),
                              float(std::sqrt(1 - square))};
        places[k] = at;
        const double turned = cosine * turn.cosine - sine * turn.sine;
        sine = cosine * turn.sine + sine * turn.cosine;
        cosine = turned;
        at += kLengthStep;
        at -= std::floor(at);
    }
    for (uint32_t k = 0; k < count; ++k) {
        uint32_t shorter = 0;
        for (uint32_t other = 0; other < count; ++other) shorter += places[other] < places[k];
        rays_[k].length = (float(shorter) + 0.5f) / float(count);
    }
}

TangentFrame::TangentFrame(const Vec3& normal) {
    const float side = glm::dot(kPole, normal) < kOpposite ? -1.0f : 1.0f;
    const Vec3 turned = normal * side;
    const Vec3 half = (kPole + turned) / (1 + glm::dot(kPole, turned));
    x = kAcross - half * glm::dot(kAcross, turned);
    y = kAlong - half * glm::dot(kAlong, turned);
}

} // namespace peregrine::shade
