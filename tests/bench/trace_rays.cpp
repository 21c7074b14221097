#include "trace_rays.h"

#include "primary_rays.h"
#include "render/tile.h"
#include "sampling.h"
#include "tracer.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace peregrine::bench {

using math::Ray;
using math::Vec3;

const char* const kRayLegend =
    "P  primary, closest: an image (--size) from each of two cameras at most, a batch per camera\n"
    "S  shadow, any hit: from the point light that reaches most of what a camera sees, to the\n"
    "   points it sees that face the light, t in [0, 1 - 2^-12], in the order of P; a batch per "
    "light\n"
    "A  ambient occlusion, any hit: 4 cosine-distributed rays from every 4th point, 10% of the\n"
    "   scene's diagonal long\n"
    "D  diffuse bounce, closest: a cosine-distributed ray per point\n"
    "R  mirror reflection by the geometric normal, closest: a ray per point\n"
    "L  line of sight, any hit: segments between random points of empty space, one call per ray\n"
    "N  short rays of 0.1 to 1 m from such points, closest, one call per ray\n";

namespace {

constexpr size_t kLargestSet = size_t(1) << 20; // of A, D and R; P and S have it for each camera
constexpr size_t kFreeRays = 200'000;           // of L and N
constexpr size_t kLightSamples = 4096;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kOffset = 1e-4f;         // of the diagonal: how far above a surface rays start
constexpr float kAmbientLength = 0.1f;   // of the diagonal
constexpr float kBeforePoint = 0x1p-12f; // shadow rays end before their point
constexpr size_t kAmbientRays = 4, kAmbientEvery = 4;

RaySet empty_set(char kind, bool any) {
    RaySet set;
    set.kind = kind;
    set.any = any;
    set.batches = {0};
    return set;
}

RaySet close_batch(RaySet set) {
    set.batches.push_back(set.rays.size());
    return set;
}

} // namespace

RayMaker::RayMaker(const TraceScene& scene, const Tracer& exact, uint32_t image_size)
    : scene_(scene), exact_(exact),
      primary_(make_primary_rays(scene.cameras, image_size, image_size)) {
    trace_primary();
}

void RayMaker::trace_primary() {
    Results results;
    exact_.prepare(primary_, results);
    exact_.trace(0, primary_, 0, primary_.rays.size(), results);
    for (size_t i = 0; i < primary_.rays.size(); ++i) {
        const Answer answer = exact_.answer(0, primary_, results, i);
        t_.push_back(answer.t);
        triangle_.push_back(answer.triangle);
    }
    if (std::ranges::all_of(triangle_, [](uint32_t i) { return i == geometry::kNoTriangle; }))
        throw std::runtime_error(scene_.name + ": its cameras see nothing");
}

bool RayMaker::find_point(size_t ray, Point& point) const {
    if (triangle_[ray] == geometry::kNoTriangle) return false;
    const geometry::Triangle& triangle = scene_.triangles[triangle_[ray]];
    // In double: the normals of slivers would overflow or vanish.
    const math::Vec3d v0(triangle.v0);
    const Vec3 normal(
        glm::normalize(glm::cross(math::Vec3d(triangle.v1) - v0, math::Vec3d(triangle.v2) - v0)));
    const Ray& from = primary_.rays[ray];
    point.position = from.origin + t_[ray] * from.direction;
    point.direction = from.direction;
    point.normal = glm::dot(normal, from.direction) > 0 ? -normal : normal;
    return true;
}

// Of large images every nth tile is left out, so that neighbours stay together.
bool RayMaker::is_kept(size_t ray, size_t rays_per_tile) const {
    const size_t tiles = (primary_.rays.size() + render::kTileRays - 1) / render::kTileRays;
    const size_t every = (tiles * rays_per_tile + kLargestSet - 1) / kLargestSet;
    return ray / render::kTileRays % every == 0;
}

Vec3 RayMaker::off_surface(const Point& point) const {
    return point.position + kOffset * scene_.diagonal() * point.normal;
}

