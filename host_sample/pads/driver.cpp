#include "driver.h"

#include "eightbitdo.h"
#include "generic.h"
#include "known_pads.h"
#include "xbox.h"

namespace host::pads {

namespace {

class XboxDriver : public Driver {
public:
    explicit XboxDriver(XboxLayout layout) : layout_(layout) {}

    std::optional<PadState> receive(Bytes report, const PadState& before) override {
        return parse_xbox(report, layout_, before);
    }
    bool send(Link& link, Rumble rumble, Color) override { return link.write(xbox_output(rumble)); }
    Abilities abilities() const override { return {.rumble = true}; }

private:
    XboxLayout layout_;
};

class DescribedDriver : public Driver {
public:
    DescribedDriver(const ReportDescriptor& descriptor, const Mapping& mapping, bool rumbles)
        : reader_(descriptor, mapping), mapping_(mapping_text(mapping)), rumbles_(rumbles) {}

    std::optional<PadState> receive(Bytes report, const PadState& before) override {
        return reader_.parse(report, before);
    }
    bool send(Link& link, Rumble rumble, Color) override {
        return rumbles_ && link.write(eightbitdo_output(rumble));
    }
    Abilities abilities() const override { return {.rumble = rumbles_}; }
    std::string mapping() const override { return mapping_; }

private:
    GenericReader reader_;
    std::string mapping_;
    bool rumbles_;
};

std::unique_ptr<Driver> make_described_driver(const Identity& identity,
                                              const ReportDescriptor& descriptor,
                                              std::string_view text) {
    if (!is_gamepad(descriptor)) return nullptr;
    const bool eightbitdo = family_of(identity) == Family::eightbitdo;
    Mapping mapping = eightbitdo ? eightbitdo_mapping(descriptor, identity.product)
                                 : default_mapping(descriptor, ButtonOrder::guess);
    apply_mapping_text(known_mapping(identity), mapping);
    apply_mapping_text(text, mapping);
    const bool rumbles = eightbitdo && descriptor.output_ids.test(eightbitdo_output_id);
    return std::make_unique<DescribedDriver>(descriptor, mapping, rumbles);
}

} // namespace

std::unique_ptr<Driver> make_driver(const Identity& identity, Bytes descriptor,
                                    std::string_view mapping) {
    const auto parsed = parse_descriptor(descriptor);
    switch (family_of(identity)) {
    case Family::dualshock4:
        return make_dualshock4_driver(identity);
    case Family::dualsense:
        return make_dualsense_driver(identity);
    case Family::switch_pro:
        return make_switch_driver(identity);
    case Family::xbox:
        return std::make_unique<XboxDriver>(
            xbox_layout(identity.product, parsed ? highest_button(*parsed) : 0));
    case Family::eightbitdo:
    case Family::generic:
        return parsed ? make_described_driver(identity, *parsed, mapping) : nullptr;
    }
    return nullptr;
}

} // namespace host::pads
