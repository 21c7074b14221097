#pragma once

#include "base/slot_map.h"
#include "math/ray.h"
#include "trace/world/position.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

// How rays come from the host and hits go to it.
namespace peregrine::query {

// Records of the host, `stride` bytes apart, aligned as they may be.
template <class Record>
struct Strided {
    std::byte* data;
    uint64_t count;
    uint32_t stride;

    Record load(uint64_t i) const {
        Record record;
        std::memcpy(&record, data + i * stride, sizeof record);
        return record;
    }
    void store(uint64_t i, const Record& record) const {
        std::memcpy(data + i * stride, &record, sizeof record);
    }
};

// Element i of an array of the host, aligned as it may be.
template <class T>
T load_element(const T* array, uint64_t i) {
    T value;
    std::memcpy(&value, reinterpret_cast<const std::byte*>(array) + i * sizeof value, sizeof value);
    return value;
}

template <class T>
void store_element(T* array, uint64_t i, const T& value) {
    std::memcpy(reinterpret_cast<std::byte*>(array) + i * sizeof value, &value, sizeof value);
}

// Rays as separate arrays, in the order of math::Ray's members.
struct RayArrays {
    static constexpr uint32_t kBegin = 3, kEnd = 7;

    const float* array[8]; // origin, t_min, direction, t_max; a null t_min is 0, t_max infinity

    math::Ray load(uint64_t i) const {
        const auto at = [&](uint32_t k) { return load_element(array[k], i); };
        return {{at(0), at(1), at(2)},
                array[kBegin] ? at(kBegin) : 0.0f,
                {at(4), at(5), at(6)},
                array[kEnd] ? at(kEnd) : std::numeric_limits<float>::infinity()};
    }

    RayArrays from(uint64_t first) const {
        RayArrays rest;
        for (uint32_t k = 0; k < 8; ++k) rest.array[k] = array[k] ? array[k] + first : nullptr;
        return rest;
    }
};

// Added to the places of a host's rays and shapes, in double; the sum is rounded to float, once an
// axis. Not 0 where they are relative to a point of the host's own.
struct Shift {
    math::Vec3d by{0};

    // Whether it is not 0, of either sign; in integers, for the sake of small batches.
    explicit operator bool() const {
        const auto bits = [this](int k) { return std::bit_cast<uint64_t>(by[k]); };
        return (bits(0) | bits(1) | bits(2)) << 1 != 0;
    }
    float applied(float value, int axis) const { return float(double(value) + by[axis]); }
    math::Vec3 applied(const math::Vec3& point) const {
        return {applied(point.x, 0), applied(point.y, 1), applied(point.z, 2)};
    }
    math::Ray applied(const math::Ray& ray) const {
        return {applied(ray.origin), ray.t_min, ray.direction, ray.t_max};
    }
};

// The rays of a query, in one form or the other.
struct Rays {
    uint64_t count;
    const std::byte* records; // null: arrays
    uint32_t stride;
    RayArrays arrays;
    Shift shift{};

    // A record goes in wide words all the way to the kernels, which load it so.
    math::Ray load(uint64_t i) const {
        if (shift) return shift.applied(records ? load_record(i) : arrays.load(i));
        if (records) return load_record(i);
        return arrays.load(i);
    }
    // These are as the host gives them.
    template <class Number>
    void gather(const Number& number, uint32_t count, math::Ray* to) const {
        if (records)
            for (uint32_t i = 0; i < count; ++i)
                std::memcpy(to + i, records + number(i) * stride, sizeof *to);
        else
            for (uint32_t i = 0; i < count; ++i) to[i] = arrays.load(number(i));
    }
    math::Vec3 own_origin(uint64_t i) const { return load_vector(i, 0); }
    trace::Position position(uint64_t i) const { return {own_origin(i), shift.by}; }
    math::Vec3 direction(uint64_t i) const { return load_vector(i, 4); }

    Rays part(uint64_t first, uint64_t end) const {
        return records ? Rays{end - first, records + first * stride, stride, {}, shift}
                       : Rays{end - first, nullptr, 0, arrays.from(first), shift};
    }

private:
    math::Vec3 load_vector(uint64_t i, uint32_t k) const {
        if (!records)
            return {load_element(arrays.array[k], i), load_element(arrays.array[k + 1], i),
                    load_element(arrays.array[k + 2], i)};
        math::Vec3 v;
        std::memcpy(&v, records + i * stride + k * sizeof(float), sizeof v);
        return v;
    }
    math::Ray load_record(uint64_t i) const {
        math::Ray ray;
        std::memcpy(&ray, records + i * stride, sizeof ray);
        return ray;
    }
};

// A hit as it leaves the library: the layout of rt_hit.
struct Hit {
    float t, u, v;
    uint32_t triangle; // the host's own index; kNoTriangle for a miss
    base::Handle mesh;
    uint32_t instance;
    uint32_t back_face;
};
static_assert(sizeof(Hit) == 32);

// Eight bytes at a time to where the host wants them: a record put together elsewhere and copied
// would wait for its own stores.
inline void store_hit(const Hit& hit, std::byte* place) {
    const auto store = [place](size_t offset, auto low, auto high) {
        static_assert(sizeof low == 4 && sizeof high == 4);
        const uint64_t both =
            std::bit_cast<uint32_t>(low) | uint64_t(std::bit_cast<uint32_t>(high)) << 32;
        std::memcpy(place + offset, &both, sizeof both);
    };
    static_assert(offsetof(Hit, v) == 8 && offsetof(Hit, mesh) == 16
                  && offsetof(Hit, instance) == 24);
    store(0, hit.t, hit.u);
    store(8, hit.v, hit.triangle);
    store(16, hit.mesh.index, hit.mesh.generation);
    store(24, hit.instance, hit.back_face);
}

// Hits as separate arrays; null: not wanted.
struct HitArrays {
    float* t;
    float* u;
    float* v;
    uint32_t* triangle;
    base::Handle* mesh;
    uint32_t* back_face;

    void store(uint64_t i, const Hit& hit) const {
        const auto put = [i](auto* array, auto value) {
            if (array) store_element(array, i, value);
        };
        put(t, hit.t);
        put(u, hit.u);
        put(v, hit.v);
        put(triangle, hit.triangle);
        put(mesh, hit.mesh);
        put(back_face, hit.back_face);
    }
};

// Where the hits of a query go, in one form or the other.
struct Hits {
    std::byte* records; // null: arrays
    uint32_t stride;
    HitArrays arrays;

    void store(uint64_t i, const Hit& hit) const {
        if (records)
            store_hit(hit, records + i * stride);
        else
            arrays.store(i, hit);
    }
};

} // namespace peregrine::query
