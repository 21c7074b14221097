#pragma once

#include <cstdint>
#include <vector>

namespace host::sound {

constexpr int sample_rate = 44100;

// Rises for `attack` seconds, then falls to a 1000th in `decay` seconds.
struct Envelope {
    double attack = 0.002, decay = 0.2;
    double at(double seconds) const;
};

// A frequency that glides from one to another, evenly in pitch, over the length of a sound.
struct Glide {
    double from = 440.0, to = 440.0; // Hz
    double at(double fraction) const;
};

enum class Shape { sine, triangle, saw, square };
enum class Pass { low, band, high };

struct Filter {
    Pass pass = Pass::low;
    Glide cutoff{};
    double resonance = 0.7; // Q
};

// One channel of sound that tones and noises are added to. The same samples for the same calls.
class Track {
public:
    explicit Track(double seconds);

    void add_tone(double start, double length, const Glide& pitch, const Envelope& envelope,
                  double gain, Shape shape = Shape::sine);
    void add_noise(double start, double length, const Filter& filter, const Envelope& envelope,
                   double gain);
    // A struck bar or bell: partials that are no harmonics, higher ones die sooner.
    void add_bell(double start, double pitch, double decay, double gain);

    // Through tanh: louder and rougher with `gain`.
    void drive(double gain);
    // Makes the end run into the beginning: the last seconds are blended over the first.
    void make_loop(double blend_seconds);

    // Scaled so that the loudest sample has this height. What is no loop ends in silence.
    std::vector<int16_t> finish(double peak, bool loop = false);

    const std::vector<float>& samples() const { return samples_; }

private:
    double noise(); // -1 to 1

    std::vector<float> samples_;
    uint32_t seed_ = 1;
};

} // namespace host::sound
