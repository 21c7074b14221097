#include "shade/material/roughness.h"

#include "shade/material/highlight.h"

#include <algorithm>

namespace peregrine::shade {
namespace {

GainTable make_gain_table() {
    GainTable table;
    for (uint32_t i = 0; i <= GainTable::kCells; ++i) {
        const float part = float(i) / float(GainTable::kCells);
        table.gain[i] =
            highlight_gain(shininess_of(kLeastRoughness + part * (1 - kLeastRoughness)));
    }
    return table;
}

} // namespace

float shininess_of(float roughness) {
    const float r = std::max(roughness, kLeastRoughness), square = r * r;
    return std::min(std::max(2.0f / (square * square) - 2.0f, 1.0f), kMostShininess);
}

const GainTable& gain_table() {
    static const GainTable table = make_gain_table();
    return table;
}

} // namespace peregrine::shade
