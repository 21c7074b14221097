#include "document.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "../error.h"
#include "files.h"
#include "precheck.h"

namespace host::gltf {

namespace {

constexpr std::array supported_extensions = {"KHR_lights_punctual", "KHR_texture_transform",
                                             "KHR_mesh_quantization", "KHR_materials_unlit",
                                             "KHR_materials_emissive_strength"};

// Images are decoded later, with checked bounds and only where a material needs them. At this
// point tinygltf has not checked the buffer view, so its bytes must not be touched.
bool keep_encoded(tinygltf::Image* image, int, std::string*, std::string*, int, int,
                  const unsigned char* bytes, int size, void*) {
    if (image->bufferView < 0 && size > 0) image->image.assign(bytes, bytes + size);
    return true;
}

bool is_regular(const std::string& path, void*) {
    std::error_code error;
    return std::filesystem::is_regular_file(path, error);
}

bool read_whole(std::vector<unsigned char>* out, std::string* error, const std::string& path,
                void*) {
    try {
        const std::string bytes = read_regular_file(path);
        out->assign(bytes.begin(), bytes.end());
        return true;
    } catch (const std::exception& failure) {
        if (error) *error += failure.what();
        return false;
    }
}

std::string to_one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && text.back() == ' ') text.pop_back();
    constexpr size_t max_length = 300; // an error may quote a whole data URI
    if (text.size() > max_length) text = text.substr(0, max_length) + "...";
    return text;
}

void check_required_extensions(const tinygltf::Model& model) {
    for (const std::string& name : model.extensionsRequired) {
        const bool known = std::any_of(supported_extensions.begin(), supported_extensions.end(),
                                       [&](const char* supported) { return name == supported; });
        if (!known)
            throw InputError("it requires the extension " + to_one_line(name)
                             + ", which is not supported");
    }
}

uint64_t count_bytes(const tinygltf::Model& model) {
    uint64_t bytes = 0;
    for (const tinygltf::Buffer& buffer : model.buffers) bytes += buffer.data.size();
    for (const tinygltf::Image& image : model.images) bytes += image.image.size();
    return bytes;
}

} // namespace

Document parse_document(const std::string& bytes, const std::filesystem::path& folder) {
    const bool binary = is_binary_gltf(bytes);
    check_json(binary ? check_container(bytes) : std::string_view(bytes), binary);

    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(&keep_encoded, nullptr);
    loader.SetFsCallbacks(
        {&is_regular, &tinygltf::ExpandFilePath, &read_whole, &tinygltf::WriteWholeFile, nullptr});
    Document document;
    std::string error, warning;
    const auto size = static_cast<unsigned int>(bytes.size());
    const bool read =
        binary ? loader.LoadBinaryFromMemory(&document.model, &error, &warning,
                                             reinterpret_cast<const unsigned char*>(bytes.data()),
                                             size, folder.string())
               : loader.LoadASCIIFromString(&document.model, &error, &warning, bytes.data(), size,
                                            folder.string());
    if (!read) throw InputError(to_one_line(error.empty() ? "it is malformed" : error));
    check_required_extensions(document.model);
    document.bytes_read = bytes.size() + count_bytes(document.model);
    return document;
}

Document read_document(const std::filesystem::path& path) {
    return parse_document(read_regular_file(path), path.parent_path());
}

} // namespace host::gltf
