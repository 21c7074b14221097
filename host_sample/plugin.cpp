#include "plugin.h"

#include <cstdlib>
#include <filesystem>

#include <dlfcn.h>

#include "elf_check.h"
#include "error.h"
#include "manifest.h"
#include "paths.h"

namespace host {

namespace {

constexpr const char* soname = "libperegrine.so.0";

std::string choose_library(const std::string& wanted) {
    if (!wanted.empty()) return wanted;
    if (const char* variable = std::getenv("PEREGRINE_LIBRARY"); variable && *variable)
        return variable;
    const std::filesystem::path here = executable_folder();
    for (const char* folder : {".", "../lib", ".."})
        for (const char* name : {manifest_name, "libperegrine.so", soname}) {
            const auto candidate = (here / folder / name).lexically_normal();
            std::error_code error;
            if (std::filesystem::exists(candidate, error)) return candidate.string();
        }
    return soname;
}

} // namespace

Plugin::Plugin(const std::string& library) : path_(choose_library(library)) {
    if (std::filesystem::path(path_).extension() == ".json") {
        const Manifest manifest = read_manifest(path_);
        path_ = manifest.library.string();
        entry_ = manifest.entry;
    }
    open();
    try {
        find_api();
    } catch (...) {
        dlclose(library_);
        throw;
    }
}

Plugin::~Plugin() {
    dlclose(library_);
}

void Plugin::open() {
    // Without a slash dlopen would search the system's folders instead of the current one.
    std::string name = path_;
    if (name != soname && name.find('/') == std::string::npos) name = "./" + name;
    if (name != soname) {
        std::error_code error;
        if (!std::filesystem::exists(name, error))
            throw InputError("the engine library " + path_ + " does not exist");
        if (const std::string mistake = find_elf_mistake(name); !mistake.empty())
            throw InputError("the engine library " + path_ + " cannot be loaded: it " + mistake);
    }
    library_ = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library_) return;
    const char* cause = dlerror();
    throw InputError("the engine library " + path_
                     + " cannot be loaded: " + (cause ? cause : "no cause is known")
                     + ". --library FILE or PEREGRINE_LIBRARY says where it is");
}

void Plugin::find_api() {
    const auto get_api = reinterpret_cast<rt_get_api_function>(dlsym(library_, entry_.c_str()));
    if (!get_api)
        throw InputError(path_ + " is no Peregrine library: it does not export " + entry_);
    api_ = get_api(RT_API_VERSION);
    if (!api_)
        throw InputError("the library " + path_ + " does not speak version "
                         + std::to_string(RT_API_VERSION) + " of the interface");
    if (api_->struct_size < sizeof(rt_api))
        throw InputError("the library " + path_ + " (" + api_->get_version_string()
                         + ") is older than this program and lacks functions that it needs");
}

} // namespace host
