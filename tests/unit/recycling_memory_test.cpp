#include "base/recycling_memory.h"

#include <gtest/gtest.h>

#include <cstring>
#include <new>
#include <thread>
#include <vector>

namespace peregrine::base {
namespace {

// Counts, and fails beyond a limit.
class Beneath final : public Memory {
public:
    size_t limit = ~size_t(0);
    size_t bytes = 0;
    uint32_t allocations = 0;

private:
    void* do_allocate(size_t size, size_t alignment) override {
        if (bytes + size > limit) throw std::bad_alloc();
        bytes += size;
        ++allocations;
        return ::operator new(size, std::align_val_t(alignment));
    }
    void do_deallocate(void* memory, size_t size, size_t alignment) override {
        bytes -= size;
        ::operator delete(memory, std::align_val_t(alignment));
    }
    bool do_is_equal(const memory_resource& other) const noexcept override {
        return this == &other;
    }
};

TEST(RecyclingMemory, HoldsWhatWasAskedFor) {
    Beneath beneath;
    {
        RecyclingMemory memory(&beneath);
        for (size_t size = 0; size < 3'000'000; size += size / 7 + 1)
            for (const size_t alignment : {1u, 16u, 64u, 256u}) {
                const size_t before = beneath.bytes;
                void* const block = memory.allocate(size, alignment);
                EXPECT_EQ(reinterpret_cast<uintptr_t>(block) % alignment, 0u);
                std::memset(block, 0x5a, size);
                if (beneath.bytes > before) {
                    EXPECT_GE(beneath.bytes - before, size);
                    EXPECT_LE(beneath.bytes - before, size + size / 4 + 64);
                }
                memory.deallocate(block, size, alignment);
            }
    }
    EXPECT_EQ(beneath.bytes, 0u);
}

TEST(RecyclingMemory, AsksBeneathOnce) {
    Beneath beneath;
    RecyclingMemory memory(&beneath);
    for (int round = 0; round < 3; ++round) {
        void* const a = memory.allocate(1000, 8);
        void* const b = memory.allocate(1000 + size_t(round), 8);
        EXPECT_NE(a, b);
        memory.deallocate(a, 1000, 8);
        memory.deallocate(b, 1000 + size_t(round), 8);
    }
    EXPECT_EQ(beneath.allocations, 2u);
}

TEST(RecyclingMemory, GivesBackBeforeItFails) {
    Beneath beneath;
    beneath.limit = 100'000;
    RecyclingMemory memory(&beneath);
    memory.deallocate(memory.allocate(80'000, 8), 80'000, 8);
    void* const block = memory.allocate(40'000, 8); // has room only without what lies idle
    EXPECT_LE(beneath.bytes, 50'000u);
    EXPECT_THROW((void)memory.allocate(90'000, 8), std::bad_alloc);
    memory.deallocate(block, 40'000, 8);
}

TEST(RecyclingMemory, TrimsWhatOutweighsWhatIsInUse) {
    constexpr size_t kBlock = 1 << 20;
    Beneath beneath;
    RecyclingMemory memory(&beneath);
    void* const kept = memory.allocate(kBlock, 8);
    std::vector<void*> blocks;
    for (int i = 0; i < 8; ++i) blocks.push_back(memory.allocate(kBlock, 8));
    for (void* block : blocks) memory.deallocate(block, kBlock, 8);
    memory.trim();
    EXPECT_EQ(beneath.bytes, 9 * kBlock) << "eight times as much may lie idle";
    memory.deallocate(kept, kBlock, 8);
    memory.trim();
    EXPECT_EQ(beneath.bytes, 0u);
}

TEST(RecyclingMemory, ServesManyThreads) {
    Beneath beneath;
    RecyclingMemory memory(&beneath);
    constexpr size_t kSizes[] = {100, 1000, 10000};
    for (const size_t size : kSizes) { // so that nobody asks beneath, which is no thread's friend
        void* blocks[4];
        for (void*& block : blocks) block = memory.allocate(size, 8);
        for (void* block : blocks) memory.deallocate(block, size, 8);
    }
    std::vector<std::thread> threads;
    for (int i = 1; i <= 4; ++i)
        threads.emplace_back([&, i] {
            for (int round = 0; round < 3000; ++round) {
                const size_t size = kSizes[size_t(round + i) % 3];
                void* const block = memory.allocate(size, 8);
                std::memset(block, i, size);
                for (size_t k = 0; k < size; k += 99)
                    ASSERT_EQ(static_cast<unsigned char*>(block)[k], i);
                memory.deallocate(block, size, 8);
            }
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(beneath.allocations, 12u);
}

} // namespace
} // namespace peregrine::base
