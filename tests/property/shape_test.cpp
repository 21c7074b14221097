// Promise 1 of docs/design.md for shapes: sweeps, overlaps and nearest points give the bits of
// brute force, through every structure, on every instruction set, in worlds that move.
//
//     PEREGRINE_RAYS=N build/release/bin/shape_test       # N cases of each kind in a world
//
// Ten million over four real levels, through the BVH on every instruction set; other structures and
// counted queries get the first kFew of each kind (F is 'Files/*:-*teapots:*dragon*:*hall'):
//     PEREGRINE_RAYS=850000 build/release/bin/shape_test --gtest_filter=F
#include "geometry/area.h"
#include "query/shapes.h"
#include "shape_world.h"
#include "support/adversaries.h"

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
    bool compact = false;
};
constexpr Way kWays[] = {{base::Isa::scalar, trace::Structure::bvh, "bvh, scalar"},
                         {base::Isa::sse4, trace::Structure::bvh, "bvh, sse4"},
                         {base::Isa::avx2, trace::Structure::bvh, "bvh, avx2"},
                         {base::Isa::avx512, trace::Structure::bvh, "bvh, avx512"},
                         {base::Isa::neon, trace::Structure::bvh, "bvh, neon"},
                         {base::Isa::sse4, trace::Structure::bvh, "compact, sse4", true},
                         {base::Isa::best, trace::Structure::bvh, "compact", true},
                         {base::Isa::best, trace::Structure::kdtree, "kdtree"},
                         {base::Isa::best, trace::Structure::bih, "bih"}};

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
        for (const auto& [name, hit] :
             {std::pair("\n  expected", expected[i]), std::pair("\n  got", got[i])}) {
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
    math::Vec3d base{0}; // that they are relative to
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
    const math::Vec3d& base = asked.base;
    Expected expected;
    for (const query::Sweep& sweep : asked.sweeps)
        expected.sweeps.push_back(brute_sweep(meshes, sweep, selection, base));
    for (const query::Shape& shape : asked.shapes) {
        std::vector<query::OverlapHit> hits = brute_overlap(meshes, shape, selection, base);
        expected.overlaps.push_back(!hits.empty());
        expected.counts.push_back(uint32_t(hits.size()));
        hits.resize(kMost, kUntouched);
        expected.lists.insert(expected.lists.end(), hits.begin(), hits.end());
    }
    for (const query::Point& point : asked.points)
        expected.nearest.push_back(brute_nearest(meshes, point, selection, base));
    return expected;
}

void compare_request(const scene::Snapshot& snapshot, Asked& asked, const Expected& expected,
                     const query::Request& request, const std::string& what) {
    std::vector<query::SweepHit> hits(asked.sweeps.size());
    query::sweep(snapshot, placed(asked.sweeps, asked.base), request, strided(hits));
    expect_same(asked.sweeps, expected.sweeps, hits, "sweeps, " + what);

    std::vector<uint8_t> overlaps(asked.shapes.size(), 9);
    query::overlap_any(snapshot, placed(asked.shapes, asked.base), request, strided(overlaps));
    expect_same(asked.shapes, expected.overlaps, overlaps, "overlaps, " + what);

    std::vector<query::OverlapHit> lists(asked.shapes.size() * kMost, kUntouched);
    std::vector<uint32_t> counts(asked.shapes.size());
    query::overlap_all(snapshot, placed(asked.shapes, asked.base), request,
                       {reinterpret_cast<std::byte*>(lists.data()), sizeof(query::OverlapHit),
                        kMost, strided(counts)});
    expect_same(asked.shapes, expected.counts, counts, "counts, " + what);
    expect_same(lists, expected.lists, lists, "lists, " + what);

    std::vector<query::NearestPoint> nearest(asked.points.size());
    query::nearest(snapshot, placed(asked.points, asked.base), request, strided(nearest));
    expect_same(asked.points, expected.nearest, nearest, "nearest points, " + what);
}

