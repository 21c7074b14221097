#include "shade/light/passage.h"

#include "math/exponential.h"
#include "scene/texture_sampling.h"
#include "shade/path/media.h"
#include "trace/world/search.h"

#include <algorithm>
#include <cmath>

namespace peregrine::shade {
namespace {

using math::Vec3;
using scene::Material;
using trace::WorldHit;

constexpr uint32_t kMostCrossings = 64; // beyond them it is dark

// Between the ray and the normal of the triangle, 0 to 1.
float cosine_at(const scene::Snapshot& snapshot, const WorldHit& hit, const Vec3& direction) {
    const scene::Snapshot::Mesh& mesh = snapshot.meshes[hit.mesh];
    const auto& corners = mesh.data->triangles()[hit.primitive];
    const auto side = [&](int corner) {
        const math::Vec3d d = math::Vec3d(mesh.data->positions[corners[size_t(corner)]])
                              - math::Vec3d(mesh.data->positions[corners[0]]);
        const scene::Placement* const placement = snapshot.placement_of(mesh);
        return placement ? placement->to_world.vector(d) : d;
    };
    const math::Vec3d normal = glm::cross(side(1), side(2)), d(direction);
    const double squares = glm::dot(normal, normal) * glm::dot(d, d);
    if (!(squares > 0)) return 1;
    return float(std::min(std::fabs(glm::dot(normal, d)) / std::sqrt(squares), 1.0));
}

// Fresnel's equations for unpolarised light that comes from the thinner side of two.
float reflectance(float cosine, float index, float other) {
    const float eta = std::min(index, other) / std::max(index, other);
    const float beyond = std::sqrt(1 - eta * eta * (1 - cosine * cosine));
    const float near = eta * cosine, far = eta * beyond;
    const float s = (near - beyond) / std::max(near + beyond, 1e-20f);
    const float p = (cosine - far) / std::max(cosine + far, 1e-20f);
    return 0.5f * (s * s + p * p);
}

// A ray on its way.
class Passage {
public:
    Passage(const scene::Snapshot& snapshot, const math::Ray& ray)
        : snapshot_(snapshot), ray_(ray),
          length_(std::sqrt(glm::dot(ray.direction, ray.direction))) {}

    // Solids that the ray leaves without having entered them hold its beginning.
    void begin(const WorldHit* hits, uint32_t count) {
        Media entered;
        for (uint32_t i = 0; i < count; ++i) {
            const uint32_t number = number_of(hits[i]);
            if (!material(number).is_solid()) continue;
            if (!hits[i].back_face)
                entered.enter(number);
            else if (entered.holds(number))
                entered.leave(number);
            else
                inside_.enter(number);
        }
        std::reverse(inside_.material, inside_.material + depth_of(inside_));
        at_ = ray_.t_min;
    }

    void cross(const WorldHit& hit) {
        const uint32_t number = number_of(hit);
        const Material& m = material(number);
        absorb(hit.t);
        if (!m.may_pass_light()) return; // an edge of it, which shadow rays passed
        Vec3 through = m.program == 0 ? through_surface(m, number, hit) : Vec3(0);
        if (m.is_translucent()) {
            const float cover = std::min(color_at(m, hit).a, 1.0f);
            through = through * cover + Vec3(1 - cover);
        }
        left_ *= through;
        if (!m.is_solid()) return;
        if (hit.back_face)
            inside_.leave(number);
        else
            inside_.enter(number);
    }

    Vec3 end() {
        absorb(ray_.t_max);
        return left_;
    }

private:
    static uint32_t depth_of(const Media& media) {
        uint32_t depth = 0;
        while (depth < Media::kMost && media.material[depth] != Media::kNone) ++depth;
        return depth;
    }
    uint32_t number_of(const WorldHit& hit) const {
        return snapshot_.meshes[hit.mesh].materials->of(hit.primitive);
    }
    const Material& material(uint32_t number) const {
        return snapshot_.material_set->materials[number];
    }
    float index_of(uint32_t number) const {
        return number == Media::kNone ? 1.0f : material(number).index_of_refraction;
    }

    math::Vec4 color_at(const Material& m, const WorldHit& hit) const {
        const scene::TextureUse& use = m.base_color_texture;
        if (!use.texture) return m.base_color;
        const math::Vec2 at = texcoord_at(*snapshot_.meshes[hit.mesh].data, hit.primitive,
                                          use.texcoord_set, hit.u, hit.v);
        return m.base_color * sample(*use.texture, transform(use, at));
    }

    // Where it is: what it neither mirrors nor swallows.
    Vec3 through_surface(const Material& m, uint32_t number, const WorldHit& hit) const {
        const float cosine = cosine_at(snapshot_, hit, ray_.direction);
        Vec3 rest(1);
        if (m.reflectivity > 0) {
            const Vec3 head_on = m.reflection_color * m.reflectivity;
            const float s = 1 - cosine, ss = s * s;
            rest -= head_on + (Vec3(1) - head_on) * (ss * ss * s);
        }
        if (m.transmission == 0) return Vec3(0);
        float mirrored;
        if (m.thin) {
            const float once = reflectance(cosine, 1, m.index_of_refraction);
            mirrored = (once + once) / (1 + once);
        } else {
            Media beyond = inside_;
            if (hit.back_face)
                beyond.leave(number);
            else
                beyond.enter(number);
            mirrored =
                reflectance(cosine, index_of(inside_.innermost()), index_of(beyond.innermost()));
        }
        const Vec3 color = glm::min(Vec3(color_at(m, hit)), Vec3(1));
        return rest * color * ((1 - mirrored) * m.transmission);
    }

    // Up to t.
    void absorb(float t) {
        const float metres = std::min((t - at_) * length_, 1e30f);
        at_ = t;
        const uint32_t medium = inside_.innermost();
        if (medium == Media::kNone) return;
        const Vec3& per_metre = material(medium).absorption;
        for (int k = 0; k < 3; ++k)
            left_[k] *= math::exp_of_minus(std::max(per_metre[k] * metres, 0.0f));
    }

    const scene::Snapshot& snapshot_;
    const math::Ray& ray_;
    float length_;
    float at_ = 0;
    Media inside_;
    Vec3 left_{1};
};

} // namespace

Vec3 passage(const scene::Snapshot& snapshot, const trace::Filter& filter, const math::Ray& ray,
             const trace::Position& position) {
    WorldHit hits[kMostCrossings + 1];
    const trace::Judge nobody;
    trace::Search search(snapshot.world, filter, nobody);
    const uint32_t count = search.crossings(
        ray, position, kMostCrossings + 1, [&](uint32_t i, const WorldHit& hit) { hits[i] = hit; });
    if (count > kMostCrossings) return Vec3(0);
    Passage way(snapshot, ray);
    way.begin(hits, count);
    for (uint32_t i = 0; i < count; ++i) way.cross(hits[i]);
    return way.end();
}

} // namespace peregrine::shade
