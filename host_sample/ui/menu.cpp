#include "ui/menu.h"

#include <algorithm>

namespace host::ui {

namespace {

constexpr double first_pause = 0.4, next_pause = 0.09; // seconds, as keyboards repeat

bool is_held(const MenuInput& input) {
    return input.up || input.down || input.left || input.right;
}

bool same_directions(const MenuInput& a, const MenuInput& b) {
    return a.up == b.up && a.down == b.down && a.left == b.left && a.right == b.right;
}

// The next entry that can be selected, around the ends.
uint32_t next_enabled(const std::vector<Entry>& entries, uint32_t from, uint32_t step) {
    const auto count = static_cast<uint32_t>(entries.size());
    for (uint32_t i = 0, entry = from; i < count; ++i) {
        entry = (entry + step) % count;
        if (entries[entry].enabled) return entry;
    }
    return from;
}

} // namespace

MenuInput Repeater::update(const MenuInput& held, double seconds) {
    const bool changed = !same_directions(held, before_);
    waited_ = changed ? 0.0 : waited_ + seconds;
    repeating_ = repeating_ && !changed;
    const bool again = is_held(held) && waited_ >= (repeating_ ? next_pause : first_pause);
    if (again) {
        repeating_ = true;
        waited_ = 0.0;
    }
    const auto press = [&](bool now, bool before) { return now && (again || !before); };
    const MenuInput presses{press(held.up, before_.up),     press(held.down, before_.down),
                            press(held.left, before_.left), press(held.right, before_.right),
                            held.accept && !before_.accept, held.back && !before_.back};
    before_ = held;
    return presses;
}

bool Box::contains(glm::vec2 point) const {
    return point.x >= lower.x && point.x < upper.x && point.y >= lower.y && point.y < upper.y;
}

bool Box::overlaps(const Box& other) const {
    return lower.x < other.upper.x && other.lower.x < upper.x && lower.y < other.upper.y
           && other.lower.y < upper.y;
}

namespace {

Choice put(uint32_t entry, const Box& slider, const Pointer& pointer) {
    Choice choice;
    choice.kind = Choice::Kind::set;
    choice.entry = entry;
    const float part = (pointer.place.x - slider.lower.x) / (slider.upper.x - slider.lower.x);
    choice.level = std::clamp(part, 0.0f, 1.0f);
    return choice;
}

} // namespace

Choice Menu::update(const std::vector<Entry>& entries, const std::vector<EntryBoxes>& boxes,
                    const MenuInput& input, const Pointer& pointer) {
    Choice choice;
    const auto count = static_cast<uint32_t>(entries.size());
    if (count == 0) return choice;
    // A slider that is held follows the mouse wherever it goes.
    dragging_ = dragging_ && pointer.shown && pointer.held && !input.back
                && selected_ < std::min<size_t>(count, boxes.size());
    if (dragging_) {
        choice = put(selected_, boxes[selected_].slider, pointer);
        choice.dragged = true;
        return choice;
    }
    const uint32_t before = selected_;
    if (selected_ >= count || !entries[selected_].enabled)
        selected_ = next_enabled(entries, count - 1, 1);
    if (input.up != input.down)
        selected_ = next_enabled(entries, selected_, input.down ? 1 : count - 1);

    bool clicked = false;
    const EntryBoxes* under = nullptr;
    for (uint32_t i = 0; pointer.shown && i < boxes.size() && i < count; ++i) {
        if (!entries[i].enabled || !boxes[i].row.contains(pointer.place)) continue;
        if (pointer.moved || pointer.pressed) selected_ = i;
        clicked = pointer.pressed;
        under = &boxes[i];
    }
    choice.entry = selected_;
    choice.moved = selected_ != before;

    const Entry& entry = entries[selected_];
    const bool has_value = !entry.value.empty();
    bool less = input.left && !input.right, more = input.right && !input.left;
    const bool accept = input.accept || (clicked && !has_value);
    const bool slides = clicked && entry.level >= 0.0f && under->slider.contains(pointer.place);
    if (slides && !input.back && !accept) {
        const bool moved = choice.moved;
        choice = put(selected_, under->slider, pointer);
        choice.moved = moved;
        dragging_ = pointer.held;
        return choice;
    }
    if (clicked && has_value) {
        less = less || under->less.contains(pointer.place);
        more = more || (!less && under->more.contains(pointer.place));
    }
    if (input.back)
        choice.kind = Choice::Kind::back;
    else if (accept)
        choice.kind = Choice::Kind::accept;
    else if (has_value && less && entry.has_less)
        choice.kind = Choice::Kind::less;
    else if (has_value && more && entry.has_more)
        choice.kind = Choice::Kind::more;
    return choice;
}

} // namespace host::ui
