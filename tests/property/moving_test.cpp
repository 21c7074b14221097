// Promise 1 of docs/design.md in a world that moves: rays through fixed, deforming and rigid meshes
// give the bits of brute force, which tests every triangle of every mesh, rigid ones in their own
// space, also where rays are relative to an origin.
#include "geometry/area.h"
#include "query/records.h"
#include "support/brute_force.h"
#include "support/world.h"
#include "trace/world/world.h"

#include <peregrine/rt.h>

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <memory>

namespace peregrine::test {
namespace {

using math::Ray;
using math::Vec3;

#define ASSERT_OK(call) ASSERT_EQ(call, RT_OK) << rt_get_last_error()

struct Part {
    rt_mesh mesh{};
    std::vector<geometry::Triangle> triangles; // in its own space, for rigid ones
    bool rigid = false;
    bool hidden = false;
    uint32_t layer_mask = ~0u;
    math::Affine to_local;
    math::Vec3d origin{0}; // where its own one is
};

// As the header defines the answer.
rt_hit ask_brute_force(const std::vector<Part>& parts, const std::vector<BruteForce>& oracles,
                       const Ray& record, const math::Vec3d& base, uint32_t layer_mask,
                       uint32_t ignored) {
    const query::Shift shift{base};
    const trace::Position position{record.origin, base};
    const Ray ray = shift.applied(record);
    rt_hit best{};
    best.t = std::numeric_limits<float>::infinity();
    best.triangle = RT_NO_TRIANGLE;
    for (size_t i = 0; i < parts.size(); ++i) {
        const Part& part = parts[i];
        if (part.hidden || part.triangles.empty() || (part.layer_mask & layer_mask) == 0
            || part.mesh.index == ignored)
            continue;
        Ray local = ray;
        if (part.rigid && !trace::to_local(part.to_local, position.from(part.origin), ray, local))
            continue;
        trace::Hit hit;
        oracles[i].closest({&local, 1}, {}, &hit);
        if (hit.triangle == geometry::kNoTriangle) continue;
        const uint32_t triangle = part.triangles[hit.triangle].primitive;
        if (hit.t > best.t
            || (hit.t == best.t
                && std::tuple(uint32_t(hit.back_face), part.mesh.index, triangle)
                       > std::tuple(best.back_face, best.mesh.index, best.triangle)))
            continue;
        best = {hit.t, hit.u, hit.v, triangle, part.mesh, 0, hit.back_face};
    }
    return best;
}

bool same(const rt_hit& a, const rt_hit& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

rt_mesh_desc describe(const std::vector<Vec3>& positions) {
    rt_mesh_desc desc = rt_default_mesh_desc();
    desc.index_type = RT_INDEX_NONE;
    desc.positions = {positions.data(), positions.size(), 0, 0};
    return desc;
}

std::vector<Vec3> corners(const std::vector<geometry::Triangle>& triangles) {
    std::vector<Vec3> out;
    for (const auto& triangle : triangles) {
        out.push_back(triangle.v0);
        out.push_back(triangle.v1);
        out.push_back(triangle.v2);
    }
    return out;
}

class MovingTest : public testing::TestWithParam<rt_isa> {
protected:
    void SetUp() override {
        rt_scene_desc desc = rt_default_scene_desc();
        desc.isa = GetParam();
        if (rt_create_scene(&desc, &scene_) == RT_ERROR_UNSUPPORTED)
            GTEST_SKIP() << "this machine lacks the instruction set";
    }
    void TearDown() override {
        if (scene_.generation) rt_destroy_scene(scene_);
    }

    void add(std::vector<geometry::Triangle> triangles, decltype(rt_add_static_mesh)* add_mesh) {
        Part part;
        const std::vector<Vec3> positions = corners(triangles);
        const rt_mesh_desc desc = describe(positions);
        ASSERT_OK(add_mesh(scene_, &desc, &part.mesh));
        part.triangles = std::move(triangles);
        part.rigid = add_mesh == rt_add_rigid_mesh;
        parts_.push_back(std::move(part));
    }

    void add_instance(size_t of) {
        Part part = parts_[of];
        ASSERT_OK(rt_add_mesh_instance(scene_, parts_[of].mesh, &part.mesh));
        parts_.push_back(std::move(part));
    }

    // Turned, stretched, sheared, every third one mirrored.
    void place(Part& part, double spread) {
        std::uniform_real_distribution<double> unit(-1, 1);
        rt_transform transform;
        math::Affine to_world;
        double scale = std::exp2(2 * unit(random_));
        do {
            for (int row = 0; row < 3; ++row) {
                for (int k = 0; k < 3; ++k) to_world.column[k][row] = scale * unit(random_);
                to_world.offset[row] = base_[row] + spread * unit(random_);
            }
        } while (std::abs(math::determinant(to_world)) < 0.1 * scale * scale * scale);
        for (int row = 0; row < 3; ++row) {
            for (int k = 0; k < 3; ++k) transform.m[4 * row + k] = to_world.column[k][row];
            transform.m[4 * row + 3] = to_world.offset[row];
        }
        ASSERT_OK(rt_set_mesh_transform(scene_, part.mesh, &transform));
        part.to_local = math::inverse(to_world);
        part.origin = to_world.offset;
    }

    void deform(Part& part) {
        part.triangles = soup(uint32_t(random_()), part.triangles.size(), 0.2f);
        const std::vector<Vec3> positions = corners(part.triangles);
        rt_mesh_update update = rt_default_mesh_update();
        update.positions = {positions.data(), positions.size(), 0, 0};
        ASSERT_OK(rt_update_dynamic_mesh(scene_, part.mesh, &update));
    }

    // Every triangle where it stands, relative to the rays' origin, for rays that aim at it.
    std::vector<geometry::Triangle> all_triangles() const {
        std::vector<geometry::Triangle> all;
        for (const Part& part : parts_) {
            math::Affine to_world = math::inverse(part.to_local);
            to_world.offset = part.origin;
            for (geometry::Triangle triangle : part.triangles) {
                for (Vec3* v : {&triangle.v0, &triangle.v1, &triangle.v2}) {
                    const math::Vec3d own(*v);
                    *v = Vec3((part.rigid ? to_world.point(own) : own) - base_);
                }
                all.push_back(triangle);
            }
        }
        return all;
    }

    void compare(size_t rays_each, uint32_t seed, uint32_t layer_mask = ~0u, rt_mesh ignored = {}) {
        std::vector<BruteForce> oracles;
        for (const Part& part : parts_) oracles.emplace_back(part.triangles);
        for (RaySet& set : make_ray_sets(all_triangles(), {}, {}, rays_each, seed)) {
            std::erase_if(set.rays, [](const Ray& ray) { return ray.direction == Vec3(0); });
            std::vector<rt_hit> expected;
            for (const Ray& ray : set.rays)
                expected.push_back(ask_brute_force(parts_, oracles, ray, base_, layer_mask,
                                                   ignored.generation ? ignored.index : ~0u));
            rt_query_desc desc = rt_default_query_desc();
            desc.layer_mask = layer_mask;
            desc.ignore_mesh = ignored;
            rt_query_options options = rt_default_query_options();
            for (int k = 0; k < 3; ++k) options.origin[k] = base_[k];
            if (base_ != math::Vec3d(0)) desc.options = &options;
            ask_singles(set, expected, desc);
            for (const rt_coherence hint : {RT_COHERENCE_AUTO, RT_COHERENCE_COHERENT,
                                            RT_COHERENCE_COMMON_ORIGIN, RT_COHERENCE_INCOHERENT}) {
                desc.coherence = hint;
                ask_batch(set, expected, desc);
            }
        }
    }

    void commit() {
        rt_commit_desc desc = rt_default_commit_desc();
        desc.memory = memory_;
        ASSERT_OK(rt_commit_scene(scene_, &desc, nullptr));
    }

    rt_scene scene_{};
    rt_memory memory_ = RT_MEMORY_FULL;
    std::vector<Part> parts_;
    math::Vec3d base_{0}; // of rays, and what rigid meshes are placed around
    std::mt19937 random_{5};

private:
    void ask_singles(const RaySet& set, const std::vector<rt_hit>& expected, rt_query_desc desc) {
        size_t wrong = 0;
        for (size_t i = 0; i < set.rays.size(); ++i) {
            rt_hit hit;
            uint8_t occluded = 2;
            desc.rays = reinterpret_cast<const rt_ray*>(&set.rays[i]);
            desc.ray_count = 1;
            desc.kind = RT_QUERY_CLOSEST;
            desc.hits = &hit;
            ASSERT_OK(rt_trace_query(scene_, &desc));
            desc.kind = RT_QUERY_ANY;
            desc.hits = nullptr;
            desc.occluded = &occluded;
            ASSERT_OK(rt_trace_query(scene_, &desc));
            wrong += !same(hit, expected[i]) || occluded != (expected[i].t < HUGE_VALF);
        }
        EXPECT_EQ(wrong, 0u) << set.name << ", one by one, of " << set.rays.size();
    }

    void ask_batch(const RaySet& set, const std::vector<rt_hit>& expected, rt_query_desc desc) {
        std::vector<rt_hit> hits(set.rays.size());
        std::vector<uint8_t> occluded(set.rays.size());
        desc.rays = reinterpret_cast<const rt_ray*>(set.rays.data());
        desc.ray_count = set.rays.size();
        desc.kind = RT_QUERY_CLOSEST;
        desc.hits = hits.data();
        ASSERT_OK(rt_trace_query(scene_, &desc));
        desc.kind = RT_QUERY_ANY;
        desc.hits = nullptr;
        desc.occluded = occluded.data();
        ASSERT_OK(rt_trace_query(scene_, &desc));
        size_t wrong = 0;
        for (size_t i = 0; i < hits.size(); ++i)
            wrong += !same(hits[i], expected[i]) || occluded[i] != (expected[i].t < HUGE_VALF);
        EXPECT_EQ(wrong, 0u) << set.name << ", batch, hint " << desc.coherence << ", of "
                             << hits.size();
    }
};

TEST_P(MovingTest, EqualsBruteForce) {
    add(soup(uint32_t(random_()), 300, 0.3f), rt_add_static_mesh);
    add(soup(uint32_t(random_()), 200, 0.2f), rt_add_dynamic_mesh);
    add(soup(uint32_t(random_()), 100, 0.3f), rt_add_rigid_mesh);
    add(soup(uint32_t(random_()), 1, 1.0f), rt_add_rigid_mesh);
    add(soup(uint32_t(random_()), 50, 0.2f), rt_add_dynamic_mesh);
    for (int i = 0; i < 9; ++i) add_instance(2);
    for (uint32_t step = 0; step < 4; ++step) {
        for (Part& part : parts_)
            if (part.rigid) place(part, step == 3 ? 40 : 1.5);
        deform(parts_[step % 2 ? 1 : 4]);
        commit();
        compare(rays_per_set(300), step);
    }
}

TEST_P(MovingTest, CompactMeshesToo) {
    memory_ = RT_MEMORY_COMPACT;
    add(soup(uint32_t(random_()), 200, 0.3f), rt_add_static_mesh);
    add(soup(uint32_t(random_()), 100, 0.3f), rt_add_rigid_mesh);
    for (int i = 0; i < 3; ++i) add_instance(1);
    for (Part& part : parts_)
        if (part.rigid) place(part, 1.5);
    commit();
    compare(rays_per_set(150), 1);
}

// At equal t a front goes before a back, then the smaller (mesh, triangle), whatever structure
// holds them. `flipped` says which of six meshes with the same triangles are turned inside out.
TEST_P(MovingTest, Ties) {
    const std::vector<geometry::Triangle> same_for_all = soup(uint32_t(random_()), 60, 0.4f);
    std::vector<geometry::Triangle> inside_out = same_for_all;
    for (geometry::Triangle& triangle : inside_out) std::swap(triangle.v1, triangle.v2);
    for (const uint32_t flipped : {0u, 1u, 6u, 21u, 42u, 62u}) {
        uint32_t number = 0;
        for (const auto add_mesh : {rt_add_rigid_mesh, rt_add_dynamic_mesh, rt_add_static_mesh,
                                    rt_add_rigid_mesh, rt_add_static_mesh, rt_add_dynamic_mesh})
            add(flipped >> number++ & 1 ? inside_out : same_for_all, add_mesh);
        commit();
        compare(rays_per_set(200), 1);
        compare(rays_per_set(200), 2, ~0u, parts_[0].mesh);
        for (const Part& part : parts_) ASSERT_OK(rt_remove_mesh(scene_, part.mesh));
        parts_.clear();
    }
}

// Mirrored in x, a rigid mesh keeps its fronts, so its triangles tie with those of the others.
TEST_P(MovingTest, TiesWithMirroredMeshes) {
    std::vector<geometry::Triangle> triangles = soup(uint32_t(random_()), 60, 0.4f);
    add(triangles, rt_add_static_mesh);
    for (geometry::Triangle& triangle : triangles) {
        for (Vec3* v : {&triangle.v0, &triangle.v1, &triangle.v2}) v->x = -v->x;
    }
    for (const bool flipped : {false, true}) {
        if (flipped)
            for (geometry::Triangle& triangle : triangles) std::swap(triangle.v1, triangle.v2);
        add(triangles, rt_add_rigid_mesh);
        rt_transform transform = rt_default_transform();
        transform.m[0] = -1;
        ASSERT_OK(rt_set_mesh_transform(scene_, parts_.back().mesh, &transform));
        parts_.back().to_local.column[0].x = -1;
    }
    commit();
    compare(rays_per_set(200), 7);
}

TEST_P(MovingTest, LayersAndHiddenMeshes) {
    add(soup(uint32_t(random_()), 100, 0.4f), rt_add_static_mesh);
    add(soup(uint32_t(random_()), 100, 0.4f), rt_add_dynamic_mesh);
    add(soup(uint32_t(random_()), 60, 0.4f), rt_add_rigid_mesh);
    for (int i = 0; i < 3; ++i) add_instance(2);
    for (size_t i = 0; i < parts_.size(); ++i) {
        parts_[i].layer_mask = 1u << (i % 3);
        ASSERT_OK(rt_set_mesh_layer_mask(scene_, parts_[i].mesh, parts_[i].layer_mask));
        if (parts_[i].rigid) place(parts_[i], 1);
    }
    commit();
    for (const uint32_t mask : {~0u, 1u, 6u, 0u}) compare(rays_per_set(100), mask, mask);
    for (Part& part : parts_) {
        part.hidden = true;
        ASSERT_OK(rt_set_mesh_hidden(scene_, part.mesh, 1));
        commit();
        compare(rays_per_set(50), 3);
    }
    for (Part& part : parts_) {
        part.hidden = false;
        ASSERT_OK(rt_set_mesh_hidden(scene_, part.mesh, 0));
    }
    commit();
    compare(rays_per_set(50), 4);
}

// A mesh far away, and rays beside it: the nodes' margins must grow with the distance.
TEST_P(MovingTest, FarAwayAndTiny) {
    for (const double far : {1e-6, 1e3, 1e7}) {
        parts_.clear();
        TearDown();
        SetUp();
        add(soup(uint32_t(random_()), 80, 0.4f), rt_add_rigid_mesh);
        for (int i = 0; i < 6; ++i) add_instance(0);
        for (Part& part : parts_) place(part, far);
        commit();
        compare(rays_per_set(200), 6);
    }
}

// Rays that are relative to a point far away: rigid meshes get them in double, others in float.
TEST_P(MovingTest, FarAwayRelativeToAnOrigin) {
    for (const double far : {0.37, 1e3, 1e5 + 0.1, 1e7 + 1 / 3.0, 1e9, 1e12}) {
        parts_.clear();
        TearDown();
        SetUp();
        base_ = {far, -far, 0.7 * far};
        const float size = std::max(1.0f, float(far) * 0x1p-22f);
        for (const auto add_mesh : {rt_add_static_mesh, rt_add_dynamic_mesh}) {
            auto triangles = soup(uint32_t(random_()), 40, 0.5f, size);
            std::erase_if(triangles, [&](geometry::Triangle& triangle) {
                for (Vec3* v : {&triangle.v0, &triangle.v1, &triangle.v2})
                    *v = Vec3(math::Vec3d(*v) + base_);
                return !geometry::has_area(triangle.v0, triangle.v1, triangle.v2);
            });
            for (uint32_t i = 0; i < triangles.size(); ++i) triangles[i].primitive = i;
            add(std::move(triangles), add_mesh);
        }
        add(soup(uint32_t(random_()), 60, 0.4f), rt_add_rigid_mesh);
        for (int i = 0; i < 10; ++i) add_instance(2);
        for (size_t i = 2; i < parts_.size(); ++i) place(parts_[i], i < 9 ? 2 : 0.1 * far);
        commit();
        compare(rays_per_set(100), 7);
    }
}

std::string isa_name(const testing::TestParamInfo<rt_isa>& info) {
    constexpr const char* kNames[] = {"best", "sse4", "avx2", "avx512", "scalar", "neon"};
    return kNames[info.param];
}

INSTANTIATE_TEST_SUITE_P(Isas, MovingTest,
                         testing::Values(RT_ISA_SCALAR, RT_ISA_SSE4, RT_ISA_AVX2, RT_ISA_AVX512),
                         isa_name);

} // namespace
} // namespace peregrine::test
