#include "unattended.h"

#include <cinttypes>
#include <cstdio>

#include "../error.h"
#include "../stop.h"
#include "../whole_file.h"

namespace host::game {

namespace {

constexpr uint64_t longest_round = 60 * 60 * three_cores::kTicksPerSecond; // an hour

const char* name_of(three_cores::Outcome outcome) {
    switch (outcome) {
    case three_cores::Outcome::won:
        return "WON";
    case three_cores::Outcome::lost:
        return "LOST";
    case three_cores::Outcome::playing:
        break;
    }
    return "UNFINISHED";
}

} // namespace

int play_unattended(Round& round) {
    while (!is_stopped() && !round.astray() && round.game().ticks() < longest_round
           && round.tick({})) {
    }
    if (round.astray()) {
        std::fprintf(stderr,
                     "peregrine_play: the replay goes astray in tick %" PRIu64
                     ": the state after it is not the recorded one\n",
                     *round.astray());
        return 4;
    }
    const three_cores::Outcome outcome = round.game().status().outcome;
    std::printf("%s %016" PRIx64 "\n", name_of(outcome), round.game().hash());
    std::fflush(stdout); // whatever becomes of what is written next
    return outcome == three_cores::Outcome::won ? 0 : 3;
}

gameplay::Replay read_replay(const std::string& path) {
    try {
        return gameplay::load_replay(path);
    } catch (const gameplay::ReplayError& error) {
        throw InputError(error.what());
    }
}

void write_replay(const gameplay::Replay& replay, const std::string& path) {
    const std::vector<uint8_t> bytes = gameplay::encode_replay(replay);
    const std::string cause =
        write_whole_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    if (!cause.empty()) throw InputError("the replay " + path + " cannot be written: " + cause);
}

} // namespace host::game
