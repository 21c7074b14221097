#pragma once

#include "gameplay/replay.h"
#include "gameplay/three_cores/crate.h"
#include "gameplay/three_cores/door.h"
#include "gameplay/three_cores/drone.h"
#include "gameplay/three_cores/glow.h"
#include "gameplay/three_cores/lift.h"
#include "gameplay/three_cores/light_meter.h"
#include "gameplay/three_cores/plan.h"
#include "gameplay/three_cores/rules.h"

namespace peregrine::three_cores {

enum class Outcome : uint32_t { playing, won, lost };

enum class Sound : uint32_t {
    step,
    jump,
    land,
    fling, // a grenade leaves the hand
    bounce,
    blast,
    core,
    noticed, // a drone became suspicious
    alarm,
    shot,
    hurt,
    door,
    lift,
    gate,
    disabled, // a drone went out
    won,
    lost
};

struct Event {
    Sound sound;
    Vec3 point{0};
    double strength = 1; // 0 to 1
};

enum class Use : uint32_t { nothing, open_door, close_door, move_lift };

// What the player is shown beside the picture.
struct Status {
    Outcome outcome = Outcome::playing;
    uint32_t lives = 0, grenades = 0;
    uint32_t cores = 0, cores_total = 0;   // taken, of all
    uint32_t drones = 0, drones_total = 0; // still at work, of all
    uint32_t score = 0;
    double seconds = 0;
    double light = 0;   // on the player, 0 to 1
    double seen = 0;    // how much of the player the keenest drone sees, 0 to 1
    double alarm = 0;   // the highest suspicion, 0 to 1; falls while `alarmed` lasts
    double cooking = 0; // how much of the fuse is burnt of the grenade in the hand; 0: none there
    double charge = 0;  // how near the next shot is, 0 to 1
    double hurt = 0;    // 1 when just hit, back to 0 in a second
    bool open = false;  // the gate: all cores are taken
    Use use = Use::nothing; // what the button does here
    bool alarmed = false;   // a drone is
    uint32_t alarms = 0;    // how often one became so
};

struct Eye {
    Vec3 position{0};
    Vec3 forward{0, 0, -1}; // unit
};

struct Core {
    Vec3 position{0};
    bool taken = false;
};

struct Thrown {
    gameplay::Grenade ball;
    uint64_t end = 0; // the tick that it goes off in
};

struct Settings {
    Difficulty difficulty = Difficulty::normal;
    uint64_t seed = 1;
    rt_commit_desc commit = rt_default_commit_desc(); // as the host has committed the scene
};

// One round of the game. It moves the plan's parts in the scene and commits it, in every tick; the
// scene is otherwise the host's. Not for two threads at a time; frames may render meanwhile. The
// state depends on plan, settings and inputs alone, to the bit.
class Game {
public:
    Game(const rt_api& api, rt_scene scene, const Plan& plan, const Settings& settings);

    // 1/60 s. After the round has ended nothing happens any more.
    void tick(const gameplay::TickInput& input);

    uint64_t hash() const;
    uint64_t ticks() const { return tick_; }

    const Status& status() const { return status_; }
    Eye eye() const;
    const gameplay::Character& player() const { return player_; }
    std::span<const Drone> drones() const { return drones_; }
    std::span<const Bolt> bolts() const { return bolts_; }
    std::span<const Door> doors() const { return doors_; }
    std::span<const Core> cores() const { return cores_; }
    std::span<const Thrown> thrown() const { return thrown_; }
    std::vector<Glow> glows() const;                          // what shines of it now
    std::span<const Event> events() const { return events_; } // of the last tick
    const Plan& plan() const { return plan_; }
    const Rules& rules() const { return rules_; }
    const gameplay::World& world() const { return world_; }

    // The way that the grenade in the hand would take now, thrown along `view`: places every few
    // hundredths of a second, until its fuse ends; empty if there is none in the hand.
    std::vector<Vec3> preview(const Vec3& view) const;

private:
    void use();
    const Door* door_at_hand() const;
    Use usable() const;
    void move_parts();
    void commit();
    void move_player(const gameplay::TickInput& input);
    void make_steps(bool running, double fall_speed);
    void handle_grenades();
    void fly_grenades();
    void blast(const Vec3& point);
    void run_drones();
    void shoot(const Drone& drone);
    void fly_bolts();
    void collect();
    void hurt();
    void begin_again();
    void finish(Outcome outcome);
    void measure();
    uint32_t score() const;
    bool is_waited_for() const { return rules_.is_patient && idle_; }
    bool is_pressed(Button button) const { return (buttons_ & ~held_ & button) != 0; }
    void say(Sound sound, const Vec3& point, double strength = 1);
    void make_noise(const Vec3& point, double radius);
    gameplay::Grenade throw_along(const Vec3& view) const;
    Vec3 chest() const;
    std::vector<gameplay::Sentry> sentries() const;

    const rt_api* api_;
    rt_scene scene_;
    Plan plan_;
    Rules rules_;
    Settings settings_;
    gameplay::World world_;
    gameplay::Character player_;
    gameplay::Watch watch_;
    std::vector<Door> doors_;
    std::vector<Lift> lifts_;
    std::vector<Platform> gates_;
    std::vector<Crate> crates_;
    std::vector<Drone> drones_;
    std::vector<Bolt> bolts_;
    std::vector<Core> cores_;
    std::vector<Thrown> thrown_;
    std::vector<Blast> blasts_; // that still shine
    std::vector<gameplay::MeshMotion> motions_;
    std::vector<Event> events_;
    Status status_;
    Vec3 view_{0, 0, -1};
    LightMeter light_;
    uint64_t tick_ = 0;
    uint64_t cooking_since_ = 0;      // tick; 0: no grenade in the hand
    uint64_t safe_until_ = 0;         // tick: after a hit nobody is hit again
    bool idle_ = true;                // since the player begins, or begins again
    uint32_t spawn_ = 0;              // where to begin again
    double stride_ = 0;               // m since the last step
    uint32_t buttons_ = 0, held_ = 0; // of this tick and of the one before
};

} // namespace peregrine::three_cores
