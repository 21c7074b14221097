#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace peregrine::test {

// Pixels of 4 bytes, or elements of several such: as a PNG file keeps them, bit by bit.
struct Picture {
    uint32_t width = 0, height = 0; // of elements
    uint32_t units = 1;             // of 4 bytes, an element
    std::vector<uint8_t> bytes;
};

// Fails the test, with a sentence and two files to look at (what was found, and where it differs),
// unless the picture is bit by bit the one in golden/. `how` says what it was made with. With
// $PEREGRINE_RENEW_PICTURES set, the first picture of a name becomes the golden one.
void expect_golden(const std::string& name, const std::string& how, const Picture& found);

} // namespace peregrine::test
