#pragma once

#include "shade/surface/surface.h"

#include <cstdint>

namespace peregrine::shade {

// Which lights a point sees: neighbours are compared by it, and told by it what is known.
struct LightMarks {
    static constexpr uint32_t kLights = 128; // the first ones; of later ones only a sum is kept

    uint64_t lit[kLights / 64]{};  // seen, where they reach the point at all
    uint64_t dark[kLights / 64]{}; // something is in between
    uint64_t later = 0;            // of the later ones that are seen
    bool traced = false;           // a ray was traced to find that out

    void see(uint32_t light) {
        if (light < kLights)
            lit[light / 64] |= uint64_t(1) << light % 64;
        else
            later += (light + uint64_t(1)) * 0x9e3779b97f4a7c15u;
    }
    void miss(uint32_t light) {
        if (light < kLights) dark[light / 64] |= uint64_t(1) << light % 64;
    }
    bool sees(uint32_t light) const { return light < kLights && lit[light / 64] >> light % 64 & 1; }
    bool misses(uint32_t light) const {
        return light < kLights && dark[light / 64] >> light % 64 & 1;
    }

    void join(const LightMarks& other) {
        for (uint32_t k = 0; k < kLights / 64; ++k) {
            lit[k] |= other.lit[k];
            dark[k] |= other.dark[k];
        }
    }
    // Whether no light is seen by some of those that were joined and missed by others.
    bool agree() const {
        uint64_t both = 0;
        for (uint32_t k = 0; k < kLights / 64; ++k) both |= lit[k] & dark[k];
        return both == 0;
    }
};

// Beside the points of a batch.
struct BatchMarks {
    LightMarks found[kBatch];
    const LightMarks* known[kBatch]; // what neighbours say; null: nothing
    bool any_known;
};

} // namespace peregrine::shade
