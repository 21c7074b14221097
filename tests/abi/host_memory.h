// A host's allocator that counts, checks and fails on demand.
#pragma once

#include <peregrine/rt.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <mutex>
#include <unordered_map>

namespace peregrine::test {

class TestMemory {
public:
    ~TestMemory() { EXPECT_TRUE(blocks_.empty()) << blocks_.size() << " blocks leaked"; }

    rt_allocator allocator() {
        return {this,
                [](void* self, uint64_t size, uint64_t alignment) {
                    return static_cast<TestMemory*>(self)->allocate(size, alignment);
                },
                [](void* self, void* memory, uint64_t size, uint64_t alignment) {
                    static_cast<TestMemory*>(self)->deallocate(memory, size, alignment);
                }};
    }

    // The allocation after `count` more, and every one after that, fails; ~0: none.
    void fail_after(uint64_t count) {
        const std::lock_guard lock(mutex_);
        left_ = count;
    }

    uint64_t bytes() const {
        const std::lock_guard lock(mutex_);
        return bytes_;
    }

    uint64_t allocations() const {
        const std::lock_guard lock(mutex_);
        return allocations_;
    }

private:
    struct Block {
        uint64_t size, alignment;
    };

    void* allocate(uint64_t size, uint64_t alignment) {
        const std::lock_guard lock(mutex_);
        EXPECT_EQ(alignment & (alignment - 1), 0u) << alignment;
        if (left_ == 0) return nullptr;
        if (left_ != ~uint64_t(0)) --left_;
        // Exactly as aligned as was asked for, no better: over-reliance shows.
        const uint64_t step = alignment < 16 ? 16 : alignment;
        auto* raw =
            static_cast<char*>(std::aligned_alloc(2 * step, (size / (2 * step) + 2) * 2 * step));
        char* memory = raw + alignment;
        blocks_[memory] = {size, alignment};
        raws_[memory] = raw;
        bytes_ += size;
        ++allocations_;
        return memory;
    }

    void deallocate(void* memory, uint64_t size, uint64_t alignment) {
        const std::lock_guard lock(mutex_);
        const auto found = blocks_.find(memory);
        ASSERT_NE(found, blocks_.end()) << "freed twice, or never allocated";
        EXPECT_EQ(found->second.size, size);
        EXPECT_EQ(found->second.alignment, alignment);
        bytes_ -= size;
        blocks_.erase(found);
        std::free(raws_[memory]);
        raws_.erase(memory);
    }

    mutable std::mutex mutex_;
    std::unordered_map<void*, Block> blocks_;
    std::unordered_map<void*, void*> raws_;
    uint64_t bytes_ = 0;
    uint64_t allocations_ = 0;
    uint64_t left_ = ~uint64_t(0);
};

} // namespace peregrine::test
