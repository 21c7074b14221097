#include "query_records.h"

#include "base/error.h"

namespace peregrine::abi {

void fail_stride(uint32_t stride, size_t size, const char* field) {
    base::fail(base::Code::invalid_argument, "%s is %u, but a record has %zu bytes", field, stride,
               size);
}

} // namespace peregrine::abi
