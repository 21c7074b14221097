#pragma once

#include "gameplay/world.h"

#include <array>
#include <span>

namespace peregrine::gameplay {

// The surfaces that something stands on: three hold it in any direction.
class Contacts {
public:
    std::span<const Vec3> normals() const { return {normals_.data(), count_}; }
    size_t count() const { return count_; }
    void clear() { *this = {}; }

    // With a normal in this direction. Takes the place of one that faces the same way; of the
    // oldest if there is no room.
    void add(const Vec3& direction);

    // What a body of this velocity leaves behind is no contact any more.
    void drop_parting(const Vec3& velocity);

private:
    std::array<Vec3, 3> normals_{};
    size_t count_ = 0;
};

// The vector nearest to `v` that points into none of the surfaces; at most three.
Vec3 constrain(const Vec3& v, std::span<const Vec3> normals);

} // namespace peregrine::gameplay
