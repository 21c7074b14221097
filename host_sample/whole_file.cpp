#include "whole_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace host {

namespace {

namespace fs = std::filesystem;

// All of these return errno, or 0.

int write_all(int file, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(file, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return written < 0 ? errno : EIO;
        bytes.remove_prefix(static_cast<size_t>(written));
    }
    return 0;
}

int write_opened(int file, std::string_view bytes, Durable durable) {
    if (file < 0) return errno;
    int error = write_all(file, bytes);
    if (error == 0 && durable == Durable::yes && ::fsync(file) != 0) error = errno;
    if (::close(file) != 0 && error == 0) error = errno;
    return error;
}

int write_in_place(const fs::path& path, std::string_view bytes) {
    const int file = ::open(path.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
    return write_opened(file, bytes, Durable::no);
}

enum class Kind { none, regular, folder, device, other };

Kind kind_of(const fs::path& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) return Kind::none;
    return S_ISREG(status.st_mode)   ? Kind::regular
           : S_ISDIR(status.st_mode) ? Kind::folder
           : S_ISCHR(status.st_mode) ? Kind::device
                                     : Kind::other;
}

// What a link names is written, not the link.
fs::path followed(const fs::path& path) {
    std::error_code error;
    const fs::path whole = fs::canonical(path, error);
    return error ? path : whole;
}

std::string sentence(int error) {
    return error == 0 ? "" : std::strerror(error);
}

} // namespace

std::string write_whole_file(const fs::path& path, std::string_view bytes, Durable durable) {
    const Kind kind = kind_of(path);
    if (kind == Kind::folder) return sentence(EISDIR);
    if (kind == Kind::device || kind == Kind::other) return sentence(write_in_place(path, bytes));
    const fs::path target = followed(path), fresh = target.string() + ".new";
    const int file = ::open(fresh.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (file < 0 && kind == Kind::regular) return sentence(write_in_place(path, bytes));
    if (file < 0) return sentence(errno);
    int error = write_opened(file, bytes, durable);
    if (error == 0 && std::rename(fresh.c_str(), target.c_str()) != 0) error = errno;
    if (error != 0) ::unlink(fresh.c_str());
    return sentence(error);
}

// A byte shows whether the disk is full. It is kept from whoever reads a pipe or looks at a
// terminal.
std::string try_whole_file(const fs::path& path) {
    const Kind kind = kind_of(path);
    if (kind == Kind::folder) return sentence(EISDIR);
    if (kind == Kind::other) return sentence(::access(path.c_str(), W_OK) == 0 ? 0 : errno);
    if (kind == Kind::device) {
        const int file = ::open(path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC);
        const bool shown = file >= 0 && ::isatty(file) != 0;
        return sentence(write_opened(file, shown ? "" : std::string_view("", 1), Durable::no));
    }
    const fs::path fresh = followed(path).string() + ".new";
    const int file = ::open(fresh.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (file < 0) {
        const int cause = errno;
        const bool stands = kind == Kind::regular && ::access(path.c_str(), W_OK) == 0;
        return sentence(stands ? 0 : cause);
    }
    const int error = write_opened(file, std::string_view("", 1), Durable::no);
    ::unlink(fresh.c_str());
    return sentence(error);
}

} // namespace host
