#pragma once

#include "base/error.h"
#include "base/memory.h"
#include "base/progress.h"
#include "base/scheduler.h"
#include "builder_worlds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <new>
#include <span>
#include <thread>

// What the builders of all structures owe alike. A `build` below is a builder with its options
// given, build(triangles, scheduler, progress, memory): see with_options.
namespace peregrine::test {

template <class Tree, class Options>
auto with_options(Tree (*build)(std::span<const geometry::Triangle>, const Options&,
                                base::Scheduler&, const base::Progress&, base::Memory*),
                  const Options& options) {
    return [=](std::span<const geometry::Triangle> triangles, base::Scheduler& scheduler,
               const base::Progress& progress, base::Memory* memory) {
        return build(triangles, options, scheduler, progress, memory);
    };
}

template <class Build>
auto build_alone(const Build& build, const Triangles& triangles, uint32_t workers) {
    base::Memory* memory = std::pmr::new_delete_resource();
    base::Scheduler scheduler(workers, {}, memory);
    return build(triangles, scheduler, {}, memory);
}

template <class Element>
void expect_same_bytes(const base::Vector<Element>& a, const base::Vector<Element>& b) {
    ASSERT_EQ(a.size(), b.size());
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(Element)), 0);
}

// covered(point, triangle, tolerance): does the tree lead from the point to the triangle?
template <class Covered>
void expect_coverage(const Triangles& triangles, double tolerance_of_coordinate,
                     const Covered& covered) {
    Random random(11);
    const uint32_t step = uint32_t(triangles.size()) / 4000 + 1;
    for (uint32_t i = 0; i < triangles.size(); i += step) {
        const geometry::Triangle& t = triangles[i];
        const math::Vec3 largest =
            glm::max(glm::max(glm::abs(t.v0), glm::abs(t.v1)), glm::abs(t.v2));
        const double tolerance =
            tolerance_of_coordinate * double(std::max({largest.x, largest.y, largest.z}));
        for (uint32_t k = 0; k < 16; ++k)
            ASSERT_TRUE(covered(random.inside(t), i, tolerance)) << "triangle " << i;
    }
}

// expect_same(tree, tree) compares all that a tree holds.
template <class Build, class Tree, class Same>
void expect_same_for_any_workers(const Build& build, const Triangles& triangles, const Tree& one,
                                 const Same& expect_same) {
    for (uint32_t workers : {2u, 5u}) expect_same(one, build_alone(build, triangles, workers));
}

// A host may run all tasks on the calling thread, in any order.
template <class Build, class Same>
void expect_same_on_a_hosts_scheduler(const Build& build, const Same& expect_same) {
    const Triangles triangles = Random(10).soup(10000, 1024);
    base::HostScheduler host;
    host.concurrency = 7;
    host.run = [](void*, uint32_t count, base::TaskFunction task, void* data) {
        for (uint32_t i = count; i-- > 0;) task(data, i);
    };
    base::Memory* memory = std::pmr::new_delete_resource();
    base::Scheduler scheduler(1, host, memory);
    expect_same(build_alone(build, triangles, 1), build(triangles, scheduler, {}, memory));
}

// Fails after so many allocations.
class FailingMemory final : public std::pmr::memory_resource {
public:
    explicit FailingMemory(int64_t allocations) : left_(allocations) {}
    int64_t live_bytes() const { return live_; }

private:
    void* do_allocate(size_t size, size_t alignment) override {
        if (left_.fetch_sub(1) <= 0) throw std::bad_alloc();
        live_ += int64_t(size);
        return ::operator new(size, std::align_val_t(alignment));
    }
    void do_deallocate(void* memory, size_t size, size_t alignment) override {
        live_ -= int64_t(size);
        ::operator delete(memory, std::align_val_t(alignment));
    }
    bool do_is_equal(const memory_resource& other) const noexcept override {
        return this == &other;
    }

    std::atomic<int64_t> left_;
    std::atomic<int64_t> live_{0};
};

// ... of which there must be fewer than `limit`.
template <class Build>
void expect_survives_failing_allocations(const Build& build, const Triangles& triangles,
                                         int64_t limit) {
    base::Scheduler scheduler(2, {}, std::pmr::new_delete_resource());
    for (int64_t allowed = 0;; ++allowed) {
        FailingMemory memory(allowed);
        bool built = false;
        try {
            built = !build(triangles, scheduler, {}, &memory).nodes.empty();
        } catch (const std::bad_alloc&) {
        }
        ASSERT_EQ(memory.live_bytes(), 0);
        if (built) break;
        ASSERT_LT(allowed, limit);
    }
}

// A progress callback that looks at how it is called, and cancels at a call.
struct Watcher {
    std::thread::id caller = std::this_thread::get_id();
    uint32_t calls = 0;
    uint32_t stop_at = ~0u;
    float last = 0;
    bool good = true;

    base::Progress progress() {
        return {[](void* user, float fraction) {
                    Watcher& self = *static_cast<Watcher*>(user);
                    self.good &= std::this_thread::get_id() == self.caller && fraction >= self.last
                                 && fraction <= 1;
                    self.last = fraction;
                    return int32_t(++self.calls >= self.stop_at);
                },
                this};
    }
};

template <class Build>
void expect_progress_and_cancellation(const Build& build, const Triangles& triangles) {
    base::Memory* memory = std::pmr::new_delete_resource();
    base::Scheduler scheduler(2, {}, memory);
    Watcher watcher;
    build(triangles, scheduler, watcher.progress(), memory);
    EXPECT_TRUE(watcher.good);
    EXPECT_GT(watcher.calls, 4u);
    for (uint32_t stop_at = 1; stop_at <= 4; ++stop_at) {
        Watcher stopper;
        stopper.stop_at = stop_at;
        try {
            build(triangles, scheduler, stopper.progress(), memory);
            FAIL() << "was not cancelled at call " << stop_at;
        } catch (const base::Error& error) {
            EXPECT_EQ(error.code, base::Code::cancelled);
        }
    }
}

template <class Build>
void expect_too_many_triangles_refused(const Build& build) {
    base::Memory* memory = std::pmr::new_delete_resource();
    base::Scheduler scheduler(1, {}, memory);
    const geometry::Triangle one = make({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const std::span<const geometry::Triangle> many(&one, (size_t(1) << 27) + 1); // never read
    try {
        build(many, scheduler, {}, memory);
        FAIL();
    } catch (const base::Error& error) {
        EXPECT_EQ(error.code, base::Code::limit);
    }
}

} // namespace peregrine::test
