#include "gameplay/sentry.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>

namespace peregrine::gameplay {
namespace {

constexpr size_t kPoints = 5;
constexpr double kCell = 256; // metres

// Head, chest, feet, and the shoulders as the viewer sees them: to the left and right.
std::array<Vec3, kPoints> points_of(const Target& target, const Vec3& eye) {
    const auto at = [&](double height) { return target.position + Vec3(0, height, 0); };
    const Vec3 view = target.position - eye;
    const Vec3 side(-view.z, 0, view.x);
    const double length = glm::length(side);
    const Vec3 shoulder = length > 0 ? side * (0.8 * target.radius / length) : Vec3(0);
    const double h = target.height;
    return {at(0.93 * h), at(0.7 * h), at(0.05 * h), at(0.8 * h) - shoulder,
            at(0.8 * h) + shoulder};
}

// What rays are relative to: near enough for floats, and the same whoever else watches.
Vec3 origin_near(const Vec3& point) {
    return glm::floor(point / kCell + 0.5) * kCell;
}

} // namespace

void add(StateHash& hash, const Notice& notice) {
    hash.add(notice.last_known);
    hash.add(notice.unseen);
    hash.add(notice.visibility);
    hash.add(notice.suspicion);
    hash.add(uint32_t(notice.mood));
    hash.add(notice.known);
}

void Watch::reset(size_t sentry_count, size_t target_count) {
    notices_.assign(sentry_count * target_count, {});
    target_count_ = target_count;
}

void Watch::restore(std::span<const Notice> notices, size_t target_count) {
    notices_.assign(notices.begin(), notices.end());
    target_count_ = target_count;
}

void Watch::aim(const Sentry& sentry, const Target& target, uint32_t pair) {
    const double reach = rules_.range + target.height + target.radius;
    const Vec3 way = target.position - sentry.eye;
    if (glm::dot(way, way) > reach * reach) return;
    const double forward = glm::length(sentry.forward);
    for (const Vec3& point : points_of(target, sentry.eye)) {
        const Vec3 line = point - sentry.eye;
        const double distance = glm::length(line);
        if (distance > rules_.range
            || glm::dot(line, sentry.forward) < rules_.cos_half_angle * distance * forward)
            continue;
        from_.push_back(sentry.eye);
        to_.push_back(point);
        pairs_.push_back(pair);
    }
}

void Watch::update(const World& world, std::span<const Sentry> sentries,
                   std::span<const Target> targets, double seconds, const Mask& mask) {
    if (notices_.size() != sentries.size() * targets.size() || target_count_ != targets.size())
        reset(sentries.size(), targets.size());
    from_.clear();
    to_.clear();
    pairs_.clear();
    for (size_t s = 0; s < sentries.size(); ++s)
        for (size_t t = 0; t < targets.size(); ++t)
            aim(sentries[s], targets[t], uint32_t(s * targets.size() + t));
    clear_.resize(from_.size());
    if (!from_.empty()) world.lines_of_sight(origin_near(from_[0]), from_, to_, mask, clear_);

    for (Notice& notice : notices_) notice.visibility = 0;
    for (size_t i = 0; i < pairs_.size(); ++i)
        if (clear_[i]) notices_[pairs_[i]].visibility += 1;
    for (size_t s = 0; s < sentries.size(); ++s)
        for (size_t t = 0; t < targets.size(); ++t)
            judge(notices_[s * targets.size() + t], sentries[s].eye, targets[t], seconds);
}

// In view, suspicion rises with what is seen and with nearness; out of view, it fades.
void Watch::judge(Notice& notice, const Vec3& eye, const Target& target, double seconds) const {
    notice.visibility /= double(kPoints);
    if (notice.visibility > 0) {
        const double far = std::min(glm::length(target.position - eye) / rules_.range, 1.0);
        const double rate =
            target.conspicuous * notice.visibility * (1 - 0.9 * far * far) / rules_.notice_seconds;
        notice.suspicion = std::min(notice.suspicion + rate * seconds, 1.0);
        notice.last_known = target.position;
        notice.unseen = 0;
        notice.known = 1;
    } else {
        notice.suspicion = std::max(notice.suspicion - seconds / rules_.forget_seconds, 0.0);
        notice.unseen += seconds;
    }
    if (notice.suspicion >= 1)
        notice.mood = Mood::alarmed;
    else if (notice.suspicion <= 0)
        notice.mood = Mood::calm;
    else if (notice.mood != Mood::alarmed)
        notice.mood = notice.suspicion >= rules_.suspicious ? Mood::suspicious : Mood::calm;
}

void Watch::hear(const World& world, std::span<const Sentry> sentries, const Noise& noise,
                 const Mask& mask) {
    for (size_t s = 0; s < sentries.size() && noise.target < target_count_; ++s) {
        const double distance = glm::length(noise.point - sentries[s].eye);
        if (distance > noise.radius) continue;
        if (distance > 0.5 * noise.radius && !world.is_free(sentries[s].eye, noise.point, mask))
            continue;
        Notice& notice = notices_[s * target_count_ + noise.target];
        notice.suspicion = std::max(notice.suspicion, rules_.suspicious);
        if (notice.mood == Mood::calm) notice.mood = Mood::suspicious;
        notice.last_known = noise.point;
        notice.known = 1;
    }
}

} // namespace peregrine::gameplay
