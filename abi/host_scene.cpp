#include "host_scene.h"

#include <cstdio>

namespace peregrine::abi {

void log_line(const HostScene& host, rt_log_level level, const char* format, ...) noexcept {
    if (!host.log) return;
    char line[320];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    try {
        host.log(host.log_user, level, line);
    } catch (...) { // a log that fails is no reason to fail
    }
}

} // namespace peregrine::abi
