#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include <glm/glm.hpp>

namespace peregrine::three_cores {
struct Event;
}

namespace host::sound {

struct Listener {
    glm::dvec3 position{0.0};
    glm::vec3 forward{0.0f, 0.0f, -1.0f}, up{0.0f, 1.0f, 0.0f};
};

enum class MenuSound { moved, chosen };

// All sounds of the game, made at the start and played with OpenAL. A thread of its own opens the
// device and plays, so nothing here waits; without a device everything is silent.
class Mixer {
public:
    Mixer();
    ~Mixer();
    Mixer(const Mixer&) = delete;
    Mixer& operator=(const Mixer&) = delete;

    // A sentence, once, if there will be no sound.
    std::optional<std::string> take_note();
    bool silent() const; // there is no device, or none yet

    void set_volume(double volume); // 0 to 1

    // Once a frame: what happened in the ticks since, and from where it is heard.
    void play(const Listener& listener, std::span<const peregrine::three_cores::Event> events);
    void play(MenuSound sound);
    // The night outside: quieter while a menu is shown, quicker and darker with the alarm (0 to 1).
    void set_mood(double alarm, bool in_menu);

private:
    struct Shared;
    std::shared_ptr<Shared> shared_;
};

} // namespace host::sound
