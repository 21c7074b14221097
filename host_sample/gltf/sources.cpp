#include "sources.h"

#include <string>

#include "../error.h"
#include "quote.h"
#include "uri.h"

namespace host::gltf {

namespace {

using nlohmann::json;

const json* find(const json& object, const char* key) {
    const auto found = object.find(key);
    return found == object.end() ? nullptr : &*found;
}

// Empty: none.
std::string text_of(const json& object, const char* key) {
    const json* value = find(object, key);
    return value && value->is_string() ? value->get<std::string>() : "";
}

// The elements of an array of the root; none if there is no such array.
const json& array_of(const json& root, const char* key) {
    static const json none = json::array();
    const json* value = find(root, key);
    return value && value->is_array() ? *value : none;
}

uint64_t length_of(const json& object, const std::string& name) {
    const json* length = find(object, "byteLength");
    if (!length || !length->is_number_integer()) throw InputError(name + " has no byteLength");
    return length->get<uint64_t>();
}

Buffer read_buffer(const json& object, size_t index, std::optional<std::string_view> bin,
                   Resources& resources) {
    std::string name = "buffer " + std::to_string(index);
    if (!object.is_object()) throw InputError(name + " is not an object");
    const uint64_t length = length_of(object, name);
    const std::string uri = text_of(object, "uri");
    Buffer buffer;
    if (!uri.empty()) {
        name += " (" + describe_uri(uri) + ")";
        try {
            buffer.bytes = resources.load(uri);
        } catch (const InputError& error) {
            throw InputError(name + " cannot be read: " + error.what());
        }
    } else if (index == 0 && bin) {
        name += " (the BIN chunk)";
        buffer.bytes = resources.keep(std::string(*bin));
    } else {
        return {{}, "has no uri, and so no bytes"};
    }
    if (buffer.bytes.size() < length)
        throw InputError(name + " holds " + std::to_string(buffer.bytes.size())
                         + " bytes, fewer than its byteLength of " + std::to_string(length));
    buffer.bytes = buffer.bytes.first(length);
    return buffer;
}

ImageSource read_image(const json& object, Resources& resources) {
    if (!object.is_object()) return {"", -1, {}, "it is not an object"};
    const std::string uri = text_of(object, "uri");
    const json* view = find(object, "bufferView");
    ImageSource image;
    image.name = quote(text_of(object, "name"));
    if (!uri.empty()) image.name += (image.name.empty() ? "" : ", ") + describe_uri(uri);
    if (uri.empty() == !view) {
        image.lack =
            view ? "it has both a uri and a buffer view" : "it has neither a uri nor a buffer view";
        return image;
    }
    if (view) {
        image.buffer_view = view->is_number_integer() ? view->get<int>() : -1;
        if (image.buffer_view < 0) image.lack = "its buffer view is not an index";
        return image;
    }
    try {
        image.bytes = resources.load(uri);
    } catch (const InputError& error) {
        image.lack = error.what();
    }
    return image;
}

} // namespace

std::vector<Buffer> read_buffers(const json& root, std::optional<std::string_view> bin,
                                 Resources& resources) {
    std::vector<Buffer> buffers;
    for (const json& object : array_of(root, "buffers"))
        buffers.push_back(read_buffer(object, buffers.size(), bin, resources));
    return buffers;
}

std::vector<ImageSource> read_images(const json& root, Resources& resources) {
    std::vector<ImageSource> images;
    for (const json& object : array_of(root, "images"))
        images.push_back(read_image(object, resources));
    return images;
}

} // namespace host::gltf
