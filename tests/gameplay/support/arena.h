#pragma once

#include "gameplay/character.h"

#include <vector>

namespace peregrine::test {

using gameplay::Vec3;

// A little world of boxes and quads for the rules of the game, through the table of the library.
class Arena {
public:
    explicit Arena(rt_isa isa = RT_ISA_BEST, uint32_t threads = 1);
    ~Arena();
    Arena(const Arena&) = delete;
    Arena& operator=(const Arena&) = delete;

    bool is_supported() const { return supported_; } // the instruction set, by this machine

    // Fixed parts; all before the first commit.
    void add_triangle(const Vec3& a, const Vec3& b, const Vec3& c);
    void add_quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
    void add_box(const Vec3& lower, const Vec3& upper);
    void add_floor(double half_size, double height = 0);
    void add_room(const Vec3& lower, const Vec3& upper); // seen from inside

    // A box that moves. `move` commits, and returns what to tell the characters.
    rt_mesh add_mover(const Vec3& lower, const Vec3& upper);
    gameplay::MeshMotion move(rt_mesh mover, const rt_transform& to);
    gameplay::MeshMotion shift(rt_mesh mover, const Vec3& offset);

    void commit();
    gameplay::World world() const { return {*api_, scene_}; }
    rt_scene scene() const { return scene_; }

private:
    rt_transform& place_of(rt_mesh mover);

    const rt_api* api_;
    rt_scene scene_{};
    bool supported_ = true;
    std::vector<float> positions_; // of the fixed part, until it is committed
    struct Mover {
        rt_mesh mesh;
        rt_transform place;
    };
    std::vector<Mover> movers_;
};

// A turn about the y axis through `hinge`, by an angle of this sine and cosine.
rt_transform turned(const Vec3& hinge, double sine, double cosine);

// Updates `steps` times, with jumps and motions in the first step alone.
void run(gameplay::Character& character, gameplay::CharacterInput input, int steps,
         double seconds = 1.0 / 60);

// A character that has come to rest at a place.
gameplay::Character standing(const gameplay::World& world, const Vec3& position,
                             const gameplay::CharacterRules& rules = {});

uint64_t hash(const gameplay::CharacterState& state);

} // namespace peregrine::test
