#pragma once

#include "tracer.h"

#include <memory>
#include <span>
#include <string>

namespace peregrine::bench {

struct TracerChoice {
    std::string structure = "auto"; // auto, kdtree, bvh, bih
    std::string build = "balanced"; // balanced, fast, best
    std::string isa = "best";       // best, scalar, sse4, avx2, avx512
    uint32_t threads = 1;
    bool compact = false;
    std::string name = "peregrine";
};

// The engine through its header. Throws the engine's sentence where it cannot do what is chosen.
std::unique_ptr<Tracer> make_peregrine_tracer(const rt_api& api,
                                              std::span<const geometry::Triangle> triangles,
                                              const TracerChoice& choice);

} // namespace peregrine::bench
