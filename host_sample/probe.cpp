#include "probe.h"

namespace host {

std::optional<Contact> Probe::cast(const glm::dvec3& origin, const glm::dvec3& direction,
                                   double reach) const {
    rt_ray ray{};
    rt_query_options options = rt_default_query_options();
    for (int i = 0; i < 3; ++i) {
        options.origin[i] = origin[i];
        ray.direction[i] = static_cast<float>(direction[i]);
    }
    ray.t_max = static_cast<float>(reach);
    rt_hit hit{};
    rt_query_desc query = rt_default_query_desc();
    query.kind = RT_QUERY_CLOSEST;
    query.rays = &ray;
    query.ray_count = 1;
    query.hits = &hit;
    query.options = &options;
    query.flags = RT_QUERY_ALPHA_TEST;
    stage_.check(stage_.api().trace_query(stage_.scene(), &query), "probing the scene");
    if (hit.triangle == RT_NO_TRIANGLE) return std::nullopt;

    rt_surface surface{};
    stage_.check(stage_.api().resolve_hits(stage_.scene(), &hit, 1, 0, &surface, 0),
                 "resolving a hit");
    Contact contact;
    contact.distance = static_cast<double>(hit.t);
    for (int i = 0; i < 3; ++i) contact.normal[i] = surface.geometric_normal[i];
    if (glm::dot(contact.normal, direction) > 0.0) contact.normal = -contact.normal;
    return contact;
}

} // namespace host
