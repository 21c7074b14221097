#include "shape_world.h"

#include "geometry/shapes/slide.h"

#include <cmath>
#include <limits>
#include <tuple>

namespace peregrine::test {

using math::Vec3;
using math::Vec3d;

ShapeWorld::ShapeWorld(base::Isa isa, trace::Structure structure, bool compact)
    : scene_(std::make_unique<scene::Scene>(scene::SceneOptions{{}, {}, 1, isa})),
      structure_(structure), compact_(compact) {}

void ShapeWorld::add(std::vector<geometry::Triangle> triangles, scene::MeshKind kind,
                     uint32_t layer_mask, const math::Affine& to_world) {
    const auto surface = std::make_shared<scene::MeshSurface>(&scene_->memory);
    const auto data = std::make_shared<scene::MeshData>(surface, &scene_->memory);
    for (geometry::Triangle& triangle : triangles) {
        const auto first = uint32_t(data->positions.size());
        triangle.primitive = uint32_t(surface->triangles.size());
        surface->triangles.push_back({first, first + 1, first + 2});
        for (const Vec3& v : {triangle.v0, triangle.v1, triangle.v2}) data->positions.push_back(v);
    }
    scene::MeshDescription mesh{data, layer_mask, kind};
    if (kind != scene::MeshKind::fixed) mesh.shape = std::make_shared<scene::Shape>();
    if (kind == scene::MeshKind::rigid) {
        mesh.placement = {to_world, math::inverse(to_world)};
        mesh.placement.condition = to_world.norm() * mesh.placement.to_local.norm();
        mesh.placement.mirrored = math::determinant(to_world) < 0;
    }
    scene_->touch_triangles(kind);
    meshes_.push_back(
        {scene_->meshes.insert(mesh), std::move(triangles), kind, layer_mask, to_world, {}});
    ShapeMesh& added = meshes_.back();
    for (const geometry::Triangle& t : added.triangles)
        added.boxes.add(added.in_the_world(t.v0), added.in_the_world(t.v1),
                        added.in_the_world(t.v2));
}

void ShapeWorld::commit() {
    pin_.reset();
    scene::CommitOptions options;
    options.build.structure = structure_;
    options.build.compact = compact_;
    scene_->commit(options);
    pin_ = std::make_unique<scene::SnapshotStore::Pin>(scene_->snapshots);
}

double ShapeMesh::coordinate(const geometry::Triangle& t) const {
    double largest = 0;
    for (const Vec3& v : {t.v0, t.v1, t.v2}) {
        const Vec3d size = glm::abs(Vec3d(v));
        for (int k = 0; k < 3; ++k)
            largest = std::max(largest, kind != scene::MeshKind::rigid
                                            ? size[k]
                                            : (std::fabs(to_world.column[0][k]) * size.x
                                               + std::fabs(to_world.column[1][k]) * size.y)
                                                  + std::fabs(to_world.column[2][k]) * size.z);
    }
    return largest;
}

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Calls visit(mesh, triangle, corners, side) for all in the swath that the selection sees; `side`
// is -1 where the mesh is mirrored.
template <class Visit>
void for_each_triangle(const std::vector<ShapeMesh>& meshes, const query::Selection& selection,
                       const Swath& swath, const trace::Position& position, Visit&& visit) {
    std::vector<uint32_t> near;
    for (const ShapeMesh& mesh : meshes) {
        if ((mesh.layer_mask & selection.layer_mask) == 0 || mesh.handle == selection.ignore_mesh)
            continue;
        const auto visit_one = [&](const geometry::Triangle& t) {
            visit(mesh, t, mesh.around(t, position), mesh.mirrored() ? -1.0 : 1.0);
        };
        if (mesh.boxes.empty() || position.base != Vec3d(0)) {
            for (const geometry::Triangle& t : mesh.triangles) visit_one(t);
            continue;
        }
        near.clear();
        mesh.boxes.find(swath, near);
        for (uint32_t i : near) visit_one(mesh.triangles[i]);
    }
}

double length(const Vec3& v) {
    return glm::length(Vec3d(v));
}

bool sees(const query::Selection& selection, double front) {
    return selection.faces == trace::Faces::both
           || (selection.faces == trace::Faces::front ? front > 0 : front < 0);
}

bool sees_centre(const query::Selection& selection, const geometry::Corners& corners, double side) {
    const geometry::Face face = geometry::face_of(corners);
    const double front = -side * glm::dot(face.normal, corners.a);
    return sees(selection, front < 0 ? -1 : 1);
}

// Whether it stops what slides, with everything that touches its point, and the normal.
bool stops(const std::vector<ShapeMesh>& meshes, const geometry::Sweep& test, double t_max,
           const query::Selection& selection, const trace::Position& position,
           const geometry::Tile& tile, geometry::Contact& contact) {
    geometry::Slide slide(test, t_max, tile, contact);
    while (slide.is_open()) {
        for_each_triangle(
            meshes, selection, {test.center + contact.point, slide.reach(), Vec3d(0), 0}, position,
            [&](const ShapeMesh& mesh, const geometry::Triangle& triangle,
                const geometry::Corners& corners, double side) {
                const geometry::Tile other({corners.a, corners.b, corners.c, contact.point},
                                           mesh.coordinate(triangle));
                const double rate = glm::dot(other.face.normal, slide.direction());
                if (std::fabs(rate) <= other.slack() * other.length
                    || sees(selection, -side * rate))
                    slide.look_at(other);
            });
        slide.settle();
    }
    contact.normal = slide.normal();
    return slide.stops();
}

} // namespace

