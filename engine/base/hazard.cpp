#include "base/hazard.h"

#include <new>

#if defined(__linux__)
#include <linux/membarrier.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

#if defined(__SANITIZE_THREAD__)
#define PEREGRINE_THREAD_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define PEREGRINE_THREAD_SANITIZER 1
#endif
#endif

namespace peregrine::base {
namespace {

using Record = detail::HazardRecord;

std::atomic<Record*> records{nullptr};

Record* take_record() {
    for (Record* record = records.load(std::memory_order_acquire); record; record = record->next) {
        bool free = false;
        if (record->taken.compare_exchange_strong(free, true)) return record;
    }
    auto* record = new Record;
    record->next = records.load(std::memory_order_relaxed);
    while (!records.compare_exchange_weak(record->next, record)) {
    }
    return record;
}

struct GiveBack {
    ~GiveBack() {
        detail::this_record->taken.store(false, std::memory_order_release);
        detail::this_record = nullptr;
    }
};

#if defined(__linux__) && !defined(PEREGRINE_THREAD_SANITIZER)
bool register_barrier() {
    return syscall(SYS_membarrier, MEMBARRIER_CMD_REGISTER_PRIVATE_EXPEDITED, 0, 0) == 0;
}
#else
bool register_barrier() {
    return false;
}
#endif

} // namespace

namespace detail {

constinit thread_local HazardRecord* this_record = nullptr;
const bool has_membarrier = register_barrier();

[[gnu::noinline, gnu::cold]] HazardRecord* first_record_of_thread() {
    this_record = take_record();
    thread_local GiveBack give_back;
    (void)give_back;
    return this_record;
}

} // namespace detail

void Hazard::writer_barrier() {
#if defined(__linux__) && !defined(PEREGRINE_THREAD_SANITIZER)
    if (detail::has_membarrier) {
        syscall(SYS_membarrier, MEMBARRIER_CMD_PRIVATE_EXPEDITED, 0, 0);
        return;
    }
#endif
    std::atomic_thread_fence(std::memory_order_seq_cst);
}

bool Hazard::is_announced(const void* object) {
    for (Record* record = records.load(std::memory_order_acquire); record; record = record->next)
        for (const Slot& slot : record->slots)
            if (slot.load(std::memory_order_acquire) == object) return true;
    return false;
}

} // namespace peregrine::base
