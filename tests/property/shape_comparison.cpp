#include "shape_comparison.h"

namespace peregrine::test {

using math::Vec3;

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

namespace {

constexpr query::OverlapHit kUntouched = {{77, 77}, 77, 77};

} // namespace

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

namespace {

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

} // namespace

std::vector<Choice> usual_choices() {
    std::vector<Choice> choices(2);
    choices[1].selection.skip_separating = true;
    return choices;
}

void compare_all(const std::vector<MeshToAdd>& meshes, size_t count,
                 const std::vector<Choice>& choices, const math::Vec3d& base) {
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

} // namespace peregrine::test
