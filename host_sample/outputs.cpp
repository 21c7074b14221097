#include "outputs.h"

#include "error.h"
#include "headless.h"
#include "image_file.h"
#include "whole_file.h"

namespace host {

namespace {

void check(const char* what, const std::string& path) {
    const std::string cause = try_whole_file(path);
    if (!cause.empty())
        throw InputError(std::string("the ") + what + " " + path + " cannot be written: " + cause);
}

void check_picture(const std::filesystem::path& path) {
    std::error_code error; // a failure shows when the file is tried
    if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), error);
    check("picture", path.string());
}

} // namespace

void check_outputs(const Options& options) {
    if (!options.record.empty()) check("replay", options.record);
    if (!options.stats.empty()) check("statistics", options.stats);
    if (!options.headless || options.game()) return;
    const std::string& out = options.out.empty() ? flight_pictures : options.out;
    const auto numbered = NumberedName::parse(out);
    check_picture(numbered ? numbered->at(0) : out);
}

} // namespace host
