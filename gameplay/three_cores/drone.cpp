#include "gameplay/three_cores/drone.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace peregrine::three_cores {
namespace {

using gameplay::Mood;

constexpr double kHurry = 1.6;   // times the speed, when alarmed
constexpr double kSway = 0.55;   // how far the gaze goes to the sides
constexpr double kSwayEvery = 5; // s
constexpr double kCooling = 0.5; // of a charge, out of sight, a second
constexpr double kHover = 0.3;   // m above the floor, when it lies there
constexpr double kSink = 6;      // m/s

// Up and down between -1 and 1, once in a period.
double triangle_wave(double phase) {
    const double part = phase - std::floor(phase);
    return 1 - 4 * std::abs(part - 0.5);
}

} // namespace

Drone::Drone(std::vector<Vec3> round, double phase) : round_(std::move(round)), clock_(phase) {
    loop_ = round_.size() > 2 && glm::distance(round_.front(), round_.back()) < kLoopDistance;
    if (loop_) round_.push_back(round_.front());
    ends_.push_back(0);
    for (size_t i = 1; i < round_.size(); ++i)
        ends_.push_back(ends_.back() + glm::distance(round_[i - 1], round_[i]));
    way_ = 0.5 * ends_.back(); // rounds are named from where the player comes in
    position_ = place(way_);
    const Vec3 ahead = place(way_ + 0.1) - position_;
    if (glm::length(ahead) > 0) forward_ = glm::normalize(ahead);
}

Vec3 Drone::place(double way) const {
    const auto next = std::ranges::upper_bound(ends_, way);
    if (next == ends_.end()) return round_.back();
    if (next == ends_.begin()) return round_.front();
    const auto i = size_t(next - ends_.begin());
    const double part = (way - ends_[i - 1]) / (ends_[i] - ends_[i - 1]);
    return round_[i - 1] + part * (round_[i] - round_[i - 1]);
}

double Drone::way_nearest(const Vec3& point) const {
    double best = 0, nearest = glm::distance(point, round_[0]);
    for (size_t i = 1; i < round_.size(); ++i) {
        const Vec3 leg = round_[i] - round_[i - 1];
        const double square = glm::dot(leg, leg);
        if (square == 0) continue;
        const double part = std::clamp(glm::dot(point - round_[i - 1], leg) / square, 0.0, 1.0);
        const double distance = glm::distance(point, round_[i - 1] + part * leg);
        if (distance >= nearest) continue;
        nearest = distance;
        best = ends_[i - 1] + part * (ends_[i] - ends_[i - 1]);
    }
    return best;
}

void Drone::look_along(const Vec3& direction, double turn) {
    const double length = glm::length(direction);
    if (length == 0) return;
    const Vec3 turned = forward_ + std::min(1.0, turn * kTick) * (direction / length - forward_);
    const double left = glm::length(turned);
    forward_ = left > 1e-3 ? turned / left : direction / length;
}

void Drone::patrol(const Rules& rules) {
    const double end = ends_.back();
    way_ += sense_ * rules.drone_speed * kTick;
    if (loop_ && way_ >= end)
        way_ -= end;
    else if (way_ >= end || way_ <= 0) {
        way_ = std::clamp(way_, 0.0, end);
        if (!loop_) sense_ = way_ > 0 ? -1 : 1;
    }
    const Vec3 before = position_;
    position_ = place(way_);
    Vec3 ahead = sense_ * (place(std::min(way_ + 0.01, end)) - place(std::max(way_ - 0.01, 0.0)));
    if (glm::length(ahead) == 0) ahead = position_ - before;
    if (glm::length(ahead) == 0) return;
    ahead = glm::normalize(ahead);
    const Vec3 side(-ahead.z, 0, ahead.x);
    look_along(ahead + kSway * triangle_wave(clock_ / kSwayEvery) * side + Vec3(0, -0.12, 0),
               rules.drone_turn);
}

bool Drone::chase(const Rules& rules, const gameplay::Notice& notice, const Vec3& target) {
    const double goal = way_nearest(notice.last_known);
    const double step = kHurry * rules.drone_speed * kTick;
    way_ += std::clamp(goal - way_, -step, step);
    position_ = place(way_);
    const bool sees = notice.visibility > 0;
    look_along((sees ? target : notice.last_known + Vec3(0, 1, 0)) - position_,
               2 * rules.drone_turn);
    charge_ =
        std::clamp(charge_ + (sees ? kTick / rules.charge_seconds : -kCooling * kTick), 0.0, 1.0);
    if (charge_ < 1) return false;
    charge_ = 0;
    return true;
}

bool Drone::update(const Rules& rules, const gameplay::Notice& notice, const Vec3& target) {
    clock_ += kTick;
    if (disabled_) {
        position_.y = std::max(position_.y - kSink * kTick, std::min(floor_, position_.y));
        return false;
    }
    mood_ = notice.mood;
    suspicion_ = notice.suspicion;
    if (mood_ == Mood::alarmed) return chase(rules, notice, target);
    charge_ = 0;
    if (mood_ == Mood::suspicious)
        look_along(notice.last_known + Vec3(0, 1, 0) - position_, rules.drone_turn);
    else
        patrol(rules);
    return false;
}

void Drone::disable(double floor) {
    disabled_ = true;
    floor_ = floor + kHover;
    mood_ = Mood::calm;
    suspicion_ = charge_ = 0;
}

void Drone::add_to(gameplay::StateHash& hash) const {
    hash.add(way_);
    hash.add(sense_);
    hash.add(position_);
    hash.add(forward_);
    hash.add(charge_);
    hash.add(uint32_t(disabled_));
}

} // namespace peregrine::three_cores
