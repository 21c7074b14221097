#pragma once

#include "base/isa.h"
#include "base/memory.h"
#include "base/scheduler.h"
#include "render/camera.h"
#include "scene/snapshot.h"

#include <cstdint>
#include <span>

namespace peregrine::render {

// The values are those of rt.h.
enum class PixelFormat : uint32_t {
    rgba8_srgb = 0,
    bgra8_srgb = 1,
    rgba16f = 3,
    rgba32f = 4,
};
enum class View : uint32_t {
    shaded = 0,
    normals = 1,
    depth = 2,
    steps = 3,
    light = 4,
    occlusion = 5,
};
enum class ToneMapping : uint32_t { filmic = 0, clamp = 1, none = 2 };
enum class TextureFilter : uint32_t { finest = 0, mipmaps = 1 };

inline uint32_t bytes_per_pixel(PixelFormat format) {
    return format == PixelFormat::rgba32f ? 16 : format == PixelFormat::rgba16f ? 8 : 4;
}

// Rows of what the primary rays see; null: not wanted.
struct Plane {
    void* data = nullptr;    // top row first, of any alignment
    uint64_t row_stride = 0; // bytes
};

// What trades error for time; as it is here, nothing. See rt_frame_desc.
struct Approximations {
    uint32_t light_block = 1;
    float light_tolerance = 0;
    TextureFilter texture_filter = TextureFilter::finest;
    float least_light = 0;
    uint32_t edge_samples = 1;
    float edge_budget = 0;
    uint32_t render_width = 0; // of the frame, if not smaller
    uint32_t render_height = 0;
};

// How far the paths are followed that mirrors and glass send on; see rt_frame_desc.
struct Bounces {
    uint32_t max_depth = 0; // 0: they send none on
    float least_importance = 0;
};
inline constexpr uint32_t kMostDepth = 16;

// How much ambient light reaches a place. See rt_frame_desc.
struct Occlusion {
    float range = 0; // metres; 0: all of it
    uint32_t samples = 16;
    uint32_t block = 1;
    float tolerance = 0;
    float normal_tolerance = 0;
    float plane_tolerance = 0;
};

// Over-bright light that spreads to its surroundings; see rt_frame_desc.
struct Bloom {
    float strength = 0; // 0: none does
    float threshold = 1;
    float radius = 0.15f;
};

// A point that shines; see rt_particle.
struct Particle {
    math::Vec3 place; // from the eye
    float radius;
    math::Vec3 color;
};

struct Extent {
    uint32_t width = 0;
    uint32_t height = 0;

    bool operator==(const Extent&) const = default;
};

struct Frame {
    PixelFormat format = PixelFormat::rgba8_srgb;
    void* pixels = nullptr;  // top row first, of any alignment; null: shade nothing
    uint64_t row_stride = 0; // bytes; at least width pixels
    uint32_t width = 0;
    uint32_t height = 0;
    View view = View::shaded;
    ToneMapping tone_mapping = ToneMapping::filmic;
    float exposure = 1;
    float depth_range = 50;
    float steps_range = 100;
    bool shadows = true;
    bool tinted_shadows = false;
    Plane depth;        // float: t, which is the distance along `forward` (see Pinhole)
    Plane triangle_ids; // uint32_t
    Plane mesh_ids;     // base::Handle
    Plane normals;      // float[3]
    Approximations approximations;
    Bounces bounces;
    Occlusion occlusion;
    Bloom bloom;
    uint32_t airlight_pieces = 0; // see shade::AirShadows, ...
    uint32_t airlight_block = 1;  // ... of which this is the group's side
    std::span<const Particle> particles;
    bool measures_luminance = false;
    bool baked_light = false; // what the snapshot's light map says is used

    bool is_shaded() const { return pixels && view == View::shaded; }
    bool looks_for_edges() const { return is_shaded() && approximations.edge_samples > 1; }
    bool finds_blocks() const {
        return pixels && (view == View::light || (is_shaded() && approximations.light_block > 1));
    }
    // Beyond the batch for which it was found.
    bool keeps_light() const { return finds_blocks() || looks_for_edges(); }
    bool counts_luminance() const { return is_shaded() && measures_luminance; }
    bool blooms() const { return is_shaded() && bloom.strength > 0; }
    bool shows_particles() const { return is_shaded() && !particles.empty(); }
    Extent extent() const { return {width, height}; }
    // What is traced of it. Debug views and planes are never enlarged.
    Extent traced() const {
        const uint32_t w = approximations.render_width, h = approximations.render_height;
        if (!is_shaded()) return extent();
        return {w == 0 || w > width ? width : w, h == 0 || h > height ? height : h};
    }
    bool is_enlarged() const { return traced() != extent(); }
    bool wants_planes() const {
        return depth.data || triangle_ids.data || mesh_ids.data || normals.data;
    }
};

struct FrameStats {
    uint32_t threads = 0;
    uint64_t rays_primary = 0;
    uint64_t rays_shadow = 0;
    uint64_t rays_edge = 0;
    uint64_t light_points = 0;
    uint64_t rays_bounced = 0;
    uint64_t rays_occlusion = 0;
    uint64_t occlusion_points = 0;
    uint64_t rays_particle = 0;
    uint64_t program_hits = 0;
    uint64_t program_faults = 0;
    float mean_luminance = 0; // 0: not measured
    double frame_ms = 0;
    base::Isa isa = base::Isa::scalar;
};

// Renders what the snapshot holds into frame.pixels and the planes. Throws std::bad_alloc alone,
// before the first pixel is written. `stats` may be null.
void render_frame(const scene::Snapshot& snapshot, const Camera& camera, const Frame& frame,
                  base::Scheduler& scheduler, base::Memory* memory, FrameStats* stats);

} // namespace peregrine::render
