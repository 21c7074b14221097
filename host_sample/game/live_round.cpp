#include "live_round.h"

namespace host::game {

namespace {

constexpr double longest_step = 0.6; // metres in a tick: who goes farther was put somewhere else

} // namespace

LiveRound::LiveRound(Stage& stage, const three_cores::Plan& plan, const RoundSetup& setup,
                     Actors& actors)
    : setup_hands_(setup.hands), round_(stage, plan, setup), simulation_(round_, actors) {
    look_.face(shown().now.forward);
}

void LiveRound::advance(const Intent& intent, double seconds) {
    look_.turn(intent.turn);
    const uint32_t ticks = steps_.advance(seconds);
    blend_ = next_blend_;
    next_blend_ = steps_.blend();
    waiting_ |= intent.buttons;
    if (ticks == 0) return;
    simulation_.start(ticks, look_.input(intent.walk, waiting_));
    waiting_ = 0;
}

Viewpoint LiveRound::view(double field_of_view) const {
    const three_cores::Eye &before = shown().before, &now = shown().now;
    const bool jumped = glm::distance(before.position, now.position) > longest_step;
    const double part = jumped ? 1.0 : blend_;
    Viewpoint view;
    view.position = glm::mix(before.position, now.position, part);
    view.forward =
        is_mine() ? look_.direction() : glm::vec3(glm::mix(before.forward, now.forward, part));
    view.vertical_fov = static_cast<float>(glm::radians(field_of_view));
    return view;
}

std::vector<glm::dvec3> LiveRound::preview() const {
    const three_cores::Game& game = round_.game();
    if (shown().status.cooking <= 0) return {};
    return game.preview(is_mine() ? glm::dvec3(look_.direction()) : game.eye().forward);
}

} // namespace host::game