query::SweepHit brute_sweep(const std::vector<ShapeMesh>& meshes, const query::Sweep& sweep,
                            const query::Selection& selection, const Vec3d& base) {
    query::SweepHit best{kInfinity, Vec3(0), Vec3(0), 0, geometry::kNoTriangle, {}, 0};
    const geometry::Sweep test(sweep.center, sweep.axis, sweep.direction, sweep.radius);
    std::tuple first(true, kInfinity, 0.0f);
    const trace::Position position{sweep.center, base};
    for_each_triangle(meshes, selection,
                      {Vec3d(sweep.center), double(sweep.radius) + length(sweep.axis),
                       Vec3d(sweep.direction), sweep.t_max},
                      position,
                      [&](const ShapeMesh& mesh, const geometry::Triangle& triangle,
                          const geometry::Corners& corners, double side) {
                          geometry::Contact contact;
                          if (!geometry::sweep_triangle(test, corners, contact)
                              || !sees(selection, -side * contact.rate)
                              || !(float(contact.t) <= sweep.t_max))
                              return;
                          const auto t = float(contact.t), depth = float(contact.depth);
                          const auto place = std::tuple(!contact.initial, t, -depth);
                          if (!(place < first)) return;
                          if (selection.skip_separating
                              && !stops(meshes, test, sweep.t_max, selection, position,
                                        {corners, mesh.coordinate(triangle)}, contact))
                              return;
                          first = place;
                          best = {t,
                                  Vec3(Vec3d(sweep.center) + contact.point),
                                  Vec3(contact.normal),
                                  depth,
                                  triangle.primitive,
                                  mesh.handle,
                                  contact.initial};
                      });
    return best;
}

std::vector<query::OverlapHit> brute_overlap(const std::vector<ShapeMesh>& meshes,
                                             const query::Shape& shape,
                                             const query::Selection& selection, const Vec3d& base) {
    const bool is_capsule = shape.kind == query::Shape::capsule && shape.extent != Vec3(0);
    const double rr = double(shape.radius) * double(shape.radius);
    const double radius = shape.kind == query::Shape::sphere ? shape.radius
                          : shape.kind == query::Shape::box
                              ? length(shape.extent)
                              : double(shape.radius) + length(shape.extent);
    const geometry::Cuboid box = query::cuboid_of(shape);
    std::vector<query::OverlapHit> hits;
    for_each_triangle(
        meshes, selection, {Vec3d(shape.center), radius, Vec3d(0), 0}, {shape.center, base},
        [&](const ShapeMesh& mesh, const geometry::Triangle& triangle,
            const geometry::Corners& corners, double side) {
            const geometry::Face face = geometry::face_of(corners);
            const bool touches =
                shape.kind == query::Shape::box ? geometry::touches(box, corners)
                : is_capsule
                    ? geometry::nearest_to_segment(corners, face, Vec3d(shape.extent)).square <= rr
                    : geometry::nearest_to_origin(corners, face).square <= rr;
            if (touches && sees_centre(selection, corners, side))
                hits.push_back({mesh.handle, triangle.primitive, 0});
        });
    return hits;
}

