#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "document.h"
#include <glm/glm.hpp>

namespace host::gltf {

// The bytes of a buffer view, checked against its buffer. Throws InputError.
Bytes view_bytes(const Document& document, int buffer_view, const std::string& user);

// One accessor whose every element is known to lie within its buffer, sparse ones included.
class Accessor {
public:
    // Throws InputError if any element would lie outside.
    Accessor(const Document& document, int index);

    uint64_t count() const { return count_; }
    int components() const { return components_; }
    const std::string& name() const { return name_; }

    // Components that the accessor does not have read as 0. `element` must be below count().
    float read(uint64_t element, int component) const;
    uint32_t read_index(uint64_t element) const; // for integer accessors
    bool is_unsigned_integer() const;

    glm::vec2 read_vec2(uint64_t i) const { return {read(i, 0), read(i, 1)}; }
    glm::vec3 read_vec3(uint64_t i) const { return {read(i, 0), read(i, 1), read(i, 2)}; }
    glm::vec4 read_vec4(uint64_t i) const {
        return {read(i, 0), read(i, 1), read(i, 2), read(i, 3)};
    }
    glm::mat4 read_mat4(uint64_t i) const;

private:
    void open_dense(const Document& document, const tinygltf::Accessor& accessor);
    void open_sparse(const Document& document, const tinygltf::Accessor& accessor);
    const unsigned char* find_element(uint64_t element) const; // null: zeros

    std::string name_;
    uint64_t count_ = 0;
    uint64_t stride_ = 0, component_bytes_ = 0;
    int components_ = 0, component_type_ = 0;
    bool normalized_ = false;
    const unsigned char* data_ = nullptr;  // null: all zeros
    std::vector<uint32_t> sparse_indices_; // ascending
    const unsigned char* sparse_values_ = nullptr;
};

// Opens each accessor once.
class Accessors {
public:
    explicit Accessors(const Document& document)
        : document_(document), open_(document.model.accessors.size()) {}

    // Throws InputError if there is no such accessor or it is not sound.
    const Accessor& open(int index);

private:
    const Document& document_;
    std::vector<std::unique_ptr<Accessor>> open_;
};

} // namespace host::gltf
