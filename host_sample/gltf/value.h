#pragma once

#include <cmath>
#include <optional>
#include <string>

#include <glm/glm.hpp>
#include <tiny_gltf.h>

// Reading the loosely typed parts of a document: extensions.
namespace host::gltf {

inline const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& map, const char* name) {
    const auto it = map.find(name);
    return it != map.end() && it->second.IsObject() ? &it->second : nullptr;
}

inline std::optional<double> read_number(const tinygltf::Value& object, const char* key) {
    if (!object.IsObject() || !object.Has(key)) return std::nullopt;
    const tinygltf::Value& value = object.Get(std::string(key));
    if (!value.IsNumber()) return std::nullopt;
    return value.GetNumberAsDouble();
}

// -1 for anything that is no index.
inline int read_index(const tinygltf::Value& object, const char* key) {
    const double number = read_number(object, key).value_or(-1.0);
    const bool index = number >= 0.0 && number < 2147483648.0 && number == std::trunc(number);
    return index ? static_cast<int>(number) : -1;
}

inline glm::dvec2 read_pair(const tinygltf::Value& object, const char* key, glm::dvec2 otherwise) {
    if (!object.IsObject() || !object.Has(key)) return otherwise;
    const tinygltf::Value& value = object.Get(std::string(key));
    if (!value.IsArray() || value.ArrayLen() != 2) return otherwise;
    if (!value.Get(0).IsNumber() || !value.Get(1).IsNumber()) return otherwise;
    return {value.Get(0).GetNumberAsDouble(), value.Get(1).GetNumberAsDouble()};
}

inline glm::dvec3 read_triple(const tinygltf::Value& object, const char* key,
                              glm::dvec3 otherwise) {
    if (!object.IsObject() || !object.Has(key)) return otherwise;
    const tinygltf::Value& value = object.Get(std::string(key));
    if (!value.IsArray() || value.ArrayLen() != 3) return otherwise;
    glm::dvec3 triple;
    for (int i = 0; i < 3; ++i) {
        if (!value.Get(i).IsNumber()) return otherwise;
        triple[i] = value.Get(i).GetNumberAsDouble();
    }
    return triple;
}

// A factor of a material: finite and not negative.
inline float to_factor(double value) {
    if (!std::isfinite(value) || value < 0.0) return 0.0f;
    return static_cast<float>(value > 1e6 ? 1e6 : value);
}

} // namespace host::gltf