// The light that reaches most of what the camera sees; a point above the scene if none does.
Vec3 RayMaker::choose_light(size_t view) const {
    const size_t first = primary_.batches[view], last = primary_.batches[view + 1];
    const size_t step = std::max<size_t>(1, (last - first) / kLightSamples);
    RaySet set = empty_set('S', true);
    std::vector<size_t> ends;
    for (const Vec3& light : scene_.lights) {
        Point point;
        for (size_t i = first; i < last; i += step) {
            if (!find_point(i, point)) continue;
            const Vec3 direction = point.position - light;
            if (glm::dot(point.normal, direction) >= 0) continue;
            set.rays.push_back({light, 0, direction, 1 - kBeforePoint});
        }
        ends.push_back(set.rays.size());
    }
    Results results;
    exact_.prepare(set, results);
    exact_.trace(0, set, 0, set.rays.size(), results);
    const math::Box& bounds = scene_.bounds;
    Vec3 best = 0.5f * (bounds.lower + bounds.upper);
    best.y = bounds.upper.y + 0.5f * scene_.diagonal();
    size_t most = 0, ray = 0;
    for (size_t light = 0; light < ends.size(); ++light) {
        size_t reached = 0;
        for (; ray < ends[light]; ++ray)
            reached += exact_.answer(0, set, results, ray).triangle == geometry::kNoTriangle;
        if (reached > most) best = scene_.lights[light];
        most = std::max(most, reached);
    }
    return best;
}

RaySet RayMaker::shadow() const {
    RaySet set = empty_set('S', true);
    set.common_origin = true;
    for (size_t view = 0; view < primary_.views.size(); ++view) {
        const Vec3 light = choose_light(view);
        Point point;
        for (size_t i = primary_.batches[view]; i < primary_.batches[view + 1]; ++i) {
            if (!find_point(i, point)) continue;
            const Vec3 direction = point.position - light;
            if (glm::dot(point.normal, direction) < 0)
                set.rays.push_back({light, 0, direction, 1 - kBeforePoint});
        }
        set.batches.push_back(set.rays.size());
    }
    return set;
}

RaySet RayMaker::ambient() const {
    RaySet set = empty_set('A', true);
    Random random(1);
    Point point;
    const float length = kAmbientLength * scene_.diagonal();
    for (size_t i = 0; i < primary_.rays.size(); i += kAmbientEvery) {
        if (!is_kept(i, render::kTileRays / kAmbientEvery * kAmbientRays)) continue;
        if (!find_point(i, point)) continue;
        for (size_t k = 0; k < kAmbientRays; ++k)
            set.rays.push_back({off_surface(point), 0, random.cosine(point.normal), length});
    }
    return close_batch(std::move(set));
}

RaySet RayMaker::diffuse() const {
    RaySet set = empty_set('D', false);
    Random random(2);
    Point point;
    for (size_t i = 0; i < primary_.rays.size(); ++i)
        if (is_kept(i, render::kTileRays) && find_point(i, point))
            set.rays.push_back({off_surface(point), 0, random.cosine(point.normal), kInfinity});
    return close_batch(std::move(set));
}

RaySet RayMaker::mirror() const {
    RaySet set = empty_set('R', false);
    Point point;
    for (size_t i = 0; i < primary_.rays.size(); ++i)
        if (is_kept(i, render::kTileRays) && find_point(i, point))
            set.rays.push_back(
                {off_surface(point), 0, glm::reflect(point.direction, point.normal), kInfinity});
    return close_batch(std::move(set));
}

RaySet RayMaker::line_of_sight() const {
    RaySet set = empty_set('L', true);
    set.one_by_one = true;
    Random random(3);
    while (set.rays.size() < kFreeRays) {
        const Vec3 from = random.free_point(primary_.rays, t_);
        const Vec3 to = random.free_point(primary_.rays, t_);
        if (from != to) set.rays.push_back({from, 0, to - from, 1});
    }
    return close_batch(std::move(set));
}

RaySet RayMaker::nearby() const {
    RaySet set = empty_set('N', false);
    set.one_by_one = true;
    Random random(4);
    while (set.rays.size() < kFreeRays) {
        const Vec3 from = random.free_point(primary_.rays, t_);
        const Vec3 direction = random.direction();
        set.rays.push_back({from, 0, direction, 0.1f + 0.9f * random.uniform()});
    }
    return close_batch(std::move(set));
}

RaySet RayMaker::make(char kind) const {
    switch (kind) {
    case 'P':
        return primary_;
    case 'S':
        return shadow();
    case 'A':
        return ambient();
    case 'D':
        return diffuse();
    case 'R':
        return mirror();
    case 'L':
        return line_of_sight();
    case 'N':
        return nearby();
    default:
        throw std::logic_error("no such kind of rays");
    }
}

} // namespace peregrine::bench
