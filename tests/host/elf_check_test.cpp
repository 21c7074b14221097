#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "../ui/scratch_folder.h"
#include "elf_check.h"
#include "error.h"
#include "plugin.h"

// Libraries that are not whole.
namespace host::test {
namespace {

TEST(ElfCheck, AWholeLibraryIsRight) {
    EXPECT_EQ(find_elf_mistake(FAKE_ENGINE), "");
    EXPECT_EQ(find_elf_mistake("/proc/self/exe"), "");
}

// However much is there: a sentence, where the loader would take the program down.
TEST(ElfCheck, ATruncatedLibraryIsASentence) {
    const ScratchFolder folder;
    const std::string file = (folder.path() / "cut.so").string();
    const std::string whole = read_text(FAKE_ENGINE);
    size_t cut_off = 0;
    for (size_t size = 0; size < whole.size(); size += size < 2048 ? 61 : 997) {
        write_text(file, whole.substr(0, size));
        cut_off += find_elf_mistake(file).find("cut off") != std::string::npos;
        try {
            const Plugin plugin(file);
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find("cannot be loaded"), std::string::npos);
            continue;
        }
        EXPECT_GT(size, whole.size() / 2); // only what no segment needs is missing
    }
    EXPECT_GT(cut_off, 5u);
}

TEST(ElfCheck, NumbersThatAreTooLargeAreNoTrouble) {
    const ScratchFolder folder;
    const std::string file = (folder.path() / "odd.so").string();
    const std::string whole = read_text(FAKE_ENGINE);
    for (const size_t place : {32u, 33u, 39u, 54u, 56u, 57u}) { // of the table of segments
        std::string odd = whole;
        odd[place] = '\xff';
        write_text(file, odd);
        EXPECT_NO_FATAL_FAILURE(find_elf_mistake(file));
    }
}

TEST(ElfCheck, WhatIsNoLibraryIsLeftToTheLoader) {
    const ScratchFolder folder;
    const std::string file = (folder.path() / "text.so").string();
    write_text(file, "no library");
    EXPECT_EQ(find_elf_mistake(file), "");
    EXPECT_EQ(find_elf_mistake(folder.path().string()), "is no file");
}

} // namespace
} // namespace host::test
