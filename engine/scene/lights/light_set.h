#pragma once

#include "accel/spheres/tree.h"
#include "base/memory.h"
#include "base/scheduler.h"
#include "math/box.h"
#include "scene/light.h"
#include "scene/lights/prepared_light.h"

#include <memory>

namespace peregrine::scene {

// What was proved of a light's ways to the fixed triangles.
using LightViews = base::Vector<std::shared_ptr<const trace::visibility::PointVisibility>>;

// The lights of a snapshot, in the order of their slots; shared by snapshots between which none of
// them changed.
struct LightSet {
    explicit LightSet(base::Memory* memory)
        : lights(memory), views(memory), prepared(memory), tree(memory), beside(memory),
          in_fog(memory) {}

    base::Vector<Light> lights;
    LightViews views; // beside `lights`; null: nothing. Empty if nothing was proved at all
    base::Vector<PreparedLight> prepared; // beside `lights`, relative to the snapshot's origin
    accel::spheres::Tree tree;            // of those that end somewhere, unless these are few, ...
    base::Vector<uint32_t> beside;        // ... and the others: both by their numbers
    base::Vector<uint32_t> in_fog;        // numbers of those that fog scatters
    float largest_radius = 0;             // of those with from_light

    // Whether it is what make_light_set() would make.
    bool is_of(const base::Vector<Light>& lights, const LightViews& views,
               const math::Box& bounds) const;
};

// `bounds`: of the world.
std::shared_ptr<const LightSet> make_light_set(base::Vector<Light> lights, LightViews views,
                                               const math::Box& bounds, base::Scheduler& scheduler,
                                               base::Memory* memory);

} // namespace peregrine::scene
