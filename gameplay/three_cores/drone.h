#pragma once

#include "gameplay/projectile.h"
#include "gameplay/three_cores/plan.h"
#include "gameplay/three_cores/rules.h"

namespace peregrine::three_cores {

// Flies its round and looks along it. What it notices it looks at; alarmed, it goes along its round
// to where it is nearest to what it saw, and shoots at what it sees.
class Drone {
public:
    Drone(std::vector<Vec3> round, double phase);

    // Returns true in the tick that it shoots in.
    bool update(const Rules& rules, const gameplay::Notice& notice, const Vec3& target);
    // It falls onto the floor at this height, and is out for good.
    void disable(double floor);

    gameplay::Sentry sentry() const { return {position_, forward_}; }
    const Vec3& position() const { return position_; }
    const Vec3& forward() const { return forward_; }
    gameplay::Mood mood() const { return mood_; }
    double suspicion() const { return suspicion_; }
    double charge() const { return charge_; } // 0 to 1: the shot
    bool is_disabled() const { return disabled_; }
    void add_to(gameplay::StateHash& hash) const;

private:
    Vec3 place(double way) const;
    double way_nearest(const Vec3& point) const;
    void look_along(const Vec3& direction, double turn);
    void patrol(const Rules& rules);
    bool chase(const Rules& rules, const gameplay::Notice& notice, const Vec3& target);

    std::vector<Vec3> round_;
    std::vector<double> ends_; // of the round's legs, metres from its start
    bool loop_ = false;
    double way_ = 0;   // metres along the round
    double sense_ = 1; // or -1: backwards
    Vec3 position_{0}, forward_{0, 0, -1};
    gameplay::Mood mood_ = gameplay::Mood::calm;
    double suspicion_ = 0, charge_ = 0;
    double clock_; // s, of its gaze
    bool disabled_ = false;
    double floor_ = 0;
};

// What a drone shoots.
struct Bolt {
    gameplay::Projectile flight;
    uint64_t end = 0;
};

} // namespace peregrine::three_cores
