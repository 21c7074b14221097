// Shapes in the wide BVH, compiled once for each instruction set: boxes and triangles in float,
// with bounds on what that may miss; what they leave open is decided by the canonical tests, which
// no instruction set changes.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/bvh/shapes/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "trace/bvh/shapes/kernels.h"
#include "trace/bvh/shapes/plain.h"

#if !PEREGRINE_PLAIN_TARGET // there the plain kernels do the work
#include "trace/bvh/shapes/blocks-inl.h"
#include "trace/bvh/shapes/nodes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

// What the filters' products stay within float's normal range for.
inline bool fits_filters(const Volume& volume, double reach) {
    const double speed = largest_component(volume.direction);
    return reach >= 0x1p-30 && reach <= 0x1p24 && largest_component(volume.origin) <= 0x1p40
           && (speed == 0 || (speed >= 0x1p-24 && speed <= 0x1p24));
}

// Calls visit(block, lanes) for each block of a leaf, `lanes` being those that hold a triangle
// of it, until it returns true. Blocks may be gone afterwards.
template <class Visit>
HWY_INLINE HWY_ATTR bool visit_blocks(const Target& target, Link link, Visit&& visit) {
    LeafRoom room;
    const Leaf leaf = fetch_leaf(target, link, room);
    const Block* block = leaf.blocks;
    for (uint32_t left = leaf.count;; ++block, left -= accel::bvh::kBlockWidth) {
        if (visit(*block, left < accel::bvh::kBlockWidth ? (1u << left) - 1 : 15u)) return true;
        if (left <= accel::bvh::kBlockWidth) return false;
    }
}

// Triangles that are still to be judged, by what they can achieve at best. Most turn out to be
// beyond the limit that others set.
class Candidates {
public:
    static constexpr uint32_t kRoom = 16;

    bool is_full() const { return count_ == kRoom; }

    void add(const Block& block, uint32_t lane, float best) {
        const uint32_t triangle = block.triangle[lane];
        for (uint32_t i = 0; i < count_; ++i)
            if (entries_[i].triangle == triangle) return; // from another leaf
        entries_[count_++] = {vertices_of(block, lane), triangle, best};
    }

    // Those first that promise most. `judge(vertices, triangle)` may lower the limit.
    template <class Judge>
    void settle(const float& limit, Judge&& judge) {
        while (count_ > 0) {
            uint32_t first = 0;
            for (uint32_t i = 1; i < count_; ++i)
                if (entries_[i].best < entries_[first].best) first = i;
            // In place: a copy in wide words would wait for the stores that put it together.
            Entry& entry = entries_[first];
            if (!(entry.best > limit)) judge(entry.vertices, entry.triangle);
            entry = entries_[--count_];
        }
    }

    void drop_beyond(float limit) {
        uint32_t kept = 0;
        for (uint32_t i = 0; i < count_; ++i)
            if (!(entries_[i].best > limit)) entries_[kept++] = entries_[i];
        count_ = kept;
    }

private:
    struct Entry {
        Vertices vertices;
        uint32_t triangle;
        float best;
    };
    uint32_t count_ = 0;
    Entry entries_[kRoom];
};

// The last triangles that were judged: split ones come again.
class Mailbox {
public:
    bool takes(uint32_t triangle) {
        for (const uint32_t known : known_)
            if (known == triangle) return false;
        known_[next_++ % kRoom] = triangle;
        return true;
    }

private:
    static constexpr uint32_t kRoom = 4;
    static constexpr uint32_t kNone = geometry::kNoTriangle;
    uint32_t known_[kRoom] = {kNone, kNone, kNone, kNone};
    uint32_t next_ = 0;
};

// Whether what float is sure of is an answer: not if triangles are asked for more than their
// geometry, by the filter or the host, nor if the shape is larger here than in the world.
template <class Query>
bool is_plain(const Query& query, const Place& place) {
    return query.filter.trivial() && !(query.watch && query.watch->accepts) && !place.to_world;
}

inline Volume thinned(const Volume& volume, double by) {
    Volume thinner = volume;
    thinner.radius = std::max(0.0, volume.radius - by);
    thinner.extent -= math::Vec3d(volume.radius - thinner.radius);
    return thinner;
}

