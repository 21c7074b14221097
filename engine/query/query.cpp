#include "query/query.h"

#include "query/batch.h"
#include "query/store_hit.h"
#include "query/valid_ray.h"
#include "scene/alpha_test.h"
#include "trace/world/single.h"

namespace peregrine::query {

trace::Filter make_filter(const scene::Snapshot& snapshot, const Selection& selection) {
    trace::Filter filter;
    filter.faces = selection.faces;
    filter.layer_mask = selection.layer_mask;
    filter.layer_masks = snapshot.layer_masks.data();
    const base::Handle ignored = selection.ignore_mesh;
    if (ignored && ignored.index < snapshot.meshes.size()
        && snapshot.meshes[ignored.index].generation == ignored.generation)
        filter.ignore_mesh = ignored.index;
    if (selection.alpha_test && (snapshot.features & scene::kAlphaMask))
        filter.alpha = scene::alpha_test(snapshot);
    return filter;
}

namespace {

void check_each(const Rays& rays) {
    for (uint64_t i = 0; i < rays.count; ++i) check_ray(i, rays.load(i));
}

void store_record(const trace::Hit& hit, const HitNames& names, std::byte* place) {
    store_hit(hit.t, hit.u, hit.v, names.of(hit.triangle), hit.back_face, place);
}

void store_elements(const trace::Hit& hit, const HitNames& names, const HitArrays& arrays,
                    uint64_t i) {
    const auto store = [i](auto* array, auto value) {
        if (array) store_element(array, i, value);
    };
    const HitIds ids = names.of(hit.triangle);
    store(arrays.t, hit.t);
    store(arrays.u, hit.u);
    store(arrays.v, hit.v);
    store(arrays.triangle, ids.triangle);
    store(arrays.mesh, ids.mesh);
    store(arrays.back_face, uint32_t(hit.back_face));
}

} // namespace

void closest_hits(const scene::Snapshot& snapshot, const Rays& rays, const Selection& selection,
                  const Hits& hits) {
    const trace::Filter filter = make_filter(snapshot, selection);
    if (rays.count >= kSmallestBatch)
        return closest_batch(snapshot, rays, filter, selection.coherence, hits);
    check_each(rays);
    const HitNames names(snapshot);
    for (uint64_t i = 0; i < rays.count; ++i) {
        const trace::Hit hit = trace::closest(snapshot.world, rays.load(i), filter);
        hits.records ? store_record(hit, names, hits.records + i * hits.stride)
                     : store_elements(hit, names, hits.arrays, i);
    }
}

void occlusion(const scene::Snapshot& snapshot, const Rays& rays, const Selection& selection,
               const Strided<uint8_t>& occluded) {
    const trace::Filter filter = make_filter(snapshot, selection);
    if (rays.count >= kSmallestBatch)
        return occlusion_batch(snapshot, rays, filter, selection.coherence, occluded);
    check_each(rays);
    for (uint64_t i = 0; i < rays.count; ++i)
        occluded.store(i, trace::occluded(snapshot.world, rays.load(i), filter));
}

} // namespace peregrine::query
