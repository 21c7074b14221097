// Scenes of rigid meshes that stand anywhere.
#pragma once

#include "support.h"

namespace peregrine::test {

inline rt_transform at(const double (&place)[3]) {
    rt_transform transform = rt_default_transform();
    for (int k = 0; k < 3; ++k) transform.m[4 * k + 3] = place[k];
    return transform;
}

inline rt_query_options relative_to(const double (&origin)[3]) {
    rt_query_options options = rt_default_query_options();
    std::memcpy(options.origin, origin, sizeof origin);
    return options;
}

class Space {
public:
    Space() {
        const rt_scene_desc desc = rt_default_scene_desc();
        EXPECT_OK(rt_create_scene(&desc, &scene));
    }
    ~Space() { EXPECT_OK(rt_destroy_scene(scene)); }
    Space(const Space&) = delete;
    Space& operator=(const Space&) = delete;

    rt_mesh add(const std::vector<float>& corners, const rt_transform& transform) {
        rt_mesh_desc desc = rt_default_mesh_desc();
        desc.index_type = RT_INDEX_NONE;
        desc.positions = {corners.data(), corners.size() / 3, 0, 0};
        rt_mesh mesh{};
        EXPECT_OK(rt_add_rigid_mesh(scene, &desc, &mesh));
        EXPECT_OK(rt_set_mesh_transform(scene, mesh, &transform));
        return mesh;
    }
    void commit() { EXPECT_OK(rt_commit_scene(scene, nullptr, nullptr)); }

    rt_scene scene{};
};

//   corners of [-1, 1]^3, three a triangle, counter-clockwise from outside
inline std::vector<float> box_corners() {
    std::vector<float> out;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            const float quad[4][2] = {{-side, -1}, {side, -1}, {side, 1}, {-side, 1}};
            for (const int i : {0, 1, 2, 0, 2, 3}) {
                float v[3];
                v[axis] = side;
                v[(axis + 1) % 3] = quad[i][0];
                v[(axis + 2) % 3] = quad[i][1];
                out.insert(out.end(), v, v + 3);
            }
        }
    return out;
}

} // namespace peregrine::test
