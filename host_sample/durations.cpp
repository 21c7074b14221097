#include "durations.h"

#include <algorithm>

namespace host {

double Durations::median() const {
    if (milliseconds_.empty()) return 0.0;
    std::vector<double> sorted = milliseconds_;
    std::sort(sorted.begin(), sorted.end());
    const size_t middle = sorted.size() / 2;
    return sorted.size() % 2 == 1 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
}

double Durations::worst() const {
    return milliseconds_.empty() ? 0.0
                                 : *std::max_element(milliseconds_.begin(), milliseconds_.end());
}

} // namespace host
