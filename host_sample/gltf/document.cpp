#include "document.h"

#include <algorithm>

#include "../error.h"
#include "container.h"
#include "extensions.h"
#include "files.h"
#include "json.h"
#include "quote.h"
#include "sources.h"

namespace host::gltf {

namespace {

using nlohmann::json;

// tinygltf refuses indices whose accessor has no buffer view, though zeros and sparse ones are
// legal. Such accessors are lent one past the end; returns their numbers.
std::vector<size_t> lend_views(json& root) {
    std::vector<size_t> borrowers;
    const auto accessors = root.find("accessors");
    if (accessors == root.end() || !accessors->is_array()) return borrowers;
    for (size_t i = 0; i < accessors->size(); ++i)
        if ((*accessors)[i].is_object() && !(*accessors)[i].contains("bufferView"))
            borrowers.push_back(i);
    if (borrowers.empty()) return borrowers;
    json& views = root["bufferViews"];
    if (!views.is_array()) views = json::array();
    for (const size_t i : borrowers) (*accessors)[i]["bufferView"] = views.size();
    views.push_back({{"buffer", 0}, {"byteLength", 1}});
    return borrowers;
}

void take_back_views(const std::vector<size_t>& borrowers, tinygltf::Model& model) {
    if (borrowers.empty()) return;
    for (const size_t i : borrowers) model.accessors[i].bufferView = -1;
    model.bufferViews.pop_back();
}

tinygltf::Model parse_model(json root) {
    root.erase("buffers");
    root.erase("images");
    const auto borrowers = lend_views(root);
    const std::string text = root.dump();
    tinygltf::TinyGLTF loader;
    tinygltf::Model model;
    std::string error, warning;
    if (!loader.LoadASCIIFromString(&model, &error, &warning, text.data(),
                                    static_cast<unsigned int>(text.size()), ""))
        throw InputError(error.empty() ? "it is malformed" : quote(error, 300));
    take_back_views(borrowers, model);
    return model;
}

} // namespace

Document parse_document(const std::string& bytes, const std::filesystem::path& folder) {
    if (bytes.size() > max_file_bytes) throw InputError("it is larger than 2 GiB");
    const Container container = open_container(bytes);
    json root = parse_json(container.json);
    check_required_extensions(root);
    Document document{{}, {}, {}, find_extensions(root), Resources(folder), 0};
    document.buffers = read_buffers(root, container.bin, document.resources);
    document.images = read_images(root, document.resources);
    document.model = parse_model(std::move(root));
    document.bytes_read = bytes.size() + document.resources.byte_count();
    return document;
}

Document read_document(const std::filesystem::path& path) {
    return parse_document(read_regular_file(path), path.parent_path());
}

} // namespace host::gltf
