#include "guard.h"

#include "base/error.h"

#include <cstdio>
#include <exception>
#include <new>
#include <stdexcept>
#include <system_error>

namespace peregrine::abi {
namespace {

// In static thread-local storage: naming an error then needs no memory, which is just what may have
// run out. Small, for what a loader keeps for libraries that come late is about a kilobyte.
#if defined(__linux__)
[[gnu::tls_model("initial-exec")]]
#endif
constinit thread_local char sentence[sizeof(base::Error::text)] = "";

rt_result report(rt_result result, const char* text) {
    std::snprintf(sentence, sizeof sentence, "%s", text);
    return result;
}

} // namespace

rt_result report_current_exception() noexcept {
    try {
        throw;
    } catch (const base::Error& error) {
        return report(rt_result(error.code), error.text);
    } catch (const std::bad_alloc&) {
        return report(RT_ERROR_OUT_OF_MEMORY, "an allocation failed");
    } catch (const std::length_error&) {
        return report(RT_ERROR_LIMIT, "an array would be larger than the address space");
    } catch (const std::system_error& error) {
        std::snprintf(sentence, sizeof sentence, "the system refused a thread or a lock: %s",
                      error.what());
        return RT_ERROR_OUT_OF_MEMORY;
    } catch (const std::exception& error) {
        std::snprintf(sentence, sizeof sentence, "unexpected: %s", error.what());
        return RT_ERROR_INTERNAL;
    } catch (...) {
        return report(RT_ERROR_INTERNAL, "an unknown exception, perhaps from a host callback");
    }
}

} // namespace peregrine::abi

const char* rt_get_last_error() noexcept {
    return peregrine::abi::sentence;
}
