#include "known_pads.h"

namespace host::pads {

std::string_view known_mapping(const Identity& identity) {
    struct Known {
        uint16_t vendor, product;
        std::string_view text;
    };
    static constexpr Known known[] = {
        {0x0079, 0x0006, "north=1 east=2 south=3 west=4"}, // DragonRise
        {0x0810, 0x0001,
         "north=1 east=2 south=3 west=4"}, // Personal Communication Systems, one pad
        {0x0810, 0x0003, "north=1 east=2 south=3 west=4"}, // the same, two pads
    };
    for (const Known& pad : known)
        if (pad.vendor == identity.vendor && pad.product == identity.product) return pad.text;
    return {};
}

} // namespace host::pads
