#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json_fwd.hpp>

// JSON files that belong to the user: small, and never lost to a crash, a full disk or a typo.
namespace host {

// An object, empty if there is no file. If the file is no JSON object it is renamed to *.broken and
// `note` becomes a sentence that says so; `what` names it ("settings").
nlohmann::json read_user_file(const std::filesystem::path& path, const std::string& what,
                              std::string& note);

// Whole, and on the disk when it returns (whole_file.h). Returns a sentence if it cannot be
// written, else nothing.
std::string write_user_file(const std::filesystem::path& path, const nlohmann::json& content,
                            const std::string& what);

} // namespace host
