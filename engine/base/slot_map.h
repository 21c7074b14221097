#pragma once

#include "base/error.h"
#include "base/memory.h"

#include <cstdint>
#include <optional>
#include <utility>

namespace peregrine::base {

// A handle: {0, 0} is null, and no generation is 0.
struct Handle {
    uint32_t index = 0;
    uint32_t generation = 0;

    explicit operator bool() const { return generation != 0; }
    friend bool operator==(const Handle&, const Handle&) = default;
};

// Objects under handles. A removed object's slot is used again with the next generation, so an old
// handle finds nothing. `first_generation`, not 0, differs between scenes, so that neither does a
// handle of another one.
template <class T>
class SlotMap {
public:
    struct Slot {
        uint32_t generation;
        std::optional<T> object;
    };

    SlotMap(uint32_t first_generation, Memory* memory)
        : first_generation_(first_generation), slots_(memory), free_(memory) {}

    Handle insert(T object) {
        if (free_.empty()) {
            if (slots_.size() >= 0xfffffffeu) fail(Code::limit, "too many objects");
            if (free_.capacity() == slots_.size()) // so that erase never allocates
                free_.reserve(2 * slots_.size() + 1);
            slots_.push_back({first_generation_, std::nullopt});
            free_.push_back(uint32_t(slots_.size() - 1));
        }
        const uint32_t index = free_.back();
        slots_[index].object.emplace(std::move(object));
        free_.pop_back();
        return {index, slots_[index].generation};
    }

    T* find(Handle handle) {
        if (handle.index >= slots_.size()) return nullptr;
        Slot& slot = slots_[handle.index];
        return slot.object && slot.generation == handle.generation ? &*slot.object : nullptr;
    }

    bool erase(Handle handle) {
        if (!find(handle)) return false;
        Slot& slot = slots_[handle.index];
        slot.object.reset();
        if (++slot.generation == 0) slot.generation = 1;
        free_.push_back(handle.index);
        return true;
    }

    uint32_t count() const { return uint32_t(slots_.size() - free_.size()); }
    const Vector<Slot>& slots() const { return slots_; }
    Vector<Slot>& slots() { return slots_; }

private:
    uint32_t first_generation_;
    Vector<Slot> slots_;
    Vector<uint32_t> free_; // indices of empty slots, the next one to use last
};

} // namespace peregrine::base
