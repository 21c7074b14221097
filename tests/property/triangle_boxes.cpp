#include "triangle_boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace peregrine::test {
namespace {

constexpr size_t kBlock = 256;
constexpr double kMargin = 1e-3; // of the largest coordinate, of which 2^-24 is rounding

// Of an axis: when the swath's middle is within the widened boxes.
struct Slab {
    const float* lower;
    const float* upper;
    float center, margin, direction;
};

// 0 where the middle is never in a box: what is not a number counts as in.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)                                \
    && !defined(__SANITIZE_ADDRESS__)
[[gnu::target_clones("avx2", "default")]]
#endif
int32_t
meet(const Slab (&slabs)[3], float t_max, size_t first, size_t count, int32_t* in) {
    float enter[kBlock], leave[kBlock];
    for (size_t i = 0; i < count; ++i) {
        enter[i] = 0;
        leave[i] = t_max;
    }
    for (const Slab& slab : slabs) {
        const float *lower = slab.lower + first, *upper = slab.upper + first;
        const float low = slab.center + slab.margin, high = slab.center - slab.margin;
        if (slab.direction == 0) {
            const float never = std::numeric_limits<float>::infinity();
            for (size_t i = 0; i < count; ++i)
                enter[i] = ((lower[i] > low) | (upper[i] < high)) ? never : enter[i];
            continue;
        }
        const float inverse = 1 / slab.direction;
        for (size_t i = 0; i < count; ++i) {
            const float a = (lower[i] - low) * inverse, b = (upper[i] - high) * inverse;
            const float sooner = a < b ? a : b, later = a < b ? b : a;
            enter[i] = sooner > enter[i] ? sooner : enter[i];
            leave[i] = later < leave[i] ? later : leave[i];
        }
    }
    int32_t any = 0;
    for (size_t i = 0; i < count; ++i) {
        in[i] = !(enter[i] > leave[i]) & !(enter[i] == std::numeric_limits<float>::infinity());
        any |= in[i];
    }
    return any;
}

} // namespace

void TriangleBoxes::add(const math::Vec3d& a, const math::Vec3d& b, const math::Vec3d& c) {
    for (int k = 0; k < 3; ++k) {
        lower_[k].push_back(float(std::min({a[k], b[k], c[k]})));
        upper_[k].push_back(float(std::max({a[k], b[k], c[k]})));
        largest_ = std::max({largest_, std::abs(a[k]), std::abs(b[k]), std::abs(c[k])});
    }
}

void TriangleBoxes::find(const Swath& swath, std::vector<uint32_t>& found) const {
    double largest = std::max(largest_, swath.radius);
    for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(swath.center[k]));
    const double margin = swath.radius + kMargin * largest;
    Slab slabs[3];
    for (int k = 0; k < 3; ++k)
        slabs[k] = {lower_[k].data(), upper_[k].data(), float(swath.center[k]), float(margin),
                    float(swath.direction[k])};
    for (size_t first = 0; first < lower_[0].size(); first += kBlock) {
        const size_t count = std::min(kBlock, lower_[0].size() - first);
        int32_t in[kBlock];
        if (!meet(slabs, float(swath.t_max), first, count, in)) continue;
        for (size_t i = 0; i < count; ++i)
            if (in[i]) found.push_back(uint32_t(first + i));
    }
}

} // namespace peregrine::test
