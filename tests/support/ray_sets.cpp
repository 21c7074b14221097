#include "support/ray_sets.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace peregrine::test {
namespace {

using math::Ray;
using math::Vec3;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

class Generator {
public:
    Generator(std::span<const geometry::Triangle> triangles, std::span<const Eye> eyes,
              std::span<const Vec3> lights, uint32_t seed)
        : triangles_(triangles), eyes_(eyes), lights_(lights), random_(seed) {
        for (const auto& triangle : triangles) bounds_.extend(geometry::bounds(triangle));
    }

    void start_set() { fan_left_ = 0; }

    Ray camera() {
        const Eye eye = eyes_.empty() ? Eye{inside(), direction()} : eyes_[pick(eyes_.size())];
        return {eye.position, 0, glm::normalize(eye.forward) + 0.7f * direction(), kInfinity};
    }

    Ray shadow() {
        const Vec3 from = on_triangle();
        const Vec3 to = lights_.empty() ? inside() : lights_[pick(lights_.size())];
        return {from, 1e-4f, to - from, 0.9999f};
    }

    Ray random() { return {inside(), 0, direction(), kInfinity}; }

    // From a vertex's own coordinates half of the time: then the ray runs in the planes of faces
    // and of splits.
    Ray axis_parallel() {
        Vec3 origin = inside();
        const Vec3 corner = vertex();
        for (int k = 0; k < 3; ++k)
            if (coin()) origin[k] = corner[k];
        Vec3 d(0.0f);
        d[int(pick(3))] = coin() ? 1.0f : -1.0f;
        if (pick(4) == 0) d[int(pick(3))] = coin() ? 0.5f : -2.0f;
        if (pick(4) == 0)
            for (int k = 0; k < 3; ++k)
                if (d[k] == 0) d[k] = -0.0f;
        return {origin, coin() ? 0.0f : -kInfinity, d, kInfinity};
    }

    Ray through_vertex() {
        const Vec3 origin = inside();
        return aimed(origin, vertex());
    }

    Ray along_edge() {
        const geometry::Triangle& triangle = triangles_[pick(triangles_.size())];
        const Vec3 corners[3] = {triangle.v0, triangle.v1, triangle.v2};
        const size_t i = pick(3);
        const Vec3 a = corners[i], b = corners[(i + 1) % 3];
        return {a - uniform() * (b - a), 0, b - a, kInfinity};
    }

    Ray through_edge() {
        const geometry::Triangle& triangle = triangles_[pick(triangles_.size())];
        const Vec3 origin = inside();
        return aimed(origin, 0.5f * (triangle.v0 + triangle.v1));
    }

    // Lengths and distances far from 1, segments, and origins far outside.
    Ray extreme() {
        Ray ray = random();
        const float scale = std::exp2(float(int(pick(240))) - 120.0f);
        switch (pick(4)) {
        case 0:
            ray.direction *= scale;
            break;
        case 1: {
            const float far = std::exp2(float(int(pick(24))));
            const Vec3 target = on_triangle();
            ray.origin = target + far * direction() * glm::length(bounds_.upper - bounds_.lower);
            ray.direction = target - ray.origin;
            break;
        }
        case 2:
            ray.direction[int(pick(3))] *= scale;
            break;
        default: {
            ray.t_max = uniform() * glm::length(bounds_.upper - bounds_.lower);
            ray.t_min = ray.t_max * (uniform() - 0.3f);
        }
        }
        if (ray.direction == Vec3(0)) ray.direction.x = 1;
        return ray;
    }

    // Rays with a common origin, up to 300 in turn: through a narrow or wide window of directions
    // that may lie on a diagonal or on an axis, some of them straight at vertices.
    Ray fan() {
        if (fan_left_ == 0) {
            fan_left_ = 1 + pick(300);
            const size_t kind = pick(4);
            fan_origin_ = kind == 0                     ? vertex()
                          : kind == 1 && !eyes_.empty() ? eyes_[0].position
                                                        : inside();
            fan_width_ = std::exp2(-float(pick(16)));
            fan_direction_ =
                coin() ? direction() : Vec3(coin() ? 1 : -1, int(pick(3)) - 1, int(pick(3)) - 1);
            fan_end_ =
                pick(3) == 0 ? uniform() * glm::length(bounds_.upper - bounds_.lower) : kInfinity;
            fan_target_ = vertex();
            fan_scale_ = coin() ? 1.0f : std::exp2(float(int(pick(20)) - 10));
        }
        --fan_left_;
        Ray ray{fan_origin_, pick(9) == 0 ? 0.01f * uniform() : 0.0f,
                fan_scale_ * (fan_direction_ + fan_width_ * direction()), fan_end_};
        if (pick(8) == 0 && fan_target_ != fan_origin_) {
            ray.direction = fan_target_ - fan_origin_;
            if (coin()) ray.t_max = 1;
        }
        if (ray.direction == Vec3(0)) ray.direction.z = 1;
        return ray;
    }

