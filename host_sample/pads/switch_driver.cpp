#include <array>

#include "driver.h"
#include "switch_commands.h"
#include "switch_pro.h"

namespace host::pads {

namespace {

using namespace std::chrono_literals;

constexpr auto answer_time = 100ms, vibration_time = 40ms; // a pulse fades if it is not renewed
constexpr unsigned most_tries = 3;

// A pad is set up step by step while its reports are read. A step that is not answered (another
// driver was there first, or the pad is an imitation) is passed over.
class SwitchDriver : public Driver {
public:
    explicit SwitchDriver(const Identity& identity) {
        if (identity.bus != Bus::bluetooth)
            for (const SwitchUsb command : {SwitchUsb::handshake, SwitchUsb::baud_rate,
                                            SwitchUsb::handshake, SwitchUsb::no_timeout})
                steps_.push_back({command, {}, {}});
        add(SwitchCommand::read_flash, flash_arguments(factory_sticks_at, factory_sticks_size));
        add(SwitchCommand::read_flash, flash_arguments(user_sticks_at, user_sticks_size));
        mode_step_ = steps_.size();
        add(SwitchCommand::set_report_mode, {0x30});
        add(SwitchCommand::enable_gyro, {0x01});
        add(SwitchCommand::enable_vibration, {0x01});
        add(SwitchCommand::set_player_lights, {0x01});
    }

    std::optional<PadState> receive(Bytes report, const PadState&) override {
        if (at_ < steps_.size() && confirms(report, steps_[at_])) next_step();
        // Whoever else uses the pad may have switched it back.
        const bool simple = !report.empty() && report[0] == 0x3f;
        if (simple && at_ == steps_.size() && repeats_ < most_tries) {
            ++repeats_;
            at_ = mode_step_;
        }
        return parse_switch(report, sticks_);
    }

    void tick(Link& link, Time now) override {
        if (at_ < steps_.size() && (tries_ == 0 || now - sent_ >= answer_time)) {
            if (tries_ == most_tries) next_step();
            if (at_ < steps_.size()) send_step(link, now);
        }
        if (rumble_ != Rumble{} && now - vibrated_ >= vibration_time) {
            vibrated_ = now;
            link.write(switch_rumble(rumble_, number_++));
        }
    }

    bool send(Link& link, Rumble rumble, Color) override {
        rumble_ = rumble;
        return link.write(switch_rumble(rumble, number_++));
    }

    Abilities abilities() const override { return {.rumble = true, .gyro = true}; }

private:
    struct Step {
        std::optional<SwitchUsb> usb; // or else:
        SwitchCommand command;
        std::vector<uint8_t> arguments;
    };

    void add(SwitchCommand command, std::vector<uint8_t> arguments) {
        steps_.push_back({std::nullopt, command, std::move(arguments)});
    }

    void next_step() {
        ++at_;
        tries_ = 0;
    }

    void send_step(Link& link, Time now) {
        const Step& step = steps_[at_];
        ++tries_;
        sent_ = now;
        link.write(step.usb ? switch_usb_command(*step.usb)
                            : switch_command(step.command, step.arguments, number_++));
        if (step.usb == SwitchUsb::no_timeout) next_step(); // has no answer
    }

    bool confirms(Bytes report, const Step& step) {
        if (step.usb) return confirmed_usb_command(report) == step.usb;
        const auto answer = command_answer(report);
        if (!answer || answer->command != step.command) return false;
        if (step.command != SwitchCommand::read_flash) return true;
        if (const auto flash = flash_content(*answer, factory_sticks_at, factory_sticks_size)) {
            sticks_ = with_factory_sticks(sticks_, *flash);
            return step.arguments == flash_arguments(factory_sticks_at, factory_sticks_size);
        }
        if (const auto flash = flash_content(*answer, user_sticks_at, user_sticks_size)) {
            sticks_ = with_user_sticks(sticks_, *flash);
            return step.arguments == flash_arguments(user_sticks_at, user_sticks_size);
        }
        return false;
    }

    std::vector<Step> steps_;
    size_t at_ = 0, mode_step_ = 0;
    unsigned tries_ = 0, repeats_ = 0, number_ = 0;
    Time sent_{}, vibrated_{};
    Rumble rumble_;
    SwitchSticks sticks_;
};

} // namespace

std::unique_ptr<Driver> make_switch_driver(const Identity& identity) {
    return std::make_unique<SwitchDriver>(identity);
}

} // namespace host::pads
