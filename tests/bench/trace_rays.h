#pragma once

#include "level.h"
#include "math/ray.h"
#include "trace_scene.h"

#include <cstdint>
#include <vector>

namespace peregrine::bench {

class Tracer;

// Rays of one kind, the same for all contestants.
struct RaySet {
    char kind = 'P';
    bool any = false;           // any hit; otherwise the closest
    bool one_by_one = false;    // a call per ray
    bool common_origin = false; // within each batch
    std::vector<math::Ray> rays;
    std::vector<size_t> batches; // where each begins, and the end of the last

    // Of primary rays: batch i is the whole image of view i, in tiles of 32x32 row by row, each in
    // Morton order, as render::Tile orders them.
    std::vector<host::Viewpoint> views;
    uint32_t image_width = 0, image_height = 0;
    std::vector<size_t> pixels; // where a ray's pixel is, image after image, row by row
};

// A sentence for each kind of rays.
extern const char* const kRayLegend;

// Makes the sets of a scene. Everything starts from the camera's rays and what they hit, which an
// exact tracer finds; sets are the same for the same scene and size.
class RayMaker {
public:
    RayMaker(const TraceScene& scene, const Tracer& exact, uint32_t image_size);

    RaySet make(char kind) const; // of "PSADRLN"

private:
    struct Point {
        math::Vec3 position, normal; // unit, towards the viewer
        math::Vec3 direction;        // of the ray that found it
    };

    void trace_primary();
    bool find_point(size_t ray, Point& point) const;
    bool is_kept(size_t ray, size_t rays_per_tile) const;
    math::Vec3 choose_light(size_t view) const;
    math::Vec3 off_surface(const Point& point) const;

    RaySet shadow() const;
    RaySet ambient() const;
    RaySet diffuse() const;
    RaySet mirror() const;
    RaySet line_of_sight() const;
    RaySet nearby() const;

    const TraceScene& scene_;
    const Tracer& exact_;
    RaySet primary_;
    std::vector<float> t_;           // of the primary rays
    std::vector<uint32_t> triangle_; // of the primary rays
};

} // namespace peregrine::bench
