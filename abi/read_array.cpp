#include "read_array.h"

#include "base/error.h"
#include "check.h"

namespace peregrine::abi {

using base::Code;
using base::fail;

ArrayExtent check_array(const rt_array& array, const char* field, uint32_t element_size,
                        uint64_t limit) {
    if (array.reserved != 0)
        fail(Code::invalid_argument, "%s.reserved is %u; it must be 0", field, array.reserved);
    if (array.stride != 0 && array.stride < element_size)
        fail(Code::invalid_argument, "%s.stride is %u, but an element has %u bytes", field,
             array.stride, element_size);
    if (array.count == 0) return {};
    if (!array.data)
        fail(Code::invalid_argument, "%s.data is null, but the count is %llu", field,
             static_cast<unsigned long long>(array.count));
    if (array.count > limit)
        fail(Code::limit, "%s.count is %llu; the limit is %llu", field,
             static_cast<unsigned long long>(array.count), static_cast<unsigned long long>(limit));
    const uint32_t stride = array.stride ? array.stride : element_size;
    require_addressable(array.data, array.count, stride, element_size, field);
    return {static_cast<const std::byte*>(array.data), array.count, stride};
}

} // namespace peregrine::abi
