#include "shade/air/airlight.h"

#include "scene/lights/falloff.h"
#include "shade/scratch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace peregrine::shade {
namespace {

constexpr double kFarthest = 3e7;  // metres from the rays: no lamp is that large
constexpr double kMargin = 1e-3;   // radians, for all rounding
constexpr float kSmallest = 1e-6f; // metres: lamps that end nearer have no light to speak of
constexpr float kPerSteradian = 0.25f * std::numbers::inv_pi_v<float>; // of all around

// Gauss's: exact for polynomials of degree 2 n - 1.
constexpr double kTenPlaces[] = {0.1488743389816312, 0.4333953941292472, 0.6794095682990244,
                                 0.8650633666889845, 0.9739065285171717};
constexpr double kTenWeights[] = {0.2955242247147529, 0.2692667193099964, 0.2190863625159820,
                                  0.1494513491505806, 0.0666713443086881};
constexpr double kThreePlace = 0.7745966692414834, kTwoPlace = 0.5773502691896258;

AirNodes ten_nodes() {
    AirNodes nodes;
    for (uint32_t i = 0; i < 5; ++i)
        for (const double side : {-1.0, 1.0}) {
            nodes.at[nodes.count] = float(side * kTenPlaces[i]);
            nodes.weight[nodes.count++] = float(kTenWeights[i]);
        }
    return nodes;
}

// Two or three in each piece.
AirNodes nodes_of(uint32_t pieces) {
    constexpr uint32_t kFew = 8;
    AirNodes nodes;
    nodes.in_piece = pieces < kFew ? 3 : 2;
    const auto add = [&](double at, double weight) {
        nodes.at[nodes.count] = float(at);
        nodes.weight[nodes.count++] = float(weight);
    };
    const double half = 1.0 / std::max(pieces, 1u);
    for (uint32_t i = 0; i < pieces; ++i) {
        const double middle = (2 * i + 1) * half - 1;
        if (nodes.in_piece == 2) {
            add(middle - half * kTwoPlace, half);
            add(middle + half * kTwoPlace, half);
        } else {
            add(middle - half * kThreePlace, half * (5.0 / 9));
            add(middle, half * (8.0 / 9));
            add(middle + half * kThreePlace, half * (5.0 / 9));
        }
    }
    return nodes;
}
static_assert(2 * kMostPieces <= AirNodes::kMost);

// Whether a ray may come near the lamp. What is left out would have got nothing.
bool may_meet(const AirBounds& bounds, const PreparedLight& light) {
    const math::Vec3d lower(bounds.lower), upper(bounds.upper);
    const math::Vec3d way = math::Vec3d(light.position) - 0.5 * (lower + upper);
    const double reach = double(light.radius) + 0.5 * glm::length(upper - lower);
    const double distance = glm::length(way);
    if (!(distance < kFarthest + reach) || light.radius < kSmallest) return false;
    if (distance <= reach) return true;
    if (distance > (reach + double(bounds.longest)) * (1 + kMargin)) return false;
    const double off =
        std::acos(std::clamp(glm::dot(way, math::Vec3d(bounds.axis)) / distance, -1.0, 1.0));
    const double cone = std::acos(std::clamp(double(bounds.least_cosine), -1.0, 1.0));
    return off <= cone + std::asin(std::min(reach / distance, 1.0)) + kMargin;
}

// Whether two ways are so alike that what one sees holds for the other, too.
bool are_alike(const AirWays& ways, uint32_t a, uint32_t b) {
    constexpr float kPart = 1.0f / 16;
    const float most = (ways.last[a] - ways.first[a]) * kPart;
    const auto differs = [&](const AirWays::Lanes& lanes) {
        return !(std::fabs(lanes[a] - lanes[b]) <= most);
    };
    return !(differs(ways.first) || differs(ways.last) || differs(ways.before)
             || differs(ways.foot[0]) || differs(ways.foot[1]) || differs(ways.foot[2]));
}

} // namespace

