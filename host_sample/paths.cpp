#include "paths.h"

#include "error.h"

#ifndef PEREGRINE_CONTENT_DIR
#define PEREGRINE_CONTENT_DIR "content"
#endif

namespace host {

std::filesystem::path executable_folder() {
    std::error_code error;
    const auto link = std::filesystem::read_symlink("/proc/self/exe", error);
    return error ? std::filesystem::path(".") : link.parent_path();
}

std::string content_file(const std::string& name) {
    const std::filesystem::path here = executable_folder();
    for (const std::filesystem::path& folder :
         {std::filesystem::path("content"), here / "content", here / "../content",
          here / "../share/peregrine/content", std::filesystem::path(PEREGRINE_CONTENT_DIR)}) {
        std::error_code error;
        if (std::filesystem::is_regular_file(folder / name, error))
            return (folder / name).lexically_normal().string();
    }
    throw InputError("the file content/" + name
                     + " is not there: start this program from the folder that has it");
}

} // namespace host
