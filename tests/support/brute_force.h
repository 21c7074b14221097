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

    // The closest hit of each ray; a ray is occluded exactly if it has one.
    void closest(std::span<const math::Ray> rays, const trace::Filter& filter,
                 trace::Hit* hits) const;

private:
    void test_block(const math::Ray& ray, size_t first, const trace::Filter& filter,
                    trace::Hit& best) const;

    std::span<const geometry::Triangle> triangles_;
    std::vector<float> corners_[3][3]; // by vertex and axis
};

} // namespace peregrine::test
