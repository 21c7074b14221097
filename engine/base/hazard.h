#pragma once

#include "base/error.h"

#include <atomic>
#include <cstdint>

// Hazard pointers (Michael 2004): a reader announces the object that it reads, a writer frees only
// what nobody announces. Reading costs two plain stores and two loads, all on lines that no other
// thread writes; the price, a barrier in every running thread of the process, is the writer's
// (membarrier(2); elsewhere the reader pays for a fence).
namespace peregrine::base {

namespace detail {

inline constexpr uint32_t kHazardSlots = 8;

// One a thread, never freed, used again by later threads.
struct alignas(64) HazardRecord {
    std::atomic<const void*> slots[kHazardSlots] = {};
    uint32_t used = 0; // slots; its thread's own
    std::atomic<bool> taken{true};
    HazardRecord* next = nullptr;
};

// A plain pointer, so that reading it needs neither a guard nor a call.
#if defined(__linux__)
[[gnu::tls_model("initial-exec")]]
#endif
extern constinit thread_local HazardRecord* this_record;
extern const bool has_membarrier;

HazardRecord* first_record_of_thread();

} // namespace detail

class Hazard {
public:
    // Announces what `source` points to, and keeps it alive until this object ends. Pins of a
    // thread nest, up to eight deep; std::bad_alloc if the thread's first one finds no memory.
    template <class T>
    explicit Hazard(const std::atomic<T*>& source) : record_(record_of_thread()) {
        Slot& slot = record_->slots[record_->used++];
        T* object = source.load(std::memory_order_acquire);
        for (;;) {
            slot.store(object, std::memory_order_release);
            reader_barrier();
            T* again = source.load(std::memory_order_acquire);
            if (again == object) break;
            object = again;
        }
        object_ = object;
    }

    ~Hazard() { record_->slots[--record_->used].store(nullptr, std::memory_order_release); }
    Hazard(const Hazard&) = delete;
    Hazard& operator=(const Hazard&) = delete;

    const void* object() const { return object_; }

    // For writers, after the object was made unreachable: whether a reader may still use it. Call
    // writer_barrier() once before a series of these.
    static bool is_announced(const void* object);
    static void writer_barrier();

private:
    using Slot = std::atomic<const void*>;

    static detail::HazardRecord* record_of_thread() {
        detail::HazardRecord* record = detail::this_record;
        if (!record) [[unlikely]]
            record = detail::first_record_of_thread();
        if (record->used == detail::kHazardSlots) [[unlikely]]
            fail(Code::limit, "more than %u queries of one thread are inside one another",
                 detail::kHazardSlots);
        return record;
    }
    static void reader_barrier() {
        if (detail::has_membarrier) [[likely]]
            std::atomic_signal_fence(std::memory_order_seq_cst);
        else
            std::atomic_thread_fence(std::memory_order_seq_cst);
    }

    detail::HazardRecord* record_;
    const void* object_;
};

} // namespace peregrine::base
