#pragma once

#include "scene/lights/light_set.h"
#include "shade/light/light_lists.h"

#include <cstdint>
#include <span>

namespace peregrine::shade {

// Which lights matter to which places. Read-only: all threads share it.
class LightChoice {
public:
    // `lights`: those of the set, relative to `origin`, or none. What is left out at a place adds
    // up to at most `unseen` lux. All must outlive the result.
    LightChoice(const scene::LightSet& set, std::span<const scene::PreparedLight> lights,
                const math::Vec3d& origin, float unseen)
        : set_(&set), lights_(lights), origin_(origin), unseen_(unseen) {}

    // The numbers, ascending, of those that reach into the bounds, in memory of `lists`.
    std::span<const uint32_t> reaching(const math::Box& bounds, LightLists& lists) const;

    // For so many threads.
    LightRoom make_room(uint32_t threads, base::Memory* memory) const {
        return LightRoom(lights_.size(), unseen_ > 0, threads, memory);
    }

private:
    uint32_t leave_out_unseen(const math::Box& bounds, LightLists& lists, uint32_t count) const;

    const scene::LightSet* set_;
    std::span<const scene::PreparedLight> lights_;
    math::Vec3d origin_;
    float unseen_;
};

} // namespace peregrine::shade
