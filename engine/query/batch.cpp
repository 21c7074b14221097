#include "query/batch.h"

#include "query/check_rays.h"
#include "query/hit_stores.h"
#include "query/marks.h"
#include "query/ray_loaders.h"
#include "query/ray_order.h"
#include "query/spread.h"
#include "query/valid_ray.h"
#include "trace/world/stream.h"

#include <algorithm>
#include <cstdint>

namespace peregrine::query {
namespace {

static_assert(kChunk <= trace::kMaxStream);
constexpr uint32_t kPad = 16; // to a multiple of this

template <class T>
struct alignas(64) Lane {
    T value[kChunk];
};

constexpr Lane<float> make_constant(float value) {
    Lane<float> lane{};
    for (float& v : lane.value) v = value;
    return lane;
}
constexpr Lane<float> kZeros = make_constant(0);
constexpr Lane<float> kInfinities = make_constant(kInfinity);

bool is_aligned(const void* address) {
    return reinterpret_cast<uintptr_t>(address) % 64 == 0;
}

// What is known of the rays of a batch.
struct Checked {
    const RayLoaders& loaders;
    bool some_invalid; // which are to be marked
};

// A chunk of the host's rays as a stream: in place where its arrays allow that, else copied here.
class Chunk {
public:
    // Of what was loaded.
    const trace::Positions& positions() const { return positions_; }

    // Rays that are not valid may come as records of a batch that fits one chunk: then this throws;
    // and where it is known that there are some: then others that hit nothing take their place.
    trace::RayStream load(const Rays& rays, uint64_t first, uint32_t count,
                          const Checked& checked) {
        const float* lanes[8];
        rays.records ? split(rays, first, count, checked, lanes)
                     : place(rays.arrays, first, count, lanes);
        positions_ = {{lanes[0], lanes[1], lanes[2]}, rays.shift.by};
        if (rays.shift) [[unlikely]]
            move(rays, count, lanes);
        if (checked.some_invalid) [[unlikely]]
            replace_invalid(count, lanes);
        return {{lanes[0], lanes[1], lanes[2]},
                {lanes[4], lanes[5], lanes[6]},
                lanes[RayArrays::kBegin],
                lanes[RayArrays::kEnd],
                count};
    }

private:
    void split(const Rays& rays, uint64_t first, uint32_t count, const Checked& checked,
               const float* (&lanes)[8]) {
        float* rooms[8];
        for (uint32_t k = 0; k < 8; ++k) lanes[k] = rooms[k] = room_[k].value;
        const bool valid =
            checked.loaders.split(rays.records + first * rays.stride, rays.stride, count, rooms);
        if (!valid && !rays.shift && !checked.some_invalid) [[unlikely]]
            reject_first(rays);
    }

    void place(const RayArrays& arrays, uint64_t first, uint32_t count, const float* (&lanes)[8]) {
        for (uint32_t k = 0; k < 8; ++k) {
            const float* array = arrays.array[k];
            if (!array)
                lanes[k] = k == RayArrays::kBegin ? kZeros.value : kInfinities.value;
            else if (is_aligned(array) && count % kPad == 0)
                lanes[k] = array + first;
            else
                lanes[k] = copy(array, first, count, room_[k].value);
        }
    }

    void move(const Rays& rays, uint32_t count, const float* (&lanes)[8]) {
        const uint32_t padded = (count + kPad - 1) / kPad * kPad;
        for (int k = 0; k < 3; ++k) {
            float* const room = moved_[k].value;
            for (uint32_t i = 0; i < padded; ++i) room[i] = rays.shift.applied(lanes[k][i], k);
            lanes[k] = room;
        }
    }

    void replace_invalid(uint32_t count, const float* (&lanes)[8]) {
        for (uint32_t k = 0; k < 8; ++k)
            if (lanes[k] != room_[k].value) lanes[k] = copy(lanes[k], 0, count, room_[k].value);
        const uint32_t padded = (count + kPad - 1) / kPad * kPad;
        for (uint32_t i = 0; i < padded; ++i) {
            const auto at = [&](uint32_t k) { return room_[k].value[i]; };
            if (!is_valid({{at(0), at(1), at(2)}, at(3), {at(4), at(5), at(6)}, at(7)}))
                for (uint32_t k = 0; k < 8; ++k) room_[k].value[i] = kNoRay[k];
        }
    }

