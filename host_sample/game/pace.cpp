#include "pace.h"

#include <cmath>

namespace host::game {

namespace {

constexpr double memory = 2.0; // seconds
constexpr double hang = 3.0;   // seconds: the machine slept, or the window was held

} // namespace

void Pace::add(double passed, double played) {
    if (passed > hang) return;
    const double left = std::exp(-passed / memory);
    passed_ = left * passed_ + passed;
    played_ = left * played_ + played;
}

} // namespace host::game
