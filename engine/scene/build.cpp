#include "scene/build.h"

#include "accel/bih/builder.h"
#include "accel/bvh/builder.h"
#include "accel/kdtree/builder.h"

namespace peregrine::scene {

BuildChoice BuildChoice::relevant() const {
    BuildChoice choice;
    choice.structure = structure;
    if (structure == trace::Structure::bvh) choice.quality = quality;
    if (structure == trace::Structure::bih && quality == accel::bvh::Quality::fast)
        choice.quality = quality;
    if (structure == trace::Structure::kdtree) choice.empty_bonus = empty_bonus;
    return choice;
}

void build_structure(const BuildChoice& choice, base::Scheduler& scheduler,
                     const base::Progress& progress, base::Memory* memory, Geometry& geometry) {
    geometry.structure = choice.structure;
    switch (choice.structure) {
    case trace::Structure::kdtree: {
        accel::kdtree::BuildOptions build;
        build.empty_bonus = choice.empty_bonus;
        geometry.kdtree =
            accel::kdtree::build(geometry.triangles, build, scheduler, progress, memory);
        return;
    }
    case trace::Structure::bih: {
        accel::bih::BuildOptions build;
        build.fast = choice.quality == accel::bvh::Quality::fast;
        geometry.bih = accel::bih::build(geometry.triangles, build, scheduler, progress, memory);
        return;
    }
    case trace::Structure::bvh:
        accel::bvh::BuildOptions build;
        build.quality = choice.quality;
        geometry.bvh = accel::bvh::build(geometry.triangles, build, scheduler, progress, memory);
        geometry.triangles = base::Vector<geometry::Triangle>(memory); // it has its own copy
    }
}

} // namespace peregrine::scene