constexpr size_t kFew = 20000;

Asked few_of(const Asked& asked) {
    const auto few = [](const auto& all) {
        return std::decay_t<decltype(all)>(
            all.begin(), all.begin() + std::ptrdiff_t(std::min(all.size(), kFew)));
    };
    return {few(asked.sweeps), few(asked.shapes), few(asked.points), asked.base};
}

// ... with counters too: those shapes go through the plain kernels.
void compare(const scene::Snapshot& snapshot, Asked& asked, const Expected& expected,
             const query::Selection& selection, const std::string& what) {
    compare_request(snapshot, asked, expected, {selection}, what);
    trace::Counters counters;
    Asked few = few_of(asked);
    compare_request(snapshot, few, expected, {selection, nullptr, &counters}, what + ", counted");
}

struct MeshToAdd {
    std::vector<geometry::Triangle> triangles;
    MeshKind kind = MeshKind::fixed;
    uint32_t layer_mask = ~0u;
    math::Affine to_world = {};
};

// Which triangles count; `ignored` is a place in the list of meshes.
struct Choice {
    query::Selection selection = {};
    int ignored = -1;
};

// Handles of another scene have other generations.
void rename(Expected& expected, const ShapeWorld& world) {
    const auto rename_mesh = [&](base::Handle& mesh) {
        if (mesh) mesh = world.meshes()[mesh.index].handle;
    };
    for (query::SweepHit& hit : expected.sweeps) rename_mesh(hit.mesh);
    for (query::NearestPoint& hit : expected.nearest) rename_mesh(hit.mesh);
    for (query::OverlapHit& hit : expected.lists)
        if (!same(hit, kUntouched)) rename_mesh(hit.mesh);
}

std::vector<geometry::Triangle> in_the_world(const std::vector<MeshToAdd>& meshes,
                                             const math::Vec3d& base) {
    std::vector<geometry::Triangle> all;
    for (const MeshToAdd& mesh : meshes)
        for (geometry::Triangle triangle : mesh.triangles) {
            for (Vec3* v : {&triangle.v0, &triangle.v1, &triangle.v2})
                *v = Vec3(mesh.to_world.point(math::Vec3d(*v)) - base);
            all.push_back(triangle);
        }
    return all;
}

// Everything, and what slides.
std::vector<Choice> usual_choices() {
    std::vector<Choice> choices(2);
    choices[1].selection.skip_separating = true;
    return choices;
}

void compare_all(const std::vector<MeshToAdd>& meshes, size_t count,
                 const std::vector<Choice>& choices = usual_choices(),
                 const math::Vec3d& base = math::Vec3d(0)) {
    Asked asked = make_cases(in_the_world(meshes, base), count, 21);
    asked.base = base;
    Asked few = few_of(asked);
    std::vector<Expected> expected(choices.size());
    for (const Way& way : kWays) {
        if (!base::is_available(way.isa)) continue;
        ShapeWorld world(way.isa, way.structure, way.compact);
        for (const MeshToAdd& mesh : meshes)
            world.add(mesh.triangles, mesh.kind, mesh.layer_mask, mesh.to_world);
        world.commit();
        for (size_t i = 0; i < choices.size(); ++i) {
            query::Selection selection = choices[i].selection;
            if (choices[i].ignored >= 0)
                selection.ignore_mesh = world.meshes()[size_t(choices[i].ignored)].handle;
            if (expected[i].sweeps.empty())
                expected[i] = ask_brute_force(world.meshes(), asked, selection);
            rename(expected[i], world);
            compare(world.snapshot(), way.structure == trace::Structure::bvh ? asked : few,
                    expected[i], selection, way.name);
        }
    }
}

// ------------------------------------------------------------------------------ levels of others

class ShapeFileTest : public testing::TestWithParam<std::string> {};

