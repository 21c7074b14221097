#include "base/recycling_memory.h"

#include <algorithm>
#include <bit>
#include <new>
#include <utility>

// Idle memory is not to be read: a recycled block would hide that from the address sanitizer.
#if defined(__SANITIZE_ADDRESS__)
#define PEREGRINE_ADDRESS_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define PEREGRINE_ADDRESS_SANITIZER 1
#endif
#endif
#if defined(PEREGRINE_ADDRESS_SANITIZER)
#include <sanitizer/asan_interface.h>
#else
#define ASAN_POISON_MEMORY_REGION(address, size) (static_cast<void>(address))
#define ASAN_UNPOISON_MEMORY_REGION(address, size) (static_cast<void>(address))
#endif

namespace peregrine::base {
namespace {

constexpr size_t kAlignment = 64;             // of every block; its size is a multiple
constexpr size_t kMostIdle = 8;               // times what is in use, ...
constexpr size_t kFewBytes = size_t(1) << 20; // ... or as little as this

struct SizeClass {
    uint32_t number;
    size_t bytes;
};

// Four to each doubling, so that a block is at most a quarter larger than what was asked for.
SizeClass size_class_of(size_t size) {
    const size_t units = size == 0 ? 0 : (size - 1) / kAlignment; // less one
    const auto bits = uint32_t(std::bit_width(units));
    const uint32_t shift = bits > 3 ? bits - 3 : 0;
    const size_t steps = units >> shift;
    return {4 * shift + uint32_t(steps), ((steps + 1) << shift) * kAlignment};
}

size_t bytes_of(uint32_t number) {
    const uint32_t shift = number < 8 ? 0 : number / 4 - 1;
    return (size_t(number - 4 * shift + 1) << shift) * kAlignment;
}

} // namespace

void* RecyclingMemory::take_idle(uint32_t number, size_t bytes) noexcept {
    const std::lock_guard lock(mutex_);
    IdleBlock* const block = idle_[number];
    if (!block) return nullptr;
    ASAN_UNPOISON_MEMORY_REGION(block, sizeof *block);
    idle_[number] = block->next;
    bytes_idle_ -= bytes;
    bytes_in_use_ += bytes;
    most_in_use_ = std::max(most_in_use_, bytes_in_use_);
    return block;
}

void* RecyclingMemory::take_new(size_t bytes) {
    void* block;
    try {
        block = beneath_->allocate(bytes, kAlignment);
    } catch (const std::bad_alloc&) { // maybe for want of what lies idle here
        give_back();
        block = beneath_->allocate(bytes, kAlignment);
    }
    const std::lock_guard lock(mutex_);
    bytes_in_use_ += bytes;
    most_in_use_ = std::max(most_in_use_, bytes_in_use_);
    return block;
}

void* RecyclingMemory::do_allocate(size_t size, size_t alignment) {
    if (alignment > kAlignment) return beneath_->allocate(size, alignment);
    const SizeClass of = size_class_of(size);
    void* block = take_idle(of.number, of.bytes);
    if (!block) block = take_new(of.bytes);
    ASAN_POISON_MEMORY_REGION(block, of.bytes);
    ASAN_UNPOISON_MEMORY_REGION(block, size);
    return block;
}

void RecyclingMemory::do_deallocate(void* memory, size_t size, size_t alignment) {
    if (alignment > kAlignment) return beneath_->deallocate(memory, size, alignment);
    const SizeClass of = size_class_of(size);
    const std::lock_guard lock(mutex_);
    ASAN_UNPOISON_MEMORY_REGION(memory, sizeof(IdleBlock));
    idle_[of.number] = new (memory) IdleBlock{idle_[of.number]};
    ASAN_POISON_MEMORY_REGION(memory, of.bytes);
    bytes_in_use_ -= of.bytes;
    bytes_idle_ += of.bytes;
}

void RecyclingMemory::trim() noexcept {
    {
        const std::lock_guard lock(mutex_);
        if (bytes_idle_ <= kFewBytes || bytes_idle_ / kMostIdle <= bytes_in_use_) return;
    }
    give_back();
}

void RecyclingMemory::trim_unused() noexcept {
    {
        const std::lock_guard lock(mutex_);
        const size_t most = std::exchange(most_in_use_, bytes_in_use_);
        if (bytes_idle_ <= kFewBytes || bytes_idle_ / kMostIdle <= most) return;
    }
    give_back();
}

void RecyclingMemory::give_back() noexcept {
    const std::lock_guard lock(mutex_);
    for (uint32_t number = 0; number < kSizeClasses; ++number) {
        const size_t bytes = bytes_of(number);
        while (IdleBlock* const block = idle_[number]) {
            ASAN_UNPOISON_MEMORY_REGION(block, bytes);
            idle_[number] = block->next;
            beneath_->deallocate(block, bytes, kAlignment);
        }
    }
    bytes_idle_ = 0;
}

} // namespace peregrine::base
