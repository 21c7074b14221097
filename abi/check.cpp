#include "check.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace peregrine::abi {

using base::Code;
using base::fail;

namespace {

unsigned long long print(uint64_t value) {
    return value;
}

template <class Real>
void require_finite_span(std::span<const Real> values, const char* field) {
    for (size_t i = 0; i < values.size(); ++i)
        if (!std::isfinite(values[i]))
            fail(Code::invalid_argument, "%s[%zu] is %g; it must be finite", field, i,
                 double(values[i]));
}

} // namespace

void require_pointer(const void* pointer, const char* name) {
    if (!pointer) fail(Code::invalid_argument, "%s is null", name);
}

void require_zero(uint32_t reserved, const char* field) {
    if (reserved != 0) fail(Code::invalid_argument, "%s is %u; it must be 0", field, reserved);
}

void require_flag(uint32_t value, const char* field) {
    if (value > 1) fail(Code::invalid_argument, "%s is %u; it must be 0 or 1", field, value);
}

void require_enum(int32_t value, int32_t last, const char* field) {
    if (value < 0 || value > last)
        fail(Code::invalid_argument, "%s is %d; the known values are 0 to %d", field, value, last);
}

void require_bits(uint32_t value, uint32_t known, const char* field) {
    if (value & ~known)
        fail(Code::invalid_argument, "%s is %#x; the known bits are %#x", field, value, known);
}

void require_extent(uint32_t value, uint32_t largest, const char* field) {
    if (value == 0) fail(Code::invalid_argument, "%s is 0; it must be at least 1", field);
    if (value > largest) fail(Code::limit, "%s is %u; the limit is %u", field, value, largest);
}

void require_finite(float value, const char* field) {
    if (!std::isfinite(value))
        fail(Code::invalid_argument, "%s is %g; it must be finite", field, double(value));
}

void require_finite(std::span<const float> values, const char* field) {
    require_finite_span(values, field);
}

void require_finite(std::span<const double> values, const char* field) {
    require_finite_span(values, field);
}

void require_position(const double (&position)[3], const char* field) {
    for (int k = 0; k < 3; ++k)
        if (!is_coordinate(position[k]))
            fail(Code::invalid_argument, "%s[%d] is %g; it must be at most 1e30 in magnitude",
                 field, k, position[k]);
}

void require_positive(float value, const char* field) {
    if (!(value > 0) || !std::isfinite(value))
        fail(Code::invalid_argument, "%s is %g; it must be above 0 and finite", field,
             double(value));
}

void require_least_zero(float value, const char* field) {
    if (!(value >= 0) || !std::isfinite(value))
        fail(Code::invalid_argument, "%s is %g; it must be at least 0 and finite", field,
             double(value));
}

void require_colour(std::span<const float> values, const char* field) {
    for (size_t i = 0; i < values.size(); ++i)
        if (!(values[i] >= 0) || !std::isfinite(values[i]))
            fail(Code::invalid_argument, "%s[%zu] is %g; it must be at least 0 and finite", field,
                 i, double(values[i]));
}

void require_direction(std::span<const float> values, const char* field) {
    require_finite(values, field);
    for (const float value : values)
        if (value != 0) return;
    fail(Code::invalid_argument, "%s is the zero vector", field);
}

uint64_t require_rows(const void* pixels, uint64_t row_stride, uint64_t row_bytes, uint32_t height,
                      const char* pixels_field, const char* stride_field) {
    require_pointer(pixels, pixels_field);
    const uint64_t stride = row_stride ? row_stride : row_bytes;
    if (stride < row_bytes)
        fail(Code::invalid_argument, "%s is %llu, but a row has %llu bytes", stride_field,
             print(stride), print(row_bytes));
    require_addressable(pixels, height, stride, row_bytes, stride_field);
    return stride;
}

void require_addressable(const void* data, uint64_t count, uint64_t stride, uint64_t element,
                         const char* name) {
    if (count == 0) return;
    // Nor is any object larger than pointer differences are.
    const uint64_t room = std::min<uint64_t>(std::numeric_limits<uintptr_t>::max()
                                                 - reinterpret_cast<uintptr_t>(data),
                                             std::numeric_limits<ptrdiff_t>::max());
    if (room < element || (room - element) / stride < count - 1)
        fail(Code::limit, "%s: %llu elements of stride %llu reach beyond the address space", name,
             print(count), print(stride));
}

void fail_handle(base::Handle handle, const char* field, const char* kind) {
    if (!handle) fail(Code::invalid_handle, "%s is the null handle", field);
    fail(Code::invalid_handle,
         "%s is {%u, %u}, which names no %s of this scene: it was removed, or belongs elsewhere",
         field, handle.index, handle.generation, kind);
}

} // namespace peregrine::abi
