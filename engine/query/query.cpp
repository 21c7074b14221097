#include "query/query.h"

#include "query/batch.h"
#include "query/chosen.h"
#include "query/hit_names.h"
#include "query/marks.h"
#include "query/search.h"
#include "query/valid_ray.h"
#include "trace/world/single.h"

namespace peregrine::query {
namespace {

// Calls answer(i, ray) for every ray, or mark(i) for those that are not valid.
template <class Answer, class Mark>
void for_each(const Rays& rays, bool marks, Answer&& answer, Mark&& mark) {
    if (!marks)
        for (uint64_t i = 0; i < rays.count; ++i) check_ray(i, rays.load(i));
    for (uint64_t i = 0; i < rays.count; ++i) {
        const math::Ray ray = rays.load(i);
        if (marks && !is_valid(ray)) [[unlikely]]
            mark(i);
        else
            answer(i, ray);
    }
}

} // namespace

void closest_hits(const scene::Snapshot& snapshot, const Rays& rays, const Request& request,
                  const Hits& hits, const Surfaces& surfaces) {
    if (needs_search(request)) return search_closest(snapshot, rays, request, hits, surfaces);
    const Chosen chosen(snapshot, request.selection);
    if (rays.count >= kSmallestBatch)
        return closest_batch(snapshot, rays, chosen.filter(), request, hits, surfaces);
    const HitNames names(snapshot);
    for_each(
        rays, request.mark_invalid,
        [&](uint64_t i, const math::Ray& ray) {
            const trace::Hit found =
                trace::closest(snapshot.world, ray, rays.position(i), chosen.filter());
            const Hit hit = names.hit(found);
            hits.store(i, hit);
            if (surfaces) surfaces.store(i, surface_at(snapshot, hit, surfaces.fields));
        },
        [&](uint64_t i) { mark(i, hits, surfaces); });
}

void occlusion(const scene::Snapshot& snapshot, const Rays& rays, const Request& request,
               const Strided<uint8_t>& occluded) {
    if (needs_search(request)) return search_any(snapshot, rays, request, occluded);
    const Chosen chosen(snapshot, request.selection);
    if (rays.count >= kSmallestBatch)
        return occlusion_batch(snapshot, rays, chosen.filter(), request, occluded);
    for_each(
        rays, request.mark_invalid,
        [&](uint64_t i, const math::Ray& ray) {
            occluded.store(i,
                           trace::occluded(snapshot.world, ray, rays.position(i), chosen.filter()));
        },
        [&](uint64_t i) { occluded.store(i, kInvalidByte); });
}

} // namespace peregrine::query
