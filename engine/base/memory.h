#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <vector>

namespace peregrine::base {

// Memory as the host supplies it. Everything that a scene owns comes from one HostMemory, so that
// a failing host allocator surfaces as std::bad_alloc, which the door turns into a result code.
class HostMemory final : public std::pmr::memory_resource {
public:
    struct Functions {
        void* user = nullptr;
        void* (*allocate)(void* user, uint64_t size, uint64_t alignment) = nullptr;
        void (*deallocate)(void* user, void* memory, uint64_t size, uint64_t alignment) = nullptr;
    };

    // Null functions: the C++ runtime's memory.
    explicit HostMemory(const Functions& functions) : functions_(functions) {}

    uint64_t bytes() const { return bytes_.load(std::memory_order_relaxed); }
    uint64_t peak() const { return peak_.load(std::memory_order_relaxed); }
    uint64_t allocations() const { return allocations_.load(std::memory_order_relaxed); }

private:
    void* do_allocate(size_t size, size_t alignment) override;
    void do_deallocate(void* memory, size_t size, size_t alignment) override;
    bool do_is_equal(const memory_resource& other) const noexcept override {
        return this == &other;
    }

    Functions functions_;
    std::atomic<uint64_t> bytes_{0};
    std::atomic<uint64_t> peak_{0};
    std::atomic<uint64_t> allocations_{0};
};

template <class T>
using Vector = std::pmr::vector<T>;
using Memory = std::pmr::memory_resource;

} // namespace peregrine::base
