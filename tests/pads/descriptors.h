// Report descriptors written from the HID usage tables.
#pragma once

#include "bytes.h"

namespace host::pads::test {

// Eight bytes, as the cheapest pads have them: X, Y, Z, Rz of 8 bits, hat, twelve buttons.
inline std::vector<uint8_t> plain_descriptor() {
    return bytes("05 01 09 05 a1 01 " // gamepad
                 "15 00 26 ff 00 75 08 95 04 09 30 09 31 09 32 09 35 81 02 "
                 "25 07 35 00 46 3b 01 65 14 75 04 95 01 09 39 81 42 65 00 " // hat, with null
                 "05 09 19 01 29 0c 25 01 75 01 95 0c 81 02 "                // twelve buttons
                 "75 08 95 02 81 03 "                                        // padding
                 "c0");
}

// Report 3: X, Y, Z, Rz of 16 bits and signs; report 5: accelerator and brake of 10 bits, fifteen
// buttons in Android's order, hat 1..8. A motor in output report 9.
inline std::vector<uint8_t> numbered_descriptor() {
    return bytes("05 01 09 05 a1 01 85 03 09 01 a1 00 "
                 "16 01 80 26 ff 7f 75 10 95 04 09 30 09 31 09 32 09 35 81 02 c0 "
                 "85 05 05 02 15 00 26 ff 03 75 0a 95 02 09 c4 09 c5 81 02 75 04 95 01 81 03 "
                 "05 09 19 01 29 0f 15 00 25 01 75 01 95 0f 81 02 75 01 95 01 81 03 "
                 "05 01 09 39 15 01 25 08 75 04 95 01 81 42 75 04 81 03 "
                 "85 09 06 00 ff 09 01 15 00 26 ff 00 75 08 95 02 91 02 c0");
}

// A joystick whose buttons are an array of three numbers, and whose hat knows four directions.
inline std::vector<uint8_t> array_descriptor() {
    return bytes("05 01 09 04 a1 01 15 81 25 7f 75 08 95 02 09 30 09 31 81 02 "
                 "05 09 19 01 29 0a 15 01 25 0a 75 08 95 03 81 00 "
                 "05 01 09 39 15 00 25 03 75 04 95 01 81 42 75 04 95 01 81 03 c0");
}

// Nothing to play with: a mouse and a keyboard.
inline std::vector<uint8_t> mouse_descriptor() {
    return bytes("05 01 09 02 a1 01 09 01 a1 00 05 09 19 01 29 03 15 00 25 01 75 01 95 03 81 02 "
                 "75 05 95 01 81 03 05 01 09 30 09 31 15 81 25 7f 75 08 95 02 81 06 c0 c0");
}

} // namespace host::pads::test
