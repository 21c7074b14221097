#pragma once

#include "geometry/triangle.h"
#include "trace_rays.h"

#include <peregrine/rt.h>

#include <cstdint>
#include <new>
#include <string>
#include <vector>

namespace peregrine::bench {

// Begins with a cache line.
template <class T>
struct LineAllocator {
    using value_type = T;
    static constexpr std::align_val_t kLine{64};

    LineAllocator() = default;
    template <class U>
    LineAllocator(const LineAllocator<U>&) {}
    T* allocate(size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), kLine)); }
    void deallocate(T* memory, size_t) { ::operator delete(memory, kLine); }
    bool operator==(const LineAllocator&) const = default;
};
template <class T>
using LineVector = std::vector<T, LineAllocator<T>>;

// Where a contestant leaves what it found: in one of these forms. All have room for the whole set.
struct Results {
    std::vector<rt_hit> hits;
    LineVector<float> t;
    LineVector<uint32_t> triangle, mesh;
    LineVector<rt_mesh> meshes;
    std::vector<uint8_t> occluded;
};

// The same of any contestant.
struct Answer {
    float t = 0;                               // of a closest hit
    uint32_t triangle = geometry::kNoTriangle; // of a closest hit; any hit: 0 if there is one
};

// A contestant: a structure over a scene, and its ways to trace rays, the modes.
class Tracer {
public:
    virtual ~Tracer() = default;

    virtual std::string name() const = 0;
    virtual size_t mode_count() const = 0;
    virtual std::string mode_name(size_t mode) const = 0;
    virtual bool suits(size_t mode, const RaySet& set) const = 0;

    virtual void prepare(const RaySet& set, Results& results) const = 0;
    // What is measured. Rays [first, first + count) have a common origin if the set has any.
    virtual void trace(size_t mode, const RaySet& set, size_t first, size_t count,
                       Results& results) const = 0;
    virtual Answer answer(size_t mode, const RaySet& set, const Results& results,
                          size_t ray) const = 0;
    // Whether a mode spreads the work over threads of its own.
    virtual bool is_parallel(size_t) const { return false; }

    double build_ms() const { return build_ms_; }
    double bytes_per_triangle() const { return bytes_per_triangle_; }

protected:
    double build_ms_ = 0;
    double bytes_per_triangle_ = 0;
};

} // namespace peregrine::bench
