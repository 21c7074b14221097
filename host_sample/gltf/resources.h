#pragma once

#include <cstdint>
#include <filesystem>
#include <list>
#include <map>
#include <span>
#include <string>
#include <string_view>

namespace host::gltf {

using Bytes = std::span<const unsigned char>;

// The bytes that a document names by URIs. A file that is named often is read and kept once, so
// that a small document cannot ask for more than the files beside it hold.
class Resources {
public:
    explicit Resources(std::filesystem::path folder) : folder_(std::move(folder)) {}

    // What a data URI or a relative one names. Valid as long as this or what it was moved to.
    // Throws InputError with a cause, without the URI.
    Bytes load(std::string_view uri);

    Bytes keep(std::string bytes);

    uint64_t byte_count() const { return byte_count_; }

private:
    std::filesystem::path find_file(std::string_view uri) const;

    std::filesystem::path folder_;
    std::list<std::string> kept_; // whose elements stay where they are
    std::map<std::filesystem::path, Bytes> files_;
    uint64_t byte_count_ = 0;
};

} // namespace host::gltf
