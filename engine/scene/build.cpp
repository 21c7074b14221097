#include "scene/build.h"

#include "accel/bih/builder.h"
#include "accel/bvh/builder.h"
#include "accel/bvh/compact.h"
#include "accel/kdtree/builder.h"

namespace peregrine::scene {

BuildChoice BuildChoice::relevant() const {
    BuildChoice choice;
    choice.structure = structure;
    if (structure == trace::Structure::bvh) {
        choice.quality = quality;
        choice.compact = compact;
    }
    if (structure == trace::Structure::bih && quality == accel::bvh::Quality::fast)
        choice.quality = quality;
    if (structure == trace::Structure::kdtree) choice.empty_bonus = empty_bonus;
    return choice;
}

namespace {

// The nodes and blocks go, the report stays.
void make_compact(base::Scheduler& scheduler, base::Memory* memory, Geometry& geometry) {
    accel::bvh::Tree& full = geometry.bvh;
    geometry.compact_bvh = accel::bvh::compact(full, scheduler, memory);
    full.nodes = base::Vector<accel::bvh::Node>(memory);
    full.blocks = base::Vector<accel::bvh::Block>(memory);
}

} // namespace

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
        if (choice.compact) make_compact(scheduler, memory, geometry);
    }
}

} // namespace peregrine::scene
