#include "user_file.h"

#include <fstream>

#include <nlohmann/json.hpp>

#include "whole_file.h"

namespace host {

namespace {

namespace fs = std::filesystem;

constexpr std::streamsize longest = 1 << 20; // bytes: what we write is far smaller

bool read_text(const fs::path& path, std::string& text) {
    std::ifstream file(path, std::ios::binary);
    if (!file) return false;
    text.resize(longest);
    file.read(text.data(), longest);
    text.resize(static_cast<size_t>(file.gcount()));
    return !file.bad();
}

} // namespace

nlohmann::json read_user_file(const fs::path& path, const std::string& what, std::string& note) {
    nlohmann::json content = nlohmann::json::object();
    std::error_code error;
    if (path.empty() || !fs::exists(path, error)) return content;
    std::string text;
    if (!fs::is_regular_file(path, error)) {
        note = "The " + what + " in " + path.string() + " cannot be read.";
        return content;
    }
    const bool readable = read_text(path, text);
    nlohmann::json found = nlohmann::json::parse(text, nullptr, false);
    if (readable && found.is_object()) return found;
    const fs::path kept = path.string() + ".broken";
    fs::rename(path, kept, error);
    note = "The " + what + " in " + path.string()
           + (readable ? " are damaged and start anew" : " cannot be read and start anew")
           + (error ? "." : "; the old file is kept as " + kept.filename().string() + ".");
    return content;
}

std::string write_user_file(const fs::path& path, const nlohmann::json& content,
                            const std::string& what) {
    if (path.empty())
        return "The " + what + " cannot be kept: neither HOME nor an XDG folder is set.";
    std::error_code error;
    fs::create_directories(path.parent_path(), error); // a failure shows when the file is opened
    using nlohmann::json;
    const std::string text = content.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
    const std::string cause = write_whole_file(path, text, Durable::yes);
    if (cause.empty()) return {};
    return "The " + what + " cannot be kept in " + path.string() + ": " + cause + ".";
}

} // namespace host
