#include "sound/mixer.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "sound/player.h"

namespace host::sound {

namespace {

using peregrine::three_cores::Event;
using peregrine::three_cores::Sound;

constexpr size_t most_waiting = 64; // sounds: more at once are a din
constexpr auto patience = std::chrono::seconds(5);

bool is_everywhere(Sound sound) {
    return sound == Sound::won || sound == Sound::lost || sound == Sound::hurt
           || sound == Sound::core || sound == Sound::alarm;
}

} // namespace

struct Mixer::Shared {
    std::mutex mutex;
    std::condition_variable changed, ended;
    // Guarded by the mutex:
    bool dirty = false, done = false;
    Listener listener;
    double volume = 1.0;
    Loops loops;
    std::vector<Heard> waiting;
    std::optional<std::string> note;

    std::atomic<bool> silent{true}, quit{false};

    void add(const Heard& heard) {
        if (waiting.size() < most_waiting) waiting.push_back(heard);
        dirty = true;
    }

    void run();
    void serve(Player& player);
    void end(std::optional<std::string> cause);
};

void Mixer::Shared::serve(Player& player) {
    std::vector<Heard> heard;
    for (std::unique_lock lock(mutex);;) {
        changed.wait(lock, [this] { return dirty || quit; });
        if (quit) return;
        dirty = false;
        heard.clear();
        heard.swap(waiting);
        const Listener from = listener;
        const Loops gains = loops;
        const double gain = volume;
        lock.unlock();
        player.listen(from, gain);
        player.set_loops(gains);
        for (const Heard& sound : heard) player.play(sound);
        lock.lock();
    }
}

void Mixer::Shared::run() {
    std::string cause;
    try {
        const auto player = Player::open(quit, cause);
        if (player) {
            {
                const std::lock_guard lock(mutex);
                waiting.clear(); // of a past that nobody wants to hear
            }
            silent = false;
            serve(*player);
            silent = true;
        }
    } catch (const std::exception&) {
        silent = true;
        cause = "There will be no sound: there is not enough memory for it.";
    }
    end(cause.empty() ? std::nullopt : std::optional(cause));
}

void Mixer::Shared::end(std::optional<std::string> cause) {
    const std::lock_guard lock(mutex);
    note = std::move(cause);
    done = true;
    ended.notify_all();
}

Mixer::Mixer() : shared_(std::make_shared<Shared>()) {
    setenv("ALSOFT_LOGLEVEL", "0", 0); // we say it ourselves, and once
    try {
        std::thread([shared = shared_] { shared->run(); }).detach();
    } catch (const std::system_error&) {
        shared_->end("There will be no sound: no thread can be started for it.");
    }
}

// A sound server that does not answer must not keep the game from ending: its thread is left alone.
Mixer::~Mixer() {
    std::unique_lock lock(shared_->mutex);
    shared_->quit = true;
    shared_->changed.notify_all();
    shared_->ended.wait_for(lock, patience, [this] { return shared_->done; });
}

std::optional<std::string> Mixer::take_note() {
    const std::lock_guard lock(shared_->mutex);
    return std::exchange(shared_->note, std::nullopt);
}

bool Mixer::silent() const {
    return shared_->silent;
}

void Mixer::set_volume(double volume) {
    const std::lock_guard lock(shared_->mutex);
    const double gain = std::clamp(volume, 0.0, 1.0);
    shared_->volume = gain * gain; // ears hear ratios
    shared_->dirty = true;
    shared_->changed.notify_one();
}

void Mixer::play(const Listener& listener, std::span<const Event> events) {
    const std::lock_guard lock(shared_->mutex);
    shared_->listener = listener;
    shared_->dirty = true;
    for (const Event& event : events)
        shared_->add({wave_of(event.sound), event.point, is_everywhere(event.sound),
                      std::clamp(event.strength, 0.0, 1.0)});
    shared_->changed.notify_one();
}

void Mixer::play(MenuSound sound) {
    const std::lock_guard lock(shared_->mutex);
    shared_->add({sound == MenuSound::moved ? Wave::menu_moved : Wave::menu_chosen, glm::dvec3(0.0),
                  true, 1.0});
    shared_->changed.notify_one();
}

void Mixer::set_mood(double alarm, bool in_menu) {
    const std::lock_guard lock(shared_->mutex);
    const double tense = in_menu ? 0.0 : std::clamp(alarm, 0.0, 1.0);
    shared_->loops = {in_menu ? 0.3 : 0.5, 0.7 * tense};
    shared_->dirty = true;
    shared_->changed.notify_one();
}

} // namespace host::sound
