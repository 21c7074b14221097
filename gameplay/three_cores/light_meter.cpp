#include "gameplay/three_cores/light_meter.h"

#include "gameplay/three_cores/rules.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace peregrine::three_cores {
namespace {

constexpr double kHalf = 0.9;   // lux that make half of it
constexpr double kSunWay = 500; // m

// What would fall on a place if nothing were between, as frames show it: rt.h has the formulas at
// rt_falloff; levels' lamps are windowed inverse squares. The way to the lamp in `to`.
double illuminance(const Lamp& lamp, const Vec3& place, Vec3& to) {
    if (lamp.kind == Lamp::Kind::sun) {
        to = -kSunWay * lamp.direction;
        return lamp.candela;
    }
    to = lamp.position - place;
    const double square = glm::dot(to, to);
    if (square >= lamp.radius * lamp.radius || square == 0) return 0;
    const double part = square / (lamp.radius * lamp.radius);
    double lux = lamp.candela * (1 - part * part) / std::max(square, 0.01);
    if (lamp.kind == Lamp::Kind::spot) {
        const double cosine = -glm::dot(to, lamp.direction) / glm::length(to);
        const double range = std::max(lamp.cos_inner - lamp.cos_outer, 1e-6);
        const double s = std::clamp((cosine - lamp.cos_outer) / range, 0.0, 1.0);
        lux *= s * s * (3 - 2 * s);
    }
    return lux;
}

} // namespace

double LightMeter::measure(const gameplay::World& world, const Vec3& place) {
    from_.clear();
    to_.clear();
    lux_.clear();
    for (const Lamp& lamp : lamps_) {
        Vec3 way;
        const double lux = illuminance(lamp, place, way);
        if (lux < 0.01) continue;
        from_.push_back(place);
        to_.push_back(place + 0.98 * way); // lamps hang in their own glass
        lux_.push_back(lux);
    }
    clear_.resize(from_.size());
    if (!from_.empty()) world.lines_of_sight(place, from_, to_, {kSolid, {}}, clear_);
    double sum = 0;
    for (size_t i = 0; i < lux_.size(); ++i)
        if (clear_[i]) sum += lux_[i];
    return sum / (sum + kHalf);
}

} // namespace peregrine::three_cores
