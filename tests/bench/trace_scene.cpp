#include "trace_scene.h"

#include "cameras.h"
#include "gltf/import.h"
#include "support/world.h"

#include <filesystem>
#include <stdexcept>

namespace peregrine::bench {
namespace {

constexpr size_t kCameras = 2;

} // namespace

TraceScene load_trace_scene(const std::string& file) {
    const host::Level level = host::gltf::import_file(file);
    TraceScene scene;
    scene.name = std::filesystem::path(file).stem().string();
    test::TriangleList list;
    for (const host::Mesh& mesh : level.meshes)
        for (size_t i = 0; i < mesh.indices.size(); i += 3)
            list.add(mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]],
                     mesh.positions[mesh.indices[i + 2]]);
    if (list.triangles.empty()) throw std::runtime_error(file + " has no triangles");
    scene.triangles = std::move(list.triangles);
    for (const geometry::Triangle& triangle : scene.triangles)
        scene.bounds.extend(geometry::bounds(triangle));
    scene.cameras = host::usable_cameras(level);
    if (scene.cameras.size() > kCameras) scene.cameras.resize(kCameras);
    for (const host::Light& light : level.lights)
        if (light.type != host::LightType::directional)
            scene.lights.push_back(math::Vec3(light.position));
    return scene;
}

} // namespace peregrine::bench
