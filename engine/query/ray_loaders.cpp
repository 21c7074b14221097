// Rays from records to separate arrays, compiled once for each instruction set.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/ray_loaders.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "query/ray_loaders.h"
#include "query/valid_ray.h"

#include <algorithm>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace peregrine::query::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, 16>;
using Bits = hn::RebindToSigned<Lanes>;
using Floats = hn::Vec<Lanes>;
using Ints = hn::Vec<Bits>;
constexpr uint32_t kWidth = uint32_t(hn::MaxLanes(Lanes()));
constexpr uint32_t kRecord = sizeof(math::Ray);

// As many rays as a vector has lanes, each axis for itself, in the order of math::Ray's members.
struct Group {
    Floats lane[8];
};

#if HWY_TARGET == HWY_SCALAR
HWY_INLINE Group load_group(const std::byte* records, size_t) {
    Group group;
    for (uint32_t k = 0; k < 8; ++k)
        group.lane[k] = hn::Set(Lanes(), load_element(reinterpret_cast<const float*>(records), k));
    return group;
}

HWY_INLINE Floats load_array(const float* array, uint64_t first) {
    return hn::Set(Lanes(), load_element(array, first));
}
#else
// The first 16 bytes of records r, r + 4, r + 8, ... beside one another.
template <class D>
HWY_INLINE hn::Vec<D> load_halves(D d, const std::byte* records, size_t stride) {
    if constexpr (hn::MaxLanes(d) == 4) {
        const hn::Full128<uint8_t> bytes;
        return hn::BitCast(d, hn::LoadU(bytes, reinterpret_cast<const uint8_t*>(records)));
    } else {
        const hn::Half<D> half;
        return hn::Combine(d, load_halves(half, records + hn::MaxLanes(half) * stride, stride),
                           load_halves(half, records, stride));
    }
}

// A 4x4 transposition in each 128-bit block.
HWY_INLINE void transpose_halves(const std::byte* records, size_t stride, Floats* lane) {
    const Lanes d;
    const Floats r0 = load_halves(d, records, stride);
    const Floats r1 = load_halves(d, records + stride, stride);
    const Floats r2 = load_halves(d, records + 2 * stride, stride);
    const Floats r3 = load_halves(d, records + 3 * stride, stride);
    const Floats a = hn::InterleaveLower(d, r0, r2), b = hn::InterleaveLower(d, r1, r3);
    const Floats c = hn::InterleaveUpper(d, r0, r2), e = hn::InterleaveUpper(d, r1, r3);
    lane[0] = hn::InterleaveLower(d, a, b);
    lane[1] = hn::InterleaveUpper(d, a, b);
    lane[2] = hn::InterleaveLower(d, c, e);
    lane[3] = hn::InterleaveUpper(d, c, e);
}

HWY_INLINE Group load_group(const std::byte* records, size_t stride) {
    Group group;
    transpose_halves(records, stride, group.lane);
    transpose_halves(records + kRecord / 2, stride, group.lane + 4);
    return group;
}
HWY_INLINE Floats load_array(const float* array, uint64_t first) {
    const hn::Repartition<uint8_t, Lanes> bytes;
    const auto* place = reinterpret_cast<const uint8_t*>(array) + first * sizeof(float);
    return hn::BitCast(Lanes(), hn::LoadU(bytes, place));
}

#endif

// The largest magnitudes seen, and the smallest length in the sense that zero has no bits.
class Validity {
public:
    HWY_INLINE Validity()
        : origin_(hn::Zero(Bits())), direction_(origin_), range_(origin_),
          length_(hn::Set(Bits(), int32_t(kMagnitude))) {}

