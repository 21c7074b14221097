#include "elf_check.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <vector>

#include <elf.h>

namespace host {

namespace {

template <class T>
bool read_at(std::ifstream& file, uint64_t offset, T& value) {
    file.seekg(static_cast<std::streamoff>(offset));
    return static_cast<bool>(file.read(reinterpret_cast<char*>(&value), sizeof value));
}

// The byte behind the last one that a table of `count` entries or a segment needs; of what would
// not end within 64 bits the largest number.
uint64_t end_of(uint64_t offset, uint64_t size) {
    return size > UINT64_MAX - offset ? UINT64_MAX : offset + size;
}

template <class Header, class Segment>
std::string check(std::ifstream& file, uint64_t size) {
    Header header;
    if (!read_at(file, 0, header)) return "is cut off within its header";
    uint64_t needed = end_of(header.e_phoff, uint64_t{header.e_phnum} * sizeof(Segment));
    if (needed > size) return "is cut off: its table of segments is not there";
    if (header.e_phentsize != sizeof(Segment)) return {}; // the loader's to refuse
    for (uint64_t i = 0; i < header.e_phnum; ++i) {
        Segment segment;
        if (!read_at(file, header.e_phoff + i * sizeof segment, segment)) return "cannot be read";
        if (segment.p_type == PT_LOAD || segment.p_type == PT_DYNAMIC)
            needed = std::max(needed, end_of(segment.p_offset, segment.p_filesz));
    }
    if (needed <= size) return {};
    return "is cut off: it has " + std::to_string(size) + " bytes of " + std::to_string(needed);
}

} // namespace

std::string find_elf_mistake(const std::string& path) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) return "is no file";
    const uint64_t size = std::filesystem::file_size(path, error);
    std::ifstream file(path, std::ios::binary);
    if (error || !file) return {}; // as above
    unsigned char ident[EI_NIDENT] = {};
    if (!read_at(file, 0, ident) || std::memcmp(ident, ELFMAG, SELFMAG) != 0) return {};
    return ident[EI_CLASS] == ELFCLASS64 ? check<Elf64_Ehdr, Elf64_Phdr>(file, size)
                                         : check<Elf32_Ehdr, Elf32_Phdr>(file, size);
}

} // namespace host
