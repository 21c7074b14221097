#include "shade/light/penumbra.h"

#include "shade/light/sphere_points.h"

#include <algorithm>

namespace peregrine::shade {
namespace {

constexpr uint32_t kNeighbours = 4; // of a batch: mostly two by two pixels

// The rays toward a light's centre, and what is found out about its sphere.
class Penumbra {
public:
    Penumbra(const Shadows& shadows, const PreparedLight& light, uint32_t ray_count,
             ShadowMemory& memory)
        : shadows_(shadows), light_(light), memory_(memory), ray_count_(ray_count) {
        for (int k = 0; k < 3; ++k) {
            std::copy_n(memory.origin[k], ray_count, memory.fixed_origin[k]);
            std::copy_n(memory.direction[k], ray_count, memory.fixed_direction[k]);
        }
        std::fill_n(seen_, ray_count, uint16_t(0));
    }

    // What all points see of the centre, and one of neighbours of the rim.
    void probe() {
        asked_count_ = ray_count_;
        for (uint32_t i = 0; i < ray_count_; ++i) asked_[i] = uint16_t(i);
        ask(math::Vec3(0));
        asked_count_ = 0;
        for_each_group([&](uint32_t first, uint32_t) { asked_[asked_count_++] = uint16_t(first); });
        for (const math::Vec3& point : sphere_probes()) ask(point * light_.source_radius);
    }

    // Where that is not all or nothing, what they see of these points counts.
    void sample(std::span<const math::Vec3> points) {
        asked_count_ = 0;
        for_each_group([&](uint32_t first, uint32_t end) {
            const bool all = seen_[first] == kSphereProbes + 1;
            bool is_plain = all || seen_[first] == 0;
            for (uint32_t i = first + 1; i < end; ++i) is_plain &= (seen_[i] != 0) == all;
            if (is_plain) return;
            for (uint32_t i = first; i < end; ++i) {
                seen_[i] = 0;
                asked_[asked_count_++] = uint16_t(i);
            }
        });
        for (const math::Vec3& point : points) ask(point * light_.source_radius);
    }

    // Multiplies weights by what is seen; returns how many points see nothing.
    uint32_t weigh(uint32_t samples, LightWeights& weights) const {
        uint32_t hidden = 0;
        for (uint32_t i = 0, next = 0; i < ray_count_; ++i) {
            const bool is_sampled = next < asked_count_ && asked_[next] == i;
            next += is_sampled;
            const float part = is_sampled ? float(seen_[i]) / float(samples) : float(seen_[i] > 0);
            weights.diffuse[memory_.index[i]] *= part;
            memory_.occluded[i] = part == 0   ? ShadowMemory::kOccluded
                                  : part == 1 ? ShadowMemory::kFree
                                              : ShadowMemory::kPenumbra;
            hidden += part == 0;
        }
        return hidden;
    }

private:
    // Calls function(first, end) for the rays of neighbours.
    template <class Function>
    void for_each_group(Function&& function) const {
        const auto group = [&](uint32_t i) { return memory_.index[i] / kNeighbours; };
        for (uint32_t first = 0, end; first < ray_count_; first = end) {
            for (end = first + 1; end < ray_count_ && group(end) == group(first);) ++end;
            function(first, end);
        }
    }

    void ask(const math::Vec3& offset) {
        PreparedLight point = light_;
        const float side = light_.from_light ? -1.0f : 1.0f;
        if (light_.from_light) point.position += offset;
        for (int k = 0; k < 3; ++k) {
            for (uint32_t i = 0; i < asked_count_; ++i) {
                memory_.origin[k][i] = memory_.fixed_origin[k][asked_[i]];
                memory_.direction[k][i] = memory_.fixed_direction[k][asked_[i]] + side * offset[k];
            }
        }
        shadows_.trace(point, asked_count_, memory_);
        for (uint32_t i = 0; i < asked_count_; ++i)
            seen_[asked_[i]] = uint16_t(seen_[asked_[i]] + !memory_.occluded[i]);
    }

    const Shadows& shadows_;
    const PreparedLight& light_;
    ShadowMemory& memory_;
    uint32_t ray_count_, asked_count_;
    uint16_t asked_[kPadded]; // rays
    uint16_t seen_[kPadded];
};

} // namespace

uint32_t hide_penumbra(const Shadows& shadows, const PreparedLight& light, uint32_t ray_count,
                       ShadowMemory& memory, LightWeights& weights) {
    Penumbra penumbra(shadows, light, ray_count, memory);
    penumbra.probe();
    penumbra.sample(sphere_points().first(light.shadow_samples));
    return penumbra.weigh(light.shadow_samples, weights);
}

void list_centers_again(uint32_t ray_count, ShadowMemory& memory) {
    for (int k = 0; k < 3; ++k) {
        std::copy_n(memory.fixed_origin[k], ray_count, memory.origin[k]);
        std::copy_n(memory.fixed_direction[k], ray_count, memory.direction[k]);
    }
}

} // namespace peregrine::shade
