#pragma once

#include "shade/surface/surface.h"

#include <algorithm>
#include <cstdint>

namespace peregrine::shade {

// Which lights a point sees: neighbours are compared by it, and told by it what is known. Lights go
// by their slots (LightSlots).
struct LightMarks {
    static constexpr uint32_t kLights = 128; // of those without a slot only a sum is kept

    uint64_t lit[kLights / 64]{};  // seen, where they reach the point at all
    uint64_t dark[kLights / 64]{}; // something is in between
    uint64_t later = 0;            // of the others that are seen

    void see(uint32_t light) {
        if (light < kLights)
            lit[light / 64] |= uint64_t(1) << light % 64;
        else
            later += (light + uint64_t(1)) * 0x9e3779b97f4a7c15u;
    }
    void miss(uint32_t light) {
        if (light < kLights) dark[light / 64] |= uint64_t(1) << light % 64;
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

// Slots for the first lights that reach a tile, in the order in which they are met.
class LightSlots {
public:
    void clear() {
        std::fill_n(keys_, kPlaces, kFree);
        count_ = 0;
    }

    // Beyond LightMarks::kLights if it has none.
    uint32_t of(uint32_t light) {
        uint32_t place = light * 0x9e3779b9u >> (32 - kLogPlaces);
        for (; keys_[place] != light; place = (place + 1) % kPlaces)
            if (keys_[place] == kFree) {
                if (count_ == LightMarks::kLights) return LightMarks::kLights + light;
                keys_[place] = light;
                slots_[place] = uint8_t(count_++);
                break;
            }
        return slots_[place];
    }

private:
    static constexpr uint32_t kLogPlaces = 8, kPlaces = 1u << kLogPlaces, kFree = ~0u;
    static_assert(kPlaces > LightMarks::kLights);

    uint32_t keys_[kPlaces];
    uint8_t slots_[kPlaces];
    uint32_t count_;
};

// Beside the points of a batch.
struct BatchMarks {
    LightSlots* slots; // of its tile

    // What neighbours know, 32 slots to a word: lights that are seen, and that are not.
    static constexpr uint32_t kWords = LightMarks::kLights / 32;
    uint32_t known_lit[kWords][kBatch];
    uint32_t known_dark[kWords][kBatch];
    bool any_known;

    bool finds; // whether `found` is wanted
    LightMarks found[kBatch];
    uint8_t traced[kBatch]; // so many rays were, up to 255

    void know(uint32_t point, const LightMarks& marks) {
        for (uint32_t word = 0; word < kWords; ++word) {
            known_lit[word][point] = uint32_t(marks.lit[word / 2] >> word % 2 * 32);
            known_dark[word][point] = uint32_t(marks.dark[word / 2] >> word % 2 * 32);
        }
        any_known = true;
    }
    void know_nothing(uint32_t point) {
        for (uint32_t word = 0; word < kWords; ++word)
            known_lit[word][point] = known_dark[word][point] = 0;
    }
};

} // namespace peregrine::shade
