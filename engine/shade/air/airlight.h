#pragma once

#include "shade/air/air_ways.h"
#include "shade/air/fog.h"
#include "shade/kernels.h"
#include "shade/light/shadows.h"

#include <span>

namespace peregrine::shade {

struct Scratch;

inline constexpr uint32_t kMostPieces = 32;

// One thread's working memory.
struct alignas(64) AirlightMemory {
    using Lanes = Surface::Lanes;

    Lanes eye[3]; // where rays begin that come from there
    Lanes t;      // where rays end, if not at what they hit
    AirWays ways;
    Lanes sums; // of the ways

    // What the lamp sees. One way asks for those about it that are like it.
    uint32_t asking[kPadded];                 // ways
    uint32_t by[kPadded];                     // of each way: which of those
    uint8_t hidden[kMostPieces + 1][kPadded]; // of those: whether the ends of pieces are
    Lanes seen[kMostPieces];                  // the part of each piece: of those, then of all ways
    // Points that are asked: which way, and where on it.
    uint32_t way[kPadded];
    Lanes at;
    // Pieces of which one end is seen: that and the other are brought together.
    uint32_t number[kPadded]; // in `asking`
    uint32_t piece[kPadded];
    Lanes bright;
    Lanes dark;
};

// Into how many pieces ways are cut to find what a lamp sees of them, 0: its light goes through
// everything; and of so many rays in a row one asks for all whose ways are alike.
struct AirShadows {
    uint32_t pieces = 0;
    uint32_t group = 1;
};

// Light of lamps that fog scatters toward the eye, once. It goes from the lamp to the fog as if
// there were none, and from there through it. Read-only: all threads share it.
class Airlight {
public:
    // `lights`: the snapshot's, relative to `space.origin`.
    Airlight(const scene::Snapshot& snapshot, const Fog& fog, std::span<const PreparedLight> lights,
             const SurfaceSpace& space, const AirShadows& shadows);

    bool any() const { return !numbers_.empty(); }
    void begin(const math::Vec3d& eye, AirlightMemory& memory) const; // of zeroed memory

    // Adds to radiance what rays get on their way to t. Both need scratch.airlight.
    void add(const AirRays& rays, float* const radiance[3], Scratch& scratch) const;
    // ... from the eye.
    void add(const RayHits& hits, float* const radiance[3], Scratch& scratch) const;

private:
    enum class Sight { all, some, nothing };

    AirBounds bounds_of(const AirRays& rays) const;
    void add(const PreparedLight& light, uint32_t count, float* const radiance[3],
             Scratch& scratch) const;
    Sight find_seen(const PreparedLight& light, uint32_t count, Scratch& scratch) const;
    uint32_t list_asking(uint32_t count, AirlightMemory& memory) const;
    void find_borders(const PreparedLight& light, uint32_t asking, Scratch& scratch) const;
    void approach(const PreparedLight& light, uint32_t count, Scratch& scratch) const;
    void ask(const PreparedLight& light, uint32_t count, Scratch& scratch) const;
    float end_of_piece(uint32_t end) const { return 2 * float(end) / float(pieces_) - 1; }

    const Kernels* kernels_;
    FogLayer layer_;
    std::span<const PreparedLight> lights_;
    std::span<const uint32_t> numbers_; // of those that light the fog
    SurfaceSpace space_;
    Shadows shadows_;
    uint32_t pieces_, group_;
    AirNodes nodes_, piece_nodes_;
};

} // namespace peregrine::shade
