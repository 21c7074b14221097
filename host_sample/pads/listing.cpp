#include "listing.h"

#include <cstdio>

namespace host::pads {

namespace {

std::string abilities_text(const Abilities& abilities) {
    std::string text;
    const auto add = [&](bool has, const char* what) {
        if (has) text += (text.empty() ? "" : ", ") + std::string(what);
    };
    add(abilities.rumble, "rumble");
    add(abilities.light, "light");
    add(abilities.gyro, "gyroscope");
    return text.empty() ? "no rumble" : text;
}

std::string prompts_text(const Prompts& prompts) {
    using enum Button;
    std::string text;
    for (const Button button : {south, east, west, north, left_shoulder, right_shoulder,
                                left_trigger, right_trigger, select, start, guide})
        text += (text.empty() ? "" : ", ") + std::string(prompts.name(button));
    return text;
}

std::string paragraph(const HidNode& node, const Driver& driver) {
    char ids[16];
    std::snprintf(ids, sizeof ids, "%04x:%04x", node.identity.vendor, node.identity.product);
    std::string text =
        node.path + "  " + node.product + ", " + ids + ", " + bus_name(node.identity.bus) + "\n";
    text += "    read as: " + std::string(family_name(family_of(node.identity))) + "; "
            + abilities_text(driver.abilities()) + "\n";
    text += "    buttons: " + prompts_text(Prompts(node.identity)) + "\n";
    if (!driver.mapping().empty()) text += "    mapping: " + driver.mapping() + "\n";
    return text;
}

} // namespace

std::string list_pads(HidSource& source, const PlayerMappings& mappings) {
    std::string text;
    for (const std::string& name : source.names()) {
        HidNode node;
        if (!source.describe(name, node)) continue;
        const auto own = mappings.find({node.identity.vendor, node.identity.product});
        const auto driver =
            make_driver(node.identity, node.descriptor, own == mappings.end() ? "" : own->second);
        if (!driver) continue;
        text += paragraph(node, *driver);
        const Opened opened = source.open(node);
        if (opened.denied) text += "    " + permission_advice(node) + "\n";
        if (!opened.port && !opened.denied) text += "    it cannot be opened\n";
    }
    return text.empty() ? "no gamepad is connected\n" : text;
}

} // namespace host::pads
