#include "extent.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "budget.h"
#include "mesh_parts.h"
#include "primitive.h"
#include "skin.h"

namespace host::gltf {

namespace {

class Estimator {
public:
    Estimator(const Document& document, const NodeTree& tree, Accessors& accessors)
        : model_(document.model), tree_(tree), accessors_(accessors), budget_(document.bytes_read) {
    }

    Bounds run() {
        Bounds extent;
        for (const uint32_t node : tree_.scene_nodes)
            if (model_.nodes[node].mesh >= 0)
                grow(extent, mesh_box(model_.nodes[node].mesh), place_of(node));
        return extent;
    }

private:
    glm::dmat4 place_of(uint32_t node) {
        const int skin_index = model_.nodes[node].skin;
        if (skin_index < 0) return tree_.world[node];
        const Skin skin = read_skin(model_, accessors_, skin_index);
        budget_.spend(skin.nodes.size());
        if (skin.nodes.empty()) return tree_.world[node];
        return tree_.world[skin.nodes[0]] * skin.inverse_bind[0];
    }

    const Bounds& mesh_box(int mesh) {
        const auto [entry, added] = meshes_.try_emplace(mesh);
        if (added)
            for (const tinygltf::Primitive& primitive : checked_mesh(model_, mesh).primitives)
                if (is_triangles(primitive.mode))
                    grow(entry->second, primitive_box(primitive), glm::dmat4(1.0));
        return entry->second;
    }

    Bounds primitive_box(const tinygltf::Primitive& primitive) {
        const auto attribute = primitive.attributes.find("POSITION");
        if (attribute == primitive.attributes.end()) return {};
        const auto [entry, added] = boxes_.try_emplace(attribute->second);
        if (!added) return entry->second;
        const Accessor& positions = accessors_.open(attribute->second);
        budget_.spend(positions.count());
        for (uint64_t i = 0; i < positions.count(); ++i)
            grow(entry->second, glm::dvec3(positions.read_vec3(i)));
        return entry->second;
    }

    const tinygltf::Model& model_;
    const NodeTree& tree_;
    Accessors& accessors_;
    Budget budget_;                        // of its own: this reads what is read again
    std::map<int, Bounds> boxes_, meshes_; // by accessor, by mesh
};

} // namespace

Bounds estimate_extent(const Document& document, const NodeTree& tree, Accessors& accessors) {
    return Estimator(document, tree, accessors).run();
}

// At 256 times its half size from the origin, a scene has 16 of a float's 24 bits left. A grid as
// coarse as the scene is keeps the numbers round and costs a bit at most.
glm::dvec3 choose_origin(const Bounds& extent) {
    constexpr double far = 256.0, farthest = 1e29; // the engine takes 1e30
    if (extent.empty()) return glm::dvec3(0.0);
    const auto largest = [](const glm::dvec3& v) {
        return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    };
    const double half_size = 0.5 * largest(extent.upper - extent.lower);
    const double distance = largest(extent.center());
    const bool is_far = distance > far * half_size && distance < farthest;
    if (!(half_size > 0.0) || !is_far) return glm::dvec3(0.0);
    const double grid = std::exp2(std::floor(std::log2(std::max(half_size, distance * 0x1p-50))));
    return glm::round(extent.center() / grid) * grid;
}

} // namespace host::gltf
