#include "gameplay/planes.h"

#include <glm/geometric.hpp>

namespace peregrine::gameplay {
namespace {

constexpr double kSame = 0.999;  // cosine between planes that count as one
constexpr double kAway = 1e-4;   // what slides along a plane leaves it a little, rather than enter
constexpr double kAlong = 1e-12; // sine below which two planes have no crease

} // namespace

void Planes::add(const Vec3& normal) {
    for (size_t i = 0; i < count_; ++i)
        if (glm::dot(normals_[i], normal) > kSame) {
            normals_[i] = normal;
            return;
        }
    if (count_ == normals_.size()) count_ = normals_.size() - 1;
    normals_[count_++] = normal;
}

bool Planes::leads_into(const Vec3& motion) const {
    for (size_t i = 0; i < count_; ++i)
        if (glm::dot(motion, normals_[i]) < 0) return true;
    return false;
}

Vec3 Planes::clip(const Vec3& motion) const {
    if (!leads_into(motion)) return motion;
    for (size_t i = 0; i < count_; ++i) {
        Vec3 clipped = motion - normals_[i] * glm::dot(motion, normals_[i]);
        clipped += normals_[i] * (kAway * glm::length(clipped));
        if (!leads_into(clipped)) return clipped;
    }
    for (size_t i = 0; i < count_; ++i)
        for (size_t j = 0; j < i; ++j) {
            const Vec3 crease = glm::cross(normals_[i], normals_[j]);
            const double square = glm::dot(crease, crease);
            if (square < kAlong) continue;
            Vec3 clipped = crease * (glm::dot(crease, motion) / square);
            clipped += (normals_[i] + normals_[j]) * (kAway * glm::length(clipped));
            if (!leads_into(clipped)) return clipped;
        }
    return Vec3(0);
}

} // namespace peregrine::gameplay
