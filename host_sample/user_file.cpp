#include "user_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>

#include <fcntl.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

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

bool write_all(int file, const std::string& text) {
    size_t done = 0;
    while (done < text.size()) {
        const ssize_t written = ::write(file, text.data() + done, text.size() - done);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return false;
        done += static_cast<size_t>(written);
    }
    return true;
}

// Returns errno, or 0.
int write_and_rename(const fs::path& path, const std::string& text) {
    const fs::path fresh = path.string() + ".new";
    const int file = ::open(fresh.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (file < 0) return errno;
    int error = write_all(file, text) && ::fsync(file) == 0 ? 0 : errno;
    if (::close(file) != 0 && error == 0) error = errno;
    if (error == 0 && std::rename(fresh.c_str(), path.c_str()) != 0) error = errno;
    if (error != 0) ::unlink(fresh.c_str());
    return error;
}

} // namespace

nlohmann::json read_user_file(const fs::path& path, const std::string& what, std::string& note) {
    nlohmann::json content = nlohmann::json::object();
    std::error_code error;
    if (path.empty() || !fs::exists(path, error)) return content;
    std::string text;
    if (!fs::is_regular_file(path, error) || !read_text(path, text)) {
        note = "The " + what + " in " + path.string() + " cannot be read.";
        return content;
    }
    nlohmann::json found = nlohmann::json::parse(text, nullptr, false);
    if (found.is_object()) return found;
    const fs::path kept = path.string() + ".broken";
    fs::rename(path, kept, error);
    note = "The " + what + " in " + path.string() + " are damaged and start anew"
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
    const int cause = write_and_rename(path, text);
    if (cause == 0) return {};
    return "The " + what + " cannot be kept in " + path.string() + ": " + std::strerror(cause)
           + ".";
}

} // namespace host
