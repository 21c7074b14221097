#pragma once

#include "gameplay/character.h"

namespace peregrine::gameplay {

// What stopped an advance.
struct Touch {
    Vec3 normal; // unit, from the surface to the body
    Vec3 point;
    double travelled; // fraction of the motion
    rt_mesh mesh;
};

// The capsule of a character at some place. It stops `skin` before whatever it meets: far more than
// the rounding errors of a sweep, so that motion along a surface never catches on its seams.
class Body {
public:
    Body(const World& world, const CharacterRules& rules, const Mask& mask, double height)
        : world_(world), rules_(&rules), mask_(mask), height_(height) {}

    const World& world() const { return world_; }
    const CharacterRules& rules() const { return *rules_; }
    const Mask& mask() const { return mask_; }
    bool is_walkable(const Vec3& normal) const { return normal.y >= rules_->slope_limit; }

    Capsule capsule(const Vec3& position) const;

    // Moves `position` along `motion` as far as it goes; what stopped it, if anything.
    std::optional<Touch> advance(Vec3& position, const Vec3& motion) const;

    // What overlaps the body most deeply, if anything.
    std::optional<Contact> overlap(const Vec3& position) const;

    // Gives way to what overlaps the body, deepest first. False if it still overlaps.
    bool depenetrate(Vec3& position) const;

private:
    World world_;
    const CharacterRules* rules_;
    Mask mask_;
    double height_;
};

} // namespace peregrine::gameplay
