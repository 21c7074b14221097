#pragma once

// How light fades with distance: Arauna's "Schlick x linear" (section 3.2.1). With x = distance /
// radius, Schlick's rational curve of 1 - x times the line 1 - x:
//     f(x) = K (1 - x)^2 / (1 + (n - 1) x)
// stands in for 1 / x^2. It ends at x = 1 with no step and no slope, so a light beyond its radius
// can be dropped, and it is finite at 0. K and n are the minimax fit of log f to log 1/x^2 over x
// in [0.1, 0.8]: f is within a factor of 1.922 of 1/x^2 there (root mean square: a factor of
// 1.59). The shape can do no better: it meets 1/x^2 at three points (promise 4: the test measures
// it).
namespace peregrine::shade {

inline constexpr float kFalloffGain = 93.01f;  // K
inline constexpr float kFalloffBend = 4.47f;   // n - 1
inline constexpr float kFalloffError = 1.923f; // largest factor of error for x in [0.1, 0.8]

inline float falloff(float x) {
    if (!(x < 1.0f)) return 0.0f;
    return kFalloffGain * ((1.0f - x) * (1.0f - x)) / (1.0f + kFalloffBend * x);
}

} // namespace peregrine::shade
