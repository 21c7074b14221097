#pragma once

#include "base/error.h"
#include "released_sizes.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <type_traits>

namespace peregrine::abi {

// No struct of any version will be larger; a struct_size beyond is an uninitialised one.
inline constexpr uint32_t kLargestStruct = 1024;

struct StructInfo {
    const char* name;
    std::span<const uint32_t> sizes;
    uint32_t alignment;
};

template <class Struct>
constexpr StructInfo info_of() {
    using Info = Released<Struct>;
    return {Info::name, Info::sizes, uint32_t(alignof(Struct))};
}

// The size that the host's struct has: one of its releases, or a later one that this library does
// not know yet. Throws base::Error invalid_argument for null, invalid_struct for other sizes.
uint32_t check_struct_size(const void* host_struct, const StructInfo& info);

// Throws base::Error invalid_struct unless bytes [from, size) are zero.
void check_zero_tail(const void* host_struct, uint32_t from, uint32_t size, const char* name);

// What the host says, in today's layout: fields that its header lacks are zero, and fields that
// only its newer header has must be.
template <class Struct>
Struct read_struct(const Struct* host_struct) {
    const uint32_t size = check_struct_size(host_struct, info_of<Struct>());
    if (size > sizeof(Struct))
        check_zero_tail(host_struct, sizeof(Struct), size, Released<Struct>::name);
    Struct fields;
    std::memset(static_cast<void*>(&fields), 0, sizeof fields);
    std::memcpy(static_cast<void*>(&fields), host_struct, std::min(size, uint32_t(sizeof fields)));
    return fields;
}

// Calls work(*host_struct), where it lies if it has today's layout.
template <class Struct, class Work>
void with_struct(const Struct* host_struct, Work&& work) {
    if (host_struct && host_struct->struct_size == sizeof(Struct)) [[likely]]
        work(*host_struct);
    else
        work(read_struct(host_struct));
}

// A struct that the library fills, checked before the work and written after it. Null: not wanted.
template <class Struct>
class Output {
public:
    explicit Output(Struct* host_struct)
        : host_struct_(host_struct),
          size_(host_struct ? check_struct_size(host_struct, info_of<Struct>()) : 0) {}

    // Writes what the host's header knows, zeros what only that header knows, and leaves its
    // struct_size.
    void write(const Struct& fields) const {
        if (!host_struct_) return;
        constexpr uint32_t first = sizeof(uint32_t);
        const uint32_t known = std::min(size_, uint32_t(sizeof(Struct)));
        auto* bytes = reinterpret_cast<unsigned char*>(host_struct_);
        std::memcpy(bytes + first, reinterpret_cast<const unsigned char*>(&fields) + first,
                    known - first);
        std::memset(bytes + known, 0, size_ - known);
    }

private:
    static_assert(std::is_trivially_copyable_v<Struct>);

    Struct* host_struct_;
    uint32_t size_;
};

} // namespace peregrine::abi