TEST_P(ShapeFileTest, EqualsBruteForce) {
    std::vector<MeshToAdd> meshes;
    for (const geometry::Triangle& triangle : load_scene(GetParam()).triangles) {
        if (meshes.size() <= triangle.mesh) meshes.resize(triangle.mesh + 1);
        meshes[triangle.mesh].triangles.push_back(triangle);
    }
    ASSERT_FALSE(meshes.empty());
    compare_all(meshes, rays_per_set(20));
}

std::vector<std::string> files() {
    std::vector<std::string> names = scene_names();
    names.push_back("hall");
    return names;
}

INSTANTIATE_TEST_SUITE_P(Files, ShapeFileTest, testing::ValuesIn(files()),
                         [](const auto& info) { return info.param; });

TEST(ShapeFiles, AreThere) {
    if (scene_names().empty())
        GTEST_SKIP() << "no scenes of others: set PEREGRINE_SCENES to a folder of .glb files";
}

// What brute force leaves out for being far away changes nothing.
TEST(ShapeBruteForce, EqualsAllTriangles) {
    for (const float scale : {1e-30f, 1.0f, 1e20f}) {
        ShapeWorld world(base::Isa::best, trace::Structure::bvh);
        const std::vector<geometry::Triangle> triangles = soup(8, 3000, 0.02f, scale);
        world.add(triangles, MeshKind::fixed);
        std::vector<ShapeMesh> all = world.meshes();
        for (ShapeMesh& mesh : all) mesh.boxes = {};
        Asked asked = make_cases(triangles, rays_per_set(300), 22);
        const Expected near = ask_brute_force(world.meshes(), asked, {});
        const Expected expected = ask_brute_force(all, asked, {});
        expect_same(asked.sweeps, expected.sweeps, near.sweeps, "sweeps");
        expect_same(asked.shapes, expected.counts, near.counts, "counts");
        expect_same(expected.lists, expected.lists, near.lists, "lists");
        expect_same(asked.points, expected.nearest, near.nearest, "nearest points");
    }
}

// --------------------------------------------------------------------------------- adversaries

void expect_exact(std::vector<geometry::Triangle> triangles, size_t count = 200) {
    compare_all({{std::move(triangles)}}, rays_per_set(count));
}

TEST(ShapeAdversary, Soup) {
    expect_exact(soup(1, 2000, 0.1f));
}
TEST(ShapeAdversary, LargeTriangles) {
    expect_exact(soup(2, 200, 2));
}
TEST(ShapeAdversary, OneTriangle) {
    expect_exact(soup(3, 1, 1));
}

TEST(ShapeAdversary, Scales) {
    for (const float scale : {1e-30f, 1e-20f, 1e-6f, 1e-4f, 1e6f, 1e15f, 1e20f})
        expect_exact(soup(5, 200, 0.3f, scale), 100);
}

TEST(ShapeAdversary, MixedScales) {
    std::vector<geometry::Triangle> triangles = soup(6, 200, 0.3f, 1e6f);
    for (const geometry::Triangle& triangle : soup(7, 200, 0.3f, 1e-6f))
        triangles.push_back(triangle);
    expect_exact(triangles);
}

TEST(ShapeAdversary, Lattice) {
    expect_exact(lattice());
}

TEST(ShapeAdversary, CoincidentTriangles) {
    expect_exact(coincident(2500), 20);
}

TEST(ShapeAdversary, Needles) {
    expect_exact(needles(300));
}

// ------------------------------------------------------------------------ worlds that move,
// choices

math::Affine any_placement(std::mt19937& random, double spread) {
    std::uniform_real_distribution<double> unit(-1, 1);
    math::Affine map;
    const double scale = std::exp2(2 * unit(random));
    do
        for (int row = 0; row < 3; ++row) {
            for (int k = 0; k < 3; ++k) map.column[k][row] = scale * unit(random);
            map.offset[row] = spread * unit(random);
        }
    while (std::abs(math::determinant(map)) < 0.1 * scale * scale * scale);
    return map;
}

