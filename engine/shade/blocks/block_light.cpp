#include "shade/blocks/block_light.h"

#include <algorithm>
#include <cmath>

namespace peregrine::shade {
namespace {

constexpr float kPi = 3.14159265f;
constexpr float kLeastCosine = 0.951f;  // between the normals of a block: 18 degrees
constexpr float kHighlightShare = 0.2f; // of all light, below which highlights need not be right
constexpr float kDepth = 1.0f / 3.0f;   // of a smooth block, in its sides

} // namespace

void TileLight::begin(uint32_t ray_count) {
    std::fill_n(found, ray_count, false);
    std::fill_n(wanted, ray_count, uint8_t(0));
    blocks.clear();
    known_count = 0;
    point_count = 0;
    slots.clear();
    batch.slots = &slots;
}

BlockLight::BlockLight(const Shader& shader, const scene::Environment& environment, float tolerance,
                       float pixel, float least)
    : shader_(shader), ambient_(environment.ambient * kPi), tolerance_(tolerance), pixel_(pixel),
      least_(least * kPi) {}

void BlockLight::find(const TileHits& hits, TileLight& out, Scratch& scratch) const {
    for (uint32_t level = BlockLists::kLevels; level-- > 0;) try_blocks(hits, level, out, scratch);
    if (out.blocks.uneven.count > 0) try_groups(hits, out, scratch);
    find_wanted(hits, SurfacePart::geometry, out, scratch);
}

void BlockLight::try_blocks(const TileHits& hits, uint32_t level, TileLight& out,
                            Scratch& scratch) const {
    BlockLists::List& list = out.blocks.pending[level];
    uint32_t kept = 0;
    for (uint32_t i = 0; i < list.count; ++i) {
        const Block block = list.blocks[i];
        if (!shader_.kernels().block_is_smooth(hits.t + block.first, block.side, pixel_, kDepth)) {
            out.blocks.cut(block);
            continue;
        }
        for (uint32_t k = 0; k < Block::kSamples; ++k) out.want(block.sample(k), block.known);
        list.blocks[kept++] = block;
    }
    if (kept == 0) return;
    find_wanted(hits, SurfacePart::smooth, out, scratch);
    for (uint32_t i = 0; i < kept; ++i) judge(list.blocks[i], out);
}

// Of a block whose samples are lit.
void BlockLight::judge(Block block, TileLight& out) const {
    LightMarks all;
    if (!is_even(block, out)) return out.blocks.cut(block);
    if (!join_marks(block, out, all))
        return block.side == Block::kLeast ? want_all(block, out) : out.blocks.cut(block);
    if (block.known == Block::kNothing) block.known = out.know(all);
    bool relief = false;
    for (uint32_t k = 0; k < Block::kSamples; ++k) relief |= out.relief[block.sample(k)];
    if (relief) return want_all(block, out);
    if (is_between(block, out)) return interpolate(block, out);
    block.side == Block::kLeast ? want_all(block, out) : out.blocks.cut(block);
}

bool BlockLight::is_even(const Block& block, const TileLight& light) const {
    const auto& [x, y, z] = light.normal;
    const float* const normal[3] = {x, y, z};
    if (!normals_agree(normal, block, kLeastCosine)) return false;
    if (shader_.program() != Program::highlight) return true;
    for (uint32_t k = 0; k < Block::kMiddle; ++k)
        if (light.shininess[block.sample(k)] != light.shininess[block.sample(Block::kMiddle)])
            return false;
    return true;
}

bool BlockLight::join_marks(const Block& block, const TileLight& light, LightMarks& all) const {
    all = light.marks[block.sample(0)];
    for (uint32_t k = 1; k < Block::kSamples; ++k) {
        const LightMarks& other = light.marks[block.sample(k)];
        if (other.later != all.later) return false;
        all.join(other);
    }
    return all.agree();
}

// Whether light in the middle is what the corners make of it.
bool BlockLight::is_between(const Block& block, const TileLight& light) const {
    const uint32_t middle = block.sample(Block::kMiddle);
    const auto off = [&](const float* lanes, float& larger) {
        const float between = between_corners(lanes, block);
        larger = std::max(between, lanes[middle]);
        return std::fabs(between - lanes[middle]);
    };
    const bool lobes = shader_.program() == Program::highlight;
    for (int k = 0; k < 3; ++k) {
        float most, most_highlight;
        const float error = off(light.irradiance[k], most);
        if (!(error <= tolerance_ * (most + ambient_[k]) + least_)) return false;
        if (!lobes) continue;
        const float lobe_error = off(light.highlight[k], most_highlight);
        const float allowed = most_highlight + kHighlightShare * (most + ambient_[k]);
        if (!(lobe_error <= tolerance_ * allowed + least_)) return false;
    }
    return true;
}

void BlockLight::interpolate(const Block& block, TileLight& out) const {
    const auto fill = shader_.kernels().interpolate_block;
    for (auto& lanes : out.irradiance) fill(lanes + block.first, block.side);
    if (shader_.program() != Program::highlight) return;
    for (auto& lanes : out.highlight) fill(lanes + block.first, block.side);
}

// Two pixels of each group say what the others see.
void BlockLight::try_groups(const TileHits& hits, TileLight& out, Scratch& scratch) const {
    for (uint32_t b = 0; b < out.blocks.uneven.count; ++b) {
        const Block& block = out.blocks.uneven.blocks[b];
        if (block.known != Block::kNothing) continue;
        const PixelGroups groups(hits.t + block.first, pixel_);
        for (uint32_t g = 0; g < groups.count; ++g) {
            out.want(block.first + groups.first[g], Block::kNothing);
            out.want(block.first + groups.last[g], Block::kNothing);
        }
    }
    find_wanted(hits, SurfacePart::smooth, out, scratch);
    for (uint32_t b = 0; b < out.blocks.uneven.count; ++b) {
        const Block& block = out.blocks.uneven.blocks[b];
        if (block.known == Block::kNothing)
            want_groups(block, PixelGroups(hits.t + block.first, pixel_), out);
        else
            want_all(block, out);
    }
}

void BlockLight::want_groups(const Block& block, const PixelGroups& groups, TileLight& out) const {
    uint16_t known[PixelGroups::kMost];
    for (uint32_t g = 0; g < groups.count; ++g) {
        LightMarks all = out.marks[block.first + groups.first[g]];
        const LightMarks& other = out.marks[block.first + groups.last[g]];
        all.join(other);
        known[g] = all.agree() && all.later == other.later ? out.know(all) : Block::kNothing;
    }
    for (uint32_t i = 0; i < block.size(); ++i) {
        const uint8_t group = groups.of[i];
        out.want_whole(block.first + i,
                       group == PixelGroups::kNone ? Block::kNothing : known[group]);
    }
}

void BlockLight::want_all(const Block& block, TileLight& out) const {
    for (uint32_t i = block.first; i <= block.last(); ++i) out.want_whole(i, block.known);
}

// Finds light where it is wanted, in the order of the rays.
void BlockLight::find_wanted(const TileHits& hits, SurfacePart part, TileLight& out,
                             Scratch& scratch) const {
    const uint8_t want = part == SurfacePart::smooth ? TileLight::kAsSample : TileLight::kAsPixel;
    out.picked.for_each_batch(out.wanted, hits.count, want,
                              [&](uint32_t count) { find_batch(hits, part, count, out, scratch); });
}

// What is known beforehand of a batch of points.
void BlockLight::tell_known(uint32_t count, TileLight& out) const {
    BatchMarks& marks = out.batch;
    marks.any_known = false;
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t ray = out.picked.ray[i];
        if (out.found[ray])
            marks.know(i, out.marks[ray]);
        else if (out.known_of[ray] != Block::kNothing)
            marks.know(i, out.known[out.known_of[ray]]);
        else
            marks.know_nothing(i);
    }
}

