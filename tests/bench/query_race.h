#pragma once

#include "query_contestant.h"
#include "query_table.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace peregrine::bench {

using QueryContestants = std::vector<std::unique_ptr<QueryContestant>>;

// Holds the races of a run and keeps its table.
class QueryRace {
public:
    QueryRace(const rt_api& api, std::vector<std::string> peers, uint32_t passes)
        : api_(api), peers_(std::move(peers)), passes_(passes) {}

    // Ours with single calls and with whole sets, then the peers.
    QueryContestants gather(const Level& level) const;

    // All contestants that have such queries run the set once, which is judged, and then in turns,
    // so that what else the machine does meets all of them. CPU time of this thread; medians.
    using Judgement = std::function<Accuracy(size_t contestant, const QueryAnswers& answers)>;
    void hold(const std::string& scene, const std::string& item,
              const QueryContestants& contestants, const QuerySet& set, const Judgement& judgement);

    const std::vector<QueryRow>& rows() const { return rows_; }

private:
    const rt_api& api_;
    std::vector<std::string> peers_;
    uint32_t passes_;
    std::vector<QueryRow> rows_;
};

} // namespace peregrine::bench
