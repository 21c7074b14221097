#pragma once

#include "scene/snapshot.h"

namespace peregrine::scene {

// Whether masked surfaces of the snapshot, which must outlive the result, are present at a hit.
// Empty if it has none.
trace::AlphaTest alpha_test(const Snapshot& snapshot);

// ... of one instance, whose triangles do not say whose they are.
trace::AlphaTest alpha_test(const InstanceAlpha& instance);

} // namespace peregrine::scene
