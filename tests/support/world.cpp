#include "support/world.h"

#include "geometry/area.h"
#include "gltf/import.h"
#include "level.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <tuple>

namespace peregrine::test {

World::World(std::vector<geometry::Triangle> list, uint32_t threads) : triangles(std::move(list)) {
    std::sort(triangles.begin(), triangles.end(),
              [](const geometry::Triangle& a, const geometry::Triangle& b) {
                  return std::tie(a.mesh, a.primitive) < std::tie(b.mesh, b.primitive);
              });
    for (const geometry::Triangle& triangle : triangles) infos.push_back(triangle.info());
    base::Scheduler scheduler(threads, {}, &memory);
    kdtree = accel::kdtree::build(triangles, {}, scheduler, {}, &memory);
    bvh = accel::bvh::build(triangles, {}, scheduler, {}, &memory);
    compact_bvh = accel::bvh::compact(bvh, scheduler, &memory);
    bih = accel::bih::build(triangles, {}, scheduler, {}, &memory);
}

void TriangleList::add(const math::Vec3& v0, const math::Vec3& v1, const math::Vec3& v2) {
    const uint32_t primitive = next_++;
    if (geometry::is_usable(v0) && geometry::is_usable(v1) && geometry::is_usable(v2)
        && geometry::has_area(v0, v1, v2))
        triangles.push_back({v0, 0, v1, primitive, v2, 0});
}

std::vector<geometry::Triangle> soup(uint32_t seed, size_t count, float size, float scale) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(-1, 1);
    const auto point = [&] { return math::Vec3(unit(random), unit(random), unit(random)); };
    TriangleList list;
    for (size_t i = 0; i < count; ++i) {
        const math::Vec3 center = point();
        list.add(scale * (center + size * point()), scale * (center + size * point()),
                 scale * (center + size * point()));
    }
    return list.triangles;
}

std::string scenes_folder() {
    namespace fs = std::filesystem;
    if (const char* folder = std::getenv("PEREGRINE_SCENES")) return folder;
    const fs::path beside = fs::path(PEREGRINE_SOURCE_DIR) / ".." / "shared" / "scenes";
    return fs::is_directory(beside) ? beside.string() : std::string();
}

std::vector<std::string> scene_names() {
    std::vector<std::string> names;
    const std::string folder = scenes_folder();
    if (folder.empty()) return names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".glb") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

namespace {

std::string path_of(const std::string& name) {
    return name == "hall" ? std::string(PEREGRINE_SOURCE_DIR) + "/content/hall.glb"
                          : scenes_folder() + "/" + name + ".glb";
}

} // namespace

std::vector<std::string> scene_files() {
    std::vector<std::string> files{path_of("hall")};
    for (const std::string& name : scene_names()) files.push_back(path_of(name));
    return files;
}

SceneFile load_scene(const std::string& name) {
    return load_file(path_of(name));
}

SceneFile load_file(const std::string& path) {
    const host::Level level = host::gltf::import_file(path);
    SceneFile scene;
    for (const host::Mesh& mesh : level.meshes) {
        TriangleList list;
        for (size_t i = 0; i < mesh.indices.size(); i += 3)
            list.add(mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]],
                     mesh.positions[mesh.indices[i + 2]]);
        for (geometry::Triangle triangle : list.triangles) {
            triangle.mesh = uint32_t(&mesh - level.meshes.data());
            scene.triangles.push_back(triangle);
        }
    }
    for (const host::Viewpoint& camera : level.cameras)
        scene.eyes.push_back({math::Vec3(camera.position), camera.forward});
    for (const host::Light& light : level.lights)
        if (light.type != host::LightType::directional)
            scene.lights.push_back(math::Vec3(light.position));
    return scene;
}

size_t rays_per_set(size_t otherwise) {
    const char* text = std::getenv("PEREGRINE_RAYS");
    return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

} // namespace peregrine::test
