#include "gameplay/ground.h"

#include <glm/geometric.hpp>

namespace peregrine::gameplay {
namespace {

constexpr Vec3 kUp(0, 1, 0);
constexpr double kInset = 0.02; // metres: how far behind an edge the face is looked at
constexpr double kNearSkins = 8;

// How the body would slide: `direction` without what goes into the plane.
Vec3 clip(const Vec3& direction, const Vec3& normal) {
    return direction - normal * glm::dot(direction, normal);
}

// The plane that carries the body at a contact. The round end of the capsule touches an edge with a
// normal that says nothing of the faces there: then the face behind the edge decides.
//
//       (      )          n: contact normal
//        (    )
//         `--´\ n         ________
//     ________| .         face: flat, so that it carries
//             |
std::optional<Vec3> carrying_normal(const Body& body, const Touch& touch, double least_edge) {
    if (body.is_walkable(touch.normal)) return touch.normal;
    const Vec3 aside(touch.normal.x, 0, touch.normal.z);
    const double length = glm::length(aside);
    if (touch.normal.y <= least_edge || length == 0) return std::nullopt;
    const double rise = 2 * kInset; // a face within the limit rises less on the inset
    const Vec3 from = touch.point - aside * (kInset / length) + kUp * rise;
    const auto face = body.world().closest(from, -2 * rise * kUp, body.mask());
    if (!face || !body.is_walkable(face->normal)) return std::nullopt;
    return face->normal;
}

std::optional<Ground> on(const Body& body, const Vec3& position, const Touch& touch,
                         double least_edge) {
    const auto normal = carrying_normal(body, touch, least_edge);
    if (!normal) return std::nullopt;
    return Ground{position, *normal, touch.point, touch.mesh};
}

// A body on a slope that is too steep: what stops it from sliding down within a few skins.
std::optional<Ground> find_valley(const Body& body, const Vec3& position, const Touch& first,
                                  double least_edge) {
    const double reach = kNearSkins * body.rules().skin;
    const Vec3 downhill = clip(-kUp, first.normal);
    const double steepness = glm::length(downhill);
    if (first.normal.y <= 0 || steepness == 0) return std::nullopt;
    Vec3 slid = position;
    const auto second = body.advance(slid, downhill * (reach / steepness));
    if (!second) return std::nullopt;
    if (auto ground = on(body, slid, *second, least_edge)) return ground;

    const Vec3 other = clip(-kUp, second->normal);
    if (second->normal.y <= 0 || glm::dot(other, first.normal) >= 0) return std::nullopt;
    Vec3 crease = glm::cross(first.normal, second->normal);
    const double sine = glm::length(crease);
    if (sine < 1e-6) return std::nullopt;
    crease *= (crease.y > 0 ? -1 : 1) / sine; // downwards
    const Vec3 across = glm::normalize(clip(kUp, crease));
    if (body.is_walkable(across)) return Ground{slid, across, second->point, second->mesh};
    const auto third = body.advance(slid, crease * reach);
    if (!third) return std::nullopt;
    return Ground{slid, kUp, third->point, third->mesh};
}

} // namespace

std::optional<Ground> find_ground(const Body& body, const Vec3& position, double drop,
                                  double least_edge) {
    Vec3 lowered = position;
    const auto touch = body.advance(lowered, -drop * kUp);
    if (!touch) return std::nullopt;
    if (auto ground = on(body, lowered, *touch, least_edge)) return ground;
    return find_valley(body, lowered, *touch, least_edge);
}

} // namespace peregrine::gameplay
