#pragma once

#include "tracer.h"

#include <memory>
#include <span>
#include <string>

namespace peregrine::bench {

// Embree over one triangle mesh, best quality: "embree" as it comes, "embree-avx2" kept from using
// AVX-512 (its single rays are faster so on some machines), "embree-robust" with its flag for fewer
// leaks. Throws where this build has no Embree.
std::unique_ptr<Tracer> make_embree_tracer(const std::string& variant,
                                           std::span<const geometry::Triangle> triangles,
                                           uint32_t threads);

} // namespace peregrine::bench
