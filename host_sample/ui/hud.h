#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ui/projection.h"

namespace host::ui {

// Over a drone, or at the side where it is.
struct DroneMark {
    Sight sight;            // of its middle
    float radius = 0.0f;    // of what it covers of the window, pixels
    float suspicion = 0.0f; // 0 to 1; 0 is not drawn
    float charge = 0.0f;    // 0 to 1: how near its shot is
    bool alarmed = false;
};

// A place to go to.
struct GoalMark {
    Sight sight;
    std::string label; // "GATE"; distance and whereabouts are added
};

// "[E] open the door"; the key as the device in use calls it.
struct Hint {
    std::string key;  // empty: text alone
    std::string text; // empty: no hint
};

// What is drawn over the picture while playing; all numbers as in three_cores::Status.
struct Hud {
    uint32_t lives = 0, lives_total = 3;
    uint32_t grenades = 0, grenades_total = 6;
    uint32_t cores = 0, cores_total = 0;
    uint32_t drones = 0, drones_total = 0;
    uint32_t score = 0;
    double seconds = 0.0;
    double speed = 1.0; // of time; told if it is less
    float light = 0.0f, seen = 0.0f, alarm = 0.0f;
    bool alarmed = false; // a drone is, though `alarm` may have fallen since
    float cooking = 0.0f; // 0: no grenade in the hand
    float hurt = 0.0f;
    bool gate_open = false;
    Hint hint;
    Arc arc;
    std::vector<DroneMark> drone_marks;
    std::vector<GoalMark> goals;
};

} // namespace host::ui
