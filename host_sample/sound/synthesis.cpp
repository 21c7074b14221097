#include "sound/synthesis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace host::sound {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double step = 1.0 / sample_rate;

size_t samples_in(double seconds) {
    return static_cast<size_t>(std::max(0.0, seconds) * sample_rate);
}

double wave(Shape shape, double phase) { // phase in turns
    const double turn = phase - std::floor(phase);
    switch (shape) {
    case Shape::triangle:
        return 4.0 * std::abs(turn - 0.5) - 1.0;
    case Shape::saw:
        return 2.0 * turn - 1.0;
    case Shape::square:
        return turn < 0.5 ? 0.6 : -0.6;
    default:
        return std::sin(2.0 * pi * phase);
    }
}

// The state variable filter with trapezoidal integrators (V. Zavalishin, The Art of VA Filter
// Design, 2012): stays stable while its frequency glides.
class StateVariable {
public:
    double run(const Filter& filter, double fraction, double input) {
        const double cutoff = std::clamp(filter.cutoff.at(fraction), 10.0, 0.45 * sample_rate);
        const double g = std::tan(pi * cutoff * step), k = 1.0 / filter.resonance;
        const double high = (input - (g + k) * first_ - second_) / (1.0 + g * (g + k));
        const double band = g * high + first_, low = g * band + second_;
        first_ = g * high + band;
        second_ = g * band + low;
        return filter.pass == Pass::low ? low : filter.pass == Pass::band ? k * band : high;
    }

private:
    double first_ = 0.0, second_ = 0.0;
};

} // namespace

double Envelope::at(double seconds) const {
    if (seconds < attack) return seconds / attack;
    return std::exp(-6.9 * (seconds - attack) / decay);
}

double Glide::at(double fraction) const {
    return from * std::pow(to / from, fraction);
}

Track::Track(double seconds) : samples_(samples_in(seconds), 0.0f) {}

double Track::noise() {
    seed_ = seed_ * 1664525u + 1013904223u; // Numerical Recipes: good enough to be heard
    return static_cast<double>(static_cast<int32_t>(seed_)) / 2147483648.0;
}

void Track::add_tone(double start, double length, const Glide& pitch, const Envelope& envelope,
                     double gain, Shape shape) {
    const size_t first = samples_in(start), count = samples_in(length);
    double phase = 0.0;
    for (size_t i = 0; i < count && first + i < samples_.size(); ++i) {
        phase += pitch.at(static_cast<double>(i) / static_cast<double>(count)) * step;
        samples_[first + i] += static_cast<float>(gain * envelope.at(static_cast<double>(i) * step)
                                                  * wave(shape, phase));
    }
}

void Track::add_noise(double start, double length, const Filter& filter, const Envelope& envelope,
                      double gain) {
    const size_t first = samples_in(start), count = samples_in(length);
    StateVariable state;
    for (size_t i = 0; i < count && first + i < samples_.size(); ++i) {
        const double fraction = static_cast<double>(i) / static_cast<double>(count);
        samples_[first + i] += static_cast<float>(gain * envelope.at(static_cast<double>(i) * step)
                                                  * state.run(filter, fraction, noise()));
    }
}

void Track::add_bell(double start, double pitch, double decay, double gain) {
    struct Partial {
        double pitch, gain, decay;
    };
    constexpr std::array<Partial, 5> partials = {{{1.0, 1.0, 1.0},
                                                  {2.0, 0.35, 0.7},
                                                  {2.76, 0.3, 0.5},
                                                  {5.4, 0.16, 0.28},
                                                  {8.93, 0.07, 0.14}}};
    for (const Partial& partial : partials)
        add_tone(start, 1.2 * decay, {pitch * partial.pitch, pitch * partial.pitch},
                 {0.003, decay * partial.decay}, gain * partial.gain);
}

void Track::drive(double gain) {
    for (float& sample : samples_) sample = static_cast<float>(std::tanh(gain * sample));
}

void Track::make_loop(double blend_seconds) {
    const size_t blend = std::min(samples_in(blend_seconds), samples_.size() / 2);
    const size_t kept = samples_.size() - blend;
    for (size_t i = 0; i < blend; ++i) {
        // Noises are not alike at both ends: their powers add up, not their heights.
        const double turn = 0.5 * pi * static_cast<double>(i) / static_cast<double>(blend);
        samples_[i] =
            static_cast<float>(samples_[i] * std::sin(turn) + samples_[kept + i] * std::cos(turn));
    }
    samples_.resize(kept);
}

std::vector<int16_t> Track::finish(double peak, bool loop) {
    float loudest = 1e-9f;
    for (const float sample : samples_) loudest = std::max(loudest, std::abs(sample));
    const size_t fade = loop ? 0 : std::min(samples_in(0.01), samples_.size());
    std::vector<int16_t> finished(samples_.size());
    for (size_t i = 0; i < samples_.size(); ++i) {
        const size_t left = samples_.size() - 1 - i;
        const double faded =
            left < fade ? static_cast<double>(left) / static_cast<double>(fade) : 1.0;
        finished[i] = static_cast<int16_t>(
            std::lround(32767.0 * peak * faded * static_cast<double>(samples_[i] / loudest)));
    }
    return finished;
}

} // namespace host::sound
