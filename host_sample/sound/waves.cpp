#include "sound/waves.h"

#include <array>

#include "sound/synthesis.h"

namespace host::sound {

namespace {

constexpr Glide still(double pitch) {
    return {pitch, pitch};
}

std::vector<int16_t> step() { // a soft sole on stone
    Track track(0.16);
    track.add_tone(0.0, 0.1, {120.0, 62.0}, {0.002, 0.09}, 0.8);
    track.add_noise(0.0, 0.12, {Pass::low, {1300.0, 350.0}}, {0.001, 0.07}, 0.9);
    track.add_noise(0.035, 0.1, {Pass::band, {2600.0, 1900.0}, 1.2}, {0.004, 0.06}, 0.25);
    return track.finish(0.5);
}

std::vector<int16_t> jump() {
    Track track(0.3);
    track.add_noise(0.0, 0.25, {Pass::band, {380.0, 1100.0}, 1.1}, {0.05, 0.18}, 1.0);
    track.add_tone(0.0, 0.09, {90.0, 140.0}, {0.004, 0.08}, 0.4);
    return track.finish(0.4);
}

std::vector<int16_t> land() {
    Track track(0.35);
    track.add_tone(0.0, 0.25, {130.0, 42.0}, {0.001, 0.2}, 1.0);
    track.add_noise(0.0, 0.2, {Pass::low, {1800.0, 200.0}}, {0.001, 0.13}, 1.1);
    return track.finish(0.75);
}

std::vector<int16_t> fling() {
    Track track(0.35);
    track.add_noise(0.0, 0.3, {Pass::band, {350.0, 2400.0}, 1.6}, {0.1, 0.2}, 1.0);
    return track.finish(0.5);
}

std::vector<int16_t> bounce() { // iron on stone
    Track track(0.35);
    track.add_bell(0.0, 1650.0, 0.16, 0.5);
    track.add_bell(0.0, 2310.0, 0.1, 0.3);
    track.add_noise(0.0, 0.03, {Pass::high, still(2500.0)}, {0.0005, 0.02}, 0.8);
    return track.finish(0.6);
}

std::vector<int16_t> blast() {
    Track track(1.9);
    track.add_noise(0.0, 0.08, {Pass::high, still(900.0)}, {0.0005, 0.06}, 1.2);
    track.add_noise(0.0, 1.8, {Pass::low, {4200.0, 70.0}, 0.8}, {0.003, 1.5}, 2.2);
    track.add_tone(0.0, 1.1, {92.0, 27.0}, {0.002, 1.0}, 1.6);
    for (const double echo : {0.21, 0.37, 0.58}) // the walls answer
        track.add_noise(echo, 0.7, {Pass::low, {900.0, 120.0}}, {0.03, 0.5}, 0.5);
    track.drive(1.4);
    return track.finish(1.0);
}

std::vector<int16_t> core() {
    Track track(1.9);
    constexpr std::array pitches = {659.26, 987.77, 1318.51};
    for (size_t i = 0; i < pitches.size(); ++i)
        track.add_bell(0.09 * static_cast<double>(i), pitches[i], 1.4, 0.7);
    track.add_tone(0.0, 1.6, {164.81, 164.81}, {0.3, 1.2}, 0.4, Shape::triangle);
    return track.finish(0.8);
}

std::vector<int16_t> noticed() {
    Track track(0.42);
    track.add_tone(0.0, 0.13, {520.0, 640.0}, {0.008, 0.12}, 0.8, Shape::triangle);
    track.add_tone(0.15, 0.22, {780.0, 880.0}, {0.008, 0.2}, 1.0, Shape::triangle);
    track.add_tone(0.15, 0.22, {1562.0, 1758.0}, {0.008, 0.12}, 0.2);
    return track.finish(0.7);
}

std::vector<int16_t> alarm() {
    Track track(1.15);
    for (int i = 0; i < 6; ++i) {
        const double pitch = i % 2 == 0 ? 784.0 : 587.33, start = 0.17 * i;
        track.add_tone(start, 0.16, still(pitch), {0.006, 0.45}, 0.7, Shape::square);
        track.add_tone(start, 0.16, still(1.006 * pitch), {0.006, 0.4}, 0.5, Shape::saw);
    }
    track.drive(0.9);
    return track.finish(0.75);
}

std::vector<int16_t> shot() {
    Track track(0.5);
    track.add_tone(0.0, 0.34, {2300.0, 120.0}, {0.001, 0.26}, 0.8, Shape::saw);
    track.add_tone(0.0, 0.34, {1150.0, 70.0}, {0.001, 0.3}, 0.7, Shape::square);
    track.add_noise(0.0, 0.2, {Pass::band, {5200.0, 900.0}, 1.4}, {0.0005, 0.14}, 0.9);
    track.drive(1.3);
    return track.finish(0.85);
}

std::vector<int16_t> hurt() {
    Track track(0.6);
    track.add_tone(0.0, 0.3, {150.0, 46.0}, {0.001, 0.28}, 1.2);
    track.add_tone(0.0, 0.5, {233.0, 196.0}, {0.004, 0.4}, 0.4, Shape::saw);
    track.add_tone(0.0, 0.5, {247.0, 185.0}, {0.004, 0.4}, 0.4, Shape::saw);
    track.add_noise(0.0, 0.1, {Pass::low, {3000.0, 300.0}}, {0.001, 0.08}, 1.0);
    track.drive(1.2);
    return track.finish(0.9);
}

std::vector<int16_t> door() { // dry hinges, then wood on stone
    Track track(1.1);
    for (int i = 0; i < 26; ++i) { // the hinge sticks and slips
        const double way = i / 26.0, start = 0.72 * way + 0.006 * ((i * 7) % 4);
        track.add_noise(start, 0.05, {Pass::band, {520.0 + 260.0 * way, 480.0 + 300.0 * way}, 9.0},
                        {0.002, 0.045}, 0.5 + 0.5 * way);
    }
    track.add_tone(0.8, 0.22, {105.0, 58.0}, {0.002, 0.18}, 0.9);
    track.add_noise(0.8, 0.2, {Pass::low, {900.0, 200.0}}, {0.001, 0.12}, 0.8);
    return track.finish(0.65);
}

std::vector<int16_t> lift() {
    Track track(1.6);
    for (const double pitch : {49.0, 98.6, 147.0, 196.9})
        track.add_tone(0.0, 1.6, {pitch * 0.8, pitch}, {0.35, 1.9}, 0.5, Shape::triangle);
    track.add_noise(0.0, 1.6, {Pass::band, {160.0, 260.0}, 2.5}, {0.3, 1.6}, 0.6);
    track.add_noise(0.0, 0.1, {Pass::low, {1200.0, 300.0}}, {0.001, 0.08}, 1.0);
    return track.finish(0.6);
}

std::vector<int16_t> gate() { // a chain runs over a wheel, iron rises
    Track track(2.4);
    for (int i = 0; i < 15; ++i) {
        const double start = 0.13 * i + 0.008 * ((i * 5) % 3);
        track.add_bell(start, 610.0 + 45.0 * ((i * 3) % 4), 0.12, 0.35);
        track.add_noise(start, 0.05, {Pass::band, still(1800.0), 2.0}, {0.001, 0.04}, 0.6);
    }
    track.add_noise(0.0, 2.2, {Pass::low, {130.0, 210.0}, 1.5}, {0.4, 2.4}, 1.6);
    track.add_tone(2.02, 0.35, {84.0, 38.0}, {0.001, 0.3}, 1.1);
    return track.finish(0.85);
}

std::vector<int16_t> disabled() {
    Track track(1.4);
    track.add_tone(0.0, 1.1, {860.0, 46.0}, {0.004, 1.3}, 0.7, Shape::saw);
    track.add_tone(0.0, 1.1, {1290.0, 60.0}, {0.004, 0.8}, 0.3, Shape::square);
    for (int i = 0; i < 9; ++i) // sparks
        track.add_noise(0.05 + 0.11 * i + 0.02 * ((i * 5) % 3), 0.03, {Pass::high, still(3200.0)},
                        {0.0005, 0.025}, 0.8);
    track.add_tone(1.1, 0.25, {95.0, 44.0}, {0.001, 0.2}, 1.0);
    track.drive(1.1);
    return track.finish(0.75);
}

std::vector<int16_t> won() {
    Track track(3.4);
    constexpr std::array pitches = {523.25, 659.26, 783.99, 1046.5};
    for (size_t i = 0; i < pitches.size(); ++i) {
        const double start = 0.16 * static_cast<double>(i);
        track.add_bell(start, pitches[i], 2.0, 0.6);
        track.add_tone(start, 2.6, still(0.5 * pitches[i]), {0.25, 2.2}, 0.3, Shape::triangle);
    }
    return track.finish(0.8);
}

std::vector<int16_t> lost() {
    Track track(2.8);
    constexpr std::array pitches = {440.0, 349.23, 293.66, 220.0};
    for (size_t i = 0; i < pitches.size(); ++i) {
        const double start = 0.26 * static_cast<double>(i);
        track.add_tone(start, 1.6, still(pitches[i]), {0.02, 1.3}, 0.5, Shape::triangle);
        track.add_tone(start, 1.6, still(0.502 * pitches[i]), {0.05, 1.5}, 0.5);
    }
    track.add_tone(0.0, 2.6, {65.4, 49.0}, {0.2, 2.6}, 0.7);
    return track.finish(0.8);
}

std::vector<int16_t> menu_moved() {
    Track track(0.06);
    track.add_tone(0.0, 0.05, still(1175.0), {0.002, 0.045}, 0.8, Shape::triangle);
    return track.finish(0.25);
}

std::vector<int16_t> menu_chosen() {
    Track track(0.25);
    track.add_tone(0.0, 0.08, still(784.0), {0.002, 0.08}, 0.8, Shape::triangle);
    track.add_tone(0.06, 0.18, still(1175.0), {0.002, 0.15}, 1.0, Shape::triangle);
    return track.finish(0.35);
}

std::vector<int16_t> night() { // wind in the arches, far crickets
    Track track(14.0);
    track.add_noise(0.0, 14.0, {Pass::band, {210.0, 260.0}, 1.4}, {3.0, 90.0}, 1.0);
    track.add_noise(2.0, 9.0, {Pass::band, {330.0, 520.0}, 3.5}, {4.0, 16.0}, 0.6);
    track.add_noise(6.5, 7.0, {Pass::band, {480.0, 300.0}, 4.0}, {3.0, 12.0}, 0.5);
    for (int i = 0; i < 7; ++i)
        for (int chirp = 0; chirp < 3; ++chirp)
            track.add_tone(0.9 + 1.7 * i + 0.31 * ((i * 3) % 5) + 0.055 * chirp, 0.045,
                           still(4150.0 + 60.0 * (i % 3)), {0.012, 0.05}, 0.03);
    track.make_loop(2.0);
    return track.finish(0.5, true);
}

std::vector<int16_t> tension() { // a heart that beats twice a second over a low string
    Track track(4.5);
    for (int beat = 0; beat < 9; ++beat) {
        track.add_tone(0.5 * beat, 0.2, {74.0, 44.0}, {0.004, 0.18}, 1.0);
        track.add_tone(0.5 * beat + 0.16, 0.16, {66.0, 42.0}, {0.004, 0.14}, 0.6);
    }
    track.add_tone(0.0, 4.5, still(55.0), {0.4, 60.0}, 0.22, Shape::saw);
    track.add_tone(0.0, 4.5, still(58.25), {0.4, 60.0}, 0.16, Shape::saw);
    track.make_loop(0.5);
    return track.finish(0.6, true);
}

constexpr std::array<std::vector<int16_t> (*)(), wave_count> recipes = {
    step, jump, land, fling,    bounce, blast, core,       noticed,     alarm, shot,   hurt,
    door, lift, gate, disabled, won,    lost,  menu_moved, menu_chosen, night, tension};

} // namespace

std::vector<int16_t> make_wave(Wave wave) {
    return recipes.at(static_cast<size_t>(wave))();
}

} // namespace host::sound
