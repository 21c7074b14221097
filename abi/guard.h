#pragma once

#include "peregrine/rt.h"

namespace peregrine::abi {

// Turns the exception that is being handled into a result and this thread's sentence.
[[gnu::cold, gnu::noinline]] rt_result report_current_exception() noexcept;

// Every function of the door runs inside one of these, so that nothing is thrown at the host. What
// succeeds costs nothing: no branch, no thread-local access.
template <class Call>
rt_result guard(Call&& call) noexcept {
    try {
        call();
        return RT_OK;
    } catch (...) {
        return report_current_exception();
    }
}

} // namespace peregrine::abi
