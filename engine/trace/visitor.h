#pragma once

#include "geometry/intersect.h"

#include <cstdint>

namespace peregrine::trace {

// The work that rays took. It depends on the structure and on the instruction set; answers do not.
struct Counters {
    uint64_t nodes = 0;     // of structures over triangles, leaves of the kd-tree and the BIH too
    uint64_t triangles = 0; // in the leaves visited: a reference each
    uint64_t instances = 0; // rigid meshes that rays were taken to

    Counters& operator+=(const Counters& other) {
        nodes += other.nodes;
        triangles += other.triangles;
        instances += other.instances;
        return *this;
    }
};

// Sees every triangle that a ray meets: for questions that the kernels for closest and any hits do
// not answer.
class Visitor {
public:
    enum class Wants { hits, crossings }; // geometry/intersect.h, geometry/crossing.h

    explicit Visitor(Wants wants) : crossings_(wants == Wants::crossings) {}
    Visitor(const Visitor&) = delete;
    Visitor& operator=(const Visitor&) = delete;

    // The ray hits, or crosses, a triangle of the target; in any order, and a triangle may come
    // more than once. Returns the t up to which more is to be seen; it never grows.
    virtual float see(uint32_t triangle, const geometry::TriangleHit& hit) = 0;

    bool wants_crossings() const { return crossings_; }

    Counters counters;

protected:
    ~Visitor() = default;

private:
    bool crossings_;
};

} // namespace peregrine::trace
