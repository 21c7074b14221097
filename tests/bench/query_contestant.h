#pragma once

#include "geometry/triangle.h"
#include "query_set.h"
#include "tracer.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace peregrine::bench {

constexpr size_t kMaxCrossings = 16; // a ray

// What a contestant found, a place a query.
struct QueryAnswers {
    std::vector<uint8_t> yes;     // any, overlap
    LineVector<float> t;          // closest, stream, sweep, nearest: infinity if nothing
    std::vector<uint32_t> counts; // all: of `crossings`
    std::vector<float> crossings; // kMaxCrossings a ray, ascending

    void make_room(const QuerySet& set) {
        const size_t count = set.size();
        const bool all = set.kind == QueryKind::all;
        yes.assign(count, 0);
        t.assign(count, 0);
        counts.assign(all ? count : 0, 0);
        crossings.assign(all ? count * kMaxCrossings : 0, 0);
    }
};

// Where a level lies. Libraries without an origin of their own get rounded coordinates.
struct Level {
    std::span<const geometry::Triangle> triangles;
    math::Vec3d offset{0};
};

// A library with a level in it.
class QueryContestant {
public:
    virtual ~QueryContestant() = default;

    virtual std::string name() const = 0;
    virtual bool answers(QueryKind kind) const = 0;
    virtual void prepare(const QuerySet& set) = 0; // not measured; the set must stay
    virtual void run(QueryAnswers& answers) const = 0;
};

} // namespace peregrine::bench
