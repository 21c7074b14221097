#pragma once

#include <string>

#include <peregrine/rt.h>

namespace host {

// The engine, loaded by hand. Nothing of it is linked: this is how a game with plugins uses it.
class Plugin {
public:
    // `library` names a library or a manifest (manifest.h: *.json); when empty, $PEREGRINE_LIBRARY,
    // then the places beside this program, then the system's library path are tried. Throws
    // InputError.
    explicit Plugin(const std::string& library);
    ~Plugin();
    Plugin(const Plugin&) = delete;
    Plugin& operator=(const Plugin&) = delete;

    const rt_api& api() const { return *api_; }
    const std::string& path() const { return path_; }

private:
    void open();
    void find_api();

    std::string path_;
    std::string entry_ = "rt_get_api";
    void* library_ = nullptr;
    const rt_api* api_ = nullptr;
};

} // namespace host
