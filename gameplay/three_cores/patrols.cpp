#include "gameplay/three_cores/patrols.h"

#include "gameplay/random.h"
#include "gameplay/three_cores/plan.h"
#include "gameplay/three_cores/rules.h"
#include "gameplay/three_cores/way.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace peregrine::three_cores {
namespace {

constexpr gameplay::Mask kWalls{kSolid, {}};
constexpr double kHover = 1.8;                   // metres above the floor
constexpr double kClearance = 0.45;              // metres: a drone and some air
constexpr double kEye = 1.6;                     // of who stands at the spawn
constexpr double kPeace = 10;                    // metres around the spawn where no drone sees it
constexpr double kShortest = 1.5, kLongest = 16; // metres: legs
constexpr size_t kPoints = 4;                    // of a round
constexpr size_t kPlaces = 300;                  // of the graph for a drone
constexpr size_t kMost = 6;                      // drones
constexpr uint32_t kStarts = 64;                 // tried for each drone
constexpr double kLevel = 0.2;                   // how steep, of how far
constexpr uint32_t kRounds = 8;                  // of which the longest is taken
constexpr uint32_t kTries = 24;                  // for each point

class Planner {
public:
    Planner(const gameplay::World& world, const Floors& floors, const Vec3& spawn, double peace)
        : world_(world), floors_(floors), eye_(spawn + Vec3(0, kEye, 0)), peace_(peace),
          random_(1) {
        apart_ = distances_from(floors, floors.nearest(spawn));
    }

    std::vector<std::vector<Vec3>> plan() {
        std::vector<std::vector<Vec3>> rounds;
        const size_t count = std::min(kMost, 1 + floors_.size() / kPlaces);
        for (size_t i = 0; i < count; ++i)
            if (std::vector<Vec3> round = longest_round(); round.size() > 1)
                rounds.push_back(std::move(round));
        return rounds;
    }

private:
    static Vec3 above(const Vec3& floor) { return floor + Vec3(0, kHover, 0); }

    // Places drawn at random, those far from the spawn and all rounds first.
    std::vector<uint32_t> starts() {
        std::vector<uint32_t> nodes;
        for (uint32_t i = 0; i < kStarts; ++i)
            nodes.push_back(random_.below(uint32_t(floors_.size())));
        std::ranges::stable_sort(nodes,
                                 [&](uint32_t a, uint32_t b) { return apart_[a] > apart_[b]; });
        return nodes;
    }

    std::vector<Vec3> longest_round() {
        std::vector<Vec3> longest;
        uint32_t tried = 0;
        double most = 0;
        for (const uint32_t start : starts()) {
            std::vector<Vec3> round = round_from(start);
            const double length = length_of(round);
            tried += length > 0;
            if (length > most) {
                most = length;
                longest = std::move(round);
            }
            if (tried == kRounds) break;
        }
        if (most > 0) keep_away_from(floors_.nearest(longest[0]));
        return longest;
    }

    static double length_of(const std::vector<Vec3>& round) {
        double length = 0;
        for (size_t i = 1; i < round.size(); ++i) length += glm::distance(round[i - 1], round[i]);
        return length;
    }

    void keep_away_from(uint32_t node) {
        const std::vector<double> distances = distances_from(floors_, node);
        for (size_t i = 0; i < apart_.size(); ++i) apart_[i] = std::min(apart_[i], distances[i]);
    }

    bool is_free(const Vec3& point) const {
        return !world_.overlaps({point, kClearance}, kWalls) && !disturbs(point);
    }

    bool disturbs(const Vec3& point) const {
        return glm::distance(point, eye_) < peace_ && world_.is_free(eye_, point, kWalls);
    }

    bool is_leg(const Vec3& from, const Vec3& to) const {
        const Vec3 leg = to - from;
        if (world_.sweep({from, kClearance}, leg, kWalls, false)) return false;
        const int steps = int(2 * glm::length(leg)) + 1;
        for (int i = 1; i <= steps; ++i)
            if (disturbs(from + leg * (double(i) / steps))) return false;
        return true;
    }

    std::vector<Vec3> round_from(uint32_t start) {
        std::vector<Vec3> round{above(floors_.place(start))};
        if (!is_free(round[0])) return {};
        while (round.size() < kPoints)
            if (const auto next = next_point(round))
                round.push_back(*next);
            else
                break;
        while (round.size() > 2 && glm::distance(round.front(), round.back()) < kLoopDistance
               && !is_leg(round.back(), round.front()))
            round.pop_back();
        return round;
    }

    // Of some points tried, the one farthest from all of the round.
    std::optional<Vec3> next_point(const std::vector<Vec3>& round) {
        std::optional<Vec3> best;
        double farthest = kShortest;
        for (uint32_t i = 0; i < kTries; ++i) {
            const Vec3 aside = kLongest * random_.in_ball() * Vec3(1, kLevel, 1);
            const uint32_t node = floors_.nearest(round.back() + aside);
            if (node == Floors::kNone) continue;
            const Vec3 point = above(floors_.place(node));
            double distance = kLongest;
            for (const Vec3& other : round)
                distance = std::min(distance, glm::distance(point, other));
            if (distance <= farthest || !is_free(point) || !is_leg(round.back(), point)) continue;
            farthest = distance;
            best = point;
        }
        return best;
    }

    gameplay::World world_;
    const Floors& floors_;
    Vec3 eye_;
    double peace_;
    gameplay::Random random_;
    std::vector<double> apart_; // how far each place is from the spawn and all rounds
};

} // namespace

std::vector<std::vector<Vec3>> plan_patrols(const gameplay::World& world, const Floors& floors,
                                            const Vec3& spawn) {
    auto rounds = Planner(world, floors, spawn, kPeace).plan();
    if (rounds.empty()) rounds = Planner(world, floors, spawn, 0).plan(); // one room, perhaps
    return rounds;
}

} // namespace peregrine::three_cores
