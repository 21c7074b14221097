#pragma once

#include "trace/kernels.h"
#include "trace/world/ray_lists.h"

#include <algorithm>
#include <cstdint>

namespace peregrine::trace {

inline constexpr uint32_t kRoom = GateStream::kRoom;

// Rays of a stream on their own, in an instance's space.
class SubStream {
public:
    explicit SubStream(Coherence coherence) : coherence_(coherence) {}

    void clear() { count_ = 0; }
    void add(const math::Ray& ray, uint32_t number) {
        for (int k = 0; k < 3; ++k) {
            origin_[k][count_] = ray.origin[k];
            direction_[k][count_] = ray.direction[k];
        }
        t_min_[count_] = ray.t_min;
        t_max_[count_] = ray.t_max;
        number_[count_++] = number;
    }
    uint32_t count() const { return count_; }
    uint32_t number(uint32_t i) const { return number_[i]; }
    // So few that a stream is not worth its beginning.
    bool is_few() const { return count_ <= kFew; }
    math::Ray ray(uint32_t i) const {
        return {{origin_[0][i], origin_[1][i], origin_[2][i]},
                t_min_[i],
                {direction_[0][i], direction_[1][i], direction_[2][i]},
                t_max_[i]};
    }

    // Padded with its last ray, which must be there.
    RayStream stream() {
        const uint32_t end = (count_ + 15) / 16 * 16;
        const auto pad = [&](float* lane) {
            std::fill(lane + count_, lane + end, lane[count_ - 1]);
        };
        for (int k = 0; k < 3; ++k) {
            pad(origin_[k]);
            pad(direction_[k]);
        }
        pad(t_min_);
        pad(t_max_);
        return {{origin_[0], origin_[1], origin_[2]},
                {direction_[0], direction_[1], direction_[2]},
                t_min_,
                t_max_,
                count_,
                coherence_};
    }

private:
    static constexpr uint32_t kFew = 16;

    Coherence coherence_;
    uint32_t count_ = 0;
    alignas(64) float origin_[3][kRoom];
    alignas(64) float direction_[3][kRoom];
    alignas(64) float t_min_[kRoom];
    alignas(64) float t_max_[kRoom];
    uint32_t number_[kRoom];
};

// The hits of a sub-stream.
struct SubHits {
    alignas(64) float t[kRoom];
    alignas(64) float u[kRoom];
    alignas(64) float v[kRoom];
    alignas(64) uint32_t triangle[kRoom];
    alignas(64) uint32_t back_face[kRoom];
    alignas(64) uint32_t steps[kRoom];

    void set(uint32_t i, const Hit& hit) {
        t[i] = hit.t;
        u[i] = hit.u;
        v[i] = hit.v;
        triangle[i] = hit.triangle;
        back_face[i] = hit.back_face;
        steps[i] = hit.steps;
    }
    HitStream stream(bool with_steps) {
        return {t, u, v, triangle, back_face, with_steps ? steps : nullptr};
    }
};

} // namespace peregrine::trace
