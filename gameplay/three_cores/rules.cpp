#include "gameplay/three_cores/rules.h"

namespace peregrine::three_cores {

Rules rules_of(Difficulty difficulty) {
    Rules rules;
    rules.character.speed = 5;
    rules.character.crouched_speed = 1.7;
    rules.character.step_height = 0.46;
    rules.grenade.mask.layers = kSolid;
    rules.sentry.range = 22;
    rules.sentry.cos_half_angle = 0.7; // 45 degrees to each side
    rules.sentry.notice_seconds = 0.9;
    rules.sentry.forget_seconds = 7;
    switch (difficulty) {
    case Difficulty::easy:
        rules.lives = 5;
        rules.grenades = 9;
        rules.is_patient = true;
        rules.drone_speed = 1.1;
        rules.charge_seconds = 1.8;
        rules.bolt_speed = 16;
        rules.lead = 0;
        rules.sentry.range = 17;
        rules.sentry.notice_seconds = 1.6;
        rules.sentry.forget_seconds = 5;
        break;
    case Difficulty::normal:
        break;
    case Difficulty::hard:
        rules.lives = 2;
        rules.grenades = 4;
        rules.drone_speed = 1.8;
        rules.charge_seconds = 0.8;
        rules.bolt_speed = 28;
        rules.lead = 1;
        rules.sentry.range = 28;
        rules.sentry.notice_seconds = 0.55;
        rules.sentry.forget_seconds = 10;
        break;
    }
    return rules;
}

} // namespace peregrine::three_cores
