#include "hid.h"

#include <cstdio>

namespace host::pads {

std::string permission_advice(const HidNode& node) {
    char rule[160];
    std::snprintf(rule, sizeof rule,
                  R"(KERNEL=="hidraw*", KERNELS=="*:%04X:%04X.*", MODE="0660", TAG+="uaccess")",
                  node.identity.vendor, node.identity.product);
    return "no permission to open " + node.path + " (" + node.product
           + "): install 70-peregrine-pads.rules in /etc/udev/rules.d, or add to it the line "
           + rule + ", then plug the gamepad in again";
}

} // namespace host::pads