    HWY_INLINE void look(const Group& group) {
        const Bits d;
        const Ints magnitude = hn::Set(d, int32_t(kMagnitude));
        const auto at = [&](uint32_t k)
                            HWY_ATTR { return hn::And(hn::BitCast(d, group.lane[k]), magnitude); };
        const Ints x = at(4), y = at(5), z = at(6);
        origin_ = hn::Max(origin_, hn::Max(hn::Max(at(0), at(1)), at(2)));
        direction_ = hn::Max(direction_, hn::Max(hn::Max(x, y), z));
        range_ = hn::Max(range_, hn::Max(at(3), at(7)));
        length_ = hn::Min(length_, hn::Or(hn::Or(x, y), z));
    }

    HWY_INLINE bool holds() const {
        const Bits d;
        const auto beyond = [&](const Ints& seen, float limit) HWY_ATTR {
            return hn::Gt(seen, hn::Set(d, int32_t(bits_of(limit))));
        };
        const auto wrong =
            hn::Or(hn::Or(beyond(origin_, kLargestOrigin), beyond(direction_, kLargestFloat)),
                   hn::Or(beyond(range_, kInfinity), hn::Eq(length_, hn::Zero(d))));
        return hn::AllFalse(d, wrong);
    }

private:
    Ints origin_, direction_, range_, length_;
};

// The last group of records, padded with the last of them.
struct alignas(64) Tail {
    std::byte records[kWidth * kRecord];

    HWY_INLINE Tail(const std::byte* first, size_t stride, size_t count) {
        for (size_t i = 0; i < kWidth; ++i)
            std::memcpy(records + i * kRecord, first + std::min(i, count - 1) * stride, kRecord);
    }
};

bool split(const std::byte* records, uint32_t stride, uint32_t count, float* const lanes[8]) {
    const Lanes d;
    Validity validity;
    const auto put = [&](const Group& group, uint32_t first) HWY_ATTR {
        for (uint32_t k = 0; k < 8; ++k) hn::Store(group.lane[k], d, lanes[k] + first);
        validity.look(group);
    };
    uint32_t i = 0;
    for (; i + kWidth <= count; i += kWidth)
        put(load_group(records + size_t(i) * stride, stride), i);
    const uint32_t padded = (count + 15) / 16 * 16;
    if (i == padded) return validity.holds();
    const uint32_t left = std::max(count - i, 1u);
    const Tail tail(records + size_t(count - left) * stride, stride, left);
    put(load_group(tail.records, kRecord), i);
    const Tail last(records + size_t(count - 1) * stride, stride, 1);
    const Group repeated = load_group(last.records, kRecord);
    while ((i += kWidth) < padded) put(repeated, i);
    return validity.holds();
}

bool check_records(const std::byte* records, uint32_t stride, uint64_t count) {
    Validity validity;
    uint64_t i = 0;
    for (; i + kWidth <= count; i += kWidth)
        validity.look(load_group(records + i * stride, stride));
    if (i < count) {
        const Tail tail(records + i * stride, stride, count - i);
        validity.look(load_group(tail.records, kRecord));
    }
    return validity.holds();
}

bool check_arrays(const RayArrays& arrays, uint64_t count) {
    Validity validity;
    const uint64_t whole = count - count % kWidth;
    Group group;
    for (Floats& lane : group.lane) lane = hn::Zero(Lanes()); // for those that are not there
    for (uint64_t i = 0; i < whole; i += kWidth) {
        for (uint32_t k = 0; k < 8; ++k)
            if (arrays.array[k]) group.lane[k] = load_array(arrays.array[k], i);
        validity.look(group);
    }
    bool valid = validity.holds();
    for (uint64_t i = whole; i < count; ++i) valid &= is_valid(arrays.load(i));
    return valid;
}

constexpr RayLoaders kLoaders = {split, check_records, check_arrays};

} // namespace peregrine::query::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/select.h"

namespace peregrine::query {

const RayLoaders& ray_loaders(base::Isa isa) {
    const auto* const table = PEREGRINE_TABLE_FOR(isa, kLoaders);
    // Otherwise the last one compiled: the machine's baseline.
    return table ? *table : HWY_NAMESPACE::kLoaders;
}

} // namespace peregrine::query
#endif
