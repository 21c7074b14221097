#pragma once

#include <glm/vec2.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace host::ui {

// What was pressed since the frame before, on keyboard or pad: arrows, WASD, d-pad or left stick;
// Enter, Space or the south button; Escape or the east button. Repeats of held directions are the
// caller's (Repeater below).
struct MenuInput {
    bool up = false, down = false, left = false, right = false;
    bool accept = false, back = false;
};

// The mouse, in pixels of the frame buffer.
struct Pointer {
    glm::vec2 place{0.0f};
    bool shown = false;   // false: there is none, or it is captured
    bool pressed = false; // its button went down since the frame before
    bool held = false;    // and is down
    bool moved = false;   // since the frame before
};

// Turns held directions into presses: one at once, then one after a pause, then many.
class Repeater {
public:
    MenuInput update(const MenuInput& held, double seconds);

private:
    MenuInput before_;
    double waited_ = 0.0;
    bool repeating_ = false;
};

// A column of entries of which one is selected.
struct Entry {
    std::string label{};
    std::string value{};  // empty: a plain entry; else left and right change it
    bool enabled = true;  // others are skipped
    float level = -1.0f;  // 0 to 1: a slider below the value; negative: none
    bool has_less = true; // false: left would do nothing
    bool has_more = true; // false: right would do nothing
};

struct Box {
    glm::vec2 lower{0.0f}, upper{0.0f};
    bool contains(glm::vec2 point) const;
    bool overlaps(const Box& other) const;
};
// Where an entry lies on the window, the halves of its value that make it less and more, and where
// its slider goes from 0 to 1.
struct EntryBoxes {
    Box row, less, more, slider{};
};

struct Choice {
    enum class Kind { none, accept, less, more, set, back } kind = Kind::none;
    uint32_t entry = 0;
    float level = 0.0f;   // of Kind::set: where the slider was put, 0 to 1
    bool moved = false;   // the selection: for a sound
    bool dragged = false; // Kind::set once more, by a slider that is held
};

// Keyboard, pad and mouse to one choice. Knows nothing of drawing.
class Menu {
public:
    uint32_t selected() const { return selected_; }
    void select(uint32_t entry) {
        selected_ = entry;
        dragging_ = false;
    }

    // `boxes` may be empty: no mouse then.
    Choice update(const std::vector<Entry>& entries, const std::vector<EntryBoxes>& boxes,
                  const MenuInput& input, const Pointer& pointer);

private:
    uint32_t selected_ = 0;
    bool dragging_ = false; // the slider of the selected entry
};

} // namespace host::ui
