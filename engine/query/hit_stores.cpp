// Hits from streams to the host's records, compiled once for each instruction set.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/hit_stores.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "query/hit_stores.h"

#include <bit>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace peregrine::query::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<uint32_t, 8>;
constexpr uint32_t kWidth = uint32_t(hn::MaxLanes(Lanes()));

// `count` copies of a value of four or eight bytes, at any address.
template <class T>
HWY_INLINE void repeat(T value, T* array, uint32_t first) {
    if constexpr (kWidth == 1) {
        store_element(array, first, value);
    } else {
        using Bits = std::conditional_t<sizeof(T) == 8, uint64_t, uint32_t>;
        const hn::CappedTag<Bits, 8> d;
        const hn::Repartition<uint8_t, decltype(d)> bytes;
        const auto vector = hn::BitCast(bytes, hn::Set(d, std::bit_cast<Bits>(value)));
        auto* place = reinterpret_cast<uint8_t*>(array) + first * sizeof value;
        for (uint32_t i = 0; i < kWidth; i += uint32_t(hn::MaxLanes(d)))
            hn::StoreU(vector, bytes, place + i * sizeof value);
    }
}

// Names triangles one group after the other.
class Namer {
public:
    HWY_INLINE explicit Namer(const HitNames& names) : names_(names), ids_(names.of(last_)) {}

    // kWidth triangles from `triangles` on, to places from `first` on.
    HWY_INLINE void name_group(const uint32_t* triangles, uint32_t* primitives,
                               base::Handle* meshes, uint32_t first) {
        const Lanes d;
        if (!hn::AllTrue(d, hn::Eq(hn::LoadU(d, triangles), hn::Set(d, *triangles)))) {
            for (uint32_t i = 0; i < kWidth; ++i)
                name_one(triangles[i], primitives, meshes, first + i);
            return;
        }
        look(*triangles);
        if (primitives) repeat(ids_.triangle, primitives, first);
        if (meshes) repeat(ids_.mesh, meshes, first);
    }

    HWY_INLINE void name_one(uint32_t triangle, uint32_t* primitives, base::Handle* meshes,
                             uint32_t at) {
        look(triangle);
        if (primitives) store_element(primitives, at, ids_.triangle);
        if (meshes) store_element(meshes, at, ids_.mesh);
    }

private:
    HWY_INLINE void look(uint32_t triangle) {
        if (triangle == last_) return;
        last_ = triangle;
        ids_ = names_.of(triangle);
    }

    const HitNames& names_;
    uint32_t last_ = geometry::kNoTriangle;
    HitIds ids_;
};

void names(const HitNames& names, const uint32_t* triangles, uint32_t count, uint32_t* primitives,
           base::Handle* meshes) {
    Namer namer(names);
    uint32_t i = 0;
    for (; i + kWidth <= count; i += kWidth) namer.name_group(triangles + i, primitives, meshes, i);
    for (; i < count; ++i) namer.name_one(triangles[i], primitives, meshes, i);
}

#if HWY_TARGET == HWY_SCALAR
void records(const HitNames& names, const trace::HitStream& hits, uint32_t count, std::byte* place,
             uint32_t stride) {
    for (uint32_t i = 0; i < count; ++i, place += stride) store_hit(names.hit(hits, i), place);
}
#else
// A group, four records at a time: the first 16 bytes by a 4x4 transposition, the others are two
// pairs.
HWY_INLINE void store_group(const trace::HitStream& hits, const uint32_t* primitives,
                            const base::Handle* meshes, uint32_t first, std::byte* place,
                            uint32_t stride) {
    const hn::Full128<uint32_t> d;
    const hn::Full128<uint64_t> pairs;
    const hn::Full128<uint8_t> bytes;
    static_assert(offsetof(Hit, triangle) == 12 && offsetof(Hit, mesh) == 16
                  && offsetof(Hit, back_face) == 28);
    const auto load = [&](const auto* array, uint32_t i) HWY_ATTR {
        return hn::LoadU(d, reinterpret_cast<const uint32_t*>(array) + i);
    };
    const auto put = [&](auto low, auto high) HWY_ATTR {
        hn::StoreU(hn::BitCast(bytes, low), bytes, reinterpret_cast<uint8_t*>(place));
        hn::StoreU(hn::BitCast(bytes, high), bytes, reinterpret_cast<uint8_t*>(place) + 16);
        place += stride;
    };
    for (uint32_t i = 0; i < kWidth; i += 4) {
        const auto t = load(hits.t, first + i), u = load(hits.u, first + i),
                   v = load(hits.v, first + i), triangle = load(primitives, i);
        const auto back = load(hits.back_face, first + i), zero = hn::Zero(d);
        const auto a = hn::InterleaveLower(d, t, v), b = hn::InterleaveLower(d, u, triangle);
        const auto c = hn::InterleaveUpper(d, t, v), e = hn::InterleaveUpper(d, u, triangle);
        const auto back01 = hn::BitCast(pairs, hn::InterleaveLower(d, zero, back));
        const auto back23 = hn::BitCast(pairs, hn::InterleaveUpper(d, zero, back));
        const auto* handles = reinterpret_cast<const uint64_t*>(meshes + i);
        const auto mesh01 = hn::LoadU(pairs, handles), mesh23 = hn::LoadU(pairs, handles + 2);
        put(hn::InterleaveLower(d, a, b), hn::InterleaveLower(pairs, mesh01, back01));
        put(hn::InterleaveUpper(d, a, b), hn::InterleaveUpper(pairs, mesh01, back01));
        put(hn::InterleaveLower(d, c, e), hn::InterleaveLower(pairs, mesh23, back23));
        put(hn::InterleaveUpper(d, c, e), hn::InterleaveUpper(pairs, mesh23, back23));
    }
}

void records(const HitNames& names, const trace::HitStream& hits, uint32_t count, std::byte* place,
             uint32_t stride) {
    Namer namer(names);
    uint32_t primitives[kWidth];
    base::Handle meshes[kWidth];
    uint32_t i = 0;
    for (; i + kWidth <= count; i += kWidth, place += size_t(kWidth) * stride) {
        namer.name_group(hits.triangle + i, primitives, meshes, 0);
        store_group(hits, primitives, meshes, i, place, stride);
    }
    for (; i < count; ++i, place += stride) store_hit(names.hit(hits, i), place);
}
#endif

constexpr HitStores kStores = {names, records};

} // namespace peregrine::query::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/select.h"

namespace peregrine::query {

const HitStores& hit_stores(base::Isa isa) {
    const auto* const table = PEREGRINE_TABLE_FOR(isa, kStores);
    // Otherwise the last one compiled: the machine's baseline.
    return table ? *table : HWY_NAMESPACE::kStores;
}

} // namespace peregrine::query
#endif