query::NearestPoint brute_nearest(const std::vector<ShapeMesh>& meshes, const query::Point& point,
                                  const query::Selection& selection, const Vec3d& base) {
    query::NearestPoint best{kInfinity, Vec3(0), Vec3(0), 0, 0, geometry::kNoTriangle, {}};
    for_each_triangle(meshes, selection, {Vec3d(point.position), point.radius, Vec3d(0), 0},
                      {point.position, base},
                      [&](const ShapeMesh& mesh, const geometry::Triangle& triangle,
                          const geometry::Corners& corners, double side) {
                          const geometry::Face face = geometry::face_of(corners);
                          const geometry::NearestOnTriangle nearest(corners, face);
                          const auto distance = float(std::sqrt(nearest.square));
                          if (!(distance <= point.radius) || !(distance < best.distance)
                              || !sees_centre(selection, corners, side))
                              return;
                          const Vec3d away =
                              nearest.at == Vec3d(0) ? side * face.normal : -nearest.at;
                          best = {distance,
                                  Vec3(Vec3d(point.position) + nearest.at),
                                  Vec3(geometry::unit_or_zero(away)),
                                  float(nearest.u),
                                  float(nearest.v),
                                  triangle.primitive,
                                  mesh.handle};
                      });
    return best;
}

ShapeCases::ShapeCases(std::vector<geometry::Triangle> triangles, uint32_t seed)
    : triangles_(std::move(triangles)), random_(seed) {
    for (const geometry::Triangle& t : triangles_) bounds_.extend(geometry::bounds(t));
    diagonal_ = float(glm::length(Vec3d(bounds_.upper) - Vec3d(bounds_.lower)));
}

Vec3 ShapeCases::inside() {
    Vec3 p;
    for (int k = 0; k < 3; ++k)
        p[k] = bounds_.lower[k] + (bounds_.upper[k] - bounds_.lower[k]) * std::fabs(unit());
    return p;
}

// Anywhere, at a vertex, on or beside a triangle, on the outside.
Vec3 ShapeCases::place() {
    const geometry::Triangle& t = triangles_[pick(triangles_.size())];
    switch (pick(8)) {
    case 0:
        return t.v0;
    case 1:
    case 2: {
        const float u = std::fabs(unit()), v = (1 - u) * std::fabs(unit());
        return t.v0 + u * (t.v1 - t.v0) + v * (t.v2 - t.v0)
               + (diagonal_ * 0.01f * unit()) * Vec3(unit(), unit(), unit());
    }
    case 3:
        return inside() + diagonal_ * Vec3(unit(), unit(), unit());
    default:
        return inside();
    }
}

float ShapeCases::radius() {
    switch (pick(6)) {
    case 0:
        return 0;
    case 1:
        return diagonal_ * 1e-5f * std::fabs(unit());
    case 2:
        return diagonal_ * 0.2f * std::fabs(unit());
    default:
        return diagonal_ * 0.005f * std::fabs(unit());
    }
}

// In lengths of the diagonal; sometimes parallel to axes, to edges, or aimed at a vertex.
Vec3 ShapeCases::direction() {
    const geometry::Triangle& t = triangles_[pick(triangles_.size())];
    Vec3 d(unit(), unit(), unit());
    switch (pick(8)) {
    case 0:
        d = Vec3(0);
        d[int(pick(3))] = pick(2) ? 1.0f : -1.0f;
        break;
    case 1:
        d[int(pick(3))] = 0;
        break;
    case 2:
        d = (t.v1 - t.v0) / diagonal_;
        break;
    default:
        break;
    }
    return d == Vec3(0) ? Vec3(0, -1, 0) : d;
}

query::Sweep ShapeCases::sweep() {
    query::Sweep sweep{place(), radius(), Vec3(0), 0.2f, diagonal_ * direction(), 0};
    if (pick(2)) sweep.axis = diagonal_ * (0.03f * std::fabs(unit())) * direction();
    switch (pick(8)) {
    case 0:
        sweep.t_max = kInfinity;
        break;
    case 1:
        sweep.t_max = 0;
        break;
    case 2:
        sweep.direction *= 1e6f;
        break;
    case 3:
        sweep.direction *= 1e-3f;
        sweep.t_max = 1e3f;
        break;
    default:
        break;
    }
    return sweep;
}

query::Shape ShapeCases::shape() {
    query::Shape shape{place(), radius(), Vec3(0), uint32_t(pick(3)), {0, 0, 0, 1}};
    shape.extent = diagonal_ * 0.03f * std::fabs(unit()) * direction();
    if (shape.kind != query::Shape::box) return shape;
    shape.extent = glm::abs(shape.extent);
    if (pick(3))
        for (float& part : shape.rotation) part = unit();
    return shape;
}

query::Point ShapeCases::point() {
    return {place(), pick(4) == 0 ? 4 * diagonal_ : radius()};
}

} // namespace peregrine::test
