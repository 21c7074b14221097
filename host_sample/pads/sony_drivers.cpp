#include "driver.h"
#include "dualsense.h"
#include "dualshock4.h"

namespace host::pads {

namespace {

GyroScale read_calibration(Link& link, uint8_t id, size_t size, GyroOrder order) {
    return parse_sony_calibration(link.feature(id, size), order).value_or(GyroScale());
}

class DualShock4Driver : public Driver {
public:
    explicit DualShock4Driver(const Identity& identity)
        : bluetooth_(identity.bus == Bus::bluetooth), dongle_(identity.product == 0x0ba0) {}

    // To ask for the calibration is also what switches the full mode on over Bluetooth.
    void start(Link& link) override {
        gyro_ = bluetooth_ ? read_calibration(link, 0x05, 41, GyroOrder::by_sign)
                           : read_calibration(link, 0x02, 37,
                                              dongle_ ? GyroOrder::by_sign : GyroOrder::by_axis);
        send(link, {}, resting_light);
    }
    std::optional<PadState> receive(Bytes report, const PadState&) override {
        return parse_dualshock4(report, gyro_);
    }
    bool send(Link& link, Rumble rumble, Color light) override {
        return link.write(bluetooth_ ? dualshock4_bluetooth_output(rumble, light)
                                     : dualshock4_usb_output(rumble, light));
    }
    Abilities abilities() const override { return {true, true, true}; }

private:
    bool bluetooth_, dongle_;
    GyroScale gyro_;
};

class DualSenseDriver : public Driver {
public:
    explicit DualSenseDriver(const Identity& identity)
        : bluetooth_(identity.bus == Bus::bluetooth), edge_(identity.product == 0x0df2) {}

    // As with the DualShock 4, the calibration switches the full mode on.
    void start(Link& link) override {
        gyro_ = read_calibration(link, 0x05, 41, GyroOrder::by_axis);
        new_vibration_ = edge_ || has_new_vibration(link.feature(0x20, 64));
        send_effects(link, {}, resting_light, bluetooth_);
    }
    std::optional<PadState> receive(Bytes report, const PadState&) override {
        return parse_dualsense(report, gyro_);
    }
    bool send(Link& link, Rumble rumble, Color light) override {
        return send_effects(link, rumble, light, false);
    }
    Abilities abilities() const override { return {true, true, true}; }

private:
    bool send_effects(Link& link, Rumble rumble, Color light, bool end_light_show) {
        const DualSenseEffects effects{rumble, light, new_vibration_, end_light_show};
        return link.write(bluetooth_ ? dualsense_bluetooth_output(effects, number_++)
                                     : dualsense_usb_output(effects));
    }

    bool bluetooth_, edge_, new_vibration_ = false;
    unsigned number_ = 0;
    GyroScale gyro_;
};

} // namespace

std::unique_ptr<Driver> make_dualshock4_driver(const Identity& identity) {
    return std::make_unique<DualShock4Driver>(identity);
}

std::unique_ptr<Driver> make_dualsense_driver(const Identity& identity) {
    return std::make_unique<DualSenseDriver>(identity);
}

} // namespace host::pads
