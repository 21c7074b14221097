#include "gameplay/contacts.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace peregrine::gameplay {
namespace {

constexpr double kSame = 1 - 1e-6; // cosine, of normals that are one contact

constexpr double kParting = 1e-5; // m/s

bool points_into_none(const Vec3& v, double tolerance, std::span<const Vec3> normals) {
    return std::ranges::all_of(normals,
                               [&](const Vec3& n) { return glm::dot(v, n) >= -tolerance; });
}

} // namespace

void Contacts::add(const Vec3& direction) {
    const Vec3 normal = glm::normalize(direction); // a query's is one of floats
    for (Vec3& known : std::span(normals_.data(), count_))
        if (glm::dot(known, normal) > kSame) {
            known = normal;
            return;
        }
    if (count_ == normals_.size()) {
        std::shift_left(normals_.begin(), normals_.end(), 1);
        --count_;
    }
    normals_[count_++] = normal;
}

void Contacts::drop_parting(const Vec3& velocity) {
    Contacts kept;
    for (const Vec3& normal : normals())
        if (glm::dot(velocity, normal) <= kParting) kept.normals_[kept.count_++] = normal;
    *this = kept;
}

// The nearest point of the cone that the surfaces leave: inside, on one of them, on the edge
// between two, or its tip.
Vec3 constrain(const Vec3& v, std::span<const Vec3> normals) {
    const double tolerance = 1e-12 * glm::length(v);
    if (points_into_none(v, tolerance, normals)) return v;
    for (const Vec3& n : normals) {
        if (glm::dot(v, n) >= 0) continue;
        const Vec3 along = v - glm::dot(v, n) * n;
        if (points_into_none(along, tolerance, normals)) return along;
    }
    for (size_t i = 0; i < normals.size(); ++i)
        for (size_t j = i + 1; j < normals.size(); ++j) {
            const Vec3 edge = glm::cross(normals[i], normals[j]);
            const double length2 = glm::dot(edge, edge);
            if (length2 < 1e-18) continue;
            const Vec3 along = (glm::dot(v, edge) / length2) * edge;
            if (points_into_none(along, tolerance, normals)) return along;
        }
    return Vec3(0);
}

} // namespace peregrine::gameplay
