#include "stop.h"

#include <atomic>

#include <signal.h>

namespace host {

namespace {

std::atomic<bool> stopped = false;
static_assert(std::atomic<bool>::is_always_lock_free); // as a signal handler needs it

void stop(int) {
    stopped = true;
}

} // namespace

void stop_on_signals() {
    struct sigaction action {};
    action.sa_handler = stop;
    action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before {};
        // Who started the program may have wanted it to go on (nohup).
        if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
            sigaction(signal, &action, nullptr);
    }
}

bool is_stopped() {
    return stopped;
}

} // namespace host