std::vector<MeshToAdd> moving_world(uint32_t seed, double spread) {
    std::mt19937 random(seed);
    std::vector<MeshToAdd> meshes;
    const std::vector<geometry::Triangle> same = soup(seed, 40, 0.3f);
    for (uint32_t i = 0; i < 3; ++i) {
        meshes.push_back(
            {soup(seed + i, 60, 0.2f), MeshKind::rigid, 1u << i, any_placement(random, spread)});
        meshes.push_back({soup(seed + i, 100, 0.3f), MeshKind::deforming, 2u << i});
        meshes.push_back({soup(seed + i, 150, 0.3f), MeshKind::fixed, 4u << i});
        // The same triangles in the same place: the smallest mesh must win.
        meshes.push_back({same, MeshKind(i), ~0u});
    }
    return meshes;
}

TEST(ShapeWorlds, ThatMove) {
    for (const double spread : {1.0, 30.0, 1e6})
        compare_all(moving_world(uint32_t(spread) + 1, spread), rays_per_set(100));
}

TEST(ShapeWorlds, Choices) {
    std::vector<Choice> choices;
    for (const trace::Faces faces : {trace::Faces::both, trace::Faces::front, trace::Faces::back})
        for (const bool skips : {false, true}) {
            query::Selection selection;
            selection.faces = faces;
            selection.skip_separating = skips;
            choices.push_back({selection});
            selection.layer_mask = skips ? 5 : 2;
            choices.push_back({selection, skips ? 1 : 0});
        }
    compare_all(moving_world(50, 1), rays_per_set(60), choices);
}

// Records relative to a point far away: rigid meshes keep their precision, others what float has.
TEST(ShapeWorlds, ThatMoveFarAway) {
    for (const double far : {0.3, 1e4 + 0.1, 1e7 + 1 / 3.0, 1e9, 1e12}) {
        const math::Vec3d base(far, -far, 0.3 * far);
        const float size = std::max(1.0f, float(far) * 0x1p-22f);
        std::vector<MeshToAdd> meshes = moving_world(3, 3);
        for (MeshToAdd& mesh : meshes)
            if (mesh.kind == MeshKind::rigid)
                mesh.to_world.offset += base;
            else
                std::erase_if(mesh.triangles, [&](geometry::Triangle& t) {
                    for (Vec3* v : {&t.v0, &t.v1, &t.v2}) *v = Vec3(math::Vec3d(size * *v) + base);
                    return !geometry::has_area(t.v0, t.v1, t.v2);
                });
        compare_all(meshes, rays_per_set(60), {{}}, base);
    }
}

// More than the buffer of a pass holds.
TEST(ShapeLists, OfAnyLength) {
    ShapeWorld world(base::Isa::best, trace::Structure::bvh);
    world.add(soup(4, 5000, 0.05f), MeshKind::fixed);
    world.add(soup(5, 3000, 0.05f), MeshKind::rigid);
    world.commit();
    std::vector<query::Shape> shapes{{Vec3(0), 10, Vec3(0), 0, {}}, {Vec3(20), 1, Vec3(0), 0, {}}};
    std::vector<uint32_t> counts(2);
    std::vector<query::OverlapHit> hits(8000);
    query::overlap_all(
        world.snapshot(), placed(shapes), {},
        {reinterpret_cast<std::byte*>(hits.data()), sizeof hits[0], 4000, strided(counts)});
    EXPECT_EQ(counts, (std::vector<uint32_t>{8000, 0}));
    for (uint32_t i = 0; i < 4000; ++i) EXPECT_EQ(hits[i].triangle, i);
    query::overlap_all(world.snapshot(), placed(shapes), {}, {nullptr, 16, 0, strided(counts)});
    EXPECT_EQ(counts[0], 8000u);
}

} // namespace
} // namespace peregrine::test
