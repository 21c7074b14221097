#include "show_hud.h"

namespace host::game {

namespace {

constexpr double drone_radius = 0.36; // metres

void add_drones(const Shown& shown, const ui::Projection& projection, ui::Hud& hud) {
    for (const DroneShown& drone : shown.drones) {
        if (drone.disabled || (drone.suspicion <= 0 && !drone.alarmed)) continue;
        ui::DroneMark& mark = hud.drone_marks.emplace_back();
        mark.sight = projection.sight(drone.position);
        mark.radius = projection.radius(drone.position, drone_radius);
        mark.suspicion = static_cast<float>(drone.suspicion);
        mark.charge = static_cast<float>(drone.charge);
        mark.alarmed = drone.alarmed;
    }
}

void add_goals(const Shown& shown, const three_cores::Plan& plan, const ui::Projection& projection,
               ui::Hud& hud) {
    for (const glm::dvec3& core : shown.cores)
        hud.goals.push_back({projection.sight(core), "CORE"});
    if (!shown.status.open) return;
    for (const glm::dvec3& exit : plan.exits)
        hud.goals.push_back({projection.sight(exit + glm::dvec3(0, 1.2, 0)), "GATE"});
}

const char* text_of(three_cores::Use use) {
    switch (use) {
    case three_cores::Use::open_door:
        return "open the door";
    case three_cores::Use::close_door:
        return "close the door";
    case three_cores::Use::move_lift:
        return "use the lift";
    case three_cores::Use::nothing:
        break;
    }
    return "";
}

} // namespace

ui::Hud hud_of(const Shown& shown, const three_cores::Rules& rules, const three_cores::Plan& plan,
               const ui::Projection& projection, std::span<const glm::dvec3> preview,
               const std::string& use_key) {
    const three_cores::Status& status = shown.status;
    ui::Hud hud;
    hud.lives = status.lives;
    hud.lives_total = rules.lives;
    hud.grenades = status.grenades;
    hud.grenades_total = rules.grenades;
    hud.cores = status.cores;
    hud.cores_total = status.cores_total;
    hud.drones = status.drones;
    hud.drones_total = status.drones_total;
    hud.score = status.score;
    hud.seconds = status.seconds;
    hud.light = static_cast<float>(status.light);
    hud.seen = static_cast<float>(status.seen);
    hud.alarm = static_cast<float>(status.alarm);
    hud.alarmed = status.alarmed;
    hud.cooking = static_cast<float>(status.cooking);
    hud.hurt = static_cast<float>(status.hurt);
    hud.gate_open = status.open;
    if (status.use != three_cores::Use::nothing) hud.hint = {use_key, text_of(status.use)};
    if (!preview.empty()) hud.arc = ui::project_arc(projection, preview, rules.blast_radius);
    add_drones(shown, projection, hud);
    add_goals(shown, plan, projection, hud);
    return hud;
}

} // namespace host::game
