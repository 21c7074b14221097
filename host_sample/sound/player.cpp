#include "sound/player.h"

#include "sound/synthesis.h"

namespace host::sound {

namespace {

constexpr float near = 2.5f, far = 70.0f; // metres: full strength; no fainter any more

constexpr size_t index_of(Wave wave) {
    return static_cast<size_t>(wave);
}

bool varies(Wave wave) { // what is heard often should not sound like a machine
    using peregrine::three_cores::Sound;
    return wave == wave_of(Sound::step) || wave == wave_of(Sound::bounce)
           || wave == wave_of(Sound::land);
}

} // namespace

std::unique_ptr<Player> Player::open(const std::atomic<bool>& stop, std::string& cause) {
    ALCdevice* device = alcOpenDevice(nullptr);
    if (!device) {
        cause = "There will be no sound: no sound device can be opened.";
        return nullptr;
    }
    std::unique_ptr<Player> player(new Player(device));
    if (player->prepare() && player->fill_buffers(stop)) {
        player->start_loops();
        return player;
    }
    if (!stop) cause = "There will be no sound: the sound device refuses to play.";
    return nullptr;
}

bool Player::prepare() {
    context_ = alcCreateContext(device_, nullptr);
    if (!context_ || !alcMakeContextCurrent(context_)) return false;
    alGetError();
    alGenBuffers(static_cast<ALsizei>(buffers_.size()), buffers_.data());
    alGenSources(static_cast<ALsizei>(voices_.size()), voices_.data());
    alGenSources(static_cast<ALsizei>(loops_.size()), loops_.data());
    alDistanceModel(AL_INVERSE_DISTANCE_CLAMPED);
    return alGetError() == AL_NO_ERROR;
}

// Takes most of a second on a slow machine: who quits at once need not wait.
bool Player::fill_buffers(const std::atomic<bool>& stop) {
    for (uint32_t i = 0; i < wave_count && !stop; ++i) {
        const auto samples = make_wave(static_cast<Wave>(i));
        alBufferData(buffers_[i], AL_FORMAT_MONO16, samples.data(),
                     static_cast<ALsizei>(samples.size() * sizeof samples[0]), sample_rate);
    }
    return !stop && alGetError() == AL_NO_ERROR;
}

void Player::start_loops() {
    constexpr std::array loops = {Wave::night, Wave::tension};
    for (size_t i = 0; i < loops.size(); ++i) {
        alSourcei(loops_[i], AL_BUFFER, static_cast<ALint>(buffers_[index_of(loops[i])]));
        alSourcei(loops_[i], AL_LOOPING, AL_TRUE);
        alSourcei(loops_[i], AL_SOURCE_RELATIVE, AL_TRUE);
        alSourcef(loops_[i], AL_GAIN, 0.0f);
        alSourcePlay(loops_[i]);
    }
}

Player::~Player() {
    if (context_) {
        alDeleteSources(static_cast<ALsizei>(voices_.size()), voices_.data());
        alDeleteSources(static_cast<ALsizei>(loops_.size()), loops_.data());
        alDeleteBuffers(static_cast<ALsizei>(buffers_.size()), buffers_.data());
        alcMakeContextCurrent(nullptr);
        alcDestroyContext(context_);
    }
    alcCloseDevice(device_);
}

void Player::listen(const Listener& listener, double volume) {
    const glm::vec3 place(listener.position);
    const float facing[] = {listener.forward.x, listener.forward.y, listener.forward.z,
                            listener.up.x,      listener.up.y,      listener.up.z};
    alListener3f(AL_POSITION, place.x, place.y, place.z);
    alListenerfv(AL_ORIENTATION, facing);
    alListenerf(AL_GAIN, static_cast<float>(volume));
}

// One that is silent, else the one that has played longest.
ALuint Player::free_voice() {
    for (size_t i = 0; i < voices_.size(); ++i) {
        const size_t voice = (next_ + i) % voices_.size();
        ALint state = 0;
        alGetSourcei(voices_[voice], AL_SOURCE_STATE, &state);
        if (state != AL_PLAYING) {
            next_ = voice + 1;
            return voices_[voice];
        }
    }
    return voices_[next_++ % voices_.size()];
}

void Player::play(const Heard& heard) {
    const ALuint voice = free_voice();
    const glm::vec3 place(heard.everywhere ? glm::dvec3(0.0) : heard.point);
    alSourceStop(voice);
    alSourcei(voice, AL_BUFFER, static_cast<ALint>(buffers_[index_of(heard.wave)]));
    alSourcei(voice, AL_SOURCE_RELATIVE, heard.everywhere ? AL_TRUE : AL_FALSE);
    alSource3f(voice, AL_POSITION, place.x, place.y, place.z);
    alSourcef(voice, AL_REFERENCE_DISTANCE, near);
    alSourcef(voice, AL_MAX_DISTANCE, far);
    alSourcef(voice, AL_GAIN, static_cast<float>(heard.strength));
    ++plays_;
    const auto change = static_cast<float>(plays_ * 7 % 11) - 5.0f;
    alSourcef(voice, AL_PITCH, varies(heard.wave) ? 1.0f + 0.014f * change : 1.0f);
    alSourcePlay(voice);
}

void Player::set_loops(const Loops& loops) {
    alSourcef(loops_[0], AL_GAIN, static_cast<float>(loops.night));
    alSourcef(loops_[1], AL_GAIN, static_cast<float>(loops.tension));
}

} // namespace host::sound