// Looks for a contact before `best`, and before what `sure` triangles are touched at the latest.
// Returns that time.
HWY_INLINE HWY_ATTR float sweep_until(const Target& target, const Place& place,
                                      const Volume& volume, double reach, const SweepQuery& query,
                                      uint32_t sure, FirstHit& best) {
    MovingGate gate(volume, reach);
    SweepFilter filter(volume);
    Candidates candidates;
    Mailbox mailbox;
    float t_max = best.limit(query.t_max);
    const auto decide = [&](const Vertices& vertices, uint32_t triangle) HWY_ATTR {
        const float depth = best.depth;
        judge(query, place, vertices, target.infos, triangle, best);
        t_max = std::min(t_max, best.t);
        if (!(best.depth > depth) || place.to_world) return;
        // What is to be found now is as deep: a thinner shape at the start finds it.
        const Volume thinner = thinned(volume, double(best.depth) * (1 - 0x1p-20));
        gate = MovingGate(thinner, reach);
        filter = SweepFilter(thinner);
    };
    SweepFilter::Findings found;
    const auto look = [&](const Block& block, uint32_t lanes) HWY_ATTR
        __attribute__((always_inline)) {
        filter.look(block, t_max, found);
        const uint32_t certain = found.certain & sure;
        for (uint32_t open = found.open & lanes; open; open &= open - 1) {
            const auto lane = uint32_t(std::countr_zero(open));
            if (found.earliest[lane] > t_max) continue;
            if (certain >> lane & 1) t_max = std::min(t_max, found.latest[lane]);
            if (found.earliest[lane] > 0) {
                if (candidates.is_full()) candidates.drop_beyond(t_max);
                if (candidates.is_full()) candidates.settle(t_max, decide);
                candidates.add(block, lane, found.earliest[lane]);
            } else if (mailbox.takes(block.triangle[lane])) {
                decide(
                    vertices_of(block, lane),
                    block.triangle[lane]); // behind an initial contact there is nothing to look for
            }
        }
        return false;
    };
    visit_reached(
        target, gate, t_max, [&](Link leaf) HWY_ATTR __attribute__((always_inline)) {
            return visit_blocks(target, leaf, look);
        });
    candidates.settle(t_max, decide);
    return t_max;
}

HWY_ATTR void sweep_shape(const Target& target, const Place& place, const Volume& volume,
                          const SweepQuery& query, FirstHit& best) {
    if (target.bounds.empty()) return;
    const double reach = reach_of(target.bounds, volume);
    if (!fits_filters(volume, reach)) [[unlikely]]
        return kPlainShapesOfBlocks.sweep(target, place, volume, query, best);
    uint32_t sure = is_plain(query, place) ? 15 : 0;
    while (sweep_until(target, place, volume, reach, query, sure, best) < best.limit(query.t_max))
        sure = 0; // what was touched for sure did not stop a slide
}

// A ball at rest, and the distances of four triangles from its centre.
class Ball {
public:
    HWY_INLINE HWY_ATTR Ball(const Volume& volume, double reach)
        : origin_(splat(volume.origin)), reach_(hn::Set(k4, float(reach))),
          error_(float(0x1p-17 * reach)) {}

    // Squares of distances: what is at most `radius` away is below the one, what is below the other
    // is so for sure.
    float outside(float radius) const { return square(radius + error_) * (1 + 0x1p-20f); }
    float inside(float radius) const {
        return radius > error_ ? square(radius - error_) * (1 - 0x1p-20f) : 0;
    }
    // What is as far as `distance` says, squared, is below this for sure.
    float beyond(float distance) const { return outside(std::sqrt(distance) + error_); }

    HWY_INLINE HWY_ATTR FourDistances distances(const Block& block) const {
        return {FourTriangles(block, origin_), reach_};
    }

private:
    static float square(float x) { return x * x; }

    Vec4 origin_;
    V4 reach_;
    float error_;
};

// Calls visit(block, lane, is_sure) for the triangles that a ball may touch, or does for sure,
// until that returns true.
template <class Visit>
HWY_INLINE HWY_ATTR void visit_ball(const Target& target, const Volume& volume, double reach,
                                    bool sure, Visit&& visit) {
    const Ball ball(volume, reach);
    const BallGate gate(volume);
    const auto radius = float(volume.radius);
    const float limit = ball.outside(radius);
    const V4 outside = hn::Set(k4, limit), inside = hn::Set(k4, sure ? ball.inside(radius) : 0);
    const auto look = [&](const Block& block, uint32_t lanes) HWY_ATTR
        __attribute__((always_inline)) {
        const FourDistances distances = ball.distances(block);
        const uint32_t certain = bits_of(k4, hn::Lt(distances.high, inside));
        for (uint32_t open = ~bits_of(k4, hn::Gt(distances.low, outside)) & lanes; open;
             open &= open - 1) {
            const auto lane = uint32_t(std::countr_zero(open));
            if (visit(block, lane, (certain >> lane & 1) != 0)) return true;
        }
        return false;
    };
    visit_reached(
        target, gate, limit, [&](Link leaf) HWY_ATTR __attribute__((always_inline)) {
            return visit_blocks(target, leaf, look);
        });
}

// ... that another shape may touch.
template <class Visit>
HWY_INLINE HWY_ATTR void visit_box(const Target& target, const Volume& volume, double reach,
                                   Visit&& visit) {
    const BoxGate gate(volume, reach);
    const RestFilter filter(volume, reach);
    const float no_limit = 0;
    const auto look = [&](const Block& block, uint32_t lanes) HWY_ATTR
        __attribute__((always_inline)) {
        for (uint32_t open = filter.maybe(block) & lanes; open; open &= open - 1)
            if (visit(block, uint32_t(std::countr_zero(open)), false)) return true;
        return false;
    };
    visit_reached(
        target, gate, no_limit, [&](Link leaf) HWY_ATTR __attribute__((always_inline)) {
            return visit_blocks(target, leaf, look);
        });
}