void BlockLight::find_batch(const TileHits& hits, SurfacePart part, uint32_t count, TileLight& out,
                            Scratch& scratch) const {
    const RayHits points = out.picked.pick(hits, count);
    tell_known(count, out);
    BatchMarks& marks = out.batch;
    marks.finds = part == SurfacePart::smooth;
    std::fill_n(marks.traced, count, uint8_t(0));
    if (marks.finds) std::fill_n(marks.found, count, LightMarks());
    shader_.find_surfaces(points, part, scratch);
    shader_.gather_light(points, scratch, &marks);
    const int channels = shader_.program() == Program::highlight ? 6 : 3;
    for (int k = 0; k < channels; ++k) {
        const float* const light =
            k < 3 ? scratch.light.irradiance[k] : scratch.light.highlight[k - 3];
        float* const lanes = k < 3 ? out.irradiance[k] : out.highlight[k - 3];
        for (uint32_t i = 0; i < count; ++i) lanes[out.picked.ray[i]] = light[i];
    }
    for (uint32_t i = 0; i < count; ++i) {
        out.found[out.picked.ray[i]] = true;
        out.traced[out.picked.ray[i]] = marks.traced[i];
    }
    if (marks.finds) note_samples(count, out, scratch.surface);
    out.point_count += count;
}

// What judging a block takes.
void BlockLight::note_samples(uint32_t count, TileLight& out, const Surface& surface) const {
    const bool lobes = shader_.program() == Program::highlight;
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t ray = out.picked.ray[i];
        out.marks[ray] = out.batch.found[i];
        for (int k = 0; k < 3; ++k) out.normal[k][ray] = surface.geometric[k][i];
        if (lobes) out.shininess[ray] = surface.shininess[i];
    }
    for (uint32_t r = 0; r < surface.run_count; ++r) {
        const TriangleRun& run = surface.runs[r];
        for (uint32_t i = run.begin; i < run.end; ++i) out.relief[out.picked.ray[i]] = run.relief;
    }
}

} // namespace peregrine::shade
