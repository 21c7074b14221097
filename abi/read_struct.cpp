#include "read_struct.h"

namespace peregrine::abi {

using base::Code;
using base::fail;

uint32_t check_struct_size(const void* host_struct, const StructInfo& info) {
    if (!host_struct) fail(Code::invalid_argument, "the %s is null", info.name);
    uint32_t size;
    std::memcpy(&size, host_struct, sizeof size);
    if (std::find(info.sizes.begin(), info.sizes.end(), size) != info.sizes.end()) return size;
    if (size > info.sizes.back() && size <= kLargestStruct && size % info.alignment == 0)
        return size;
    fail(Code::invalid_struct,
         "%s.struct_size is %u, but the struct has %u bytes; use the rt_default_* function",
         info.name, size, info.sizes.back());
}

void check_zero_tail(const void* host_struct, uint32_t from, uint32_t size, const char* name) {
    const auto* bytes = static_cast<const unsigned char*>(host_struct);
    for (uint32_t i = from; i < size; ++i)
        if (bytes[i] != 0)
            fail(Code::invalid_struct,
                 "%s.struct_size is %u, this library knows %u bytes, and byte %u is not 0: the "
                 "field needs a newer library",
                 name, size, from, i);
}

} // namespace peregrine::abi
