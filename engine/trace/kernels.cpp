#include "trace/kernels.h"

#include "trace/bih/kernels.h"
#include "trace/bvh/kernels.h"
#include "trace/kdtree/kernels.h"

#include <iterator>

namespace peregrine::trace {
namespace {

struct Tables {
    explicit Tables(Kernels (*make)(base::Isa))
        : by_isa{make(base::best_isa()),  make(base::Isa::sse4),   make(base::Isa::avx2),
                 make(base::Isa::avx512), make(base::Isa::scalar), make(base::Isa::neon)} {}
    Kernels by_isa[6];
};

} // namespace

const Kernels* select_kernels(Structure structure, base::Isa isa, bool compact) {
    static const Tables bvh(bvh::make_kernels);
    static const Tables compact_bvh(bvh::make_compact_kernels);
    static const Tables kdtree(kdtree::make_kernels);
    static const Tables bih(bih::make_kernels);
    const Tables& tables = structure == Structure::bvh      ? (compact ? compact_bvh : bvh)
                           : structure == Structure::kdtree ? kdtree
                                                            : bih;
    const auto index = uint32_t(isa);
    return index < std::size(tables.by_isa) && base::is_available(isa) ? &tables.by_isa[index]
                                                                       : nullptr;
}

} // namespace peregrine::trace
