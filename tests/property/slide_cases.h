#pragma once

#include "shape_world.h"

#include <initializer_list>
#include <vector>

// Worlds to slide in, and shapes on and in their floors.
namespace peregrine::test {

using Triangles = std::vector<geometry::Triangle>;

struct SlideMesh {
    Triangles triangles;
    scene::MeshKind kind = scene::MeshKind::fixed;
    math::Affine to_world = {};
    uint32_t layer_mask = ~0u;
};

// What RT_QUERY_SKIP_SEPARATING asks for.
query::Selection sliding();

// The answers of all structures and instruction sets, which must be those of brute force.
std::vector<query::SweepHit> slide(const std::vector<SlideMesh>& meshes,
                                   std::vector<query::Sweep> sweeps,
                                   const query::Selection& selection = sliding());

bool is_free(const query::SweepHit& hit);
void expect_free(const std::vector<SlideMesh>& meshes, const std::vector<query::Sweep>& sweeps,
                 const char* what, const query::Selection& selection = sliding());

inline constexpr math::Vec3 kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

void add_quad(Triangles& to, const math::Vec3& corner, const math::Vec3& u, const math::Vec3& v);
// count_u by count_v quads along u and v, from `corner` on.
Triangles grid(const math::Vec3& corner, const math::Vec3& u, const math::Vec3& v, int count_u,
               int count_v);
// Unit squares at y = 0, 20 along z, between two x.
Triangles floor_of(float first, float last);
Triangles closed_box(const math::Vec3& corner, const math::Vec3& size);
Triangles joined(std::initializer_list<Triangles> parts);

// Turned by two angles, then scaled and moved.
math::Affine turned(double about_y, double about_z, double scale, const math::Vec3d& offset,
                    bool mirrored = false);
// The mesh where `map` takes it: rigid ones by their placement, others by their vertices.
SlideMesh placed_mesh(Triangles triangles, scene::MeshKind kind, const math::Affine& map);

inline constexpr float kSunk[] = {0, 1e-7f, 1e-5f, 1e-3f, 0.01f};
inline constexpr math::Vec3 kAxes[] = {{0, 0, 0}, {0, 0.5f, 0}, {0.5f, 0, 0}, {0.3f, 0.4f, 0.1f}};

// One of 36, 5 long.
math::Vec3 heading(int i);
// A ball or a capsule at a place on the floor, `sunk` into it.
query::Sweep on_floor(const math::Vec3& axis, float sunk, const math::Vec3& direction,
                      float x = 10.25f, float z = 10.2f);
// With all axes, depths and headings.
std::vector<query::Sweep> all_around(const math::Affine& map = {}, double scale = 1);

} // namespace peregrine::test
