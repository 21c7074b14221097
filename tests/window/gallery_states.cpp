#include "gallery_states.h"

namespace host::ui {
namespace {

using three_cores::Difficulty;

DroneMark mark_at(const Projection& projection, glm::dvec3 place, float suspicion, float charge) {
    return {projection.sight(place), projection.radius(place, 0.36), suspicion, charge,
            suspicion >= 1.0f};
}

} // namespace

Viewpoint viewpoint() {
    Viewpoint view;
    view.position = {0.0, 1.7, 0.0};
    return view;
}

Device keyboard() {
    return {"Keyboard and mouse",
            "Enter",
            "Esc",
            {{"Walk", "W A S D"},
             {"Look", "Mouse"},
             {"Run", "Shift"},
             {"Crouch", "Ctrl"},
             {"Jump", "Space"},
             {"Open a door", "E"},
             {"Cook and throw a grenade", "Left mouse button"},
             {"Slow walk", "Alt"},
             {"Pause", "Esc"},
             {"Picture", "F12"}}};
}

Hud calm_hud() {
    Hud hud;
    hud.lives = 2;
    hud.grenades = 4;
    hud.cores = 1;
    hud.cores_total = 3;
    hud.drones = 5;
    hud.drones_total = 6;
    hud.score = 1250;
    hud.seconds = 134.5;
    hud.light = 0.35f;
    hud.hint = {"E", "open the door"};
    return hud;
}

Hud arc_hud(const Projection& projection) {
    Hud hud = calm_hud();
    hud.cooking = 0.55f;
    hud.light = 0.7f;
    hud.hint = {};
    std::vector<glm::dvec3> way;
    for (int i = 0; i <= 40; ++i) {
        const double t = i / 40.0;
        way.emplace_back(0.25 + 1.2 * t, 1.5 + 3.4 * t - 4.8 * t * t, -0.4 - 9.0 * t);
    }
    hud.arc = project_arc(projection, way, 1.0);
    return hud;
}

Hud alarm_hud(const Projection& projection) {
    Hud hud = calm_hud();
    hud.seen = 0.8f;
    hud.light = 0.9f;
    hud.alarm = 0.8f; // it was certain a while ago
    hud.alarmed = true;
    hud.lives = 1;
    hud.hint = {};
    hud.drone_marks = {mark_at(projection, {1.9, 3.0, -9.0}, 1.0f, 0.6f),
                       mark_at(projection, {-3.4, 2.6, -11.0}, 0.55f, 0.0f),
                       mark_at(projection, {6.0, 3.0, 3.0}, 0.7f, 0.0f)};
    return hud;
}

Hud gate_hud(const Projection& projection) {
    Hud hud = calm_hud();
    hud.cores = 3;
    hud.gate_open = true;
    hud.hurt = 0.7f;
    hud.light = 0.05f;
    hud.goals = {{projection.sight({0.0, 2.2, -21.0}), "GATE"}};
    hud.hint = {"", "All cores taken: reach the gate"};
    return hud;
}

Hud suspicious_hud(const Projection& projection) {
    Hud hud = calm_hud();
    hud.seen = 0.4f;
    hud.alarm = 0.9f;
    hud.drone_marks = {mark_at(projection, {0.3, 5.9, -9.0}, 0.9f, 0.0f),
                       mark_at(projection, {6.0, 3.0, 3.0}, 0.7f, 0.0f)};
    return hud;
}

// In all directions, and some where the HUD is or where others are.
Hud goals_hud(const Projection& projection) {
    Hud hud = calm_hud();
    for (const glm::dvec3 place :
         {glm::dvec3(0.0, 5.5, -9.0), glm::dvec3(0.2, 1.2, -14.0), glm::dvec3(0.4, 1.2, -15.0),
          glm::dvec3(9.0, 1.2, -2.0), glm::dvec3(-9.0, 6.0, -1.0), glm::dvec3(0.5, 1.2, 12.0),
          glm::dvec3(-0.5, -4.0, 14.0), glm::dvec3(0.5, 9.0, -1.0), glm::dvec3(0.2, -6.0, 0.3)})
        hud.goals.push_back({projection.sight(place), "CORE"});
    return hud;
}

EndScreen won_screen() {
    EndScreen end;
    end.won = true;
    end.level = "The hall at night";
    end.story = "All three cores are yours, and the night keeps quiet.";
    end.seconds = 214.38;
    end.score = 12350;
    end.lines = {{"Cores", "3 000"},
                 {"Drones put out", "2 \xc3\x97 250"},
                 {"Never in alarm", "2 000"},
                 {"Lives left", "2 \xc3\x97 500"},
                 {"Time", "5 850"}};
    end.best = BestResult{214.38, 14100};
    end.new_best_time = true;
    return end;
}

EndScreen lost_screen() {
    EndScreen end;
    end.level = "The hall at night";
    end.difficulty = Difficulty::hard;
    end.story = "A drone's third shot found you on the gallery.";
    end.seconds = 96.2;
    end.score = 2250;
    end.lines = {{"Cores", "1 of 3"}, {"Drones put out", "2 of 6"}};
    end.best = BestResult{188.0, 9900};
    return end;
}

} // namespace host::ui
