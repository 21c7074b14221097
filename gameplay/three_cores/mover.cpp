#include "gameplay/three_cores/mover.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace peregrine::three_cores {

void Mover::move(const rt_api& api, rt_scene scene, const rt_transform& to,
                 std::vector<gameplay::MeshMotion>& motions) {
    if (std::memcmp(&to, &now_, sizeof to) == 0) return;
    for (const rt_mesh& mesh : part_.meshes) {
        if (api.set_mesh_transform(scene, mesh, &to) != RT_OK)
            throw std::runtime_error(api.get_last_error());
        motions.push_back({mesh, now_, to});
    }
    now_ = to;
}

bool Mover::has(const rt_mesh& mesh) const {
    return std::ranges::any_of(part_.meshes, [&](const rt_mesh& own) {
        return own.index == mesh.index && own.generation == mesh.generation;
    });
}

rt_transform shifted(const rt_transform& rest, const Vec3& by) {
    rt_transform to = rest;
    for (int k = 0; k < 3; ++k) to.m[4 * k + 3] += by[k];
    return to;
}

rt_transform turned(const rt_transform& rest, double sine, double cosine) {
    rt_transform to = rest;
    for (int row = 0; row < 3; ++row) {
        const double x = rest.m[4 * row], z = rest.m[4 * row + 2];
        to.m[4 * row] = cosine * x - sine * z;
        to.m[4 * row + 2] = sine * x + cosine * z;
    }
    return to;
}

Vec3 placed(const rt_transform& transform, const Vec3& point) {
    Vec3 result;
    for (int k = 0; k < 3; ++k) {
        const double* row = transform.m + 4 * k;
        result[k] = row[0] * point.x + row[1] * point.y + row[2] * point.z + row[3];
    }
    return result;
}

} // namespace peregrine::three_cores
