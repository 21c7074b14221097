#include "render/bake/grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace peregrine::render::bake {
namespace {

Sample between(const Sample& a, const Sample& b) {
    if (a.buried != b.buried) return a.buried ? b : a;
    return {0.5f * (a.open + b.open), 0.5f * (a.light + b.light), a.buried};
}

// Light counts as a part of what is there, or of what one hardly sees.
bool differ(const Sample& a, const Sample& b, float tolerance) {
    constexpr float kDim = 0.02f;
    if (a.buried != b.buried || std::fabs(a.open - b.open) > tolerance) return true;
    for (int k = 0; k < 3; ++k) {
        const float whole = std::max(a.light[k], b.light[k]) + kDim;
        if (std::fabs(a.light[k] - b.light[k]) > tolerance * whole) return true;
    }
    return false;
}

} // namespace

Grid::Grid(float longest, float spacing, base::Memory* memory) : samples_(memory), states_(memory) {
    uint32_t level = 0;
    while (level < Names::kMaxLevel && longest > spacing * float(1u << level)) ++level;
    most_level_ = level;
    level_ = level - std::min(level, kCoarser);
    samples_.resize(Names::count(level_));
    states_.resize(samples_.size(), State::wanted);
}

void Grid::set_corner(uint32_t corner, const Sample& sample) {
    const uint32_t side = 1u << level_;
    const uint32_t i = Names::index(level_, corner == 1 ? side : 0, corner == 2 ? side : 0);
    samples_[i] = sample;
    states_[i] = State::known;
}

// Calls visit(i, a, b) for each point i in the middle between two, a and b, of the level before.
template <class Visit>
void Grid::for_each_middle(Visit&& visit) {
    const uint32_t side = 1u << level_;
    for (uint32_t iv = 0, i = 0; iv <= side; ++iv)
        for (uint32_t iu = 0; iu + iv <= side; ++iu, ++i) {
            const uint32_t du = iu & 1, dv = iv & 1;
            if (du + dv == 0) continue;
            visit(i, Names::index(level_, iu + du, iv - dv),
                  Names::index(level_, iu - du, iv + dv));
        }
}

void Grid::judge(float tolerance) {
    for_each_middle([&](uint32_t i, uint32_t a, uint32_t b) {
        if (states_[i] != State::wanted) return;
        const bool is_odd = differ(samples_[i], between(samples_[a], samples_[b]), tolerance);
        states_[i] = is_odd ? State::odd : State::known;
    });
}

bool Grid::refine(float tolerance) {
    if (std::exchange(is_first_, false))
        std::fill(states_.begin(), states_.end(), State::odd);
    else
        judge(tolerance);
    if (level_ == most_level_
        || std::find(states_.begin(), states_.end(), State::odd) == states_.end())
        return false;
    base::Vector<Sample> samples(Names::count(level_ + 1), Sample(), samples_.get_allocator());
    base::Vector<State> states(samples.size(), State::between, states_.get_allocator());
    const uint32_t side = 1u << level_++;
    for (uint32_t iv = 0, i = 0; iv <= side; ++iv)
        for (uint32_t iu = 0; iu + iv <= side; ++iu, ++i) {
            const uint32_t to = Names::index(level_, 2 * iu, 2 * iv);
            samples[to] = samples_[i];
            states[to] = states_[i];
        }
    samples_.swap(samples);
    states_.swap(states);
    for_each_middle([&](uint32_t i, uint32_t a, uint32_t b) {
        samples_[i] = between(samples_[a], samples_[b]);
        const bool is_wanted = states_[a] == State::odd || states_[b] == State::odd;
        if (is_wanted) states_[i] = State::wanted;
    });
    // Around the points of the last level all is asked now.
    for (State& state : states_)
        if (state == State::odd) state = State::known;
    return true;
}

void Grid::dig_out() {
    const uint32_t side = 1u << level_;
    const auto is_free = [](const Sample& sample) { return !sample.buried; };
    if (std::none_of(samples_.begin(), samples_.end(), is_free)) return;
    for (bool any = true; any;) {
        any = false;
        base::Vector<Sample> next = samples_;
        for (uint32_t iv = 0, i = 0; iv <= side; ++iv)
            for (uint32_t iu = 0; iu + iv <= side; ++iu, ++i) {
                if (!samples_[i].buried) continue;
                any = true;
                Sample sum{0, math::Vec3(0), false};
                float count = 0;
                const auto add = [&](uint32_t u, uint32_t v) {
                    const Sample& other = samples_[Names::index(level_, u, v)];
                    if (other.buried) return;
                    sum.open += other.open;
                    sum.light += other.light;
                    ++count;
                };
                const bool inside = iu + iv < side;
                if (iu > 0) add(iu - 1, iv);
                if (iv > 0) add(iu, iv - 1);
                if (inside) add(iu + 1, iv);
                if (inside) add(iu, iv + 1);
                if (iu > 0) add(iu - 1, iv + 1);
                if (iv > 0) add(iu + 1, iv - 1);
                if (count > 0) next[i] = {sum.open / count, sum.light / count, false};
            }
        samples_.swap(next);
    }
}

} // namespace peregrine::render::bake
