#include "shade/occlusion/block_openness.h"

#include <algorithm>
#include <cmath>

namespace peregrine::shade {

// The distance of unit normals is a chord: 2 - 2 cosine = chord^2.
BlockOpenness::BlockOpenness(const Shader& shader, const OpennessTolerance& tolerance, float pixel)
    : shader_(shader), tolerance_(tolerance),
      least_cosine_(1 - 0.5f * tolerance.normal * tolerance.normal), pixel_(pixel) {}

void BlockOpenness::find(const TileHits& hits, TileOpenness& out, Scratch& scratch) const {
    if (shader_.recalls_openness()) recall(hits, out, scratch);
    for (uint32_t level = BlockLists::kLevels; level-- > 0;) try_blocks(hits, level, out, scratch);
    if (out.blocks.uneven.count > 0) try_quads(hits, out, scratch);
    find_wanted(hits, out, scratch);
}

// Of the whole tile, before anything is asked.
void BlockOpenness::recall(const TileHits& hits, TileOpenness& out, Scratch& scratch) const {
    for (uint32_t first = 0; first < hits.count; first += kBatch) {
        const RayHits batch = hits.batch(first, std::min(hits.count - first, kBatch));
        float* const openness = out.openness + first;
        shader_.recall_openness(batch, scratch, openness);
        for (uint32_t i = 0; i < batch.count; ++i) {
            const bool known = openness[i] >= 0;
            out.recalled[first + i] = out.found[first + i] = known;
            if (known) out.wanted[first + i] = 0;
        }
    }
}

// Whether nothing of the block was recalled. If something was, its rest is asked pixel by pixel.
bool BlockOpenness::keeps(const Block& block, TileOpenness& out) {
    const bool* const begin = out.recalled + block.first;
    const auto count = uint32_t(std::count(begin, begin + block.size(), true));
    if (count == 0) return true;
    if (count < block.size()) out.blocks.cut(block);
    return false;
}

void BlockOpenness::try_blocks(const TileHits& hits, uint32_t level, TileOpenness& out,
                               Scratch& scratch) const {
    const Kernels& kernels = shader_.kernels();
    BlockLists::List& list = out.blocks.pending[level];
    uint32_t kept = 0;
    for (uint32_t i = 0; i < list.count; ++i) {
        const Block block = list.blocks[i];
        if (shader_.recalls_openness() && !keeps(block, out)) continue;
        if (!kernels.block_is_smooth(hits.t + block.first, block.side, pixel_, tolerance_.plane)) {
            out.blocks.cut(block);
            continue;
        }
        for (uint32_t k = 0; k < Block::kSamples; ++k) out.want(block.sample(k));
        list.blocks[kept++] = block;
    }
    if (kept == 0) return;
    find_wanted(hits, out, scratch);
    for (uint32_t i = 0; i < kept; ++i) {
        const Block& block = list.blocks[i];
        if (is_even(block, out))
            kernels.interpolate_block(out.openness + block.first, block.side);
        else
            out.blocks.cut(block);
    }
}

// Two pixels by two of one triangle: two of them say what the others get, if they agree.
void BlockOpenness::try_quads(const TileHits& hits, TileOpenness& out, Scratch& scratch) const {
    const BlockLists::List& list = out.blocks.uneven;
    const auto for_each_quad = [&](auto&& function) {
        for (uint32_t b = 0; b < list.count; ++b)
            for (uint32_t i = list.blocks[b].first; i <= list.blocks[b].last(); i += 4) function(i);
    };
    const auto is_one_triangle = [&](uint32_t i) {
        for (uint32_t k = 1; k < 4; ++k)
            if (hits.triangle[i + k] != hits.triangle[i]
                || hits.back_face[i + k] != hits.back_face[i])
                return false;
        return true;
    };
    for_each_quad([&](uint32_t i) {
        const uint32_t step = is_one_triangle(i) ? 3 : 1;
        for (uint32_t k = 0; k < 4; k += step) out.want(i + k);
    });
    find_wanted(hits, out, scratch);
    for_each_quad([&](uint32_t i) {
        const float a = out.openness[i], b = out.openness[i + 3];
        const bool agree = std::fabs(a - b) <= tolerance_.openness;
        for (uint32_t k = 1; k < 3; ++k) {
            if (out.found[i + k]) continue;
            if (agree)
                out.openness[i + k] = 0.5f * (a + b);
            else
                out.want(i + k);
        }
    });
}

bool BlockOpenness::is_even(const Block& block, const TileOpenness& found) const {
    float least = 1, most = 0;
    for (uint32_t k = 0; k < Block::kSamples; ++k) {
        least = std::min(least, found.openness[block.sample(k)]);
        most = std::max(most, found.openness[block.sample(k)]);
    }
    const auto& [x, y, z] = found.normal;
    const float* const normal[3] = {x, y, z};
    return most - least <= tolerance_.openness && normals_agree(normal, block, least_cosine_);
}

void BlockOpenness::find_wanted(const TileHits& hits, TileOpenness& out, Scratch& scratch) const {
    out.picked.for_each_batch(out.wanted, hits.count, TileOpenness::kWanted, [&](uint32_t count) {
        const RayHits points = out.picked.pick(hits, count);
        std::fill_n(out.batch, count, -1.0f);
        shader_.find_openness(points, scratch, out.batch);
        for (uint32_t i = 0; i < count; ++i) {
            const uint32_t ray = out.picked.ray[i];
            out.openness[ray] = out.batch[i];
            for (int k = 0; k < 3; ++k) out.normal[k][ray] = scratch.surface.normal[k][i];
            out.found[ray] = true;
        }
        out.point_count += count;
    });
}

} // namespace peregrine::shade
