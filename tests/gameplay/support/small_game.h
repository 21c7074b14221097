#pragma once

#include "gameplay/character.h"
#include "gameplay/grenade.h"
#include "gameplay/replay.h"
#include "gameplay/sentry.h"
#include "support/arena.h"

#include <deque>

namespace peregrine::test {

// All rules at once: somebody walks, jumps, rides a lift and throws grenades; sentries look and
// listen.
class SmallGame {
public:
    enum Button : uint32_t { jump = 1, crouch = 2, fire = 4 };

    static constexpr uint32_t kTicksPerSecond = 60;

    SmallGame(rt_isa isa, uint32_t threads);

    bool is_supported() const { return arena_.is_supported(); }

    // Returns the hash of the state after the tick.
    uint64_t play_tick(const gameplay::TickInput& input);

    // What happened so far, lest a minute of nothing passes for a test.
    struct Events {
        size_t thrown = 0, bounces = 0, rested = 0, jumps = 0, rides = 0, alarms = 0;
    };
    const Events& events() const { return events_; }

private:
    gameplay::MeshMotion move_lift();
    void walk(const gameplay::TickInput& input, const gameplay::MeshMotion& lift);
    void throw_grenade(const Vec3& view);
    void fly_grenades();
    void watch();
    uint64_t hash() const;

    Arena arena_;
    rt_mesh lift_{};
    gameplay::World world_;
    gameplay::Character character_;
    std::deque<gameplay::Grenade> grenades_;
    std::vector<gameplay::Sentry> sentries_;
    gameplay::Watch watch_;
    uint64_t tick_ = 0;
    Events events_;
};

// A minute of somebody who plays, without a purpose but not without a plan.
std::vector<gameplay::TickInput> minute_of_inputs(uint64_t seed);

} // namespace peregrine::test
