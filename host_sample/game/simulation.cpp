#include "simulation.h"

#include <utility>

namespace host::game {

Simulation::Simulation(Round& round, Actors& actors) : round_(round), actors_(actors) {
    next_.before = next_.now = round.game().eye();
    take();
    shown_ = next_;
    thread_ = std::thread([this] { run(); });
}

Simulation::~Simulation() {
    if (running_) done_.acquire();
    stopping_ = true;
    begin_.release();
    thread_.join();
}

void Simulation::start(uint32_t ticks, const gameplay::TickInput& live) {
    if (ticks == 0) return;
    ticks_ = ticks;
    live_ = live;
    running_ = true;
    begin_.release();
}

bool Simulation::finish() {
    if (!running_) return false;
    done_.acquire();
    running_ = false;
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
    shown_ = next_;
    return true;
}

void Simulation::run() {
    for (;;) {
        begin_.acquire();
        if (stopping_) return;
        try {
            play();
        } catch (...) {
            error_ = std::current_exception();
        }
        done_.release();
    }
}

// What is only to be seen is described before a tick, whose commit publishes it: it is a tick late.
void Simulation::play() {
    next_.events.clear();
    for (uint32_t i = 0; i < ticks_; ++i) {
        if (i + 1 == ticks_) actors_.show(round_.game());
        if (!round_.tick(live_)) break;
        const auto events = round_.game().events();
        next_.events.insert(next_.events.end(), events.begin(), events.end());
        next_.before = next_.now;
        next_.now = round_.game().eye();
    }
    take();
}

void Simulation::take() {
    const three_cores::Game& game = round_.game();
    next_.status = game.status();
    next_.over = round_.over();
    next_.particles.clear();
    actors_.add_particles(game, next_.events, next_.particles);
    next_.drones.clear();
    for (const three_cores::Drone& drone : game.drones())
        next_.drones.push_back({drone.position(), drone.suspicion(), drone.charge(),
                                drone.mood() == gameplay::Mood::alarmed, drone.is_disabled()});
    next_.cores.clear();
    for (const three_cores::Core& core : game.cores())
        if (!core.taken) next_.cores.push_back(core.position);
}

} // namespace host::game
