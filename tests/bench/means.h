#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

namespace peregrine::bench {

// A geometric mean.
class Mean {
public:
    void add(double value) {
        sum_ += std::log(value);
        ++count_;
    }
    // NaN of nothing.
    double value() const {
        return count_ ? std::exp(sum_ / double(count_)) : std::numeric_limits<double>::quiet_NaN();
    }

private:
    double sum_ = 0;
    size_t count_ = 0;
};

// The other scenes are models: of them a frame shows one thing in an empty room.
inline bool is_level(const std::string& scene) {
    return scene != "teapots" && scene.rfind("dragon", 0) != 0;
}

} // namespace peregrine::bench
