#include "primitive.h"

#include <algorithm>

#include "../error.h"

namespace host::gltf {

namespace {

// The vertices of all triangles, three each, as the mode strings them together.
std::vector<uint32_t> to_triangles(const std::vector<uint32_t>& corners, int mode) {
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        auto list = corners;
        list.resize(corners.size() - corners.size() % 3);
        return list;
    }
    std::vector<uint32_t> list;
    if (corners.size() < 3) return list;
    list.reserve((corners.size() - 2) * 3);
    for (size_t i = 0; i + 2 < corners.size(); ++i) {
        const bool fan = mode == TINYGLTF_MODE_TRIANGLE_FAN;
        // glTF 2.0, 3.7.2.1: every other triangle of a strip runs the other way round.
        const size_t a = fan ? 0 : i;
        const size_t b = fan ? i + 1 : i + 1 + i % 2;
        const size_t c = fan ? i + 2 : i + 2 - i % 2;
        list.insert(list.end(), {corners[a], corners[b], corners[c]});
    }
    return list;
}

std::vector<uint32_t> read_corners(Accessors& accessors, const tinygltf::Primitive& source,
                                   uint64_t vertex_count, Budget& budget) {
    std::vector<uint32_t> corners;
    if (source.indices < 0) {
        budget.spend(vertex_count / 3);
        corners.resize(vertex_count);
        for (uint32_t i = 0; i < vertex_count; ++i) corners[i] = i;
        return corners;
    }
    const Accessor& indices = accessors.open(source.indices);
    if (!indices.is_unsigned_integer() || indices.components() != 1)
        throw InputError(indices.name() + " holds indices but is not of an unsigned scalar type");
    budget.spend(indices.count() / 3);
    corners.resize(indices.count());
    for (uint64_t i = 0; i < corners.size(); ++i) {
        corners[i] = indices.read_index(i);
        if (corners[i] >= vertex_count)
            throw InputError(indices.name() + " holds the index " + std::to_string(corners[i])
                             + ", but there are " + std::to_string(vertex_count) + " vertices");
    }
    return corners;
}

// Exporters often share one large vertex buffer between many primitives; each keeps its own part.
void keep_used_vertices(Primitive& primitive) {
    primitive.vertices = primitive.indices;
    std::sort(primitive.vertices.begin(), primitive.vertices.end());
    primitive.vertices.erase(std::unique(primitive.vertices.begin(), primitive.vertices.end()),
                             primitive.vertices.end());
    for (uint32_t& index : primitive.indices) {
        const auto it =
            std::lower_bound(primitive.vertices.begin(), primitive.vertices.end(), index);
        index = static_cast<uint32_t>(it - primitive.vertices.begin());
    }
}

template <class T, class Read>
std::vector<T> gather(const std::vector<uint32_t>& vertices, const Accessor* accessor,
                      const Read& read) {
    std::vector<T> values;
    if (!accessor) return values;
    values.reserve(vertices.size());
    for (const uint32_t vertex : vertices) values.push_back((accessor->*read)(vertex));
    return values;
}

// A tangent's w, the handedness, is not morphed.
template <class T>
void add_deltas(std::vector<T>& values, const std::vector<uint32_t>& vertices,
                const Accessor* deltas, float weight) {
    if (!deltas) return;
    for (size_t i = 0; i < values.size(); ++i) {
        const glm::vec3 delta = weight * deltas->read_vec3(vertices[i]);
        for (int axis = 0; axis < 3; ++axis) values[i][axis] += delta[axis];
    }
}

void morph(Accessors& accessors, const tinygltf::Primitive& source, std::span<const double> weights,
           uint64_t vertex_count, Primitive& primitive) {
    const size_t targets = std::min(source.targets.size(), weights.size());
    for (size_t i = 0; i < targets; ++i) {
        const auto weight = static_cast<float>(weights[i]);
        if (weight == 0.0f) continue;
        const auto find = [&](const char* name) {
            return find_attribute(accessors, source.targets[i], name, vertex_count);
        };
        add_deltas(primitive.positions, primitive.vertices, find("POSITION"), weight);
        add_deltas(primitive.normals, primitive.vertices, find("NORMAL"), weight);
        add_deltas(primitive.tangents, primitive.vertices, find("TANGENT"), weight);
    }
}

} // namespace

bool is_triangles(int mode) {
    return mode == TINYGLTF_MODE_TRIANGLES || mode == TINYGLTF_MODE_TRIANGLE_STRIP
           || mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

const Accessor* find_attribute(Accessors& accessors, const std::map<std::string, int>& attributes,
                               const char* name, uint64_t vertex_count) {
    const auto it = attributes.find(name);
    if (it == attributes.end()) return nullptr;
    const Accessor& accessor = accessors.open(it->second);
    if (accessor.count() < vertex_count)
        throw InputError(accessor.name() + " (" + name + ") has fewer elements than the "
                         + std::to_string(vertex_count) + " positions");
    return &accessor;
}

std::optional<Primitive> read_primitive(Accessors& accessors, const tinygltf::Primitive& source,
                                        std::span<const double> weights, Budget& budget,
                                        Notes& notes) {
    budget.spend(0);
    if (!is_triangles(source.mode)) {
        notes.add("points and lines are not drawn");
        return std::nullopt;
    }
    const Accessor* positions = find_attribute(accessors, source.attributes, "POSITION", 0);
    if (!positions) return std::nullopt;
    if (positions->components() != 3) throw InputError(positions->name() + " is not of type VEC3");
    if (positions->count() > (uint64_t{1} << 30))
        throw InputError(positions->name() + " counts more than 2^30 vertices");
    const uint64_t count = positions->count();
    const auto find = [&](const char* name) {
        return find_attribute(accessors, source.attributes, name, count);
    };
    if (find("COLOR_0")) notes.add("vertex colours are ignored");

    Primitive primitive;
    primitive.indices = to_triangles(read_corners(accessors, source, count, budget), source.mode);
    budget.spend(primitive.indices.size() / 3);
    keep_used_vertices(primitive);
    const auto& used = primitive.vertices;
    primitive.positions = gather<glm::vec3>(used, positions, &Accessor::read_vec3);
    primitive.normals = gather<glm::vec3>(used, find("NORMAL"), &Accessor::read_vec3);
    primitive.tangents = gather<glm::vec4>(used, find("TANGENT"), &Accessor::read_vec4);
    primitive.texcoords = gather<glm::vec2>(used, find("TEXCOORD_0"), &Accessor::read_vec2);
    primitive.texcoords1 = gather<glm::vec2>(used, find("TEXCOORD_1"), &Accessor::read_vec2);
    if (primitive.normals.empty()) primitive.tangents.clear(); // glTF 2.0, 3.7.2.1
    morph(accessors, source, weights, count, primitive);
    return primitive;
}

} // namespace host::gltf
