#pragma once

#include <peregrine/rt.h>

#include "level.h"

namespace host {

// A place to look from, as the engine wants it.
inline rt_camera camera_of(const Viewpoint& view) {
    rt_camera camera = rt_default_camera();
    camera.vertical_fov = view.vertical_fov;
    for (int k = 0; k < 3; ++k) {
        camera.position[k] = view.position[k];
        camera.forward[k] = view.forward[k];
        camera.up[k] = view.up[k];
    }
    return camera;
}

} // namespace host
