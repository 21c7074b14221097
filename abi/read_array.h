#pragma once

#include "peregrine/rt.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace peregrine::abi {

// An array of the host, checked: count elements whose bytes all have addresses.
struct ArrayExtent {
    const std::byte* data = nullptr;
    uint64_t count = 0; // 0: absent
    uint64_t stride = 0;
};

// Throws base::Error: invalid_argument for a null pointer with a count, a stride below the element
// or a reserved field in use; limit for more than `limit` elements or beyond the address space.
ArrayExtent check_array(const rt_array& array, const char* field, uint32_t element_size,
                        uint64_t limit);

// Elements are copied out one by one, however they are aligned.
template <class Element>
class Array {
public:
    Array(const rt_array& array, const char* field, uint64_t limit)
        : extent_(check_array(array, field, sizeof(Element), limit)), field_(field) {}

    uint64_t count() const { return extent_.count; }
    bool absent() const { return extent_.count == 0; }
    const char* field() const { return field_; }

    Element operator[](uint64_t i) const {
        Element element;
        std::memcpy(static_cast<void*>(&element), extent_.data + i * extent_.stride,
                    sizeof element);
        return element;
    }

private:
    ArrayExtent extent_;
    const char* field_;
};

} // namespace peregrine::abi
