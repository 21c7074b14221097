#pragma once

#include "gameplay/character.h"
#include "gameplay/three_cores/plan.h"

#include <vector>

namespace peregrine::three_cores {

// Moves a plan's part in the scene, and remembers how for those who ride on it.
class Mover {
public:
    explicit Mover(const Part& part) : part_(part), now_(part.rest) {}

    const Part& part() const { return part_; }
    const rt_transform& place() const { return now_; }

    // Does nothing if it is there. Seen after the next commit.
    void move(const rt_api& api, rt_scene scene, const rt_transform& to,
              std::vector<gameplay::MeshMotion>& motions);
    bool has(const rt_mesh& mesh) const;

private:
    Part part_;
    rt_transform now_;
};

// `rest`, shifted in the world.
rt_transform shifted(const rt_transform& rest, const Vec3& by);
// `rest`, after a turn about its own Y axis by an angle of this sine and cosine.
rt_transform turned(const rt_transform& rest, double sine, double cosine);
// A point of the part's own space in the world.
Vec3 placed(const rt_transform& transform, const Vec3& point);

} // namespace peregrine::three_cores
