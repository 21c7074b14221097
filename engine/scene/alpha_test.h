#pragma once

#include "scene/snapshot.h"

namespace peregrine::scene {

// Whether masked surfaces of the snapshot, which must outlive the result, are present at a hit.
// Empty if it has none.
trace::AlphaTest alpha_test(const Snapshot& snapshot);

// ... of one instance, whose triangles do not say whose they are.
trace::AlphaTest alpha_test(const InstanceAlpha& instance);

// Whether a surface is in the way of light: for shadow rays, which know no half shadows. What lets
// more than half of the light through is not.
trace::AlphaTest light_test(const Snapshot& snapshot);
trace::AlphaTest light_test(const InstanceAlpha& instance);

// Whether no light at all gets through: for shadow rays that are tinted by what they pass.
trace::AlphaTest opacity_test(const Snapshot& snapshot);
trace::AlphaTest opacity_test(const InstanceAlpha& instance);

} // namespace peregrine::scene
