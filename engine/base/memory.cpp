#include "base/memory.h"

#include <new>

namespace peregrine::base {

void* HostMemory::do_allocate(size_t size, size_t alignment) {
    void* memory = functions_.allocate
                       ? functions_.allocate(functions_.user, size, alignment)
                       : ::operator new(size, std::align_val_t(alignment), std::nothrow);
    if (!memory) throw std::bad_alloc();
    const uint64_t now = bytes_.fetch_add(size, std::memory_order_relaxed) + size;
    uint64_t peak = peak_.load(std::memory_order_relaxed);
    while (peak < now && !peak_.compare_exchange_weak(peak, now, std::memory_order_relaxed)) {
    }
    allocations_.fetch_add(1, std::memory_order_relaxed);
    return memory;
}

void HostMemory::do_deallocate(void* memory, size_t size, size_t alignment) {
    bytes_.fetch_sub(size, std::memory_order_relaxed);
    if (functions_.deallocate)
        functions_.deallocate(functions_.user, memory, size, alignment);
    else
        ::operator delete(memory, std::align_val_t(alignment));
}

} // namespace peregrine::base
