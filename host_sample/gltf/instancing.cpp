#include "instancing.h"

#include <cmath>

#include "../animation/pose.h"
#include "../error.h"
#include "value.h"

namespace host::gltf {

namespace {

constexpr const char* extension_name = "EXT_mesh_gpu_instancing";
constexpr uint64_t matrix_numbers = 16;

// What an instance has not is that of Local.
struct Attributes {
    const Accessor *translation = nullptr, *rotation = nullptr, *scale = nullptr;
    uint64_t count = 0;
};

const Accessor* find(const tinygltf::Value& object, const char* name, int components,
                     Accessors& accessors) {
    if (!object.Has(name)) return nullptr;
    const int index = read_index(object, name);
    if (index < 0) throw InputError(std::string(extension_name) + " names no accessor for " + name);
    const Accessor& accessor = accessors.open(index);
    if (accessor.components() != components)
        throw InputError(accessor.name() + " (" + name + " of " + extension_name
                         + ") is not of type VEC" + std::to_string(components));
    return &accessor;
}

Attributes find_attributes(const tinygltf::Value& extension, Accessors& accessors) {
    if (!extension.Has("attributes") || !extension.Get("attributes").IsObject())
        throw InputError(std::string(extension_name) + " has no attributes");
    const tinygltf::Value& object = extension.Get("attributes");
    Attributes found;
    found.translation = find(object, "TRANSLATION", 3, accessors);
    found.rotation = find(object, "ROTATION", 4, accessors);
    found.scale = find(object, "SCALE", 3, accessors);
    const Accessor* first = nullptr;
    for (const Accessor* accessor : {found.translation, found.rotation, found.scale}) {
        if (!accessor) continue;
        if (!first) first = accessor;
        if (accessor->count() != first->count())
            throw InputError(first->name() + " and " + accessor->name() + " of " + extension_name
                             + " have " + std::to_string(first->count()) + " and "
                             + std::to_string(accessor->count()) + " elements");
    }
    // Instances that differ in attributes of the author's alone stand in one place: one is enough.
    found.count = first ? first->count() : 1;
    return found;
}

Local read_local(const Attributes& attributes, uint64_t i) {
    Local local;
    if (attributes.translation) local.translation = attributes.translation->read_vec3(i);
    if (attributes.scale) local.scale = attributes.scale->read_vec3(i);
    if (attributes.rotation) {
        const glm::dvec4 q(attributes.rotation->read_vec4(i));
        if (glm::dot(q, q) > 0.0) local.rotation = glm::normalize(glm::dquat(q.w, q.x, q.y, q.z));
    }
    return local;
}

bool is_finite(const glm::dmat4& matrix) {
    double sum = 0.0;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) sum += std::abs(matrix[column][row]);
    return std::isfinite(sum);
}

} // namespace

std::optional<std::vector<glm::dmat4>>
read_instances(const tinygltf::Node& node, Accessors& accessors, Budget& budget, Notes& notes) {
    const auto* extension = find_extension(node.extensions, extension_name);
    if (!extension) return std::nullopt;
    const Attributes attributes = find_attributes(*extension, accessors);
    std::vector<glm::dmat4> places;
    for (uint64_t i = 0; i < attributes.count; ++i) {
        budget.spend(matrix_numbers);
        const glm::dmat4 place = to_matrix(read_local(attributes, i));
        if (is_finite(place))
            places.push_back(place);
        else
            notes.add("instances whose place is not finite are left out");
    }
    return places;
}

} // namespace host::gltf
