#include "accel/morton_order.h"

#include "accel/bin_mapping.h"

#include <algorithm>
#include <utility>

namespace peregrine::accel {
namespace {

constexpr uint32_t kDigitBits = 11;
constexpr uint32_t kDigits = 1u << kDigitBits;
constexpr uint32_t kMinChunk = 16384;
constexpr uint32_t kMaxChunks = 64;

// Two zeros behind each bit.
Ints spread(Ints x) {
    static_assert(kMaxMortonBits <= 10);
    x = (x | x << 16) & 0x030000ff;
    x = (x | x << 8) & 0x0300f00f;
    x = (x | x << 4) & 0x030c30c3;
    return (x | x << 2) & 0x09249249;
}

// A cube around points, in cells.
class Curve {
public:
    Curve(const Bounds& bounds, uint32_t bits_an_axis)
        : origin_(bounds.lower), scale_(float(1u << bits_an_axis) * scale_of(bounds)),
          last_(float((1u << bits_an_axis) - 1)) {}

    uint32_t place(const Floats& point) const {
        const Floats last = {last_, last_, last_, 0};
        const Ints bits =
            spread(__builtin_convertvector(min((point - origin_) * scale_, last), Ints));
        return uint32_t(bits[0] | bits[1] << 1 | bits[2] << 2);
    }

private:
    Floats origin_;
    float scale_, last_;
};

class Sorter {
public:
    Sorter(uint32_t count, base::Scheduler& scheduler, base::Memory* memory)
        : count_(count), chunk_(std::max(kMinChunk, (count + kMaxChunks - 1) / kMaxChunks)),
          chunks_((count + chunk_ - 1) / chunk_), scheduler_(scheduler), keys_(memory),
          room_(memory), offsets_(memory) {
        keys_.allocate(count);
        room_.allocate(count);
        offsets_.allocate(size_t(chunks_) * kDigits);
    }

    template <class Place>
    void fill(const Place& place) {
        for_chunks([&](uint32_t begin, uint32_t end, uint32_t*) {
            for (uint32_t i = begin; i < end; ++i) keys_[i] = {place(i), i};
        });
    }

    // By digits from the lowest one.
    Buffer<MortonKey> sort(uint32_t bits) {
        for (uint32_t shift = 0; shift < bits; shift += kDigitBits) pass(shift);
        return std::move(keys_);
    }

private:
    void pass(uint32_t shift) {
        const auto digit = [shift](const MortonKey& key) {
            return key.place >> shift & (kDigits - 1);
        };
        for_chunks([&](uint32_t begin, uint32_t end, uint32_t* counts) {
            std::fill_n(counts, kDigits, 0u);
            for (uint32_t i = begin; i < end; ++i) ++counts[digit(keys_[i])];
        });
        uint32_t sum = 0;
        for (uint32_t d = 0; d < kDigits; ++d)
            for (uint32_t chunk = 0; chunk < chunks_; ++chunk)
                sum += std::exchange(offsets_[size_t(chunk) * kDigits + d], sum);
        for_chunks([&](uint32_t begin, uint32_t end, uint32_t* offsets) {
            const MortonKey* const keys = keys_.data();
            MortonKey* const room = room_.data();
            for (uint32_t i = begin; i < end; ++i) room[offsets[digit(keys[i])]++] = keys[i];
        });
        std::swap(keys_, room_);
    }

    template <class Work>
    void for_chunks(const Work& work) {
        scheduler_.for_each(chunks_, [&](uint32_t i) {
            work(i * chunk_, uint32_t(std::min<uint64_t>(count_, uint64_t(i + 1) * chunk_)),
                 offsets_.data() + size_t(i) * kDigits);
        });
    }

    uint32_t count_;
    uint32_t chunk_;
    uint32_t chunks_;
    base::Scheduler& scheduler_;
    Buffer<MortonKey> keys_;
    Buffer<MortonKey> room_;
    Buffer<uint32_t> offsets_;
};

} // namespace

Buffer<MortonKey> sort_along_morton_curve(std::span<const geometry::Triangle> triangles,
                                          const Bounds& centers, uint32_t bits_an_axis,
                                          base::Scheduler& scheduler, base::Memory* memory) {
    Sorter sorter(uint32_t(triangles.size()), scheduler, memory);
    const Curve curve(centers, bits_an_axis);
    sorter.fill([&](uint32_t i) {
        const Bounds box = bounds_of(triangles[i]);
        return curve.place(box.lower + box.upper);
    });
    return sorter.sort(3 * bits_an_axis);
}

Buffer<MortonKey> sort_along_morton_curve(std::span<const math::Vec3> points,
                                          const math::Box& bounds, uint32_t bits_an_axis,
                                          base::Scheduler& scheduler, base::Memory* memory) {
    Sorter sorter(uint32_t(points.size()), scheduler, memory);
    const Curve curve({load(bounds.lower), load(bounds.upper)}, bits_an_axis);
    sorter.fill([&](uint32_t i) { return curve.place(load(points[i])); });
    return sorter.sort(3 * bits_an_axis);
}

} // namespace peregrine::accel
