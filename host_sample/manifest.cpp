#include "manifest.h"

#include <fstream>
#include <limits>

#include <nlohmann/json.hpp>

#include <peregrine/rt.h>

#include "error.h"

namespace host {

namespace {

using Json = nlohmann::json;

class Reader {
public:
    explicit Reader(const std::filesystem::path& path) : path_(path) {
        std::ifstream file(path);
        if (!file)
            refuse("cannot be read: --library FILE names another one, or the library itself");
        json_ = Json::parse(file, nullptr, false);
        if (!json_.is_object()) refuse("is no JSON object");
    }

    std::string text(const char* field) const {
        const auto found = json_.find(field);
        if (found == json_.end() || !found->is_string() || found->get<std::string>().empty())
            refuse(std::string("needs a text \"") + field + "\"");
        return found->get<std::string>();
    }

    uint32_t number(const char* field) const {
        const auto found = json_.find(field);
        if (found == json_.end() || !found->is_number_unsigned()
            || found->get<uint64_t>() > std::numeric_limits<uint32_t>::max())
            refuse(std::string("needs a whole number \"") + field + "\"");
        return found->get<uint32_t>();
    }

    [[noreturn]] void refuse(const std::string& cause) const {
        throw InputError("the plugin manifest " + path_.string() + " " + cause);
    }

private:
    std::filesystem::path path_;
    Json json_;
};

} // namespace

Manifest read_manifest(const std::filesystem::path& path) {
    const Reader reader(path);
    Manifest manifest;
    manifest.name = reader.text("name");
    manifest.library = (path.parent_path() / reader.text("library")).lexically_normal();
    manifest.api_version = reader.number("api_version");
    manifest.entry = reader.text("entry");
    if (manifest.api_version != RT_API_VERSION)
        reader.refuse("is for version " + std::to_string(manifest.api_version)
                      + " of the interface, and this program speaks version "
                      + std::to_string(RT_API_VERSION)
                      + ": install the plugin that was made for it, with its manifest");
    std::error_code error;
    if (!std::filesystem::is_regular_file(manifest.library, error))
        reader.refuse("names the library " + manifest.library.string()
                      + ", which does not exist: put it there or correct \"library\"");
    return manifest;
}

} // namespace host
