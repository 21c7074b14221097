#include "query/query.h"

#include "query/batch.h"
#include "query/chosen.h"
#include "query/search.h"
#include "query/store_hit.h"
#include "query/valid_ray.h"
#include "trace/world/single.h"

namespace peregrine::query {
namespace {

void check_each(const Rays& rays) {
    for (uint64_t i = 0; i < rays.count; ++i) check_ray(i, rays.load(i));
}

} // namespace

void closest_hits(const scene::Snapshot& snapshot, const Rays& rays, const Request& request,
                  const Hits& hits, const Surfaces& surfaces) {
    if (needs_search(request)) return search_closest(snapshot, rays, request, hits, surfaces);
    const Chosen chosen(snapshot, request.selection);
    if (rays.count >= kSmallestBatch)
        return closest_batch(snapshot, rays, chosen.filter(), request, hits, surfaces);
    check_each(rays);
    const HitNames names(snapshot);
    for (uint64_t i = 0; i < rays.count; ++i) {
        const trace::Hit found =
            trace::closest(snapshot.world, rays.load(i), rays.position(i), chosen.filter());
        const HitIds ids = names.of(found.triangle);
        const Hit hit = {found.t, found.u, found.v, ids.triangle, ids.mesh, 0, found.back_face};
        hits.store(i, hit);
        if (surfaces) surfaces.store(i, surface_at(snapshot, hit, surfaces.fields));
    }
}

void occlusion(const scene::Snapshot& snapshot, const Rays& rays, const Request& request,
               const Strided<uint8_t>& occluded) {
    if (needs_search(request)) return search_any(snapshot, rays, request, occluded);
    const Chosen chosen(snapshot, request.selection);
    if (rays.count >= kSmallestBatch)
        return occlusion_batch(snapshot, rays, chosen.filter(), request, occluded);
    check_each(rays);
    for (uint64_t i = 0; i < rays.count; ++i)
        occluded.store(
            i, trace::occluded(snapshot.world, rays.load(i), rays.position(i), chosen.filter()));
}

} // namespace peregrine::query
