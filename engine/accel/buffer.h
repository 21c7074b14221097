#pragma once

#include "base/memory.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>

namespace peregrine::accel {

// Growable memory that is never initialised: the builder writes before it reads.
template <class T>
class Buffer {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    explicit Buffer(base::Memory* memory) : memory_(memory) {}
    Buffer(Buffer&& other) noexcept
        : memory_(other.memory_), data_(std::exchange(other.data_, nullptr)),
          capacity_(std::exchange(other.capacity_, 0)) {}
    Buffer& operator=(Buffer&& other) noexcept {
        std::swap(memory_, other.memory_);
        std::swap(data_, other.data_);
        std::swap(capacity_, other.capacity_);
        return *this;
    }
    ~Buffer() { release(); }

    T* data() { return data_; }
    const T* data() const { return data_; }
    T& operator[](size_t index) { return data_[index]; }
    const T& operator[](size_t index) const { return data_[index]; }

    // Room for `count` elements; keeps the first `kept`.
    void grow(size_t count, size_t kept) {
        if (count > capacity_) reallocate(std::max(count, capacity_ + capacity_ / 2), kept);
    }

    // Room for `count` elements and no more, without content.
    void allocate(size_t count) {
        release();
        reallocate(count, 0);
    }

    void release() noexcept {
        if (data_) memory_->deallocate(data_, capacity_ * sizeof(T), alignof(T));
        data_ = nullptr;
        capacity_ = 0;
    }

private:
    void reallocate(size_t count, size_t kept) {
        T* data = static_cast<T*>(memory_->allocate(count * sizeof(T), alignof(T)));
        if (kept > 0) std::memcpy(static_cast<void*>(data), data_, kept * sizeof(T));
        release();
        data_ = data;
        capacity_ = count;
    }

    base::Memory* memory_;
    T* data_ = nullptr;
    size_t capacity_ = 0;
};

} // namespace peregrine::accel
