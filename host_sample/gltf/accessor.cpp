#include "accessor.h"

#include <algorithm>
#include <cstring>

#include "../error.h"

namespace host::gltf {

namespace {

uint64_t component_bytes(int type) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return 4;
    default:
        return 0;
    }
}

int component_count(int type) {
    switch (type) {
    case TINYGLTF_TYPE_SCALAR:
        return 1;
    case TINYGLTF_TYPE_VEC2:
        return 2;
    case TINYGLTF_TYPE_VEC3:
        return 3;
    case TINYGLTF_TYPE_VEC4:
        return 4;
    case TINYGLTF_TYPE_MAT4:
        return 16;
    default:
        return 0; // nothing that we read is a MAT2 or MAT3
    }
}

template <class T>
T load(const unsigned char* from) {
    T value;
    std::memcpy(&value, from, sizeof value); // elements need not be aligned in a hostile file
    return value;
}

// glTF 2.0, 3.6.2.2: the signed forms clamp, since -128/127 is below -1.
template <class T>
float load_integer(const unsigned char* from, bool normalized) {
    const auto value = static_cast<float>(load<T>(from));
    if (!normalized) return value;
    return std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0f);
}

uint32_t load_unsigned(const unsigned char* from, int type) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return load<uint8_t>(from);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return load<uint16_t>(from);
    default:
        return load<uint32_t>(from);
    }
}

bool is_unsigned(int type) {
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE
           || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT
           || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

// Whether `count` elements of `size` bytes, `stride` apart, fit into `available` bytes. Written
// so that nothing can overflow.
bool fits(uint64_t available, uint64_t count, uint64_t stride, uint64_t size) {
    if (count == 0) return true;
    if (size > available) return false;
    return stride == 0 || count - 1 <= (available - size) / stride;
}

} // namespace

Bytes view_bytes(const Document& document, int buffer_view, const std::string& user) {
    const tinygltf::Model& model = document.model;
    if (buffer_view < 0 || static_cast<size_t>(buffer_view) >= model.bufferViews.size())
        throw InputError(user + " names buffer view " + std::to_string(buffer_view)
                         + ", which does not exist");
    const tinygltf::BufferView& view = model.bufferViews[static_cast<size_t>(buffer_view)];
    if (view.buffer < 0 || static_cast<size_t>(view.buffer) >= document.buffers.size())
        throw InputError("buffer view " + std::to_string(buffer_view) + " names buffer "
                         + std::to_string(view.buffer) + ", which does not exist");
    const Buffer& buffer = document.buffers[static_cast<size_t>(view.buffer)];
    if (!buffer.lack.empty())
        throw InputError(user + " needs buffer " + std::to_string(view.buffer) + ", which "
                         + buffer.lack);
    const Bytes data = buffer.bytes;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
        throw InputError("buffer view " + std::to_string(buffer_view)
                         + " reaches beyond its buffer");
    return data.subspan(view.byteOffset, view.byteLength);
}

Accessor::Accessor(const Document& document, int index)
    : name_("accessor " + std::to_string(index)) {
    if (index < 0 || static_cast<size_t>(index) >= document.model.accessors.size())
        throw InputError(name_ + " is named but does not exist");
    const tinygltf::Accessor& accessor = document.model.accessors[static_cast<size_t>(index)];
    count_ = accessor.count;
    component_type_ = accessor.componentType;
    component_bytes_ = component_bytes(accessor.componentType);
    components_ = component_count(accessor.type);
    normalized_ = accessor.normalized;
    if (component_bytes_ == 0 || components_ == 0)
        throw InputError(name_ + " has an unsupported type");
    open_dense(document, accessor);
    if (accessor.sparse.isSparse) open_sparse(document, accessor);
}

