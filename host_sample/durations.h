#pragma once

#include <cstdint>
#include <vector>

namespace host {

// How long something took, time after time, in milliseconds.
class Durations {
public:
    void add(double milliseconds) { milliseconds_.push_back(milliseconds); }

    uint64_t count() const { return milliseconds_.size(); }
    double median() const; // 0 without any, as is worst()
    double worst() const;

private:
    std::vector<double> milliseconds_;
};

} // namespace host
