#pragma once

#include "geometry/triangle.h"
#include "level.h"
#include "math/box.h"

#include <string>
#include <vector>

namespace peregrine::bench {

// A level as all contestants get it: one list of triangles, which are known by their place in it.
struct TraceScene {
    std::string name;
    std::vector<geometry::Triangle> triangles;
    math::Box bounds;
    std::vector<host::Viewpoint> cameras; // two at most
    std::vector<math::Vec3> lights;       // point and spot lights

    float diagonal() const { return glm::length(bounds.upper - bounds.lower); }
};

TraceScene load_trace_scene(const std::string& file);

} // namespace peregrine::bench