void Accessor::open_dense(const Document& document, const tinygltf::Accessor& accessor) {
    const uint64_t element = component_bytes_ * static_cast<uint64_t>(components_);
    stride_ = element;
    if (accessor.bufferView < 0) {
        // Zeros cost the file nothing, so their number is bounded by what else it holds.
        if (count_ > document.bytes_read)
            throw InputError(name_ + " counts more elements than the file has bytes");
        return;
    }
    const auto bytes = view_bytes(document, accessor.bufferView, name_);
    const auto& view = document.model.bufferViews[static_cast<size_t>(accessor.bufferView)];
    if (view.byteStride != 0) stride_ = view.byteStride;
    if (accessor.byteOffset > bytes.size()
        || !fits(bytes.size() - accessor.byteOffset, count_, stride_, element))
        throw InputError(name_ + " reaches beyond its buffer view");
    data_ = bytes.data() + accessor.byteOffset;
}

void Accessor::open_sparse(const Document& document, const tinygltf::Accessor& accessor) {
    const auto& sparse = accessor.sparse;
    if (sparse.count < 0 || static_cast<uint64_t>(sparse.count) > count_
        || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
        throw InputError(name_ + " has a malformed sparse part");
    const auto count = static_cast<uint64_t>(sparse.count);
    const int type = sparse.indices.componentType;
    if (!is_unsigned(type)) throw InputError(name_ + " has sparse indices of a wrong type");

    const auto indices = view_bytes(document, sparse.indices.bufferView, name_);
    const auto values = view_bytes(document, sparse.values.bufferView, name_);
    const auto indices_offset = static_cast<uint64_t>(sparse.indices.byteOffset);
    const auto values_offset = static_cast<uint64_t>(sparse.values.byteOffset);
    const uint64_t index_bytes = component_bytes(type);
    const uint64_t element = component_bytes_ * static_cast<uint64_t>(components_);
    if (indices_offset > indices.size() || values_offset > values.size()
        || !fits(indices.size() - indices_offset, count, index_bytes, index_bytes)
        || !fits(values.size() - values_offset, count, element, element))
        throw InputError(name_ + " has a sparse part that reaches beyond its buffer view");

    sparse_indices_.reserve(count);
    for (uint64_t i = 0; i < count; ++i) {
        const uint32_t index =
            load_unsigned(indices.data() + indices_offset + i * index_bytes, type);
        if (index >= count_ || (i > 0 && index <= sparse_indices_.back()))
            throw InputError(name_ + " has sparse indices out of range or order");
        sparse_indices_.push_back(index);
    }
    sparse_values_ = values.data() + values_offset;
}

const unsigned char* Accessor::find_element(uint64_t element) const {
    if (!sparse_indices_.empty()) {
        const auto it = std::lower_bound(sparse_indices_.begin(), sparse_indices_.end(), element);
        if (it != sparse_indices_.end() && *it == element) {
            const auto position = static_cast<uint64_t>(it - sparse_indices_.begin());
            return sparse_values_
                   + position * component_bytes_ * static_cast<uint64_t>(components_);
        }
    }
    return data_ ? data_ + element * stride_ : nullptr;
}

float Accessor::read(uint64_t element, int component) const {
    if (component >= components_) return 0.0f;
    const unsigned char* from = find_element(element);
    if (!from) return 0.0f;
    from += static_cast<uint64_t>(component) * component_bytes_;
    switch (component_type_) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return load_integer<int8_t>(from, normalized_);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return load_integer<uint8_t>(from, normalized_);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return load_integer<int16_t>(from, normalized_);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return load_integer<uint16_t>(from, normalized_);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return load_integer<uint32_t>(from, normalized_);
    default:
        return load<float>(from);
    }
}

uint32_t Accessor::read_index(uint64_t element) const {
    const unsigned char* from = find_element(element);
    return from ? load_unsigned(from, component_type_) : 0;
}

bool Accessor::is_unsigned_integer() const {
    return is_unsigned(component_type_);
}

glm::mat4 Accessor::read_mat4(uint64_t i) const {
    glm::mat4 matrix(0.0f);
    for (int component = 0; component < 16; ++component)
        matrix[component / 4][component % 4] = read(i, component);
    return matrix;
}

const Accessor& Accessors::open(int index) {
    if (index < 0 || static_cast<size_t>(index) >= open_.size())
        throw InputError("accessor " + std::to_string(index) + " is named but does not exist");
    auto& slot = open_[static_cast<size_t>(index)];
    if (!slot) slot = std::make_unique<Accessor>(document_, index);
    return *slot;
}

} // namespace host::gltf