// Calls visit(block, lane, is_sure) for the triangles that the query's shape may touch. False if
// the numbers do not fit.
template <class Visit>
HWY_INLINE HWY_ATTR bool visit_at_rest(const Target& target, const Place& place,
                                       const Volume& volume, const OverlapQuery& query,
                                       Visit&& visit) {
    const double reach = reach_of(target.bounds, volume);
    if (!fits_filters(volume, reach)) [[unlikely]]
        return false;
    if (query.shape.kind == Shape::sphere)
        visit_ball(target, volume, reach, is_plain(query, place), visit);
    else
        visit_box(target, volume, reach, visit);
    return true;
}

HWY_ATTR bool overlaps_shape(const Target& target, const Place& place, const Volume& volume,
                             const OverlapQuery& query) {
    if (target.bounds.empty()) return false;
    bool found = false;
    if (!visit_at_rest(target, place, volume, query,
                       [&](const Block& block, uint32_t lane, bool is_sure) {
                           return found = is_sure
                                          || judge(query, place, vertices_of(block, lane),
                                                   target.infos[block.triangle[lane]]);
                       }))
        return kPlainShapesOfBlocks.overlaps(target, place, volume, query);
    return found;
}

HWY_ATTR void collect_touched(const Target& target, const Place& place, const Volume& volume,
                              const OverlapQuery& query, Touched& touched) {
    if (target.bounds.empty()) return;
    if (!visit_at_rest(target, place, volume, query,
                       [&](const Block& block, uint32_t lane, bool is_sure) {
                           const geometry::TriangleInfo& info = target.infos[block.triangle[lane]];
                           const uint64_t key = key_of(place, info);
                           if (touched.wants(key)
                               && (is_sure || judge(query, place, vertices_of(block, lane), info)))
                               touched.add(key);
                           return false;
                       }))
        kPlainShapesOfBlocks.collect(target, place, volume, query, touched);
}

HWY_ATTR void nearest_triangle(const Target& target, const Place& place, const Volume& volume,
                               const NearestQuery& query, NearestHit& best) {
    if (target.bounds.empty()) return;
    const Volume center = with_radius(volume, 0);
    const double reach = reach_of(target.bounds, center);
    if (!fits_filters(center, reach)) [[unlikely]]
        return kPlainShapesOfBlocks.nearest(target, place, volume, query, best);
    const Ball ball(center, reach);
    const BallGate gate(center);
    const bool sure = is_plain(query, place);
    const auto outside = [&](float distance) {
        const double radius = double(distance) * volume.stretch + volume.slack;
        return ball.outside(float(std::min(radius, 4 * reach)) * (1 + 0x1p-20f));
    };
    float limit = outside(best.limit(query.radius));
    const auto decide = [&](const Vertices& vertices, uint32_t triangle) {
        judge(query, place, vertices, target.infos, triangle, best);
        limit = std::min(limit, outside(best.distance));
    };
    Candidates candidates;
    const auto look = [&](const Block& block, uint32_t lanes) HWY_ATTR
        __attribute__((always_inline)) {
        const FourDistances distances = ball.distances(block);
        uint32_t open = ~bits_of(k4, hn::Gt(distances.low, hn::Set(k4, limit))) & lanes;
        if (open == 0) return false;
        alignas(16) float low[4], high[4];
        hn::Store(distances.low, k4, low);
        hn::Store(distances.high, k4, high);
        for (; open; open &= open - 1) {
            const auto lane = uint32_t(std::countr_zero(open));
            if (low[lane] > limit) continue;
            if (sure && high[lane] < limit) limit = std::min(limit, ball.beyond(high[lane]));
            if (candidates.is_full()) candidates.drop_beyond(limit);
            if (candidates.is_full()) candidates.settle(limit, decide);
            candidates.add(block, lane, low[lane]);
        }
        return false;
    };
    visit_reached(
        target, gate, limit, [&](Link leaf) HWY_ATTR __attribute__((always_inline)) {
            return visit_blocks(target, leaf, look);
        });
    candidates.settle(limit, decide);
}

HWY_ATTR void surround_point(const Target& target, const Place& place, const Volume& volume,
                             const SeamQuery& query, geometry::Slide& slide) {
    if (target.bounds.empty()) return;
    const double reach = reach_of(target.bounds, volume);
    if (!fits_filters(volume, reach)) [[unlikely]]
        return kPlainShapesOfBlocks.surround(target, place, volume, query, slide);
    visit_ball(target, volume, reach, false, [&](const Block& block, uint32_t lane, bool) {
        judge(query, place, vertices_of(block, lane), target.infos[block.triangle[lane]], slide);
        return false;
    });
}

[[maybe_unused]] constexpr ShapeKernels kShapes = {sweep_shape, overlaps_shape, collect_touched,
                                                   nearest_triangle, surround_point};

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
#include "simd/select.h"

namespace peregrine::trace::bvh {

const ShapeKernels& shape_kernels(base::Isa isa) {
    const ShapeKernels* kernels = PEREGRINE_TABLE_FOR(isa, kShapes);
    return kernels ? *kernels : kPlainShapesOfBlocks;
}

} // namespace peregrine::trace::bvh
#endif