    static const float* copy(const float* array, uint64_t first, uint32_t count, float* room) {
        std::memcpy(room, reinterpret_cast<const std::byte*>(array) + first * sizeof *array,
                    count * sizeof *array);
        const uint32_t padded = (count + kPad - 1) / kPad * kPad;
        std::fill(room + count, room + padded, room[count - 1]);
        return room;
    }

    Lane<float> room_[8];
    Lane<float> moved_[3]; // origins
    trace::Positions positions_;
};

// Room for a chunk's hits, and their way to the host.
class HitChunk {
public:
    explicit HitChunk(const scene::Snapshot& snapshot)
        : snapshot_(snapshot), names_(snapshot), stores_(hit_stores(snapshot.isa())) {}

    // Where the kernel is to put them: in the host's arrays where they allow that.
    trace::HitStream begin(const Hits& hits, uint64_t first, uint32_t count) {
        const bool whole = count % kPad == 0 && !hits.records;
        const auto choose = [&](auto* array, auto& room) {
            return whole && array && is_aligned(array) ? array + first : room.value;
        };
        const HitArrays& arrays = hits.arrays;
        stream_ = {choose(arrays.t, t_),
                   choose(arrays.u, u_),
                   choose(arrays.v, v_),
                   triangle_.value,
                   choose(arrays.back_face, back_face_),
                   nullptr};
        return stream_;
    }

    void end(const Hits& hits, const Surfaces& surfaces, uint64_t first, uint32_t count) const {
        if (hits.records)
            stores_.records(names_, stream_, count, hits.records + first * hits.stride,
                            hits.stride);
        else
            store_arrays(hits.arrays, first, count);
        if (surfaces) [[unlikely]]
            for (uint32_t i = 0; i < count; ++i)
                surfaces.store(first + i,
                               surface_at(snapshot_, names_.hit(stream_, i), surfaces.fields));
    }

private:
    void store_arrays(const HitArrays& arrays, uint64_t first, uint32_t count) const {
        const auto copy = [&](const auto* from, auto* array) {
            if (array && from != array + first)
                std::memcpy(reinterpret_cast<std::byte*>(array) + first * sizeof *array, from,
                            count * sizeof *array);
        };
        copy(stream_.t, arrays.t);
        copy(stream_.u, arrays.u);
        copy(stream_.v, arrays.v);
        copy(stream_.back_face, arrays.back_face);
        const auto from_first = [first](auto* array) { return array ? array + first : nullptr; };
        if (arrays.triangle || arrays.mesh)
            stores_.names(names_, triangle_.value, count, from_first(arrays.triangle),
                          from_first(arrays.mesh));
    }

