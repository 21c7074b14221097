#pragma once

#include <cstdint>

namespace host {

// 0 to 1, another for each place of each thing: the same for the same arguments.
inline double scatter(uint32_t thing, uint32_t place) {
    uint32_t bits = thing * 0x8da6b343u ^ place * 0xd8163841u ^ 0x2c1b3c6du;
    bits = (bits ^ bits >> 15) * 0x2c1b3c6du;
    bits = (bits ^ bits >> 13) * 0x85ebca6bu;
    return (bits >> 8) * 0x1p-24;
}

} // namespace host
