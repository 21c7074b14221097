// Promise 1 for shapes: sweeps, overlaps and nearest points give the bits of brute force, through
// every structure, on every instruction set, in worlds that move.
//
//     PEREGRINE_RAYS=N build/release/bin/shape_test       # N cases of each kind in a world
//
// Ten million over the real levels:
//     PEREGRINE_RAYS=500000 build/release/bin/shape_test --gtest_filter='Files/*'
#include "query/shapes.h"
#include "shape_world.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <cstring>

namespace peregrine::test {
namespace {

using math::Vec3;
using scene::MeshKind;

struct Way {
    base::Isa isa;
    trace::Structure structure;
    const char* name;
};
constexpr Way kWays[] = {{base::Isa::scalar, trace::Structure::bvh, "bvh, scalar"},
                         {base::Isa::sse4, trace::Structure::bvh, "bvh, sse4"},
                         {base::Isa::avx2, trace::Structure::bvh, "bvh, avx2"},
                         {base::Isa::avx512, trace::Structure::bvh, "bvh, avx512"},
                         {base::Isa::neon, trace::Structure::bvh, "bvh, neon"},
                         {base::Isa::best, trace::Structure::kdtree, "kdtree"},
                         {base::Isa::best, trace::Structure::bih, "bih"}};

template <class Record>
query::Strided<Record> strided(std::vector<Record>& records) {
    return {reinterpret_cast<std::byte*>(records.data()), records.size(), sizeof(Record)};
}

template <class Record>
bool same(const Record& a, const Record& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

template <class In, class Out>
void expect_same(const std::vector<In>& asked, const std::vector<Out>& expected,
                 const std::vector<Out>& got, const std::string& what) {
    size_t wrong = 0;
    for (size_t i = 0; i < asked.size(); ++i) {
        if (same(expected[i], got[i]) || ++wrong > 1) continue;
        std::ostringstream words;
        words << std::hexfloat;
        for (size_t k = 0; k < sizeof(In) / 4; ++k) {
            float f;
            std::memcpy(&f, reinterpret_cast<const char*>(&asked[i]) + 4 * k, 4);
            words << ' ' << f;
        }
        words << std::dec << std::defaultfloat;
        for (const auto& [name, hit] : {std::pair("\n  expected", expected[i]), std::pair("\n  got", got[i])}) {
            words << name;
            for (size_t k = 0; k < sizeof(Out) / 4; ++k) {
                float f;
                uint32_t bits;
                std::memcpy(&f, reinterpret_cast<const char*>(&hit) + 4 * k, 4);
                std::memcpy(&bits, &f, 4);
                words << ' ' << f << '/' << bits;
            }
        }
        ADD_FAILURE() << what << ", case " << i << ':' << words.str();
    }
    EXPECT_EQ(wrong, 0u) << what << ": of " << asked.size();
}

struct Asked {
    std::vector<query::Sweep> sweeps;
    std::vector<query::Shape> shapes;
    std::vector<query::Point> points;
};

Asked make_cases(const std::vector<geometry::Triangle>& triangles, size_t count, uint32_t seed) {
    ShapeCases cases(triangles, seed);
    Asked asked;
    for (size_t i = 0; i < count; ++i) {
        asked.sweeps.push_back(cases.sweep());
        asked.shapes.push_back(cases.shape());
        asked.points.push_back(cases.point());
    }
    return asked;
}

constexpr uint32_t kMost = 5;

struct Expected {
    std::vector<query::SweepHit> sweeps;
    std::vector<uint8_t> overlaps;
    std::vector<uint32_t> counts;
    std::vector<query::OverlapHit> lists; // kMost each
    std::vector<query::NearestPoint> nearest;
};

constexpr query::OverlapHit kUntouched = {{77, 77}, 77, 77};

Expected ask_brute_force(const std::vector<ShapeMesh>& meshes, const Asked& asked,
                         const query::Selection& selection) {
    Expected expected;
    for (const query::Sweep& sweep : asked.sweeps)
        expected.sweeps.push_back(brute_sweep(meshes, sweep, selection));
    for (const query::Shape& shape : asked.shapes) {
        std::vector<query::OverlapHit> hits = brute_overlap(meshes, shape, selection);
        expected.overlaps.push_back(!hits.empty());
        expected.counts.push_back(uint32_t(hits.size()));
        hits.resize(kMost, kUntouched);
        expected.lists.insert(expected.lists.end(), hits.begin(), hits.end());
    }
    for (const query::Point& point : asked.points)
        expected.nearest.push_back(brute_nearest(meshes, point, selection));
    return expected;
}

void compare(const scene::Snapshot& snapshot, Asked& asked, const Expected& expected,
             const query::Selection& selection, const std::string& what) {
    std::vector<query::SweepHit> hits(asked.sweeps.size());
    query::sweep(snapshot, strided(asked.sweeps), selection, strided(hits));
    expect_same(asked.sweeps, expected.sweeps, hits, "sweeps, " + what);

    std::vector<uint8_t> overlaps(asked.shapes.size(), 9);
    query::overlap_any(snapshot, strided(asked.shapes), selection, strided(overlaps));
    expect_same(asked.shapes, expected.overlaps, overlaps, "overlaps, " + what);

    std::vector<query::OverlapHit> lists(asked.shapes.size() * kMost, kUntouched);
    std::vector<uint32_t> counts(asked.shapes.size());
    query::overlap_all(snapshot, strided(asked.shapes), selection,
                       {reinterpret_cast<std::byte*>(lists.data()), sizeof(query::OverlapHit),
                        kMost, strided(counts)});
    expect_same(asked.shapes, expected.counts, counts, "counts, " + what);
    expect_same(lists, expected.lists, lists, "lists, " + what);

    std::vector<query::NearestPoint> nearest(asked.points.size());
    query::nearest(snapshot, strided(asked.points), selection, strided(nearest));
    expect_same(asked.points, expected.nearest, nearest, "nearest points, " + what);
}

struct MeshToAdd {
    std::vector<geometry::Triangle> triangles;
    MeshKind kind = MeshKind::fixed;
    uint32_t layer_mask = ~0u;
    math::Affine to_world = {};
};

void compare_all(const std::vector<MeshToAdd>& meshes, size_t count,
                 const std::vector<query::Selection>& selections = {{}}) {
    std::vector<geometry::Triangle> all;
    for (const MeshToAdd& mesh : meshes)
        for (geometry::Triangle triangle : mesh.triangles) {
            for (Vec3* v : {&triangle.v0, &triangle.v1, &triangle.v2})
                *v = Vec3(mesh.to_world.point(math::Vec3d(*v)));
            all.push_back(triangle);
        }
    Asked asked = make_cases(all, count, 21);
    std::vector<Expected> expected;
    for (const Way& way : kWays) {
        if (!base::machine_has(way.isa)) continue;
        ShapeWorld world(way.isa, way.structure);
        for (const MeshToAdd& mesh : meshes)
            world.add(mesh.triangles, mesh.kind, mesh.layer_mask, mesh.to_world);
        world.commit();
        for (size_t i = 0; i < selections.size(); ++i) {
            query::Selection selection = selections[i];
            if (selection.ignore_mesh.generation)
                selection.ignore_mesh = world.meshes()[selection.ignore_mesh.index].handle;
            if (expected.size() == i)
                expected.push_back(ask_brute_force(world.meshes(), asked, selection));
            for (query::SweepHit& hit : expected[i].sweeps) rename(world, hit.mesh);
            for (query::OverlapHit& hit : expected[i].lists)
                if (!same(hit, kUntouched)) rename(world, hit.mesh);
            for (query::NearestPoint& hit : expected[i].nearest) rename(world, hit.mesh);
            compare(world.snapshot(), asked, expected[i], selection, way.name);
        }
    }
}
