#pragma once

#include "base/memory.h"

#include <algorithm>
#include <cstdint>

// What was proved of the segments between a lamp and the fixed triangles.
namespace peregrine::trace::visibility {

enum class State : uint32_t {
    hidden = 0,  // a fixed triangle is in the way, everywhere
    lit = 1,     // no fixed triangle is, anywhere
    mixed = 2,   // neither was proved: to be traced
    patches = 3, // patch by patch
};

// A triangle is cut into 4^level patches by lines parallel to its edges. What holds of all but a
// border is said of the triangle without it: where a wall meets a floor, rays from points within
// micrometres of the wall may or may not be stopped by it.
struct Grid {
    // The parts of a triangle's height that a border takes, by TriangleView::border().
    static constexpr float kBorder[3] = {0, 0x1p-9f, 0x1p-6f};
    static constexpr uint32_t kMaxLevel = 7;

    // Row by row from v = 0; in a row, a patch like the whole triangle before its mirror image.
    static constexpr uint32_t index(uint32_t side, uint32_t iu, uint32_t iv, uint32_t upper) {
        return iv * (2 * side - iv) + 2 * iu + upper;
    }
};

// One triangle as a lamp sees it.
class TriangleView {
public:
    TriangleView() = default; // hidden
    TriangleView(State state, uint32_t border, uint32_t level = 0, uint32_t first_word = 0)
        : bits_(uint32_t(state) | border << 2 | level << 4 | first_word << 7) {}

    State state() const { return State(bits_ & 3); }
    uint32_t border() const { return bits_ >> 2 & 3; } // points of it are to be traced
    uint32_t level() const { return bits_ >> 4 & 7; }
    uint32_t first_word() const {
        return bits_ >> 7;
    } // in PointVisibility::codes: a patch has 2 bits
    bool operator==(const TriangleView&) const = default;

    static constexpr uint32_t kMaxWords = 1u << 25;

private:
    uint32_t bits_ = 0;
};
static_assert(sizeof(TriangleView) == 4);

// Immutable once made. Pages of triangles that are hidden, or that the lamp does not reach, share
// one.
class PointVisibility {
public:
    static constexpr uint32_t kPage = 64;

    PointVisibility(uint32_t triangle_count, base::Memory* memory)
        : pages_((triangle_count + kPage - 1) / kPage, 0u, memory),
          views_(kPage, TriangleView(), memory), codes_(memory) {}

    TriangleView of(uint32_t triangle) const {
        return views_[pages_[triangle / kPage] * kPage + triangle % kPage];
    }
    State patch(const TriangleView& view, uint32_t index) const {
        return State(codes_[view.first_word() + index / 16] >> index % 16 * 2 & 3);
    }
    const uint32_t* codes() const { return codes_.data(); }

    // The state of the point at barycentrics (u, v) of a triangle; never `patches`. The SIMD form
    // (shade) does the same operations.
    State at(uint32_t triangle, float u, float v) const {
        const TriangleView view = of(triangle);
        if (view.border() == 0 && view.state() != State::patches) return view.state();
        const float border = Grid::kBorder[view.border()];
        const float scale = 1.0f / (1.0f - 3.0f * border);
        const float x = (u - border) * scale, y = (v - border) * scale;
        if (!(x >= 0.0f && y >= 0.0f && x + y < 1.0f)) return State::mixed;
        if (view.state() != State::patches) return view.state();
        const auto side = 1u << view.level();
        const float xs = x * float(side), ys = y * float(side);
        const auto iu = uint32_t(xs), iv = uint32_t(ys);
        // A row's last patch has no mirror image, whatever rounding says.
        const uint32_t upper = (xs - float(iu)) + (ys - float(iv)) >= 1.0f && iu + iv + 1 < side;
        return patch(view, Grid::index(side, iu, iv, upper));
    }

    uint64_t bytes() const {
        return sizeof *this + (pages_.size() + views_.size() + codes_.size()) * 4;
    }

    // For the prover.
    void set(uint32_t triangle, const TriangleView& view) {
        uint32_t& page = pages_[triangle / kPage];
        if (page == 0) {
            page = uint32_t(views_.size() / kPage);
            views_.resize(views_.size() + kPage);
        }
        views_[page * kPage + triangle % kPage] = view;
    }
    base::Vector<uint32_t>& words() { return codes_; }

private:
    base::Vector<uint32_t> pages_; // of triangles: which page of views
    base::Vector<TriangleView> views_;
    base::Vector<uint32_t> codes_;
};

} // namespace peregrine::trace::visibility
