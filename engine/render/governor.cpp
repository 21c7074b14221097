#include "render/governor.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace peregrine::render {
namespace {

constexpr GovernorLevel kLevels[] = {
    {1, 0, 8, 0.5f, 8, 1.0f, "light at every pixel, 8 rays at edges"},
    {8, 0.06f, 8, 0.5f, 8, 1.05f, "light in blocks of 8, 8 rays at edges"},
    {16, 0.1f, 8, 0.5f, 8, 1.1f, "light in coarse blocks of 16, 8 rays at edges"},
    {16, 0.1f, 4, 0.3f, 8, 1.2f, "light in coarse blocks of 16, 4 rays at edges"},
    {16, 0.1f, 4, 0.1f, 8, 1.2f, "light in coarse blocks of 16, 4 rays at the strongest edges"},
    {16, 0.1f, 1, 0, 8, 1.2f, "light in coarse blocks of 16"},
    {16, 0.1f, 1, 0, 7, 1.2f, "light in coarse blocks of 16, 7/8 of the size"},
    {16, 0.1f, 1, 0, 6, 1.3f, "light in coarse blocks of 16, 3/4 of the size"},
    {16, 0.1f, 1, 0, 5, 1.4f, "light in coarse blocks of 16, 5/8 of the size"},
    {16, 0.1f, 1, 0, 4, 1.5f, "light in coarse blocks of 16, 1/2 of the size"},
    {16, 0.1f, 1, 0, 3, 1.6f, "light in coarse blocks of 16, 3/8 of the size"},
    {16, 0.1f, 1, 0, 2, 1.8f, "light in coarse blocks of 16, 1/4 of the size"},
};
static_assert(std::size(kLevels) <= Governor::kMostLevels);

constexpr uint32_t kLast = uint32_t(std::size(kLevels)) - 1;

// In parts of the target. Between the two nothing happens.
constexpr float kTooSlow = 1.05f;    // in the mean
constexpr float kFarTooSlow = 1.25f; // at once
constexpr float kWanted = 0.95f;     // what a change for the cheaper aims at
constexpr float kRoom = 0.9f;        // a better level is tried if it is foreseen to take less
constexpr float kMuchRoom = 0.6f;

constexpr uint32_t kJudged = 3;     // frames until a level may be far too slow, ...
constexpr uint32_t kKnown = 8;      // ... or too slow, ...
constexpr uint32_t kWellKnown = 48; // ... and until nothing more is learned of its cost
constexpr uint32_t kLeastPatience = 12, kMostPatience = 1024;
constexpr uint32_t kRegretted = 120; // frames within which going up was a mistake
constexpr float kSmoothing = 0.25f;
constexpr uint32_t kMeanFrames = 24;
constexpr float kMostCost = 4;
constexpr float kSameScene = 1.4f; // what was learned holds while frames take about as long

float median(float a, float b, float c) {
    return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

} // namespace

std::span<const GovernorLevel> governor_levels() {
    return kLevels;
}

void GovernorLevel::apply_to(Approximations& options, const Extent& extent) const {
    const auto scaled = [&](uint32_t side) {
        return uint32_t(std::max<uint64_t>((uint64_t(side) * eighths + 4) / 8, 1));
    };
    options.light_block = light_block;
    options.light_tolerance = light_tolerance;
    options.edge_samples = edge_samples;
    options.edge_budget = edge_budget;
    options.render_width = scaled(extent.width);
    options.render_height = scaled(extent.height);
}

void Governor::begin() {
    level = target_ms > 0 ? std::min(level, kLast) : kLast;
    previous = std::min(previous, kLast);
}

void Governor::observe(double frame_ms) {
    begin();
    if (!(target_ms > 0)) {
        frames = 0;
        return;
    }
    if (!(frame_ms >= 0 && frame_ms < 1e9)) return;
    smooth(float(frame_ms));
    if (frames < kJudged) return;
    if (frames <= kWellKnown) learn();
    if (smooth_ms > kFarTooSlow * target_ms)
        go_down(smooth_ms);
    else if (mean_ms > kTooSlow * target_ms && frames >= kKnown)
        go_down(mean_ms);
    else
        try_up();
}

// One frame that something held up does not count.
void Governor::smooth(float ms) {
    if (frames == 0) recent_ms[0] = recent_ms[1] = smooth_ms = mean_ms = ms;
    const float middle = median(ms, recent_ms[0], recent_ms[1]);
    recent_ms[0] = recent_ms[1];
    recent_ms[1] = ms;
    if (frames < ~0u) ++frames;
    smooth_ms += (middle - smooth_ms) * (frames <= kJudged ? 0.5f : kSmoothing);
    mean_ms += (middle - mean_ms) / float(std::min(frames, kMeanFrames));
}

// What the last change was worth; of several levels at once, in equal parts.
void Governor::learn() {
    if (!(previous_ms > 0 && mean_ms > 0) || previous == level) return;
    const uint32_t upper = std::min(previous, level), lower = std::max(previous, level);
    const float upper_ms = previous < level ? previous_ms : mean_ms;
    const float lower_ms = previous < level ? mean_ms : previous_ms;
    const float each = std::pow(upper_ms / lower_ms, 1.0f / float(lower - upper));
    float at = lower_ms;
    for (uint32_t i = lower; i-- > upper;) {
        cost[i] = std::clamp(each, 1.0f, kMostCost);
        seen_at[i] = at;
        at *= cost[i];
    }
}

// `upper`: the level above this one.
bool Governor::is_learned(uint32_t upper) const {
    return cost[upper] >= 1 && mean_ms < seen_at[upper] * kSameScene
           && mean_ms * kSameScene > seen_at[upper];
}

float Governor::cost_of(uint32_t upper) const {
    return is_learned(upper) ? cost[upper] : kLevels[upper + 1].cost;
}

void Governor::go_to(uint32_t next) {
    previous = level;
    previous_ms = mean_ms;
    level = next;
    frames = 0;
}

void Governor::go_down(float ms) {
    if (level == kLast) return;
    const bool was_mistake = previous > level && frames < kRegretted;
    if (was_mistake)
        patience =
            std::clamp(2 * std::min(patience, kMostPatience), 2 * kLeastPatience, kMostPatience);
    uint32_t next = level;
    float foreseen = ms;
    do {
        ++next;
        foreseen /= kLevels[next].cost;
    } while (next < kLast && foreseen > kWanted * target_ms);
    go_to(next);
}

void Governor::try_up() {
    if (level == 0) return;
    const uint32_t upper = level - 1;
    if (!is_learned(upper)) patience = 0;
    const float foreseen = mean_ms * cost_of(upper);
    if (!(foreseen < kRoom * target_ms)) return;
    const uint32_t needed =
        foreseen < kMuchRoom * target_ms ? kJudged : std::max(patience, kLeastPatience);
    if (frames >= needed) go_to(upper);
}

} // namespace peregrine::render
