#pragma once

#include <atomic>

// Hazard pointers (Michael 2004): a reader announces the object that it reads, a writer frees only
// what nobody announces. Reading costs two plain stores and two loads, all on lines that no other
// thread writes; the price, a barrier in every running thread of the process, is the writer's
// (membarrier(2); elsewhere the reader pays for a fence).
namespace peregrine::base {

class Hazard {
public:
    // Announces what `source` points to, and keeps it alive until this object ends. Pins of a
    // thread may nest, eight deep; std::bad_alloc if the thread's first one finds no memory.
    template <class T>
    explicit Hazard(const std::atomic<T*>& source) : slot_(acquire_slot()) {
        T* object = source.load(std::memory_order_acquire);
        for (;;) {
            slot_.store(object, std::memory_order_release);
            reader_barrier();
            T* again = source.load(std::memory_order_acquire);
            if (again == object) break;
            object = again;
        }
        object_ = object;
    }

    ~Hazard() { release_slot(slot_); }
    Hazard(const Hazard&) = delete;
    Hazard& operator=(const Hazard&) = delete;

    const void* object() const { return object_; }

    // For writers, after the object was made unreachable: whether a reader may still use it. Call
    // writer_barrier() once before a series of these.
    static bool is_announced(const void* object);
    static void writer_barrier();

private:
    using Slot = std::atomic<const void*>;

    static Slot& acquire_slot();
    static void release_slot(Slot& slot);
    static void reader_barrier();

    Slot& slot_;
    const void* object_;
};

} // namespace peregrine::base
