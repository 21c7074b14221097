#pragma once

#include <cstdint>

namespace peregrine::base {

enum class Code : int32_t {
    invalid_argument = 1,
    invalid_handle = 2,
    invalid_struct = 3,
    limit = 4,
    out_of_memory = 5,
    cancelled = 6,
    not_committed = 7,
    unsupported = 8,
    internal = 9,
};

// What the engine throws and the door catches: a code and a sentence, in fixed storage so that
// reporting an error never allocates.
struct Error {
    Code code;
    char text[240];
};

#if defined(__GNUC__)
[[gnu::format(printf, 2, 3), gnu::cold]]
#endif
[[noreturn]] void
fail(Code code, const char* format, ...);

} // namespace peregrine::base
