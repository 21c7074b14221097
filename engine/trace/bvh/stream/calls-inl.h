// What the rooms have for streams and for each other: each table is in the kernels.cpp of its room.
// Included once for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_STREAM_CALLS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_STREAM_CALLS_INL_H
#undef PEREGRINE_TRACE_BVH_STREAM_CALLS_INL_H
#else
#define PEREGRINE_TRACE_BVH_STREAM_CALLS_INL_H
#endif

#include <hwy/highway.h>

#include "trace/bvh/single/kernels.h"
#include "trace/bvh/stream/kernels.h"
#include "trace/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

// Tables, not functions: a function that is declared and defined with attributes for its target is
// two versions of one to GCC.

extern const SingleKernels kSingles;        // of the full tree
extern const SingleKernels kCompactSingles; // ... and of the compact one

// Rays of a stream that were gathered.
struct Beam;
struct BeamCalls {
    void (*closest)(const Target& target, Beam& beam, const RayStream& rays, const Filter& filter,
                    const HitStream& hits);
    // False: these rays had better not be a beam, and nothing is known of them.
    bool (*occluded)(const Target& target, Beam& beam, const RayStream& rays, const Filter& filter,
                     uint8_t* occluded);
};
extern const BeamCalls kBeams;

struct ParallelBeam;
struct ParallelCalls {
    bool (*occluded)(const Target& target, ParallelBeam& beam, const RayStream& rays,
                     const Filter& filter, uint8_t* occluded); // as of BeamCalls
};
extern const ParallelCalls kParallels;

struct Pencil;
struct PencilCalls {
    void (*closest)(const Target& target, Pencil& pencil, const RayStream& rays,
                    const Filter& filter, const HitStream& hits);
    void (*occluded)(const Target& target, Pencil& pencil, const RayStream& rays,
                     const Filter& filter, uint8_t* occluded);
};
extern const PencilCalls kPencils;

// A stream that says its tile.
struct TileCalls {
    // False: these rays had better go as beams, and nothing is known of them.
    bool (*closest)(const Target& target, const RayStream& rays, const Filter& filter,
                    const HitStream& hits);
};
extern const TileCalls kTiles;

// All rays of a stream.
extern const StreamKernels kWaveStreams;

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
