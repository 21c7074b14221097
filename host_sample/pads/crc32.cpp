#include "crc32.h"

#include <array>

namespace host::pads {

namespace {

constexpr std::array<uint32_t, 256> make_table() {
    std::array<uint32_t, 256> table{};
    for (uint32_t i = 0; i < 256; ++i) {
        uint32_t value = i;
        for (int bit = 0; bit < 8; ++bit)
            value = value >> 1 ^ ((value & 1) != 0 ? 0xedb88320u : 0u); // the polynomial, reflected
        table[i] = value;
    }
    return table;
}

constexpr std::array<uint32_t, 256> table = make_table();

} // namespace

uint32_t crc32(uint8_t first, Bytes rest) {
    uint32_t crc = 0xffffffffu;
    const auto feed = [&](uint8_t byte) { crc = crc >> 8 ^ table[(crc ^ byte) & 0xff]; };
    feed(first);
    for (const uint8_t byte : rest) feed(byte);
    return ~crc;
}

} // namespace host::pads
