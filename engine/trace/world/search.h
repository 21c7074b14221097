#pragma once

#include "trace/filter.h"
#include "trace/visitor.h"
#include "trace/world/hit_list.h"
#include "trace/world/world.h"

// Rays through all parts of a world, one by one and by way of visitors: for every question that the
// kernels for closest and any hits do not answer.
namespace peregrine::trace {

// Decides about hits that passed a filter, on the thread that searches. A hit may be asked about
// more than once.
struct Judge {
    bool (*accepts)(void* context, const WorldHit& hit) = nullptr; // null: all
    void* context = nullptr;
};

class Search {
public:
    Search(const World& world, const Filter& filter, const Judge& judge)
        : world_(world), filter_(filter), judge_(judge) {}

    // The first hit; false: none.
    bool closest(const math::Ray& ray, const Position& position, WorldHit& hit);
    bool occluded(const math::Ray& ray, const Position& position);

    // Calls store(i, hit) for each triangle that the ray crosses (geometry/crossing.h), in order,
    // but for no more than `most`; returns how many there were.
    template <class Store>
    uint32_t crossings(const math::Ray& ray, const Position& position, uint32_t most,
                       Store&& store) {
        HitList list(most);
        uint32_t count = 0;
        math::Ray left = ray;
        while (count < most) {
            collect_crossings(left, position, list);
            for (const WorldHit& hit : list.hits()) store(count++, hit);
            if (!list.full() || count == most) break;
            left.t_min = list.hits().back().t;
            list.go_on(most - count);
        }
        return count;
    }

    const Counters& counters() const { return counters_; }

private:
    void collect_crossings(const math::Ray& ray, const Position& position, HitList& list);

    template <class Hits>
    void visit_parts(const math::Ray& ray, const Position& position, Visitor::Wants wants,
                     Hits& hits);

    const World& world_;
    const Filter& filter_;
    const Judge& judge_;
    Counters counters_;
};

} // namespace peregrine::trace