Airlight::Airlight(const scene::Snapshot& snapshot, const Fog& fog,
                   std::span<const PreparedLight> lights, const SurfaceSpace& space,
                   const AirShadows& shadows)
    : kernels_(&kernels(snapshot.isa())), layer_(fog.layer()), lights_(lights), space_(space),
      shadows_(snapshot, space), pieces_(shadows.pieces), group_(shadows.group),
      nodes_(ten_nodes()), piece_nodes_(nodes_of(shadows.pieces)) {
    if (fog.any() && !lights.empty()) numbers_ = snapshot.lights->in_fog;
}

void Airlight::begin(const math::Vec3d& eye, AirlightMemory& memory) const {
    const math::Vec3d from = eye - space_.origin;
    for (int k = 0; k < 3; ++k) std::fill_n(memory.eye[k], kPadded, float(from[k]));
}

AirBounds Airlight::bounds_of(const AirRays& rays) const {
    const auto direction = [&](uint32_t i) {
        return glm::normalize(
            math::Vec3d(rays.direction[0][i], rays.direction[1][i], rays.direction[2][i]));
    };
    const math::Vec3d first = direction(0), both = first + direction(rays.count - 1);
    const bool have_middle = glm::length(both) > 1e-3;
    AirBounds bounds =
        kernels_->bound_rays(rays, math::Vec3(have_middle ? glm::normalize(both) : first));
    for (int k = 0; k < 3; ++k) {
        const auto [least, most] = std::minmax_element(rays.origin[k], rays.origin[k] + rays.count);
        bounds.lower[k] = *least;
        bounds.upper[k] = *most;
    }
    return bounds;
}

void Airlight::add(const RayHits& hits, float* const radiance[3], Scratch& scratch) const {
    const AirlightMemory& memory = *scratch.airlight;
    add({{memory.eye[0], memory.eye[1], memory.eye[2]},
         {hits.direction[0], hits.direction[1], hits.direction[2]},
         hits.t,
         hits.count},
        radiance, scratch);
}

void Airlight::add(const AirRays& rays, float* const radiance[3], Scratch& scratch) const {
    const AirBounds bounds = bounds_of(rays);
    for (const uint32_t number : numbers_) {
        const PreparedLight& light = lights_[number];
        if (!may_meet(bounds, light)) continue;
        const bool is_wide = light.type == scene::LightType::spot && light.cone_outer_cos < 0;
        for (uint32_t part = 0; part < 1 + uint32_t(is_wide); ++part) {
            const uint32_t count =
                kernels_->list_ways(light, layer_, rays, part, scratch.airlight->ways);
            if (count > 0) add(light, count, radiance, scratch);
        }
    }
}

void Airlight::add(const PreparedLight& light, uint32_t count, float* const radiance[3],
                   Scratch& scratch) const {
    AirlightMemory& memory = *scratch.airlight;
    Sight sight = Sight::all;
    if (pieces_ > 0 && light.casts_shadow) sight = find_seen(light, count, scratch);
    if (sight == Sight::nothing) return;
    const bool in_pieces = sight == Sight::some;
    const bool is_spot = light.type == scene::LightType::spot;
    kernels_->add_up_airlight[is_spot][uint32_t(light.falloff)](
        light, layer_, in_pieces ? piece_nodes_ : nodes_, in_pieces ? memory.seen : nullptr,
        memory.ways, count, memory.sums);
    const float part = kPerSteradian * light.fog_scatter * layer_.density;
    for (uint32_t i = 0; i < count; ++i) {
        const float sum = std::min(memory.sums[i] * part, scene::kBrightest);
        for (int k = 0; k < 3; ++k)
            radiance[k][memory.ways.ray[i]] += std::min(sum * light.color[k], scene::kBrightest);
    }
}

// Which points of `way` and `at` the lamp sees, in scratch.shadow.occluded.
void Airlight::ask(const PreparedLight& light, uint32_t count, Scratch& scratch) const {
    const AirlightMemory& memory = *scratch.airlight;
    ShadowMemory& shadow = scratch.shadow;
    float* const to[3] = {shadow.direction[0], shadow.direction[1], shadow.direction[2]};
    kernels_->place_points(memory.ways, memory.way, memory.at, count, to);
    PreparedLight lamp = light;
    lamp.from_light = true;
    shadows_.trace(lamp, count, shadow);
}

