#pragma once

#include "base/memory.h"

#include <array>
#include <mutex>

namespace peregrine::base {

// Keeps the blocks that are given back, by size, for whoever asks next: work that repeats, such as
// a commit of a world that moves, soon asks the memory beneath for nothing. From any thread.
class RecyclingMemory final : public Memory {
public:
    explicit RecyclingMemory(Memory* beneath) : beneath_(beneath) {}
    ~RecyclingMemory() override { give_back(); }
    RecyclingMemory(const RecyclingMemory&) = delete;
    RecyclingMemory& operator=(const RecyclingMemory&) = delete;

    // Gives idle blocks back if they are many times more than what is in use: what they held is
    // gone for good.
    void trim() noexcept;
    // ... or many times more than what was in use at any time since the last call.
    void trim_unused() noexcept;

private:
    struct IdleBlock {
        IdleBlock* next;
    };

    static constexpr uint32_t kSizeClasses = 256;

    void* do_allocate(size_t size, size_t alignment) override;
    void do_deallocate(void* memory, size_t size, size_t alignment) override;
    bool do_is_equal(const memory_resource& other) const noexcept override {
        return this == &other;
    }
    void* take_idle(uint32_t size_class, size_t bytes) noexcept;
    void* take_new(size_t bytes);
    void give_back() noexcept;

    Memory* beneath_;
    std::mutex mutex_;
    std::array<IdleBlock*, kSizeClasses> idle_{};
    size_t bytes_idle_ = 0;
    size_t bytes_in_use_ = 0;
    size_t most_in_use_ = 0; // since the last trim_unused()
};

} // namespace peregrine::base
