#pragma once

#include "accel/kdtree/subtree.h"

#include <list>
#include <mutex>

namespace peregrine::accel::kdtree {

// As many subtree builders as there are tasks at a time, whatever threads the host has.
class BuilderPool {
public:
    explicit BuilderPool(const Task& task) : task_(task), all_(task.memory), idle_(task.memory) {}

    class Lease {
    public:
        explicit Lease(BuilderPool& pool) : pool_(pool), builder_(pool.take()) {}
        ~Lease() { pool_.put_back(builder_); }
        Lease(const Lease&) = delete;
        Lease& operator=(const Lease&) = delete;
        SubtreeBuilder* operator->() const { return builder_; }

    private:
        BuilderPool& pool_;
        SubtreeBuilder* builder_;
    };

private:
    SubtreeBuilder* take() {
        const std::lock_guard lock(mutex_);
        if (idle_.empty()) {
            idle_.reserve(all_.size() + 1); // so that putting back cannot fail
            return &all_.emplace_back(task_);
        }
        SubtreeBuilder* builder = idle_.back();
        idle_.pop_back();
        return builder;
    }

    void put_back(SubtreeBuilder* builder) {
        const std::lock_guard lock(mutex_);
        idle_.push_back(builder);
    }

    const Task& task_;
    std::mutex mutex_;
    std::pmr::list<SubtreeBuilder> all_;
    base::Vector<SubtreeBuilder*> idle_;
};

} // namespace peregrine::accel::kdtree
