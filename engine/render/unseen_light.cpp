#include "render/unseen_light.h"

#include "render/post/display_curve.h"
#include "shade/material/highlight.h"

#include <algorithm>

namespace peregrine::render {
namespace {

float largest(const math::Vec3& color) {
    return std::max({color.x, color.y, color.z});
}

// The most that any material of the scene reflects.
struct Reflection {
    float diffuse = 1;   // of the light, over pi
    float highlight = 0; // of the light, where it is strongest

    explicit Reflection(const scene::MaterialSet& set) {
        for (const scene::Material& material : set.materials) {
            diffuse = std::max(diffuse, largest(math::Vec3(material.base_color)));
            if (const float specular = largest(material.specular); specular > 0)
                highlight =
                    std::max(highlight, specular * shade::highlight_gain(material.shininess));
        }
    }
};

} // namespace

// What is diffuse comes on top of the ambient light where that arrives; a highlight may be that of
// a black surface.
float unseen_light(const scene::Snapshot& snapshot, const Frame& frame) {
    const float steps = frame.approximations.least_light;
    if (steps <= 0 || snapshot.lights->lights.empty()) return 0;
    const Reflection most(*snapshot.material_set);
    const auto& curve = frame.tone_mapping == ToneMapping::filmic ? post::DisplayCurve::filmic()
                                                                  : post::DisplayCurve::clamp();
    const float exposure = frame.tone_mapping == ToneMapping::none ? 1.0f : frame.exposure;
    const math::Vec3& ambient = snapshot.environment.ambient;
    const float arriving = frame.occlusion.range > 0 ? 0.0f : exposure * most.diffuse;
    const float dimmest = std::min({ambient.x, ambient.y, ambient.z}) * arriving;
    const double steps_a_lux =
        double(exposure)
        * (double(most.diffuse) / 3.14159265358979324 * curve.most_steps(dimmest)
           + double(most.highlight) * curve.most_steps(0));
    return float(double(steps) / steps_a_lux);
}

} // namespace peregrine::render
