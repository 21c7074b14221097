#pragma once

#include <bitset>
#include <cstdint>

#include <glm/glm.hpp>

namespace host {

enum class Key : uint8_t {
    w,
    a,
    s,
    d,
    up,
    down,
    left,
    right,
    shift,
    control,
    c,
    e,
    f,
    g,
    p,
    v,
    space,
    enter,
    escape,
    f12,
    mouse, // its left button
    count
};

class Keys {
public:
    bool has(Key key) const { return bits_[static_cast<size_t>(key)]; }
    bool any() const { return bits_.any(); }
    void set(Key key, bool down = true) { bits_[static_cast<size_t>(key)] = down; }
    void clear() { bits_.reset(); }

private:
    std::bitset<static_cast<size_t>(Key::count)> bits_;
};

// What keyboard and mouse did since it was asked for last. Left and right Shift and Control are
// one.
struct Desk {
    Keys held, pressed;
    glm::vec2 motion{0.0f};  // of the mouse while it is captured, in pixels: right, down
    glm::vec2 pointer{0.0f}; // where it is, in pixels of the frame buffer
    bool pointer_moved = false;
    bool captured = false; // the mouse: it looks around and has no place

    float axis(Key positive, Key negative) const {
        return (held.has(positive) ? 1.0f : 0.0f) - (held.has(negative) ? 1.0f : 0.0f);
    }
};

} // namespace host