    // Rays of one mind without a common origin, up to 300 in turn, as mirrors and suns cast them:
    // from a patch of a plane, parallel or spreading, some of them from vertices or straight at
    // them.
    Ray sheaf() {
        if (fan_left_ == 0) {
            fan_left_ = 1 + pick(300);
            fan_origin_ = coin() ? on_triangle() : inside();
            fan_direction_ =
                pick(3) == 0 ? Vec3(coin() ? 1 : -1, int(pick(3)) - 1, 0) : direction();
            fan_width_ = pick(3) == 0 ? 0.0f : std::exp2(-4.0f - float(pick(12)));
            fan_end_ =
                pick(3) == 0 ? uniform() * glm::length(bounds_.upper - bounds_.lower) : kInfinity;
            fan_target_ = 0.05f * glm::length(bounds_.upper - bounds_.lower) * direction();
        }
        --fan_left_;
        const Vec3 across = glm::cross(fan_direction_, fan_target_);
        const float x = uniform() - 0.5f, y = uniform() - 0.5f;
        Ray ray{fan_origin_ + x * fan_target_ + y * across, 0,
                fan_direction_ + fan_width_ * (x * fan_target_ + y * across), fan_end_};
        if (pick(8) == 0) ray.origin = vertex();
        if (pick(8) == 0) ray.origin = vertex() - ray.direction;
        if (pick(16) == 0) ray.t_min = 0.01f * uniform();
        if (ray.direction == Vec3(0)) ray.direction.z = 1;
        return ray;
    }

    // Rays of one direction, as those to a sun: from a patch of a plane, from triangles, their
    // corners and edges, or straight at these. The direction may be an axis, an edge, or lie in a
    // triangle's plane.
    Ray parallel() {
        const float size = largest(bounds_.upper - bounds_.lower);
        if (fan_left_ == 0) {
            fan_left_ = 32 * (1 + pick(16));
            fan_origin_ = coin() ? on_triangle() : inside();
            const geometry::Triangle& triangle = triangles_[pick(triangles_.size())];
            const Vec3 a = triangle.v1 - triangle.v0, b = triangle.v2 - triangle.v0;
            const size_t kind = pick(8);
            fan_direction_ = kind == 0   ? Vec3(coin() ? 1 : -1, int(pick(3)) - 1, int(pick(3)) - 1)
                             : kind == 1 ? Vec3(0, coin() ? 1 : -1, coin() ? 0.0f : -0.0f)
                             : kind == 2 ? a
                             : kind == 3 ? uniform() * a - uniform() * b
                                         : direction();
            if (coin()) fan_direction_ *= std::exp2(float(int(pick(20)) - 10));
            if (fan_direction_ == Vec3(0)) fan_direction_.z = 1;
            fan_target_ = size * std::exp2(-float(pick(14))) * direction();
            fan_end_ = pick(3) == 0 ? uniform() * size / largest(fan_direction_) : kInfinity;
        }
        --fan_left_;
        const Vec3 across = glm::cross(fan_direction_ / largest(fan_direction_), fan_target_);
        const float x = uniform() - 0.5f, y = uniform() - 0.5f;
        Ray ray{fan_origin_ + x * fan_target_ + y * across, 0, fan_direction_, fan_end_};
        switch (pick(24)) {
        case 0:
            ray.origin = vertex();
            break;
        case 1:
            ray.origin = vertex() - ray.direction;
            break;
        case 2:
            ray.origin = on_triangle();
            break;
        case 3:
            ray.t_min = 0.01f * uniform();
            break;
        case 4:
            ray.t_min = -uniform();
            break;
        case 5:
            ray.t_max = uniform();
            break;
        default:
            break;
        }
        return ray;
    }

