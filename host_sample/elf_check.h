#pragma once

#include <string>

namespace host {

// What is wrong with a library file that the loader would not notice: of one that ends too early it
// maps pages that are not there, and the program dies when they are touched. Returns the rest of a
// sentence, or nothing; also for what is no ELF file at all, which the loader refuses itself.
std::string find_elf_mistake(const std::string& path);

} // namespace host
