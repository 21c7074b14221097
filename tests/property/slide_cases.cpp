#include "slide_cases.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

namespace peregrine::test {

using math::Vec3;
using math::Vec3d;
using scene::MeshKind;

namespace {

struct Way {
    base::Isa isa;
    trace::Structure structure;
    bool compact;
    const char* name;
};
constexpr Way kWays[] = {{base::Isa::best, trace::Structure::bvh, false, "bvh"},
                         {base::Isa::scalar, trace::Structure::bvh, false, "bvh, scalar"},
                         {base::Isa::sse4, trace::Structure::bvh, false, "bvh, sse4"},
                         {base::Isa::avx2, trace::Structure::bvh, false, "bvh, avx2"},
                         {base::Isa::best, trace::Structure::bvh, true, "compact"},
                         {base::Isa::best, trace::Structure::kdtree, false, "kdtree"},
                         {base::Isa::best, trace::Structure::bih, false, "bih"}};

} // namespace

query::Selection sliding() {
    query::Selection selection;
    selection.skip_separating = true;
    return selection;
}

// The answers of all ways, which must be those of brute force.
std::vector<query::SweepHit> slide(const std::vector<SlideMesh>& meshes,
                                   std::vector<query::Sweep> sweeps,
                                   const query::Selection& selection) {
    std::vector<query::SweepHit> expected(sweeps.size()), got(sweeps.size());
    for (const Way& way : kWays) {
        if (!base::is_available(way.isa)) continue;
        ShapeWorld world(way.isa, way.structure, way.compact);
        for (const SlideMesh& mesh : meshes)
            world.add(mesh.triangles, mesh.kind, mesh.layer_mask, mesh.to_world);
        world.commit();
        if (&way == kWays)
            for (size_t i = 0; i < sweeps.size(); ++i)
                expected[i] = brute_sweep(world.meshes(), sweeps[i], selection, math::Vec3d(0));
        query::sweep(world.snapshot(), placed(sweeps), {selection}, strided(got));
        size_t wrong = 0;
        for (size_t i = 0; i < sweeps.size(); ++i) {
            if (expected[i].mesh) expected[i].mesh = world.meshes()[expected[i].mesh.index].handle;
            wrong += std::memcmp(&expected[i], &got[i], sizeof got[i]) != 0;
        }
        EXPECT_EQ(wrong, 0u) << way.name << ": of " << sweeps.size();
    }
    return expected;
}

bool is_free(const query::SweepHit& hit) {
    return hit.triangle == geometry::kNoTriangle;
}

void add_quad(Triangles& to, const Vec3& corner, const Vec3& u, const Vec3& v) {
    to.push_back({corner, 0, corner + u, 0, corner + u + v, 0});
    to.push_back({corner, 0, corner + u + v, 0, corner + v, 0});
}

// count_x by count_z quads of `size`, from `corner` on.
Triangles grid(const Vec3& corner, const Vec3& u, const Vec3& v, int count_u, int count_v) {
    Triangles out;
    for (int i = 0; i < count_u; ++i)
        for (int k = 0; k < count_v; ++k) add_quad(out, corner + float(i) * u + float(k) * v, u, v);
    return out;
}

Triangles floor_of(float first, float last) {
    return grid({first, 0, 0}, kX, kZ, int(last - first), 20);
}

Triangles closed_box(const Vec3& corner, const Vec3& size) {
    const Vec3 x = size.x * kX, y = size.y * kY, z = size.z * kZ;
    Triangles out;
    add_quad(out, corner, x, z);
    add_quad(out, corner + y, z, x);
    add_quad(out, corner, y, x);
    add_quad(out, corner + z, x, y);
    add_quad(out, corner, z, y);
    add_quad(out, corner + x, y, z);
    return out;
}

Triangles joined(std::initializer_list<Triangles> parts) {
    Triangles out;
    for (const Triangles& part : parts) out.insert(out.end(), part.begin(), part.end());
    return out;
}

Triangles mapped(Triangles triangles, const math::Affine& map) {
    for (geometry::Triangle& t : triangles)
        for (Vec3* v : {&t.v0, &t.v1, &t.v2}) *v = Vec3(map.point(Vec3d(*v)));
    return triangles;
}

// The mesh where `map` takes it: rigid ones by their placement, others by their vertices.
SlideMesh placed_mesh(Triangles triangles, MeshKind kind, const math::Affine& map) {
    if (kind == MeshKind::rigid) return {std::move(triangles), kind, map};
    return {mapped(std::move(triangles), map), kind};
}

query::Sweep mapped(query::Sweep sweep, const math::Affine& map, double scale) {
    sweep.center = Vec3(map.point(Vec3d(sweep.center)));
    sweep.axis = Vec3(map.vector(Vec3d(sweep.axis)));
    sweep.direction = Vec3(map.vector(Vec3d(sweep.direction)));
    sweep.radius = float(double(sweep.radius) * scale);
    return sweep;
}

// Turned by two angles, then scaled and moved.
math::Affine turned(double about_y, double about_z, double scale, const Vec3d& offset,
                    bool mirrored) {
    const double c = std::cos(about_y), s = std::sin(about_y);
    const double d = std::cos(about_z), e = std::sin(about_z);
    const auto map = [&](const Vec3d& v) {
        const Vec3d w(c * v.x + s * v.z, v.y, c * v.z - s * v.x);
        return scale * Vec3d(d * w.x - e * w.y, e * w.x + d * w.y, w.z);
    };
    math::Affine out;
    out.column[0] = map({mirrored ? -1 : 1, 0, 0});
    out.column[1] = map({0, 1, 0});
    out.column[2] = map({0, 0, 1});
    out.offset = offset - (mirrored ? out.column[0] * 20.0 : Vec3d(0));
    return out;
}

Vec3 heading(int i) {
    const double angle = i * std::numbers::pi / 18;
    return Vec3(Vec3d(5 * std::cos(angle), 0, 5 * std::sin(angle)));
}

// A ball or a capsule at a place on the floor, `sunk` into it.
query::Sweep on_floor(const Vec3& axis, float sunk, const Vec3& direction, float x, float z) {
    return {{x, 0.5f + std::fabs(axis.y) - sunk, z}, 0.5f, axis, 1, direction, 0};
}

std::vector<query::Sweep> all_around(const math::Affine& map, double scale) {
    std::vector<query::Sweep> sweeps;
    for (const Vec3& axis : kAxes)
        for (const float sunk : kSunk)
            for (int i = 0; i < 36; ++i)
                sweeps.push_back(mapped(on_floor(axis, sunk, heading(i)), map, scale));
    return sweeps;
}

void expect_free(const std::vector<SlideMesh>& meshes, const std::vector<query::Sweep>& sweeps,
                 const char* what, const query::Selection& selection) {
    const std::vector<query::SweepHit> hits = slide(meshes, sweeps, selection);
    size_t stopped = 0;
    for (size_t i = 0; i < hits.size(); ++i)
        if (!is_free(hits[i]) && ++stopped == 1)
            ADD_FAILURE() << what << ": slide " << i << " at t " << hits[i].t << ", normal "
                          << hits[i].normal.x << ' ' << hits[i].normal.y << ' ' << hits[i].normal.z
                          << ", depth " << hits[i].depth;
    EXPECT_EQ(stopped, 0u) << what << ": of " << hits.size();
}

} // namespace peregrine::test
