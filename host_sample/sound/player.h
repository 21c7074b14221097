#pragma once

#include <array>
#include <atomic>
#include <memory>

#include <AL/al.h>
#include <AL/alc.h>

#include "sound/mixer.h"
#include "sound/waves.h"

namespace host::sound {

struct Heard {
    Wave wave;
    glm::dvec3 point{0.0};
    bool everywhere = false; // not at a place: as loud from all sides
    double strength = 1.0;
};

struct Loops {
    double night = 0.0, tension = 0.0; // gains
};

// An OpenAL device with all our sounds. One thread at a time.
class Player {
public:
    // Null, and a sentence why, if there is no device; null alone if `stop` became true meanwhile.
    // May take seconds where a sound server is asked.
    static std::unique_ptr<Player> open(const std::atomic<bool>& stop, std::string& cause);
    ~Player();
    Player(const Player&) = delete;
    Player& operator=(const Player&) = delete;

    void listen(const Listener& listener, double volume);
    void play(const Heard& heard);
    void set_loops(const Loops& loops);

private:
    explicit Player(ALCdevice* device) : device_(device) {}
    bool prepare();
    bool fill_buffers(const std::atomic<bool>& stop);
    void start_loops();
    ALuint free_voice();

    ALCdevice* device_;
    ALCcontext* context_ = nullptr;
    std::array<ALuint, wave_count> buffers_{};
    std::array<ALuint, 24> voices_{};
    std::array<ALuint, 2> loops_{};
    size_t next_ = 0;
    uint32_t plays_ = 0;
};

} // namespace host::sound
