#include "sound/mixer.h"

#include <chrono>
#include <cstdlib>
#include <thread>

#include <gtest/gtest.h>

#include "gameplay/three_cores/game.h"

using namespace host::sound;
using peregrine::three_cores::Event;
using peregrine::three_cores::Sound;
using Clock = std::chrono::steady_clock;

namespace {

template <class Condition>
bool comes_true(const Condition& condition) {
    const auto limit = Clock::now() + std::chrono::seconds(30);
    while (Clock::now() < limit) {
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
}

// A round of everything; returns the longest call in seconds.
double use(Mixer& mixer) {
    double longest = 0.0;
    for (int i = 0; i < 200; ++i) {
        const auto begin = Clock::now();
        std::vector<Event> events;
        for (uint32_t sound = 0; sound <= static_cast<uint32_t>(Sound::lost); ++sound)
            events.push_back({static_cast<Sound>(sound), {1.0 * i, 0.0, -2.0}, 0.7});
        mixer.play(Listener{}, events);
        mixer.play(MenuSound::moved);
        mixer.play(MenuSound::chosen);
        mixer.set_volume(0.01 * i);
        mixer.set_mood(0.01 * i, i % 2 == 0);
        longest = std::max(longest, std::chrono::duration<double>(Clock::now() - begin).count());
    }
    return longest;
}

// OpenAL reads its environment once in a process: ctest starts one for each test.
TEST(Mixer, PlaysWithoutLoudspeakers) {
    setenv("ALSOFT_DRIVERS", "null", 1);
    Mixer mixer;
    EXPECT_TRUE(comes_true([&] { return !mixer.silent(); }));
    EXPECT_LT(use(mixer), 1.0);
    EXPECT_FALSE(mixer.take_note());
}

TEST(Mixer, IsSilentWithoutADeviceAndSaysSoOnce) {
    setenv("ALSOFT_DRIVERS", "no_such_driver", 1);
    Mixer mixer;
    use(mixer);
    std::optional<std::string> note;
    EXPECT_TRUE(comes_true([&] { return (note = mixer.take_note()).has_value(); }));
    EXPECT_NE(note.value_or("").find("no sound"), std::string::npos);
    EXPECT_TRUE(mixer.silent());
    EXPECT_FALSE(mixer.take_note());
    use(mixer);
}

TEST(Mixer, CanBeClosedAtOnce) {
    setenv("ALSOFT_DRIVERS", "null", 1);
    for (int i = 0; i < 3; ++i) {
        const auto begin = Clock::now();
        { Mixer mixer; }
        EXPECT_LT(Clock::now() - begin, std::chrono::seconds(4));
    }
}

} // namespace
