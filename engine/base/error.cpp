#include "base/error.h"

#include <cstdarg>
#include <cstdio>

namespace peregrine::base {

void fail(Code code, const char* format, ...) {
    Error error;
    error.code = code;
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(error.text, sizeof error.text, format, arguments);
    va_end(arguments);
    throw error;
}

} // namespace peregrine::base
