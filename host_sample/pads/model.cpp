#include "model.h"

namespace host::pads {

Family family_of(const Identity& identity) {
    constexpr uint16_t sony = 0x054c, nintendo = 0x057e, microsoft = 0x045e, eightbitdo = 0x2dc8;
    const uint16_t product = identity.product;
    if (identity.vendor == sony && (product == 0x05c4 || product == 0x09cc || product == 0x0ba0))
        return Family::dualshock4;
    if (identity.vendor == sony && (product == 0x0ce6 || product == 0x0df2))
        return Family::dualsense;
    if (identity.vendor == nintendo && product == 0x2009) return Family::switch_pro;
    if (identity.vendor == microsoft) {
        static constexpr uint16_t over_bluetooth[] = {0x02e0, 0x02fd, 0x0b05, 0x0b0c,
                                                      0x0b13, 0x0b20, 0x0b21, 0x0b22};
        for (const uint16_t xbox : over_bluetooth)
            if (product == xbox) return Family::xbox;
    }
    return identity.vendor == eightbitdo ? Family::eightbitdo : Family::generic;
}

const char* family_name(Family family) {
    switch (family) {
    case Family::dualshock4:
        return "DualShock 4";
    case Family::dualsense:
        return "DualSense";
    case Family::switch_pro:
        return "Switch Pro";
    case Family::xbox:
        return "Xbox";
    case Family::eightbitdo:
        return "8BitDo";
    case Family::generic:
        return "generic";
    }
    return "generic";
}

const char* bus_name(Bus bus) {
    switch (bus) {
    case Bus::usb:
        return "USB";
    case Bus::bluetooth:
        return "Bluetooth";
    case Bus::other:
        return "other";
    }
    return "other";
}

} // namespace host::pads
