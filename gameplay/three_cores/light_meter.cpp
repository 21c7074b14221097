#include "gameplay/three_cores/light_meter.h"

#include "gameplay/three_cores/rules.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace peregrine::three_cores {
namespace {

constexpr double kHalf = 0.9;   // lux that make half of it
constexpr double kLeast = 0.01; // lux that are worth a ray
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

void LightMeter::add(const Lamp& lamp, const Vec3& place) {
    Vec3 way;
    const double lux = illuminance(lamp, place, way);
    if (lux < kLeast) return;
    from_.push_back(place);
    to_.push_back(place + 0.98 * way); // lamps hang in their own glass
    lux_.push_back(lux);
}

double LightMeter::measure(const gameplay::World& world, const Vec3& place,
                           std::span<const Glow> glows) {
    from_.clear();
    to_.clear();
    lux_.clear();
    double sum = 0;
    for (const Lamp& lamp : lamps_) add(lamp, place);
    for (const Glow& glow : glows) {
        Vec3 way;
        if (glow.casts_shadow)
            add(glow.lamp, place);
        else
            sum += illuminance(glow.lamp, place, way);
    }
    clear_.resize(from_.size());
    if (!from_.empty()) world.lines_of_sight(place, from_, to_, {kSolid, {}}, clear_);
    for (size_t i = 0; i < lux_.size(); ++i)
        if (clear_[i]) sum += lux_[i];
    return sum / (sum + kHalf);
}

} // namespace peregrine::three_cores
