#pragma once

// How light fades with distance: illuminance = intensity f(d), with R the light's radius, x = d / R
// and nothing from x = 1 on. The exact law is f = 1 / d^2; a radius without end has it whole.
//     inverse square             1 / d^2
//     windowed inverse square    (1 - x^4) / d^2               (glTF, KHR_lights_punctual)
//     Schlick x linear           K (1 - x)^2 / (1 + N x) / R^2
//     cosine x linear            K cos^2(pi x / 2) (1 - x) / R^2
//     linear                     K (1 - x) / R^2
// The last three are those of Arauna (Bikker 2007, section 3.2.1): Schlick x linear is his rational
// stand-in for the lobe of cosine x linear. They are finite at the light and need no root of their
// own. K and N are the minimax fits of log f to log 1 / d^2 over x in [0.1, 0.8]; the cosine's
// power of two is the best of all powers. They are within these factors of 1 / d^2 there; each
// meets it at no more points than it has freedoms, so none can do better.
namespace peregrine::scene {

struct PaperFalloff {
    float gain;  // K
    float error; // largest factor of error for x in [0.1, 0.8]
};

inline constexpr PaperFalloff kSchlickLinear{93.01f, 1.923f};
inline constexpr float kSchlickBend = 4.47f; // N
inline constexpr PaperFalloff kCosineLinear{42.054f, 2.709f};
inline constexpr PaperFalloff kLinear{27.386f, 4.058f};

// cos(pi x / 2) = (1 - y) (1 + y (c0 + y (c1 + y c2))) with y = x^2, within 2.5e-7 of itself for x
// in [0, 1].
inline constexpr float kCosine[] = {-0.23369591f, 0.01994146f, -0.00084758f};

// Lux that no lamp exceeds, however near: a million suns at arm's length, and far from where sums
// of floats overflow.
inline constexpr float kBrightest = 1e20f;

} // namespace peregrine::scene
