#include "support/query_world.h"

#include "geometry/crossing.h"
#include "support/world.h"
#include "trace/world/world.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <tuple>

namespace peregrine::test {

using math::Ray;
using math::Vec3;

size_t QueryWorld::add(const std::vector<geometry::Triangle>& triangles, scene::MeshKind kind,
                       uint32_t layer_mask, base::Handle material) {
    const auto surface = std::make_shared<scene::MeshSurface>(&scene.memory);
    surface->material = {material.index, material.generation};
    const auto data = std::make_shared<scene::MeshData>(surface, &scene.memory);
    Part part{{}, {}, kind, layer_mask, {}, {}};
    for (const geometry::Triangle& triangle : triangles) {
        const auto first = uint32_t(data->positions.size());
        surface->triangles.push_back({first, first + 1, first + 2});
        for (const Vec3& corner : {triangle.v0, triangle.v1, triangle.v2}) {
            data->positions.push_back(corner);
            data->normals.push_back(corner + Vec3(0.1f, 0.2f, 0.3f));
            surface->texcoords.push_back({corner.x, corner.y + corner.z});
        }
        part.triangles.push_back(triangle);
        part.triangles.back().primitive = first / 3;
    }
    scene::MeshDescription mesh;
    mesh.data = data;
    mesh.kind = kind;
    mesh.layer_mask = layer_mask;
    mesh.user_data = 1000 + parts.size();
    if (kind != scene::MeshKind::fixed) mesh.shape = std::make_shared<scene::Shape>();
    part.mesh = scene.meshes.insert(std::move(mesh));
    scene.touch_triangles(kind);
    parts.push_back(std::move(part));
    return parts.size() - 1;
}

size_t QueryWorld::add(const ClosedMesh& mesh, scene::MeshKind kind, const Vec3& offset,
                       float scale) {
    TriangleList list;
    const auto at = [&](uint32_t i) { return scale * mesh.vertices[i] + offset; };
    for (const auto& [a, b, c] : mesh.faces) list.add(at(a), at(b), at(c));
    return add(list.triangles, kind);
}

size_t QueryWorld::add_instance(size_t of) {
    scene::MeshDescription mesh = *scene.meshes.find(parts[of].mesh);
    Part part = parts[of];
    part.mesh = scene.meshes.insert(std::move(mesh));
    parts.push_back(std::move(part));
    return parts.size() - 1;
}

void QueryWorld::place(size_t i, const math::Affine& to_world) {
    Part& part = parts[i];
    part.to_world = to_world;
    part.to_local = math::inverse(to_world);
    scene::MeshDescription& mesh = *scene.meshes.find(part.mesh);
    mesh.placement = {to_world, part.to_local, to_world.norm() * part.to_local.norm(),
                      math::determinant(to_world) < 0};
    mesh.extent_is_known = false;
}

void QueryWorld::commit(trace::Structure structure, accel::bvh::Quality quality, bool compact) {
    scene::CommitOptions options;
    options.build.structure = structure;
    options.build.quality = quality;
    options.build.compact = compact;
    scene.commit(options);
}

std::vector<geometry::Triangle> QueryWorld::triangles() const {
    std::vector<geometry::Triangle> all;
    for (const Part& part : parts)
        for (geometry::Triangle triangle : part.triangles) {
            for (Vec3* v : {&triangle.v0, &triangle.v1, &triangle.v2})
                if (part.kind == scene::MeshKind::rigid)
                    *v = Vec3(part.to_world.point(math::Vec3d(*v)));
            all.push_back(triangle);
        }
    return all;
}

std::vector<query::Hit> QueryWorld::crossings(const Ray& ray, const Takes& takes,
                                              const math::Vec3d& base) const {
    return collect(ray, base, takes, true);
}

std::vector<query::Hit> QueryWorld::hits(const Ray& ray, const Takes& takes,
                                         const math::Vec3d& base) const {
    return collect(ray, base, takes, false);
}

std::vector<query::Hit> QueryWorld::collect(const Ray& record, const math::Vec3d& base,
                                            const Takes& takes, bool crossings) const {
    std::vector<query::Hit> found;
    const trace::Position position{record.origin, base};
    const Ray ray = query::Shift{base}.applied(record);
    for (const Part& part : parts) {
        Ray local = ray;
        if (part.kind == scene::MeshKind::rigid
            && !trace::to_local(part.to_local, position.from(part.to_world.offset), ray, local))
            continue;
        const geometry::ShearedRay sheared = geometry::shear(local);
        for (const auto& [v0, mesh, v1, primitive, v2, flags] : part.triangles) {
            geometry::TriangleHit hit;
            if (!geometry::intersect(sheared, v0, v1, v2, hit)
                || (crossings && !geometry::is_crossed(sheared, v0, v1, v2)))
                continue;
            const query::Hit candidate{hit.t, hit.u, hit.v, primitive, part.mesh, 0, hit.back_face};
            if (takes(candidate)) found.push_back(candidate);
        }
    }
    std::sort(found.begin(), found.end(), [](const query::Hit& a, const query::Hit& b) {
        return std::tie(a.t, a.back_face, a.mesh.index, a.triangle)
               < std::tie(b.t, b.back_face, b.mesh.index, b.triangle);
    });
    return found;
}

math::Affine random_placement(std::mt19937& random, double spread) {
    std::uniform_real_distribution<double> unit(-1, 1);
    const double scale = std::exp2(unit(random));
    math::Affine to_world;
    do {
        for (auto& column : to_world.column)
            column = scale * math::Vec3d(unit(random), unit(random), unit(random));
        to_world.offset = spread * math::Vec3d(unit(random), unit(random), unit(random));
    } while (std::abs(math::determinant(to_world)) < 0.1 * scale * scale * scale);
    return to_world;
}

bool same_hits(const query::Hit* a, const query::Hit* b, size_t count) {
    return count == 0 || std::memcmp(a, b, count * sizeof *a) == 0;
}

query::Rays rays_of(const std::vector<Ray>& rays) {
    return {rays.size(), reinterpret_cast<const std::byte*>(rays.data()), sizeof(Ray), {}, {}};
}

} // namespace peregrine::test
