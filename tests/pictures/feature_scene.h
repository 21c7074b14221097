#pragma once

#include "stage.h"

#include <glm/glm.hpp>
#include <vector>

namespace peregrine::test {

// A small room with one of everything that a frame can show. Made by additions, products and roots
// alone, which give the same bits on every machine.
//
//      | a a a a |   a  panels: wraps, filters, formats       f  a flag that deforms
//      | f   e   |   m  a masked fence                        r  rigid: a box and its mirrored twin
//      | m o  r r|   o  a ball of two materials               e  what glows
//      |_________|   s  single-sided: one is seen, one shows its back
//        s s    camera at the open side
class FeatureScene {
public:
    // `origin` is the world's: everything is as far away.
    FeatureScene(host::Stage& stage, const glm::dvec3& origin);

    // What changes from one commit to the next: shapes, places, a lamp, a material; one mesh hides.
    void move();

    void soften(); // the shadows of its lights
    rt_camera camera() const;
    rt_camera camera_from_the_side() const;

private:
    struct Texel {
        int x, y;
    };
    template <class ColorOf>
    rt_texture add_texture(rt_texture_desc desc, const ColorOf& color_of);
    rt_material add_material(const rt_material_desc& desc);

    void add_textures();
    void add_floor();
    void add_panels();
    void add_fence();
    void add_ball();
    void add_boxes();
    void add_flag();
    void add_glow();
    void add_single_sided();
    void add_lights();

    void add_light(rt_light_desc desc, const glm::dvec3& position, bool shadows,
                   rt_light* out = nullptr);
    void place(rt_mesh mesh, const glm::dmat3& axes, const glm::dvec3& position);
    rt_camera look(const glm::dvec3& position, const glm::vec3& forward) const;

    host::Stage& stage_;
    const rt_api& api_;
    glm::dvec3 origin_;
    rt_texture tiles_{}, bumps_{}, mask_{}, glow_{};
    rt_mesh box_{}, twin_{}, flag_{}, seen_{};
    rt_light lamp_{};
    rt_light_desc lamp_desc_{};
    std::vector<std::pair<rt_light, rt_light_desc>> lights_;
    rt_material floor_{};
    rt_material_desc floor_desc_{};
};

} // namespace peregrine::test
