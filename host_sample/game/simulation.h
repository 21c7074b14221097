#pragma once

#include <exception>
#include <semaphore>
#include <thread>
#include <vector>

#include "actors.h"
#include "round.h"

namespace host::game {

struct DroneShown {
    glm::dvec3 position{0.0};
    double suspicion = 0.0, charge = 0.0;
    bool alarmed = false, disabled = false;
};

// What a frame needs to know of a round, as plain data: the round itself moves on meanwhile.
struct Shown {
    three_cores::Status status;
    three_cores::Eye before, now; // a tick ago and at the last one
    std::vector<DroneShown> drones;
    std::vector<three_cores::Event> events; // of the last batch of ticks
    std::vector<glm::dvec3> cores;          // that are still there
    std::vector<rt_particle> particles;
    bool over = false; // nothing more will happen
};

// Plays a round on a thread of its own, some ticks at a time, while the caller renders a frame.
// What the frame sees does not change under it: it holds the snapshot that it began with.
class Simulation {
public:
    Simulation(Round& round, Actors& actors);
    ~Simulation();
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;

    // Begins the ticks, all with the same input of the player.
    void start(uint32_t ticks, const gameplay::TickInput& live);

    // Until they are done. Rethrows what they threw. True if any were played since the last call;
    // then shown() is new. Before the next start() the round may be read.
    bool finish();

    const Shown& shown() const { return shown_; } // changed by finish() alone
    const Round& round() const { return round_; }

private:
    void run();
    void play();
    void take();

    Round& round_;
    Actors& actors_;
    Shown shown_, next_; // `next_` belongs to the thread while it runs
    uint32_t ticks_ = 0;
    gameplay::TickInput live_;
    std::exception_ptr error_;
    bool running_ = false, stopping_ = false;
    std::binary_semaphore begin_{0}, done_{0};
    std::thread thread_; // the last: it uses all of the above
};

} // namespace host::game
