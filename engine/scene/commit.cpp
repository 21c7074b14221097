#include "scene/scene.h"

#include "accel/bih/builder.h"
#include "accel/bvh/builder.h"
#include "accel/kdtree/builder.h"
#include "base/error.h"
#include "scene/collect.h"
#include "scene/draft.h"
#include "scene/resolve.h"

#include <chrono>

namespace peregrine::scene {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

template <class T>
uint64_t bytes_of(const base::Vector<T>& vector) {
    return vector.size() * sizeof(T);
}

uint64_t attribute_bytes(const Snapshot& snapshot) {
    uint64_t bytes = 0;
    for (const Snapshot::Mesh& mesh : snapshot.meshes) {
        if (!mesh.data) continue;
        const MeshData& data = *mesh.data;
        bytes += bytes_of(data.positions) + bytes_of(data.normals) + bytes_of(data.tangents)
                 + bytes_of(data.texcoords) + bytes_of(data.texcoords1) + bytes_of(data.triangles)
                 + bytes_of(data.materials) + bytes_of(mesh.materials);
    }
    return bytes;
}

uint64_t texture_bytes(const Snapshot& snapshot) {
    uint64_t bytes = 0;
    for (const auto& texture : snapshot.textures) bytes += bytes_of(texture->texels);
    return bytes;
}

} // namespace

BuildChoice BuildChoice::relevant() const {
    BuildChoice choice;
    choice.structure = structure;
    if (structure == trace::Structure::bvh) choice.quality = quality;
    if (structure == trace::Structure::kdtree) choice.empty_bonus = empty_bonus;
    return choice;
}

std::shared_ptr<const Geometry> Scene::current_geometry(const Snapshot& snapshot,
                                                        const CommitOptions& options) {
    if (geometry_ && !geometry_changed_ && geometry_build_ == options.build.relevant())
        return geometry_;
    const auto geometry =
        std::allocate_shared<Geometry>(std::pmr::polymorphic_allocator<Geometry>(&memory), &memory);
    collect_triangles(snapshot, *geometry);
    geometry->structure = options.build.structure;
    if (geometry->structure == trace::Structure::kdtree) {
        accel::kdtree::BuildOptions build;
        build.empty_bonus = options.build.empty_bonus;
        geometry->kdtree =
            accel::kdtree::build(geometry->triangles, build, scheduler, options.progress, &memory);
    } else if (geometry->structure == trace::Structure::bih) {
        geometry->bih =
            accel::bih::build(geometry->triangles, {}, scheduler, options.progress, &memory);
    } else {
        accel::bvh::BuildOptions build;
        build.quality = options.build.quality;
        geometry->bvh =
            accel::bvh::build(geometry->triangles, build, scheduler, options.progress, &memory);
        geometry->triangles = base::Vector<geometry::Triangle>(&memory);
    }
    return geometry;
}

CommitReport Scene::commit(const CommitOptions& options) {
    const Clock::time_point start = Clock::now();
    snapshots.reserve();
    Draft draft(snapshots);
    Snapshot& snapshot = *draft;
    resolve(*this, snapshot);
    snapshot.version = version_ + 1;
    snapshot.features = features_of(snapshot);
    snapshot.geometry = current_geometry(snapshot, options);
    snapshot.target = snapshot.geometry->target();
    snapshot.kernels = trace::select_kernels(snapshot.geometry->structure, isa_);
    if (options.progress.cancels(1.0f))
        base::fail(base::Code::cancelled, "the commit was cancelled by its progress callback");

    CommitReport report;
    report.geometry = snapshot.geometry;
    report.build = options.build;
    report.features = snapshot.features;
    report.bytes_attributes = attribute_bytes(snapshot);
    report.bytes_textures = texture_bytes(snapshot);
    report.light_count = uint32_t(snapshot.lights.size());
    report.rebuilt = snapshot.geometry != geometry_;

    // Nothing below can fail.
    geometry_ = snapshot.geometry;
    geometry_changed_ = false;
    geometry_build_ = options.build.relevant();
    ++version_;
    draft.publish();
    report.commit_ms = ms_since(start);
    return report;
}

} // namespace peregrine::scene
