#pragma once

#include "base/memory.h"
#include "render/bake/sample.h"
#include "scene/light_map.h"

namespace peregrine::render::bake {

// The points of one triangle, as near to each other as its light wants it: begun coarse, and
// halved around points that are not what their neighbours made expect.
class Grid {
public:
    using Names = scene::PointGrids;

    // `longest`: the triangle's longest side, in metres.
    Grid(float longest, float spacing, base::Memory* memory);

    // 1 at u = 1, 2 at v = 1: it need not be sampled.
    void set_corner(uint32_t corner, const Sample& sample);

    uint32_t level() const { return level_; }
    const base::Vector<Sample>& samples() const { return samples_; }

    // Calls visit(u, v, sample) for each point that is to be sampled.
    template <class Visit>
    void for_each_wanted(Visit&& visit) {
        const uint32_t side = 1u << level_;
        const float step = 1.0f / float(side);
        for (uint32_t iv = 0, i = 0; iv <= side; ++iv)
            for (uint32_t iu = 0; iu + iv <= side; ++iu, ++i)
                if (states_[i] == State::wanted)
                    visit(float(iu) * step, float(iv) * step, samples_[i]);
    }

    // Once those are known: whether there are more.
    bool refine(float tolerance);
    // In the end: points within something solid take what their neighbours have.
    void dig_out();

private:
    enum class State : uint8_t { known, wanted, between, odd };
    static constexpr uint32_t kCoarser = 2; // levels

    void judge(float tolerance);
    template <class Visit>
    void for_each_middle(Visit&& visit);

    uint32_t level_;
    uint32_t most_level_;
    bool is_first_ = true;         // level
    base::Vector<Sample> samples_; // as in scene::PointGrids
    base::Vector<State> states_;   // odd: what lies around it is to be asked
};

} // namespace peregrine::render::bake
