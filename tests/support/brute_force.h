#pragma once

#include "geometry/triangle.h"
#include "math/ray.h"
#include "trace/kernels.h"

#include <span>
#include <vector>

namespace peregrine::test {

// The oracle: every triangle is tested with the canonical test, in order. Nothing is skipped but by
// the test's own float filter, which runs over separate arrays so that the compiler vectorises it.
class BruteForce {
public:
    explicit BruteForce(std::span<const geometry::Triangle> triangles);

    trace::Hit closest(const math::Ray& ray, const trace::Filter& filter = {}) const;
    bool occluded(const math::Ray& ray, const trace::Filter& filter = {}) const;

private:
    template <class Visit>
    void visit_candidates(const math::Ray& ray, Visit&& visit) const;

    std::span<const geometry::Triangle> triangles_;
    std::vector<float> corners_[3][3]; // by vertex and axis
};

} // namespace peregrine::test
