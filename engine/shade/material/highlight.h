#pragma once

#include <cmath>

// The highlight: Schlick, "A Fast Alternative to Phong's Specular Model", Graphics Gems IV, 1994.
//     S(t) = t / (n - n t + t),  t = the cosine between the mirrored view and the light
// replaces t^n. Its tail is longer than that of the power, so the usual (n + 2) / (2 pi) would
// overstate its energy up to sixfold; highlight_gain is the exact factor for this lobe.
namespace peregrine::shade {

inline float highlight(float t, float n) {
    return t > 0.0f ? t / (n - (n - 1.0f) * t) : 0.0f;
}

// 1 / (2 pi I), I = the integral of t S(t) over t in [0, 1]: seen head on, the highlight of a
// white specular colour gives back the light that came in.
inline float highlight_gain(float n) {
    const double a = double(n) - 1.0;
    double integral = 1.0 / 3.0; // the limit at n = 1
    if (a > 0.05)
        integral =
            (double(n) * double(n) * std::log(double(n)) / a - double(n)) / (a * a) - 0.5 / a;
    else
        integral += a * (1.0 / 4.0 - 1.0 / 3.0); // first order: within 0.1 % of the integral
    return float(1.0 / (6.283185307179586 * integral));
}

} // namespace peregrine::shade
