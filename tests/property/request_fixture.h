// A world and rays of all sorts for request_test, all that is asked of them, and an oracle.
#pragma once

#include "base/error.h"
#include "query/valid_ray.h"
#include "scene/alpha_test.h"
#include "support/query_world.h"
#include "support/world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>

namespace peregrine::test {

using math::Ray;
using math::Vec3;
using query::Hit;
using query::Request;
using query::Surface;
using scene::MeshKind;

inline constexpr uint32_t kMost = 4;

std::byte* bytes(auto& vector) {
    return reinterpret_cast<std::byte*>(vector.data());
}

// All four kinds of answers, with surfaces.
struct Answers {
    std::vector<Hit> closest, all;
    std::vector<uint8_t> occluded;
    std::vector<uint32_t> stored, counts;
    std::vector<Surface> closest_surfaces, all_surfaces;
    trace::Counters counters[4];

    explicit Answers(size_t rays)
        : closest(rays), all(rays * kMost), occluded(rays), stored(rays), counts(rays),
          closest_surfaces(rays), all_surfaces(rays * kMost) {}

    void ask(const scene::Snapshot& snapshot, const query::Rays& rays, Request request,
             uint32_t fields = query::kAllFields) {
        const bool counted = request.counters;
        const auto next = [&](int kind) {
            request.counters = counted ? &counters[kind] : nullptr;
            return request;
        };
        query::closest_hits(snapshot, rays, next(0), {bytes(closest), sizeof(Hit), {}},
                            {bytes(closest_surfaces), sizeof(Surface), fields});
        query::occlusion(snapshot, rays, next(1), {bytes(occluded), rays.count, 1});
        query::all_hits(snapshot, rays, next(2),
                        {bytes(all),
                         sizeof(Hit),
                         kMost,
                         {bytes(stored), rays.count, 4},
                         {bytes(all_surfaces), sizeof(Surface), fields}});
        query::count_hits(snapshot, rays, next(3), {bytes(counts), rays.count, 4});
    }
};

bool same(const auto& a, const auto& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

inline bool same(const Answers& a, const Answers& b) {
    return same(a.closest, b.closest) && same(a.all, b.all) && same(a.occluded, b.occluded)
           && same(a.stored, b.stored) && same(a.counts, b.counts)
           && same(a.closest_surfaces, b.closest_surfaces) && same(a.all_surfaces, b.all_surfaces);
}

// The same rays as separate arrays.
struct RayLanes {
    std::vector<float> lanes[8];
    query::RayArrays arrays;

    explicit RayLanes(const std::vector<Ray>& rays) {
        for (uint32_t k = 0; k < 8; ++k) {
            for (const Ray& ray : rays) {
                float values[8];
                std::memcpy(values, &ray, sizeof values);
                lanes[k].push_back(values[k]);
            }
            arrays.array[k] = lanes[k].data();
        }
    }
    RayLanes(const RayLanes&) = delete;
    RayLanes& operator=(const RayLanes&) = delete;
};

// The message of the error that ask() throws; empty: none.
template <class Ask>
std::string error_of(Ask&& ask) {
    try {
        ask();
    } catch (const base::Error& error) {
        return error.text;
    }
    return {};
}

struct Build {
    const char* name;
    trace::Structure structure;
    bool compact = false;
};

// Static, deforming and rigid meshes; the last have a material with holes.
class RequestTest : public testing::TestWithParam<std::tuple<Build, base::Isa>> {
protected:
    void SetUp() override {
        if (!base::is_available(std::get<1>(GetParam())))
            GTEST_SKIP() << "this machine lacks the instruction set";
        world_ = std::make_unique<QueryWorld>(std::get<1>(GetParam()), 4);
        QueryWorld& world = *world_;
        std::mt19937 random(3);
        const base::Handle holes = add_holes();
        world.add(soup(1, 200, 0.5f), MeshKind::fixed, 1, holes);
        world.add(soup(2, 200, 0.5f), MeshKind::fixed, 2);
        world.add(soup(3, 150, 0.3f), MeshKind::deforming, 4);
        world.add(soup(4, 80, 0.5f), MeshKind::rigid, 8, holes);
        for (int i = 0; i < 4; ++i) world.add_instance(3);
        for (size_t i = 3; i < world.parts.size(); ++i) world.place(i, random_placement(random, 1));
        const Build& build = std::get<0>(GetParam());
        world.commit(build.structure, accel::bvh::Quality::balanced, build.compact);
        pin_.emplace(world.scene.snapshots);
        const size_t rays = std::max<size_t>(25, rays_per_set(25)); // of each of twelve sets
        for (const RaySet& set : make_ray_sets(world.triangles(), {}, {}, rays, 5))
            for (const Ray& ray : set.rays)
                if (query::is_valid(ray)) rays_.push_back(ray);
    }

    const scene::Snapshot& snapshot() const { return *pin_->get(); }

    // Batches of several sizes must agree with the oracle, which takes what `takes` does of ray i.
    // Rays are relative to `base`.
    template <class Takes>
    void compare(const Request& request, Takes&& takes, const math::Vec3d& base = math::Vec3d(0)) {
        for (const size_t size : {rays_.size(), size_t(1), size_t(5), size_t(130)}) {
            const size_t first = size == rays_.size() ? 0 : size;
            const std::vector<Ray> rays(rays_.begin() + long(first),
                                        rays_.begin() + long(first + size));
            Answers answers(size);
            query::Rays asked = rays_of(rays);
            asked.shift.by = base;
            answers.ask(snapshot(), asked, request);
            size_t wrong = 0;
            for (size_t i = 0; i < size; ++i) {
                const auto take = [&](const Hit& hit) { return takes(i, hit); };
                wrong += !right(answers, i, world_->hits(rays[i], take, base),
                                world_->crossings(rays[i], take, base));
            }
            EXPECT_EQ(wrong, 0u) << "of " << size;
        }
    }

    uint32_t layer_of(const Hit& hit) const {
        for (const QueryWorld::Part& part : world_->parts)
            if (part.mesh == hit.mesh) return part.layer_mask;
        return 0;
    }

    bool is_present(const Hit& hit) const {
        const scene::Snapshot::Mesh& mesh = snapshot().meshes[hit.mesh.index];
        const scene::InstanceAlpha instance{&snapshot(), hit.mesh.index};
        const trace::AlphaTest alpha = scene::alpha_test(instance);
        return !snapshot().material_of(mesh, hit.triangle).masked
               || alpha.present(alpha.context, {hit.mesh.index, hit.triangle & 0x3fffffff, 0},
                                hit.u, hit.v);
    }

    std::unique_ptr<QueryWorld> world_;
    std::optional<scene::SnapshotStore::Pin> pin_;
    std::vector<Ray> rays_;

private:
    static bool right(const Answers& answers, size_t i, const std::vector<Hit>& hits,
                      const std::vector<Hit>& crossings) {
        const size_t count = std::min<size_t>(kMost, crossings.size());
        const Hit& closest = answers.closest[i];
        return answers.occluded[i] == !hits.empty()
               && (hits.empty() ? closest.triangle == geometry::kNoTriangle
                                : same_hits(&closest, &hits[0], 1))
               && answers.counts[i] == crossings.size() && answers.stored[i] == count
               && same_hits(&answers.all[i * kMost], crossings.data(), count);
    }

    base::Handle add_holes() {
        auto texture = std::make_shared<scene::Texture>(&world_->scene.memory);
        texture->width = texture->height = 2;
        texture->storage = scene::Texture::Storage::float32;
        texture->sampling = scene::Sampling::nearest;
        const float texels[16] = {1, 1, 1, 1, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 1};
        texture->texels.resize(sizeof texels);
        std::memcpy(texture->texels.data(), texels, sizeof texels);
        scene::Material material;
        material.masked = true;
        return world_->scene.materials.insert(
            {material, world_->scene.textures.insert(texture), {}, {}});
    }
};

} // namespace peregrine::test
