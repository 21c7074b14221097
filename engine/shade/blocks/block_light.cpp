#include "shade/blocks/block_light.h"

#include <algorithm>
#include <cmath>

namespace peregrine::shade {
namespace {

constexpr float kPi = 3.14159265f;
constexpr float kLeastCosine = 0.951f;  // between the normals of a block: 18 degrees
constexpr float kHighlightShare = 0.2f; // of all light, below which highlights need not be right

} // namespace

void TileLight::begin(uint32_t ray_count) {
    std::fill_n(found, ray_count, false);
    std::fill_n(wanted, ray_count, uint8_t(0));
    for (List& list : pending) list.count = 0;
    uneven.count = 0;
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
    for (uint32_t level = 3; level-- > 0;) try_blocks(hits, level, out, scratch);
    if (out.uneven.count > 0) try_groups(hits, out, scratch);
    find_wanted(hits, SurfacePart::geometry, out, scratch);
}

void BlockLight::try_blocks(const TileHits& hits, uint32_t level, TileLight& out,
                            Scratch& scratch) const {
    TileLight::List& list = out.pending[level];
    uint32_t kept = 0;
    for (uint32_t i = 0; i < list.count; ++i) {
        const Block block = list.blocks[i];
        if (!shader_.kernels().block_is_smooth(hits.t + block.first, block.side, pixel_)) {
            cut(block, out);
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
    if (!is_even(block, out)) return cut(block, out);
    if (!join_marks(block, out, all))
        return block.side == Block::kLeast ? want_all(block, out) : cut(block, out);
    if (block.known == Block::kNothing) block.known = out.know(all);
    bool relief = false;
    for (uint32_t k = 0; k < Block::kSamples; ++k) relief |= out.relief[block.sample(k)];
    if (relief) return want_all(block, out);
    if (is_between(block, out)) return interpolate(block, out);
    block.side == Block::kLeast ? want_all(block, out) : cut(block, out);
}

bool BlockLight::is_even(const Block& block, const TileLight& light) const {
    const auto normal = [&](uint32_t k) {
        const uint32_t i = block.sample(k);
        return math::Vec3(light.normal[0][i], light.normal[1][i], light.normal[2][i]);
    };
    const math::Vec3 middle = normal(Block::kMiddle);
    const bool lobes = shader_.program() == Program::highlight;
    for (uint32_t k = 0; k < Block::kMiddle; ++k) {
        const uint32_t i = block.sample(k);
        if (!(glm::dot(normal(k), middle) >= kLeastCosine) && middle != math::Vec3(0)) return false;
        if (lobes && light.shininess[i] != light.shininess[block.sample(Block::kMiddle)])
            return false;
    }
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
    const float x = (0.5f * float(block.side) - 1.0f) / float(block.side - 1);
    uint32_t at[Block::kSamples];
    for (uint32_t k = 0; k < Block::kSamples; ++k) at[k] = block.sample(k);
    const auto off = [&](const float* lanes, float& larger) {
        const float upper = lanes[at[0]] + (lanes[at[1]] - lanes[at[0]]) * x;
        const float lower = lanes[at[2]] + (lanes[at[3]] - lanes[at[2]]) * x;
        const float between = upper + (lower - upper) * x;
        larger = std::max(between, lanes[at[Block::kMiddle]]);
        return std::fabs(between - lanes[at[Block::kMiddle]]);
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

void BlockLight::cut(const Block& block, TileLight& out) const {
    if (block.side == Block::kLeast) return out.uneven.add(block);
    TileLight::List& quarters = out.pending[TileLight::level_of(block.side / 2u)];
    for (uint32_t k = 0; k < 4; ++k) quarters.add(block.quarter(k));
}

// Two pixels of each group say what the others see.
void BlockLight::try_groups(const TileHits& hits, TileLight& out, Scratch& scratch) const {
    for (uint32_t b = 0; b < out.uneven.count; ++b) {
        const Block& block = out.uneven.blocks[b];
        if (block.known != Block::kNothing) continue;
        const PixelGroups groups(hits.t + block.first, pixel_);
        for (uint32_t g = 0; g < groups.count; ++g) {
            out.want(block.first + groups.first[g], Block::kNothing);
            out.want(block.first + groups.last[g], Block::kNothing);
        }
    }
    find_wanted(hits, SurfacePart::smooth, out, scratch);
    for (uint32_t b = 0; b < out.uneven.count; ++b) {
        const Block& block = out.uneven.blocks[b];
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
    uint32_t count = 0;
    for (uint32_t i = 0; i < hits.count; ++i) {
        if (!(out.wanted[i] & want)) continue;
        out.wanted[i] &= uint8_t(~want);
        out.ray[count++] = i;
        if (count < kBatch) continue;
        find_batch(hits, part, count, out, scratch);
        count = 0;
    }
    if (count > 0) find_batch(hits, part, count, out, scratch);
}

// The rays as a batch of points.
RayHits BlockLight::list_batch(const TileHits& hits, uint32_t count, TileLight& out) const {
    BatchMarks& marks = out.batch;
    marks.any_known = false;
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t ray = out.ray[i];
        for (int k = 0; k < 3; ++k) out.direction[k][i] = hits.direction[k][ray];
        out.u[i] = hits.u[ray];
        out.v[i] = hits.v[ray];
        out.t[i] = hits.t[ray];
        out.triangle[i] = hits.triangle[ray];
        out.back_face[i] = hits.back_face[ray];
        if (out.found[ray])
            marks.know(i, out.marks[ray]);
        else if (out.known_of[ray] != Block::kNothing)
            marks.know(i, out.known[out.known_of[ray]]);
        else
            marks.know_nothing(i);
    }
    return {{out.direction[0], out.direction[1], out.direction[2]},
            out.u,
            out.v,
            out.triangle,
            out.back_face,
            out.t,
            count,
            hits.footprint};
}

void BlockLight::find_batch(const TileHits& hits, SurfacePart part, uint32_t count, TileLight& out,
                            Scratch& scratch) const {
    const RayHits points = list_batch(hits, count, out);
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
        for (uint32_t i = 0; i < count; ++i) lanes[out.ray[i]] = light[i];
    }
    for (uint32_t i = 0; i < count; ++i) {
        out.found[out.ray[i]] = true;
        out.traced[out.ray[i]] = marks.traced[i];
    }
    if (marks.finds) note_samples(count, out, scratch.surface);
    out.point_count += count;
}

// What judging a block takes.
void BlockLight::note_samples(uint32_t count, TileLight& out, const Surface& surface) const {
    const bool lobes = shader_.program() == Program::highlight;
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t ray = out.ray[i];
        out.marks[ray] = out.batch.found[i];
        for (int k = 0; k < 3; ++k) out.normal[k][ray] = surface.geometric[k][i];
        if (lobes) out.shininess[ray] = surface.shininess[i];
    }
    for (uint32_t r = 0; r < surface.run_count; ++r) {
        const TriangleRun& run = surface.runs[r];
        for (uint32_t i = run.begin; i < run.end; ++i) out.relief[out.ray[i]] = run.relief;
    }
}

} // namespace peregrine::shade
