// Rays that graze a closed mesh from outside meet its front and its back at one place: of equal t
// the front is what they report, and they enter before they leave.
#include "support/query_world.h"

#include <gtest/gtest.h>

namespace peregrine::test {
namespace {

using math::Ray;
using math::Vec3;
using query::Hit;
using scene::MeshKind;

//      __
//     /  \_ _ _ _ o    rays from outside that touch the sphere at a vertex or at the middle of an
//     \__/             edge, some a little above or below
std::vector<Ray> grazing_rays(const std::vector<geometry::Triangle>& triangles) {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> unit(-1, 1);
    std::vector<Ray> rays;
    for (const geometry::Triangle& triangle : triangles)
        for (const Vec3& touched : {triangle.v0, 0.5f * (triangle.v0 + triangle.v1), triangle.v2}) {
            const Vec3 any(unit(random), unit(random), unit(random));
            const Vec3 along = glm::normalize(glm::cross(touched, any));
            const Vec3 aim = touched * (1 - 1e-3f * std::max(0.0f, unit(random)));
            const Vec3 origin = aim + 3.0f * along;
            rays.push_back({origin, 0, aim - origin, std::numeric_limits<float>::infinity()});
        }
    return rays;
}

struct Tally {
    size_t rays = 0, backs_first = 0, ties = 0;
};

// Every grazing ray, as closest hit and as all hits.
Tally look_at(const QueryWorld& world, const scene::Snapshot& snapshot,
              const std::vector<Ray>& rays) {
    constexpr uint32_t kMost = 16;
    std::vector<Hit> closest(rays.size()), all(kMost * rays.size());
    std::vector<uint32_t> stored(rays.size());
    const auto bytes = [](auto& list) { return reinterpret_cast<std::byte*>(list.data()); };
    query::closest_hits(snapshot, rays_of(rays), {}, {bytes(closest), sizeof(Hit), {}});
    query::all_hits(snapshot, rays_of(rays), {},
                    {bytes(all), sizeof(Hit), kMost, {bytes(stored), rays.size(), 4}, {}});
    Tally tally;
    for (size_t i = 0; i < rays.size(); ++i) {
        const auto everything = [](const Hit&) { return true; };
        const std::vector<Hit> hits = world.hits(rays[i], everything);
        if (hits.empty()) continue;
        ++tally.rays;
        bool front = false, back = false; // at the first t
        for (const Hit& hit : hits)
            if (hit.t == hits[0].t) (hit.back_face ? back : front) = true;
        tally.backs_first += closest[i].back_face;
        tally.ties += front && back;
        EXPECT_EQ(closest[i].t, hits[0].t);
        EXPECT_EQ(closest[i].back_face == 1, !front) << "a front ties with it";
        for (size_t k = i * kMost + 1; k < i * kMost + stored[i]; ++k)
            EXPECT_FALSE(all[k - 1].t == all[k].t && all[k - 1].back_face && !all[k].back_face)
                << "leaves before it enters";
    }
    return tally;
}

TEST(Silhouette, OfASphereIsEnteredFirst) {
    for (const MeshKind kind : {MeshKind::fixed, MeshKind::deforming, MeshKind::rigid})
        for (const bool mirrored : {false, true}) {
            if (mirrored && kind != MeshKind::rigid) continue;
            QueryWorld world;
            const size_t part = world.add(uv_sphere(24, 48), kind);
            const std::vector<Ray> rays = grazing_rays(world.triangles());
            if (mirrored) {
                math::Affine mirror;
                mirror.column[0].x = -1; // the sphere is its own image
                world.place(part, mirror);
            }
            for (const trace::Structure structure :
                 {trace::Structure::bvh, trace::Structure::kdtree, trace::Structure::bih}) {
                world.scene.touch_triangles(kind);
                world.commit(structure);
                const scene::SnapshotStore::Pin pin(world.scene.snapshots);
                const Tally tally = look_at(world, *pin.get(), rays);
                EXPECT_GT(tally.ties, 20u); // or it would prove nothing
                EXPECT_EQ(tally.backs_first, 0u);
                RecordProperty("rays", int(tally.rays));
                RecordProperty("ties", int(tally.ties));
                RecordProperty("backs_first", int(tally.backs_first));
            }
        }
}

} // namespace
} // namespace peregrine::test
