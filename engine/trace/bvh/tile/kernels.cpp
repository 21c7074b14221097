// Tiles of primary rays, compiled once for each instruction set.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/bvh/tile/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "trace/bvh/stream/calls-inl.h"

#if !PEREGRINE_PLAIN_TARGET // there the plain kernels do the work
#include "trace/bvh/tile/kernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
HWY_ATTR bool closest_tile(const Target& target, const RayStream& rays, const Filter& filter,
                           const HitStream& hits) {
    Tile tile;
    if (!tile.gather(target, rays)) return false;
    if (filter.trivial())
        ClosestTile<false>(target, tile, rays, filter, hits).trace();
    else
        ClosestTile<true>(target, tile, rays, filter, hits).trace();
    return true;
}
#else
HWY_ATTR bool closest_tile(const Target&, const RayStream&, const Filter&, const HitStream&) {
    return false;
}
#endif

constinit const TileCalls kTiles = {closest_tile};

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
