#include "json.h"

#include <charconv>
#include <string>

#include "../error.h"
#include "integers.h"
#include "quote.h"

namespace host::gltf {

namespace {

constexpr int max_depth = 128;

// "extras" and "extensions" are walked recursively.
void check_depth(std::string_view json) {
    int depth = 0;
    bool in_string = false;
    for (size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (in_string) {
            if (c == '\\') ++i;
            if (c == '"') in_string = false;
        } else if (c == '"') {
            in_string = true;
        } else if (c == '{' || c == '[') {
            if (++depth > max_depth) throw InputError("its JSON is nested too deeply");
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
}

struct Version {
    int major = 0, minor = 0;
};

Version read_version(const nlohmann::json& asset, const char* key) {
    const auto found = asset.find(key);
    if (found == asset.end() || !found->is_string())
        throw InputError(std::string("its asset.") + key + " is not a text such as \"2.0\"");
    const auto& text = found->get_ref<const std::string&>();
    const char* const end = text.data() + text.size();
    Version version;
    const auto major = std::from_chars(text.data(), end, version.major);
    if (major.ec == std::errc() && major.ptr != end)
        std::from_chars(major.ptr + 1, end, version.minor);
    return version;
}

void check_version(const nlohmann::json& root) {
    const auto asset = root.find("asset");
    if (asset == root.end() || !asset->is_object())
        throw InputError("it has no \"asset\", which says the version of glTF");
    if (read_version(*asset, "version").major != 2)
        throw InputError("it is glTF version " + quote((*asset)["version"].get<std::string>(), 20)
                         + ", and only version 2 can be read");
    if (!asset->contains("minVersion")) return;
    const Version least = read_version(*asset, "minVersion");
    if (least.major > 2 || (least.major == 2 && least.minor > 0))
        throw InputError("it needs glTF version "
                         + quote((*asset)["minVersion"].get<std::string>(), 20)
                         + ", and only version 2.0 can be read");
}

} // namespace

nlohmann::json parse_json(std::string_view text) {
    check_depth(text);
    auto root = nlohmann::json::parse(text.begin(), text.end(), nullptr, false);
    if (root.is_discarded()) throw InputError("its JSON is malformed");
    if (!root.is_object()) throw InputError("its JSON is not an object");
    check_version(root);
    settle_integers(root);
    return root;
}

} // namespace host::gltf
