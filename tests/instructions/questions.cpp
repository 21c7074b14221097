#include "questions.h"

#include <limits>

namespace peregrine::test {
namespace {

constexpr size_t kCount = 1000; // of each kind
constexpr float kAway = 2;      // metres from the points

// Numerical Recipes' quick generator: its numbers are in the upper bits.
class Random {
public:
    float uniform() { // -1 to 1
        state_ = state_ * 1664525u + 1013904223u;
        return float(state_ >> 8) * 0x1p-23f - 1;
    }
    glm::vec3 vector() {
        const float x = uniform(), y = uniform(), z = uniform();
        return {x, y, z};
    }

private:
    uint32_t state_ = 1;
};

void copy(const glm::vec3& from, float* to) {
    for (int k = 0; k < 3; ++k) to[k] = from[k];
}

} // namespace

Questions::Questions(const std::vector<glm::vec3>& around) {
    Random random;
    const auto place = [&](size_t i) {
        return around[i % around.size()] + kAway * random.vector();
    };
    for (size_t i = 0; i < kCount; ++i) {
        rt_ray ray = {};
        copy(place(i), ray.origin);
        copy(random.vector(), ray.direction);
        ray.t_max = std::numeric_limits<float>::infinity();
        rays.push_back(ray);

        rt_ray sight = {};
        const glm::vec3 from = place(i);
        copy(from, sight.origin);
        copy(place(i + 1) - from, sight.direction);
        sight.t_max = 1;
        sights.push_back(sight);

        rt_sweep sweep = {};
        copy(place(i), sweep.center);
        copy(random.vector(), sweep.direction);
        sweep.radius = 0.3f;
        sweep.t_max = 3;
        spheres.push_back(sweep);
        sweep.axis[1] = 0.6f;
        capsules.push_back(sweep);

        rt_shape shape = {};
        copy(place(i), shape.center);
        shape.radius = 0.4f;
        shapes.push_back(shape);

        rt_point point = {};
        copy(place(i), point.position);
        point.radius = 1.5f;
        points.push_back(point);
    }
}

} // namespace peregrine::test
