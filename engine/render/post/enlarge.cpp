#include "render/post/enlarge.h"

#include "render/post/kernels.h"
#include "render/post/shown.h"

#include <algorithm>
#include <cmath>

namespace peregrine::render::post {
namespace {

constexpr uint32_t kSide = kEnlargedBlock;

// Where an image's pixel lies among the traced ones: so far behind the centre of one of them.
struct Place {
    int32_t pixel;
    float behind;

    Place(uint32_t at, uint32_t traced, uint32_t whole) {
        const double exact = (at + 0.5) * double(traced) / double(whole) - 0.5;
        pixel = int32_t(std::floor(exact));
        behind = float(exact - pixel);
    }
};

uint32_t clamp_to(int32_t pixel, uint32_t count) {
    return uint32_t(std::clamp(pixel, 0, int32_t(count) - 1));
}

class EnlargedBlock {
public:
    EnlargedBlock(const Plan& plan, uint32_t x0, uint32_t y0)
        : plan_(plan), x0_(x0), y0_(y0), width_(std::min(plan.frame.width - x0, kSide)),
          height_(std::min(plan.frame.height - y0, kSide)) {
        for (uint32_t i = 0; i < kSide; ++i) {
            const Place place(x0 + std::min(i, width_ - 1), plan.extent.width, plan.frame.width);
            behind_[i] = place.behind;
            for (int k = 0; k < 4; ++k)
                column_[k][i] = clamp_to(place.pixel + k - 1, plan.extent.width);
        }
    }

    void write() {
        const auto enlarge = kernels(plan_.snapshot.isa()).enlarge_row;
        alignas(64) float shown[3][kSide];
        float* const channels[3] = {shown[0], shown[1], shown[2]};
        const float* const values[3] = {shown[0], shown[1], shown[2]};
        for (uint32_t y = y0_; y < y0_ + height_; ++y) {
            const Place place(y, plan_.extent.height, plan_.frame.height);
            const TapRow* rows[4];
            for (int k = 0; k < 4; ++k) rows[k] = &taps_of(place.pixel + k - 1);
            enlarge(rows, behind_, place.behind, width_, channels);
            write_shown(plan_.frame, x0_, y, width_, values);
        }
    }

private:
    static constexpr int32_t kNoRow = -4;

    const TapRow& taps_of(int32_t row) {
        const auto slot = uint32_t(row) & 3;
        TapRow& taps = taps_[slot];
        if (row_[slot] == row) return taps;
        row_[slot] = row;
        const size_t at = clamp_to(row, plan_.extent.height) * plan_.film->stride();
        for (int c = 0; c < 3; ++c) {
            const float* const shown = plan_.film->shown(c) + at;
            for (int k = 0; k < 4; ++k)
                for (uint32_t i = 0; i < kSide; ++i) taps.tap[c][k][i] = shown[column_[k][i]];
        }
        return taps;
    }

    const Plan& plan_;
    uint32_t x0_, y0_, width_, height_;
    alignas(64) float behind_[kSide];
    uint32_t column_[4][kSide];
    TapRow taps_[4];
    int32_t row_[4] = {kNoRow, kNoRow, kNoRow, kNoRow};
};

uint32_t blocks_across(const Frame& frame) {
    return (frame.width + kSide - 1) / kSide;
}

} // namespace

uint32_t enlarged_block_count(const Frame& frame) {
    return blocks_across(frame) * ((frame.height + kSide - 1) / kSide);
}

void enlarge_block(const Plan& plan, uint32_t block) {
    const uint32_t across = blocks_across(plan.frame);
    EnlargedBlock(plan, block % across * kSide, block / across * kSide).write();
}

} // namespace peregrine::render::post
