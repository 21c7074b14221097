#include "files.h"

#include <fstream>

#include "../error.h"

namespace host::gltf {

std::string read_regular_file(const std::filesystem::path& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) throw InputError("there is no such file");
    if (!std::filesystem::is_regular_file(status)) throw InputError("it is not a regular file");
    const uint64_t size = std::filesystem::file_size(path, error);
    if (error) throw InputError("its size cannot be read");
    if (size == 0) throw InputError("it is empty");
    if (size > max_file_bytes) throw InputError("it is larger than 2 GiB");

    std::ifstream stream(path, std::ios::binary);
    if (!stream) throw InputError("it cannot be opened for reading");
    std::string bytes(size, '\0');
    stream.read(bytes.data(), static_cast<std::streamsize>(size));
    if (static_cast<uint64_t>(stream.gcount()) != size) throw InputError("it cannot be read whole");
    return bytes;
}

} // namespace host::gltf
