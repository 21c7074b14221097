#include "user_folders.h"

#include <cstdlib>

namespace host {

namespace {

std::filesystem::path folder(const char* variable, const char* below_home) {
    const auto absolute = [](const char* name) -> std::filesystem::path {
        const char* value = std::getenv(name);
        const std::filesystem::path path = value ? value : "";
        return path.is_absolute() ? path : ""; // the specification wants others ignored
    };
    if (const auto named = absolute(variable); !named.empty()) return named / "peregrine";
    const auto home = absolute("HOME");
    return home.empty() ? "" : home / below_home / "peregrine";
}

} // namespace

std::filesystem::path config_folder() {
    return folder("XDG_CONFIG_HOME", ".config");
}

std::filesystem::path data_folder() {
    return folder("XDG_DATA_HOME", ".local/share");
}

} // namespace host
