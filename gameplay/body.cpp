#include "gameplay/body.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace peregrine::gameplay {
namespace {

// At a grazing contact the skin takes a long way back along the motion: this many skins at most.
constexpr double kMostBack = 4;
constexpr double kLeastTravel = 1e-6; // metres; less is rounding, and would never come to rest
constexpr int kMostPushes = 8;

} // namespace

Capsule Body::capsule(const Vec3& position) const {
    const double bottom = rules_->skin + rules_->radius;
    const double top = std::max(height_ - rules_->radius, bottom);
    return {position + Vec3(0, 0.5 * (bottom + top), 0), rules_->radius,
            Vec3(0, 0.5 * (top - bottom), 0)};
}

std::optional<Touch> Body::advance(Vec3& position, const Vec3& motion) const {
    const double length = glm::length(motion);
    if (length < kLeastTravel) return std::nullopt;
    const Vec3 direction = motion / length;
    const double reach = length + kMostBack * rules_->skin;
    const auto contact = world_.sweep(capsule(position), direction * reach, mask_);
    if (!contact) {
        position += motion;
        return std::nullopt;
    }
    const double approach = -glm::dot(direction, contact->normal); // cosine
    const double back = rules_->skin * (approach * kMostBack > 1 ? 1 / approach : kMostBack);
    double travel = contact->initial ? 0 : contact->t * reach - back;
    if (travel >= length) {
        position += motion;
        return std::nullopt;
    }
    if (travel < kLeastTravel) travel = 0;
    position += direction * travel;
    return Touch{contact->normal, contact->point, travel / length, contact->mesh};
}

std::optional<Contact> Body::overlap(const Vec3& position) const {
    const Vec3 probe(0, -0.5 * rules_->skin, 0);
    auto contact = world_.sweep(capsule(position), probe, mask_, false);
    if (contact && !contact->initial) contact.reset();
    return contact;
}

bool Body::depenetrate(Vec3& position) const {
    for (int i = 0; i < kMostPushes; ++i) {
        const auto contact = overlap(position);
        if (!contact) return true;
        const Vec3 before = position;
        advance(position, contact->normal * (contact->depth + rules_->skin));
        if (position == before) return false;
    }
    return !world_.overlaps(capsule(position), mask_);
}

} // namespace peregrine::gameplay
