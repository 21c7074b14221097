#include "resources.h"

#include "../error.h"
#include "files.h"
#include "uri.h"

namespace host::gltf {

Bytes Resources::keep(std::string bytes) {
    byte_count_ += bytes.size();
    const std::string& kept = kept_.emplace_back(std::move(bytes));
    return {reinterpret_cast<const unsigned char*>(kept.data()), kept.size()};
}

// glTF 2.0, 2.8: relative paths, without scheme and authority.
std::filesystem::path Resources::find_file(std::string_view uri) const {
    if (uri.find("://") != std::string_view::npos)
        throw InputError("only files beside the scene are read");
    const std::string name = decode_percent(uri);
    if (name.find('\0') != std::string::npos) throw InputError("the name holds a zero byte");
    const auto relative = std::filesystem::path(name).lexically_normal(); // RFC 3986, 5.2.4
    if (relative.is_absolute()) throw InputError("only files beside the scene are read");
    const auto path = folder_ / relative;
    std::error_code error;
    if (!std::filesystem::exists(path, error))
        throw InputError(has_bare_percent(uri)
                             ? "there is no such file (in a URI, a % itself is written %25)"
                             : "there is no such file");
    const auto canonical = std::filesystem::canonical(path, error);
    return error ? path : canonical;
}

Bytes Resources::load(std::string_view uri) {
    if (is_data_uri(uri)) return keep(decode_data_uri(uri));
    const auto path = find_file(uri);
    const auto known = files_.find(path);
    if (known != files_.end()) return known->second;
    return files_.emplace(path, keep(read_regular_file(path))).first->second;
}

} // namespace host::gltf
