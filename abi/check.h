#pragma once

#include "base/slot_map.h"
#include "peregrine/rt.h"

#include <cmath>
#include <cstdint>
#include <span>

// Checks of single fields. Each throws a base::Error whose sentence begins with the field's name.
namespace peregrine::abi {

void require_pointer(const void* pointer, const char* name);
void require_zero(uint32_t reserved, const char* field);
void require_flag(uint32_t value, const char* field);              // 0 or 1
void require_enum(int32_t value, int32_t last, const char* field); // 0 to last
void require_bits(uint32_t value, uint32_t known, const char* field);
void require_extent(uint32_t value, uint32_t largest, const char* field); // 1 to largest
void require_finite(float value, const char* field);
void require_finite(std::span<const float> values, const char* field);
void require_finite(std::span<const double> values, const char* field);
// A point: each coordinate at most kFarthest in magnitude.
inline constexpr double kFarthest = 1e30;
inline bool is_coordinate(double value) {
    return std::fabs(value) <= kFarthest;
}
void require_position(const double (&position)[3], const char* field);
void require_positive(float value, const char* field);                    // > 0, finite
void require_least_zero(float value, const char* field);                  // >= 0, finite
void require_colour(std::span<const float> values, const char* field);    // >= 0, finite
void require_direction(std::span<const float> values, const char* field); // finite, not zero

// Bytes from row to row of an image, `row_stride` or tight. The whole image must lie inside the
// address space.
uint64_t require_rows(const void* pixels, uint64_t row_stride, uint64_t row_bytes, uint32_t height,
                      const char* pixels_field, const char* stride_field);

// The bytes from `data` to the end of the last of `count` elements must lie inside the address
// space: limit if not.
void require_addressable(const void* data, uint64_t count, uint64_t stride, uint64_t element,
                         const char* name);

template <class RtHandle>
base::Handle to_handle(RtHandle handle) {
    return {handle.index, handle.generation};
}

template <class RtHandle>
RtHandle to_host(base::Handle handle) {
    return {handle.index, handle.generation};
}

// `kind` is "mesh", "light", ...; `field` says where the handle came from.
[[noreturn, gnu::cold]] void fail_handle(base::Handle handle, const char* field, const char* kind);

template <class T>
T& require_object(base::SlotMap<T>& objects, base::Handle handle, const char* field,
                  const char* kind) {
    T* object = objects.find(handle);
    if (!object) fail_handle(handle, field, kind);
    return *object;
}

} // namespace peregrine::abi