    const scene::Snapshot& snapshot_;
    HitNames names_;
    const HitStores& stores_;
    trace::HitStream stream_;
    Lane<float> t_, u_, v_;
    Lane<uint32_t> triangle_, back_face_;
};

// Calls trace(stream, positions, first, count) for chunk after chunk of the rays from `first` to
// `end`.
template <class Trace>
void for_each_chunk(const Rays& rays, uint64_t first, uint64_t end, const Checked& checked,
                    trace::Coherence coherence, Trace&& trace) {
    Chunk chunk;
    for (; first < end; first += kChunk) {
        const auto count = uint32_t(std::min<uint64_t>(end - first, kChunk));
        trace::RayStream stream = chunk.load(rays, first, count, checked);
        stream.coherence = coherence;
        trace(stream, chunk.positions(), first, count);
    }
}

// ... of scattered rays, in another order: trace(stream, positions, number, count), where ray i of
// the stream is ray number(i) of the batch.
template <class Trace>
void for_each_sorted_chunk(const Rays& rays, uint64_t first, uint64_t end, const Checked& checked,
                           Trace&& trace) {
    RayOrder order;
    math::Ray room[kChunk];
    Chunk chunk;
    for (; first < end; first += RayOrder::kWindow) {
        const auto window = uint32_t(std::min<uint64_t>(end - first, RayOrder::kWindow));
        order.sort(rays, first, window);
        for (uint32_t begin = 0; begin < window; begin += kChunk) {
            const uint32_t count = std::min(window - begin, kChunk);
            const auto number = [&](uint32_t i) { return first + order[begin + i]; };
            rays.gather(number, count, room);
            const Rays gathered{
                count, reinterpret_cast<std::byte*>(room), sizeof *room, {}, rays.shift};
            trace::RayStream stream = chunk.load(gathered, 0, count, checked);
            stream.coherence = trace::Coherence::incoherent;
            trace(stream, chunk.positions(), number, count);
        }
    }
}

// Whether neighbours are to be found, not there already.
bool wants_order(const Rays& rays, uint64_t first, uint64_t end, trace::Coherence coherence) {
    return (coherence == trace::Coherence::automatic || coherence == trace::Coherence::incoherent)
           && are_scattered(rays, first, end);
}

// Records that fit one chunk are checked on the way into it; of more of them, of arrays and of
// moved rays, all are looked at before the first result is written.
Checked check(const scene::Snapshot& snapshot, const Rays& rays, const Request& request) {
    const RayLoaders& loaders = ray_loaders(snapshot.isa());
    if (request.mark_invalid) return {loaders, !are_all_valid(rays, loaders, request.scheduler)};
    if (!rays.records || rays.count > kChunk || rays.shift)
        check_rays(rays, loaders, request.scheduler);
    return {loaders, false};
}

} // namespace

void closest_batch(const scene::Snapshot& snapshot, const Rays& rays, const trace::Filter& filter,
                   const Request& request, const Hits& hits, const Surfaces& surfaces) {
    const Checked checked = check(snapshot, rays, request);
    const trace::Coherence coherence = request.selection.coherence;
    const auto in_order = [&](uint64_t first, uint64_t end) {
        HitChunk chunk(snapshot);
        for_each_chunk(rays, first, end, checked, coherence,
                       [&](const trace::RayStream& stream, const trace::Positions& positions,
                           uint64_t begin, uint32_t count) {
                           trace::closest(snapshot.world, stream, positions, filter,
                                          chunk.begin(hits, begin, count));
                           chunk.end(hits, surfaces, begin, count);
                       });
    };
    const auto sorted = [&](uint64_t first, uint64_t end) {
        HitChunk chunk(snapshot);
        Hit room[kChunk];
        const Hits found{reinterpret_cast<std::byte*>(room), sizeof *room, {}};
        for_each_sorted_chunk(
            rays, first, end, checked,
            [&](const trace::RayStream& stream, const trace::Positions& positions,
                const auto& number, uint32_t count) {
                trace::closest(snapshot.world, stream, positions, filter,
                               chunk.begin(found, 0, count));
                chunk.end(found, {}, 0, count);
                for (uint32_t i = 0; i < count; ++i) {
                    hits.store(number(i), room[i]);
                    if (surfaces) [[unlikely]]
                        surfaces.store(number(i), surface_at(snapshot, room[i], surfaces.fields));
                }
            });
    };
    spread(request.scheduler, rays.count, [&](uint64_t first, uint64_t end) {
        wants_order(rays, first, end, coherence) ? sorted(first, end) : in_order(first, end);
    });
    if (checked.some_invalid) [[unlikely]]
        for_each_invalid(rays, [&](uint64_t i) { mark(i, hits, surfaces); });
}

void occlusion_batch(const scene::Snapshot& snapshot, const Rays& rays, const trace::Filter& filter,
                     const Request& request, const Strided<uint8_t>& occluded) {
    const Checked checked = check(snapshot, rays, request);
    const trace::Coherence coherence = request.selection.coherence;
    const auto in_order = [&](uint64_t first, uint64_t end) {
        Lane<uint8_t> room;
        for_each_chunk(rays, first, end, checked, coherence,
                       [&](const trace::RayStream& stream, const trace::Positions& positions,
                           uint64_t begin, uint32_t count) {
                           trace::occluded(snapshot.world, stream, positions, filter, room.value);
                           std::byte* place = occluded.data + begin * occluded.stride;
                           if (occluded.stride == 1) {
                               std::memcpy(place, room.value, count);
                               return;
                           }
                           for (uint32_t i = 0; i < count; ++i, place += occluded.stride)
                               *place = std::byte(room.value[i]);
                       });
    };
    const auto sorted = [&](uint64_t first, uint64_t end) {
        Lane<uint8_t> room;
        for_each_sorted_chunk(rays, first, end, checked,
                              [&](const trace::RayStream& stream, const trace::Positions& positions,
                                  const auto& number, uint32_t count) {
                                  trace::occluded(snapshot.world, stream, positions, filter,
                                                  room.value);
                                  for (uint32_t i = 0; i < count; ++i)
                                      occluded.store(number(i), room.value[i]);
                              });
    };
    spread(request.scheduler, rays.count, [&](uint64_t first, uint64_t end) {
        wants_order(rays, first, end, coherence) ? sorted(first, end) : in_order(first, end);
    });
    if (checked.some_invalid) [[unlikely]]
        for_each_invalid(rays, [&](uint64_t i) { occluded.store(i, kInvalidByte); });
}

} // namespace peregrine::query
