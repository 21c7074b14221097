#pragma once

#include "shapes.h"
#include "stage.h"

#include <glm/glm.hpp>

namespace peregrine::test {

// What paths go on from, under an open sky. Made as FeatureScene is.
//
//      |  w     w  |   w  a window of thin panes
//     m|   b       |   m  a mirror as high as the wall, tinted
//      |     g   r |   g  a ball of glass on a polished floor, and a core of glass in it
//      |___d__v____|   d  a die of green glass   r  rigid: a golden box that mirrors
//           camera      v  a veil with holes
class GlassScene {
public:
    // `origin` is the world's: everything is as far away.
    GlassScene(host::Stage& stage, const glm::dvec3& origin);

    // The golden box turns.
    void move();
    // A lamp behind the window, and a sphere above what stands on the floor.
    void shine_through();
    // A sky that is an image.
    void change_sky();

    rt_camera camera() const;
    rt_camera camera_in_the_die() const;
    rt_camera camera_at_the_sky() const;

private:
    rt_material add(const rt_material_desc& desc);
    rt_mesh add(const Shape& shape, const rt_material_desc& material);
    rt_texture add_tiles();
    void add_room();
    void add_glass();
    void add_box();
    void add_veil();
    void add_lights();
    void place(const glm::dmat3& axes, const glm::dvec3& position);
    rt_camera look(const glm::dvec3& position, const glm::vec3& forward) const;

    host::Stage& stage_;
    const rt_api& api_;
    glm::dvec3 origin_;
    rt_mesh box_{};
};

} // namespace peregrine::test
