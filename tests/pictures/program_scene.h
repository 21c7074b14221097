#pragma once

#include "glass_scene.h"

namespace peregrine::test {

// What programs of the host shade, among mirrors and glass: a pool with ripples, a sign whose bands
// run, a hologram. They compute with sums, products, quotients and roots alone.
//
//      |  s        |   s  the sign, which the mirror on the left shows, too
//     m|        h  |   h  the hologram: blended, and it bends what is behind it
//      |___pppp____|   p  the pool: mirrors by its ripples
//           camera
class ProgramScene {
public:
    ProgramScene(host::Stage& stage, const glm::dvec3& origin);

    rt_camera camera() const { return glass_.camera(); }

private:
    rt_program add_program(uint32_t fields, rt_program_function shade);
    void add(const Shape& shape, const rt_material_desc& material, uint64_t user_data);

    host::Stage& stage_;
    GlassScene glass_;
    float phase_ = 0.3f; // of all that moves: the user data of the programs
};

} // namespace peregrine::test
