#pragma once

#include "gameplay/world.h"

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

// A game as its inputs: played again from the same state they give the same game, bit for bit. A
// hash of the state after each tick tells where a replay goes astray.
namespace peregrine::gameplay {

// What the player does in one tick. Directions, not angles: the host turns the one into the other
// before it is recorded, since no two mathematical libraries agree on a sine.
struct TickInput {
    float walk[2]{};         // along x and z of the world, at most 1 long
    float view[3]{0, 0, -1}; // unit
    uint32_t buttons = 0;    // bits of the game's choice

    friend bool operator==(const TickInput&, const TickInput&) = default;
};

struct Tick {
    TickInput input;
    uint64_t hash = 0; // of the state after it

    friend bool operator==(const Tick&, const Tick&) = default;
};

struct Replay {
    uint32_t ticks_per_second = 60; // 1 to 1000
    uint64_t seed = 0;
    uint64_t level = 0; // what it was played in; the game's choice
    std::vector<Tick> ticks;

    friend bool operator==(const Replay&, const Replay&) = default;
};

// Plays all ticks; `play_tick` returns the hash of the state after one. Returns the number of the
// first tick whose hash is not the recorded one; ticks.size() if all are.
size_t play(const Replay& replay, const std::function<uint64_t(const TickInput&)>& play_tick);

// What is wrong with a file, in a sentence.
class ReplayError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// The file: little endian; "PRGNRPLY", then as u32 the version 1 and ticks_per_second, as u64 seed,
// level and the count of ticks; for each tick walk and view as f32, buttons as u32 and the hash as
// u64; in the end a u64 hash of all that.
std::vector<uint8_t> encode_replay(const Replay& replay);
Replay decode_replay(std::span<const uint8_t> bytes); // throws ReplayError

void save_replay(const Replay& replay, const std::string& path); // throws ReplayError
Replay load_replay(const std::string& path);                     // throws ReplayError

} // namespace peregrine::gameplay