uint32_t Airlight::list_asking(uint32_t count, AirlightMemory& memory) const {
    const AirWays& ways = memory.ways;
    uint32_t asking = 0, first = 0;
    for (uint32_t i = 0; i < count; ++i) {
        const bool begins = i == 0 || ways.ray[i] / group_ != ways.ray[i - 1] / group_;
        if (begins) first = asking;
        memory.by[i] = first;
        if (!begins && are_alike(ways, memory.asking[first], i)) continue;
        memory.by[i] = asking;
        memory.asking[asking++] = i;
    }
    return asking;
}

// Fills memory.seen if it is some.
Airlight::Sight Airlight::find_seen(const PreparedLight& light, uint32_t count,
                                    Scratch& scratch) const {
    AirlightMemory& memory = *scratch.airlight;
    const uint32_t asking = list_asking(count, memory);
    uint32_t hidden = 0;
    for (uint32_t end = 0; end <= pieces_; ++end) {
        std::copy_n(memory.asking, asking, memory.way);
        std::fill_n(memory.at, asking, end_of_piece(end));
        ask(light, asking, scratch);
        std::copy_n(scratch.shadow.occluded, asking, memory.hidden[end]);
        for (uint32_t i = 0; i < asking; ++i) hidden += memory.hidden[end][i];
    }
    if (hidden == 0) return Sight::all;
    if (hidden == asking * (pieces_ + 1)) return Sight::nothing;
    find_borders(light, asking, scratch);
    if (asking < count)
        for (uint32_t piece = 0; piece < pieces_; ++piece)
            for (uint32_t i = count; i-- > 0;) // none is asked by a later one
                memory.seen[piece][i] = memory.seen[piece][memory.by[i]];
    return Sight::some;
}

void Airlight::find_borders(const PreparedLight& light, uint32_t asking, Scratch& scratch) const {
    AirlightMemory& memory = *scratch.airlight;
    uint32_t listed = 0;
    for (uint32_t piece = 0; piece < pieces_; ++piece) {
        const uint8_t* const first = memory.hidden[piece];
        const uint8_t* const last = memory.hidden[piece + 1];
        for (uint32_t i = 0; i < asking; ++i) {
            memory.seen[piece][i] = first[i] ? 0.0f : 1.0f;
            if (first[i] == last[i]) continue;
            memory.way[listed] = memory.asking[i];
            memory.number[listed] = i;
            memory.piece[listed] = piece;
            memory.bright[listed] = end_of_piece(piece + first[i]);
            memory.dark[listed] = end_of_piece(piece + last[i]);
            if (++listed < kBatch) continue;
            approach(light, listed, scratch);
            listed = 0;
        }
    }
    if (listed > 0) approach(light, listed, scratch);
}

void Airlight::approach(const PreparedLight& light, uint32_t count, Scratch& scratch) const {
    constexpr int kRounds = 3;
    AirlightMemory& memory = *scratch.airlight;
    for (int round = 0; round < kRounds; ++round) {
        for (uint32_t i = 0; i < count; ++i)
            memory.at[i] = 0.5f * (memory.bright[i] + memory.dark[i]);
        ask(light, count, scratch);
        for (uint32_t i = 0; i < count; ++i)
            (scratch.shadow.occluded[i] ? memory.dark : memory.bright)[i] = memory.at[i];
    }
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t piece = memory.piece[i], number = memory.number[i];
        const bool begins_dark = memory.hidden[piece][number];
        const float bright = end_of_piece(piece + begins_dark);
        const float border = 0.5f * (memory.bright[i] + memory.dark[i]);
        memory.seen[piece][number] = std::fabs(border - bright) * 0.5f * float(pieces_);
    }
}

} // namespace peregrine::shade
