#include "render/post/bloom.h"

#include "render/tile_buffers.h"

#include <algorithm>
#include <cmath>

namespace peregrine::render::post {
namespace {

constexpr float kMostGiven = 64;    // of a pixel, beyond the threshold, as it would be shown
constexpr float kMostLimit = 1e30f; // whatever the exposure
constexpr uint32_t kChunk = 256;    // columns of the smaller one of two levels
constexpr uint32_t kLinePadding = 16;

// Columns of a row, and a few beyond them.
template <uint32_t Count>
struct alignas(64) Line {
    float column[kLinePadding + Count + 4 * kLinePadding];

    float* at(uint32_t i) { return column + kLinePadding + i; }

    // Columns [begin, end), of those from `first` on, were found. Beyond the picture's sides
    // everything is as at the side; `last`: the last one that is read.
    void widen(uint32_t first, uint32_t begin, uint32_t end, uint32_t last) {
        float* const zero = at(0);
        for (ptrdiff_t i = -2; i < ptrdiff_t(begin) - ptrdiff_t(first); ++i)
            zero[i] = zero[begin - first];
        if (end <= last) std::fill(at(end - first), at(last + 1 - first), *at(end - 1 - first));
    }
};

uint32_t clamp_to(int64_t row, uint32_t count) {
    return uint32_t(std::clamp<int64_t>(row, 0, int64_t(count) - 1));
}

uint32_t padded(uint32_t count) {
    return (count + 15) / 16 * 16;
}

float tent(float a, float b, float c, float d) {
    return (a * (1.0f / 16) + b * (5.0f / 16)) + (c * (7.0f / 16) + d * (3.0f / 16));
}

// The four of a level about pixel `at` of one of twice the size, as Kernels::double_rows wants
// them.
void find_four(uint32_t at, uint32_t count, uint32_t (&four)[4]) {
    const int64_t middle = at / 2, step = at % 2 ? -1 : 1;
    for (int k = 0; k < 4; ++k) four[k] = clamp_to(middle + step * (k - 2), count);
}

} // namespace

Bloom::Bloom(const Frame& frame, base::Memory* memory) : extent_(frame.traced()), planes_(memory) {
    bright_.threshold = std::min(frame.bloom.threshold / frame.exposure, kMostLimit);
    bright_.limit = std::min(kMostGiven / frame.exposure, kMostLimit);
    bright_.strength = frame.bloom.strength;
    choose_levels(extent_, frame.bloom.radius);
    size_t size = 0;
    for (uint32_t i = 0; i < count_; ++i) {
        Level& level = levels_[i];
        level.stride = padded(level.width);
        level.begin = size;
        size += 3 * level.stride * level.height;
    }
    planes_.allocate(size + kPadding);
}

// Pixels of the last level are about as wide as the radius. It counts for as much as the radius
// goes beyond the one before, and all others alike.
void Bloom::choose_levels(const Extent& extent, float radius) {
    int exponent;
    const float reach = std::max(radius * float(extent.height), 2.0f);
    const float part = std::frexp(reach, &exponent); // reach = part * 2^exponent
    float levels = float(exponent - 1) + (2 * part - 1);
    Extent size = extent;
    float weights[kMostLevels];
    for (; levels > 0 && count_ < kMostLevels && (count_ == 0 || size != Extent{1, 1}); ++count_) {
        size = {(size.width + 1) / 2, (size.height + 1) / 2};
        levels_[count_].width = size.width;
        levels_[count_].height = size.height;
        weights[count_] = std::min(levels, 1.0f);
        levels -= 1.0f;
    }
    float sum = 0;
    for (uint32_t i = count_; i-- > 0;) {
        sum += weights[i];
        levels_[i].weight = weights[i] / sum;
    }
}

void Bloom::halve(const Kernels& kernels, const Film& film, uint32_t level, uint32_t y) {
    const Level& to = levels_[level];
    const Level* const from = level ? &levels_[level - 1] : nullptr;
    const Extent whole = from ? Extent{from->width, from->height} : extent_;
    Line<2 * kChunk> lines[3];
    for (uint32_t x = 0; x < to.width; x += kChunk) {
        const uint32_t count = std::min(to.width - x, kChunk);
        const uint32_t first = 2 * x, begin = first < 2 ? 0 : first - 2;
        const uint32_t end = std::min(first + 2 * count + 2, whole.width);
        BrightRows rows;
        float* sums[3];
        for (int c = 0; c < 3; ++c) {
            for (int r = 0; r < 6; ++r) {
                const uint32_t at = clamp_to(2 * int64_t(y) + r - 2, whole.height);
                const float* const begins =
                    from ? row(*from, c, at) : film.radiance(c) + at * film.stride();
                rows.row[r][c] = begins + begin;
            }
            sums[c] = lines[c].at(0) - (first - begin);
        }
        if (!from) kernels.take_bright(bright_, rows, end - begin, sums);
        for (int c = 0; c < 3; ++c) {
            const float* six[6];
            for (int r = 0; r < 6; ++r) six[r] = rows.row[r][c];
            if (from) kernels.halve_rows(six, end - begin, sums[c]);
            lines[c].widen(first, begin, end, first + 2 * padded(count) + 3);
            kernels.halve_columns(lines[c].at(0), count, row(to, c, y) + x);
        }
    }
}

// `sums`: a Line of at least count columns.
template <class Sums>
void Bloom::double_rows(const Kernels& kernels, const Level& level, int channel, uint32_t y,
                        uint32_t x, uint32_t count, Sums& sums) const {
    uint32_t four[4];
    find_four(y, level.height, four);
    const uint32_t begin = x < 2 ? 0 : x - 2, end = std::min(x + count + 3, level.width);
    const float* rows[4];
    for (int k = 0; k < 4; ++k) rows[k] = row(level, channel, four[k]) + begin;
    kernels.double_rows(rows, end - begin, sums.at(0) - (x - begin));
    sums.widen(x, begin, end, x + padded(count) + 2);
}

void Bloom::gather(const Kernels& kernels, uint32_t level, uint32_t y) {
    const Level &to = levels_[level], &from = levels_[level + 1];
    Line<kChunk> sums;
    alignas(64) float twice[2 * kChunk];
    for (int c = 0; c < 3; ++c)
        for (uint32_t x = 0; x < from.width; x += kChunk) {
            const uint32_t count = std::min(from.width - x, kChunk);
            double_rows(kernels, from, c, y, x, count, sums);
            kernels.double_columns(sums.at(0), count, twice);
            kernels.mix(to.weight, twice, std::min(to.width - 2 * x, 2 * count),
                        row(to, c, y) + 2 * x);
        }
}

// All rows before all columns: what was just written a little off is slow to read.
void Bloom::spread(const Kernels& kernels, const Tile& tile, float* const light[3]) const {
    Line<kTileSize / 2> sums[kTileSize];
    alignas(64) float glow[3][kTileRays];
    const uint32_t count = (tile.width() + 1) / 2;
    for (int c = 0; c < 3; ++c) {
        for (uint32_t y = 0; y < tile.height(); ++y)
            double_rows(kernels, levels_[0], c, tile.y0 + y, tile.x0 / 2, count, sums[y]);
        for (uint32_t y = 0; y < tile.height(); ++y)
            kernels.double_columns(sums[y].at(0), count, glow[c] + y * kTileSize);
    }
    const float* const glows[3] = {glow[0], glow[1], glow[2]};
    kernels.spread(bright_, glows, tile.height() * kTileSize, light);
}

// As the kernels find it.
math::Vec3 Bloom::glow_at(uint32_t x, uint32_t y) const {
    const Level& level = levels_[0];
    uint32_t rows[4], columns[4];
    find_four(y, level.height, rows);
    find_four(x, level.width, columns);
    math::Vec3 glow;
    for (int c = 0; c < 3; ++c) {
        float sums[4];
        for (int k = 0; k < 4; ++k)
            sums[k] = tent(row(level, c, rows[0])[columns[k]], row(level, c, rows[1])[columns[k]],
                           row(level, c, rows[2])[columns[k]], row(level, c, rows[3])[columns[k]]);
        glow[c] = tent(sums[0], sums[1], sums[2], sums[3]);
    }
    return glow;
}

} // namespace peregrine::render::post

namespace peregrine::render {

void take_spread_light(const Plan& plan, TileBuffers& buffers) {
    const Tile& tile = buffers.tile;
    alignas(64) float rows[3][kTileRays];
    float* const light[3] = {rows[0], rows[1], rows[2]};
    for (int c = 0; c < 3; ++c)
        for (uint32_t y = 0; y < tile.height(); ++y) {
            const float* const film =
                plan.film->radiance(c) + (tile.y0 + y) * plan.film->stride() + tile.x0;
            float* const end = std::copy_n(film, tile.width(), rows[c] + y * kTileSize);
            std::fill(end, rows[c] + (y + 1) * kTileSize, 0.0f);
        }
    plan.bloom->spread(post::kernels(plan.snapshot.isa()), tile, light);
    for (int c = 0; c < 3; ++c)
        for (uint32_t i = 0; i < tile.count; ++i)
            buffers.colors.channel[c][i] = rows[c][tile.y[i] * kTileSize + tile.x[i]];
}

} // namespace peregrine::render
