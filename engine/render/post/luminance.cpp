#include "render/post/luminance.h"

#include "render/tile_buffers.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace peregrine::render::post {
namespace {

constexpr float kDarkest = 0x1p-10f;
constexpr uint32_t kRest = 17; // bits

// A float's exponent and the first six bits of its fraction.
constexpr uint32_t place_of(float value) {
    return std::bit_cast<uint32_t>(value) >> kRest;
}
constexpr float value_at(uint32_t place) {
    return std::bit_cast<float>(place << kRest);
}

} // namespace

void LuminanceCounts::add(float luminance) {
    const float value = luminance > kDarkest ? luminance : kDarkest; // no NaN, either
    ++counts_[std::min(place_of(value) - place_of(kDarkest), kOctaves * kInOctave - 1)];
}

void LuminanceCounts::add(const LuminanceCounts& other) {
    for (uint32_t i = 0; i < kOctaves * kInOctave; ++i) counts_[i] += other.counts_[i];
}

float LuminanceCounts::mean() const {
    double sum = 0, count = 0;
    for (uint32_t i = 0; i < kOctaves * kInOctave; ++i) {
        if (counts_[i] == 0) continue;
        const uint32_t place = place_of(kDarkest) + i;
        const double middle = std::sqrt(double(value_at(place)) * double(value_at(place + 1)));
        sum += counts_[i] * std::log(i == 0 ? double(kDarkest) : middle);
        count += counts_[i];
    }
    return count > 0 ? float(std::exp(sum / count)) : 0;
}

void count_luminance(const Plan&, TileBuffers& buffers) {
    const auto& [red, green, blue] = buffers.colors.channel;
    for (uint32_t i = 0; i < buffers.tile.count; ++i)
        buffers.luminance->add((0.2126f * red[i] + 0.7152f * green[i]) + 0.0722f * blue[i]);
}

} // namespace peregrine::render::post
