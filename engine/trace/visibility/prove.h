#pragma once

#include "trace/visibility/point_visibility.h"
#include "trace/visibility/shaft.h"
#include "trace/visibility/triangle_tree.h"

#include <memory>

namespace peregrine::trace::visibility {

struct ProofOptions {
    float patch_size = 0.25f; // mixed patches are quartered until no side is longer, in metres
    uint32_t most_words = 1u << 22; // of codes; triangles beyond stay as they are as a whole
};

struct ProofReport {
    uint64_t proofs = 0;                  // tried
    uint64_t triangles[4] = {0, 0, 0, 0}; // within reach, by State
};

class Prover;

// Proves what it can of the segments between a lamp and all triangles of a tree, step by step. What
// it proves may depend on the options; it is true in any case.
class LampProof {
public:
    // `tree` must outlive it. Throws std::bad_alloc, as do steps.
    LampProof(const TriangleTree& tree, const Setting& setting, const ProofOptions& options,
              base::Memory* memory);

    // Looks at a few triangles, or at a place where there may be some; false: all is proved.
    bool step();
    const ProofReport& report() const;
    // What is remembered; once all is proved.
    std::shared_ptr<const PointVisibility> result() const;

private:
    std::shared_ptr<Prover> prover_;
};

// All of it at once.
std::shared_ptr<const PointVisibility> prove(const TriangleTree& tree, const Setting& setting,
                                             const ProofOptions& options, base::Memory* memory,
                                             ProofReport& report);

} // namespace peregrine::trace::visibility
