#include "shade/light/choice.h"

#include "shade/light/most_light.h"

#include <algorithm>
#include <cmath>

namespace peregrine::shade {
namespace {

// The box where the world has it, and what rounding may be off there.
math::Box moved(const math::Box& box, const math::Vec3d& by) {
    if (by == math::Vec3d(0)) return box;
    math::Box out;
    for (int k = 0; k < 3; ++k) {
        const double lower = double(box.lower[k]) + by[k], upper = double(box.upper[k]) + by[k];
        const double most = std::fabs(by[k]) + std::max(std::fabs(lower), std::fabs(upper));
        out.lower[k] = float(lower - most * 0x1p-21);
        out.upper[k] = float(upper + most * 0x1p-21);
    }
    return out;
}

bool is_dimmer(const DimLight& a, const DimLight& b) {
    return a.most < b.most || (a.most == b.most && a.number < b.number);
}

} // namespace

// The tree gives few more than reaches() lets through, in no order.
std::span<const uint32_t> LightChoice::reaching(const math::Box& bounds, LightLists& lists) const {
    if (lights_.empty()) return {};
    uint32_t* found = lists.found;
    set_->tree.for_each_near(moved(bounds, origin_), [&](uint32_t number) {
        if (reaches(lights_[number], bounds)) *found++ = number;
    });
    std::sort(lists.found, found);
    uint32_t* chosen = lists.chosen;
    const uint32_t* next = lists.found;
    for (const uint32_t number : set_->beside) {
        if (!reaches(lights_[number], bounds)) continue;
        while (next < found && *next < number) *chosen++ = *next++;
        *chosen++ = number;
    }
    chosen = std::copy(next, static_cast<const uint32_t*>(found), chosen);
    auto count = uint32_t(chosen - lists.chosen);
    if (unseen_ > 0) count = leave_out_unseen(bounds, lists, count);
    return {lists.chosen, count};
}

// The dimmest ones, as long as all of them together stay unseen.
uint32_t LightChoice::leave_out_unseen(const math::Box& bounds, LightLists& lists,
                                       uint32_t count) const {
    DimLight* const dim = lists.dim;
    uint32_t dim_count = 0;
    float sum = 0;
    for (uint32_t i = 0; i < count; ++i) {
        const float most = most_light(lights_[lists.chosen[i]], bounds);
        if (!(most <= unseen_)) continue;
        dim[dim_count++] = {most, lists.chosen[i]};
        sum += most;
    }
    if (!(sum <= unseen_)) {
        std::sort(dim, dim + dim_count, is_dimmer);
        sum = 0;
        uint32_t unseen = 0;
        while (unseen < dim_count && (sum += dim[unseen].most) <= unseen_) ++unseen;
        dim_count = unseen;
        std::sort(dim, dim + dim_count,
                  [](const DimLight& a, const DimLight& b) { return a.number < b.number; });
    }
    uint32_t kept = 0;
    for (uint32_t i = 0, next = 0; i < count; ++i)
        if (next < dim_count && dim[next].number == lists.chosen[i])
            ++next;
        else
            lists.chosen[kept++] = lists.chosen[i];
    return kept;
}

} // namespace peregrine::shade