    // A picture's rays, 16 x 16 pixels at a time.
    Ray picture() {
        if (fan_left_ == 0) {
            fan_left_ = 256;
            fan_origin_ = eyes_.empty() ? inside() : eyes_[pick(eyes_.size())].position;
            fan_direction_ = direction();
            fan_target_ = glm::cross(fan_direction_, direction());
            fan_width_ = std::exp2(-4.0f - float(pick(8)));
        }
        const size_t i = --fan_left_;
        const Vec3 down = glm::cross(fan_direction_, fan_target_);
        const float x = float(every_other_bit(i)), y = float(every_other_bit(i >> 1));
        return {fan_origin_, 0, fan_direction_ + fan_width_ * (x * fan_target_ + y * down),
                kInfinity};
    }

private:
    static size_t every_other_bit(size_t i) {
        return (i & 1) | (i >> 1 & 2) | (i >> 2 & 4) | (i >> 3 & 8);
    }

    static Ray aimed(const Vec3& origin, const Vec3& target) {
        Ray ray{origin, 0, target - origin, kInfinity};
        if (ray.direction == Vec3(0)) ray.direction.y = 1;
        return ray;
    }

    static float largest(const Vec3& v) {
        return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
    }

    float uniform() { return std::uniform_real_distribution<float>(0, 1)(random_); }
    bool coin() { return random_() & 1; }
    size_t pick(size_t count) { return random_() % count; }
    Vec3 inside() {
        return bounds_.lower
               + Vec3(uniform(), uniform(), uniform()) * (bounds_.upper - bounds_.lower);
    }
    Vec3 direction() {
        for (;;) {
            const Vec3 d(2 * uniform() - 1, 2 * uniform() - 1, 2 * uniform() - 1);
            const float length = glm::dot(d, d);
            if (length > 0.01f && length <= 1) return d / std::sqrt(length);
        }
    }
    Vec3 vertex() {
        const geometry::Triangle& triangle = triangles_[pick(triangles_.size())];
        const size_t i = pick(3);
        return i == 0 ? triangle.v0 : i == 1 ? triangle.v1 : triangle.v2;
    }
    Vec3 on_triangle() {
        const geometry::Triangle& triangle = triangles_[pick(triangles_.size())];
        float u = uniform(), v = uniform();
        if (u + v > 1) u = 1 - u, v = 1 - v;
        return triangle.v0 + u * (triangle.v1 - triangle.v0) + v * (triangle.v2 - triangle.v0);
    }

    std::span<const geometry::Triangle> triangles_;
    std::span<const Eye> eyes_;
    std::span<const Vec3> lights_;
    std::mt19937 random_;
    math::Box bounds_;
    size_t fan_left_ = 0;
    Vec3 fan_origin_{0}, fan_direction_{0}, fan_target_{0};
    float fan_width_ = 1, fan_end_ = 0, fan_scale_ = 1;
};

} // namespace

std::vector<RaySet> make_ray_sets(std::span<const geometry::Triangle> triangles,
                                  std::span<const Eye> eyes, std::span<const Vec3> lights,
                                  size_t rays_per_set, uint32_t seed) {
    struct Kind {
        const char* name;
        Ray (Generator::*make)();
    };
    const Kind kinds[] = {
        {"camera", &Generator::camera},
        {"shadow", &Generator::shadow},
        {"random", &Generator::random},
        {"axis-parallel", &Generator::axis_parallel},
        {"through vertices", &Generator::through_vertex},
        {"along edges", &Generator::along_edge},
        {"through edges", &Generator::through_edge},
        {"extreme", &Generator::extreme},
        {"fan", &Generator::fan},
        {"sheaf", &Generator::sheaf},
        {"parallel", &Generator::parallel},
        {"picture", &Generator::picture},
    };
    Generator generator(triangles, eyes, lights, seed);
    std::vector<RaySet> sets;
    for (const Kind& kind : kinds) {
        sets.push_back({kind.name, {}});
        generator.start_set();
        for (size_t i = 0; i < rays_per_set; ++i)
            sets.back().rays.push_back((generator.*kind.make)());
    }
    return sets;
}

} // namespace peregrine::test
