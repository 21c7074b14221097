#pragma once

#include <cstdint>
#include <vector>

#include "gameplay/three_cores/game.h"

namespace host::sound {

// What is heard: the game's sounds in their order, then those of the host.
enum class Wave : uint32_t {
    first_of_game = 0,
    menu_moved = static_cast<uint32_t>(peregrine::three_cores::Sound::lost) + 1,
    menu_chosen,
    night,  // a loop
    tension // a loop
};
constexpr uint32_t wave_count = static_cast<uint32_t>(Wave::tension) + 1;

constexpr Wave wave_of(peregrine::three_cores::Sound sound) {
    return static_cast<Wave>(sound);
}

constexpr bool is_loop(Wave wave) {
    return wave == Wave::night || wave == Wave::tension;
}

// One channel at sample_rate. Takes milliseconds, some of them many.
std::vector<int16_t> make_wave(Wave wave);

} // namespace host::sound
