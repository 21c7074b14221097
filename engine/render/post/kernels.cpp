// The loops of passes, compiled once for each instruction set.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/post/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/post/bloom-inl.h"
#include "render/post/edges-inl.h"
#include "render/post/encode-inl.h"
#include "render/post/enlarge-inl.h"
#include "render/post/kernels.h"
#include "render/post/shown-inl.h"
#include "render/post/sprites-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::render::post::HWY_NAMESPACE {

constexpr Kernels kKernels = {
    to_shown,      encode_bytes, find_edges,     enlarge_row, take_bright, halve_rows,
    halve_columns, double_rows,  double_columns, mix,         spread,      add_sprite,
};

} // namespace peregrine::render::post::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/select.h"

namespace peregrine::render::post {

const Kernels& kernels(base::Isa isa) {
    const auto* const table = PEREGRINE_TABLE_FOR(isa, kKernels);
    // Otherwise the last one compiled: the machine's baseline.
    return table ? *table : HWY_NAMESPACE::kKernels;
}

} // namespace peregrine::render::post
#endif
