#include "query_race.h"

#include "bullet_queries.h"
#include "embree_queries.h"
#include "peregrine_queries.h"
#include "timing.h"

#include <cstdio>

namespace peregrine::bench {
namespace {

constexpr double kPatience = 5; // seconds: who takes longer than this runs but once

double time_run(const QueryContestant& contestant, QueryAnswers& answers) {
    const double start = thread_seconds();
    contestant.run(answers);
    return thread_seconds() - start;
}

struct Entrant {
    QueryContestant* contestant;
    Accuracy accuracy;
    bool is_slow;
    std::vector<double> seconds; // a pass
};

} // namespace

QueryContestants QueryRace::gather(const Level& level) const {
    QueryContestants contestants;
    contestants.push_back(make_peregrine_queries(api_, level, false));
    contestants.push_back(make_peregrine_queries(api_, level, true));
    for (const std::string& peer : peers_) {
        if (peer == "bullet") {
            contestants.push_back(make_bullet_queries(level));
        } else {
            contestants.push_back(make_embree_queries(level, true));
            contestants.push_back(make_embree_queries(level, false));
        }
    }
    return contestants;
}

void QueryRace::hold(const std::string& scene, const std::string& item,
                     const QueryContestants& contestants, const QuerySet& set,
                     const Judgement& judgement) {
    std::fprintf(stderr, "%s, %s: running\n", scene.c_str(), item.c_str());
    QueryAnswers answers;
    std::vector<Entrant> entrants;
    for (size_t i = 0; i < contestants.size(); ++i) {
        QueryContestant& contestant = *contestants[i];
        if (!contestant.answers(set.kind)) continue;
        contestant.prepare(set);
        answers.make_room(set);
        const double seconds = time_run(contestant, answers);
        std::fprintf(stderr, "  %-16s %10.0f thousand/s\n", contestant.name().c_str(),
                     1e-3 * double(set.size()) / seconds);
        const bool is_slow = seconds > kPatience;
        entrants.push_back({&contestant, judgement(i, answers), is_slow, {}});
        if (is_slow) entrants.back().seconds.push_back(seconds);
    }
    for (uint32_t pass = 0; pass < passes_; ++pass)
        for (Entrant& entrant : entrants)
            if (!entrant.is_slow) entrant.seconds.push_back(time_run(*entrant.contestant, answers));
    for (const Entrant& entrant : entrants) {
        rows_.push_back({scene, item, entrant.contestant->name(),
                         double(set.size()) / median(entrant.seconds), entrant.accuracy});
        print_query_row(rows_.back());
    }
}

} // namespace peregrine::bench
