#include "query/search.h"

#include "query/check_rays.h"
#include "query/chosen.h"
#include "query/hit_names.h"
#include "query/marks.h"
#include "query/spread.h"
#include "query/total_counters.h"
#include "query/valid_ray.h"
#include "trace/world/search.h"

#include <limits>

namespace peregrine::query {
namespace {

constexpr uint32_t kAll = std::numeric_limits<uint32_t>::max(); // crossings of a ray
constexpr Hit kMiss = {kInfinity, 0, 0, geometry::kNoTriangle, {}, 0, 0};

// The host's word in the world's terms.
class HostJudge {
public:
    HostJudge(const scene::Snapshot& snapshot, const Accept& accept)
        : names_(snapshot), accept_(accept) {
        if (accept) judge_ = {accepts, this};
    }
    HostJudge(const HostJudge&) = delete;
    HostJudge& operator=(const HostJudge&) = delete;

    void begin_ray(uint64_t ray) { ray_ = ray; }
    const trace::Judge& judge() const { return judge_; }

private:
    static bool accepts(void* context, const trace::WorldHit& hit) {
        const auto& self = *static_cast<const HostJudge*>(context);
        return self.accept_.ask(self.accept_.user, self.ray_, self.names_.hit(hit));
    }

    const HitNames names_;
    const Accept& accept_;
    trace::Judge judge_;
    uint64_t ray_ = 0;
};

// Calls answer(search, i, ray) for every ray, or mark(i) for those that are not valid.
template <class Answer, class Mark>
void search_each(const scene::Snapshot& snapshot, const Rays& rays, const Request& request,
                 Answer&& answer, Mark&& mark) {
    const bool marks = request.mark_invalid;
    if (!marks) check_rays(rays, ray_loaders(snapshot.isa()), request.scheduler);
    const Accept& accept = request.selection.accept;
    const Chosen chosen(snapshot, request.selection);
    TotalCounters total;
    spread(accept ? nullptr : request.scheduler, rays.count, [&](uint64_t first, uint64_t end) {
        HostJudge host(snapshot, accept);
        trace::Search search(snapshot.world, chosen.filter(), host.judge());
        for (uint64_t i = first; i < end; ++i) {
            const math::Ray ray = rays.load(i);
            if (marks && !is_valid(ray)) [[unlikely]] {
                mark(i);
                continue;
            }
            host.begin_ray(i);
            answer(search, i, ray);
        }
        if (request.counters) total.add(search.counters());
    });
    if (request.counters) *request.counters = total.get();
}

} // namespace

void search_closest(const scene::Snapshot& snapshot, const Rays& rays, const Request& request,
                    const Hits& hits, const Surfaces& surfaces) {
    const HitNames names(snapshot);
    search_each(
        snapshot, rays, request,
        [&](trace::Search& search, uint64_t i, const math::Ray& ray) {
            trace::WorldHit found;
            const Hit hit = search.closest(ray, rays.position(i), found) ? names.hit(found) : kMiss;
            hits.store(i, hit);
            if (surfaces) surfaces.store(i, surface_at(snapshot, hit, surfaces.fields));
        },
        [&](uint64_t i) { mark(i, hits, surfaces); });
}

void search_any(const scene::Snapshot& snapshot, const Rays& rays, const Request& request,
                const Strided<uint8_t>& occluded) {
    search_each(
        snapshot, rays, request,
        [&](trace::Search& search, uint64_t i, const math::Ray& ray) {
            occluded.store(i, search.occluded(ray, rays.position(i)));
        },
        [&](uint64_t i) { occluded.store(i, kInvalidByte); });
}

namespace {

// `Counted`: to the end of each ray, for lists.totals.
template <bool Counted>
void list_hits(const scene::Snapshot& snapshot, const Rays& rays, const Request& request,
               const HitLists& lists) {
    const HitNames names(snapshot);
    search_each(
        snapshot, rays, request,
        [&](trace::Search& search, uint64_t i, const math::Ray& ray) {
            const auto store = [&](uint32_t k, const trace::WorldHit& found) {
                if (Counted && k >= lists.most) return;
                const uint64_t place = i * lists.most + k;
                store_hit(names.hit(found), lists.hits + place * lists.stride);
                if (lists.surfaces)
                    lists.surfaces.store(
                        place, surface_at(snapshot, names.hit(found), lists.surfaces.fields));
            };
            const uint32_t count =
                search.crossings(ray, rays.position(i), Counted ? kAll : lists.most, store);
            lists.counts.store(i, Counted ? std::min(count, lists.most) : count);
            if (Counted) lists.totals.store(i, count);
        },
        [&](uint64_t i) {
            lists.counts.store(i, kInvalidCount);
            if (Counted) lists.totals.store(i, kInvalidCount);
        });
}

} // namespace

void all_hits(const scene::Snapshot& snapshot, const Rays& rays, const Request& request,
              const HitLists& lists) {
    lists.totals.data ? list_hits<true>(snapshot, rays, request, lists)
                      : list_hits<false>(snapshot, rays, request, lists);
}

void count_hits(const scene::Snapshot& snapshot, const Rays& rays, const Request& request,
                const Strided<uint32_t>& counts) {
    search_each(
        snapshot, rays, request,
        [&](trace::Search& search, uint64_t i, const math::Ray& ray) {
            const auto ignore = [](uint32_t, const trace::WorldHit&) {};
            counts.store(i, search.crossings(ray, rays.position(i), kAll, ignore));
        },
        [&](uint64_t i) { counts.store(i, kInvalidCount); });
}

} // namespace peregrine::query
