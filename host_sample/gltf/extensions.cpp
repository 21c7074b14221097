#include "extensions.h"

#include <algorithm>
#include <map>
#include <string_view>

#include "../error.h"
#include "quote.h"

namespace host::gltf {

namespace {

using nlohmann::json;

const std::set<std::string, std::less<>> supported = {
    "EXT_mesh_gpu_instancing", "KHR_lights_punctual",    "KHR_materials_emissive_strength",
    "KHR_materials_ior",       "KHR_materials_specular", "KHR_materials_transmission",
    "KHR_materials_unlit",     "KHR_materials_volume",   "KHR_mesh_quantization",
    "KHR_texture_transform"};

// What is seen instead.
const std::map<std::string, const char*, std::less<>> consequences = {
    {"EXT_lights_image_based", "the surroundings give no light"},
    {"EXT_meshopt_compression", "the data that is not compressed is used"},
    {"EXT_texture_avif", "only PNG and JPEG images are read"},
    {"EXT_texture_webp", "only PNG and JPEG images are read"},
    {"KHR_animation_pointer", "what it animates stands still"},
    {"KHR_draco_mesh_compression", "the data that is not compressed is used"},
    {"KHR_materials_anisotropy", "highlights are round"},
    {"KHR_materials_clearcoat", "there are no coats"},
    {"KHR_materials_diffuse_transmission", "no light passes such surfaces"},
    {"KHR_materials_dispersion", "all colours are bent alike"},
    {"KHR_materials_iridescence", "there are no thin films"},
    {"KHR_materials_pbrSpecularGlossiness", "such materials show their metallic-roughness values"},
    {"KHR_materials_sheen", "cloth has no sheen"},
    {"KHR_materials_variants", "the default materials are shown"},
    {"KHR_node_visibility", "all nodes are shown"},
    {"KHR_texture_basisu", "only PNG and JPEG images are read"},
    {"MSFT_lod", "the finest level is shown"},
    {"MSFT_texture_dds", "only PNG and JPEG images are read"},
};

// Adds the names in an array of the root.
void add_declared(const json& root, const char* key, std::set<std::string>& names) {
    const auto list = root.find(key);
    if (list == root.end() || !list->is_array()) return;
    for (const json& name : *list)
        if (name.is_string()) names.insert(name.get<std::string>());
}

void add_held(const json& value, std::set<std::string>& names) {
    if (value.is_object()) {
        const auto extensions = value.find("extensions");
        if (extensions != value.end() && extensions->is_object())
            for (const auto& [name, extension] : extensions->items()) names.insert(name);
        for (const auto& [key, member] : value.items())
            if (key != "extras") add_held(member, names);
    } else if (value.is_array()) {
        for (const json& element : value) add_held(element, names);
    }
}

} // namespace

std::set<std::string> find_extensions(const json& root) {
    std::set<std::string> names;
    add_declared(root, "extensionsUsed", names);
    add_held(root, names);
    return names;
}

void check_required_extensions(const json& root) {
    std::set<std::string> required;
    add_declared(root, "extensionsRequired", required);
    std::string list;
    size_t count = 0;
    for (const std::string& name : required)
        if (!supported.contains(name) && count++ < 10)
            list += (list.empty() ? "" : ", ") + quote(name);
    if (count == 0) return;
    throw InputError(count == 1 ? "it requires the extension " + list + ", which is not supported"
                                : "it requires extensions that are not supported: " + list);
}

void note_ignored(const std::set<std::string>& extensions, Notes& notes) {
    for (const std::string& name : extensions) {
        if (supported.contains(name)) continue;
        const auto known = consequences.find(name);
        notes.add("the extension " + quote(name) + " is ignored"
                  + (known == consequences.end() ? "" : std::string(": ") + known->second));
    }
}

} // namespace host::gltf
