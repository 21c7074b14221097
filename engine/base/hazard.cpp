#include "base/hazard.h"

#include "base/error.h"

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

constexpr uint32_t kSlots = 8;

// One a thread, never freed, used again by later threads.
struct alignas(64) Record {
    std::atomic<const void*> slots[kSlots] = {};
    uint32_t used = 0; // slots; its thread's own
    std::atomic<bool> taken{true};
    Record* next = nullptr;
};

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

// A plain pointer, so that reading it needs neither a guard nor a call.
#if defined(__linux__)
[[gnu::tls_model("initial-exec")]]
#endif
constinit thread_local Record* this_record = nullptr;

struct GiveBack {
    ~GiveBack() {
        this_record->taken.store(false, std::memory_order_release);
        this_record = nullptr;
    }
};

[[gnu::noinline, gnu::cold]] Record* first_record_of_thread() {
    this_record = take_record();
    thread_local GiveBack give_back;
    (void)give_back;
    return this_record;
}

#if defined(__linux__) && !defined(PEREGRINE_THREAD_SANITIZER)
bool register_barrier() {
    return syscall(SYS_membarrier, MEMBARRIER_CMD_REGISTER_PRIVATE_EXPEDITED, 0, 0) == 0;
}
const bool has_membarrier = register_barrier();
#else
constexpr bool has_membarrier = false;
#endif

} // namespace

Hazard::Slot& Hazard::acquire_slot() {
    Record* record = this_record;
    if (!record) record = first_record_of_thread();
    if (record->used == kSlots)
        fail(Code::limit, "more than %u queries of one thread are inside one another", kSlots);
    return record->slots[record->used++];
}

void Hazard::release_slot(Slot& slot) {
    slot.store(nullptr, std::memory_order_release);
    --this_record->used;
}

void Hazard::reader_barrier() {
    if (has_membarrier)
        std::atomic_signal_fence(std::memory_order_seq_cst);
    else
        std::atomic_thread_fence(std::memory_order_seq_cst);
}

void Hazard::writer_barrier() {
#if defined(__linux__) && !defined(PEREGRINE_THREAD_SANITIZER)
    if (has_membarrier) {
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
