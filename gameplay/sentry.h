#pragma once

#include "gameplay/state_hash.h"

#include <span>
#include <type_traits>
#include <vector>

namespace peregrine::gameplay {

struct SentryRules {
    double range = 30;           // metres
    double cos_half_angle = 0.5; // of the view cone: 60 degrees to each side
    double notice_seconds = 0.5; // to certainty, of somebody near and in full view
    double forget_seconds = 8;   // from certainty to calm, of somebody out of view
    double suspicious = 0.3;     // suspicion from which a sentry looks closer
};

struct Sentry {
    Vec3 eye{0};
    Vec3 forward{0, 0, -1}; // any length but zero
};

// Somebody upright. Seen by head, chest, feet and both shoulders.
struct Target {
    Vec3 position{0}; // between the feet
    double height = 1.8;
    double radius = 0.3;
    double conspicuous = 1; // how fast it is noticed, times the rules' rate: less in the dark
};

struct Noise {
    Vec3 point{0};
    double radius = 10;  // how far it is heard; half as far behind a wall
    uint32_t target = 0; // who made it
};

enum class Mood : uint32_t { calm, suspicious, alarmed };

// What one sentry knows of one target.
struct Notice {
    Vec3 last_known{0};     // where it was seen or heard last
    double unseen = 0;      // seconds since it was in view
    double visibility = 0;  // fraction of its points in view now
    double suspicion = 0;   // 0 to 1
    Mood mood = Mood::calm; // alarmed at 1, and until the suspicion is 0 again
    uint32_t known = 0;     // 1: last_known means something
};
static_assert(sizeof(Notice) == 56 && std::is_trivially_copyable_v<Notice>);

void add(StateHash& hash, const Notice& notice);

// Many sentries watching many targets: all their lines of sight are one batch of rays, and only
// those within range and view cone are traced.
class Watch {
public:
    explicit Watch(const SentryRules& rules = {}) : rules_(rules) {}

    // Everybody looks, and suspicions rise and fall. The counts may change only after a reset. The
    // mask leaves out whatever moves with the targets.
    void update(const World& world, std::span<const Sentry> sentries,
                std::span<const Target> targets, double seconds, const Mask& mask = {});

    // Everybody listens. A noise makes suspicious, but never certain.
    void hear(const World& world, std::span<const Sentry> sentries, const Noise& noise,
              const Mask& mask = {});

    const Notice& notice(size_t sentry, size_t target) const {
        return notices_[sentry * target_count_ + target];
    }
    std::span<const Notice> notices() const { return notices_; } // a row a sentry
    size_t rays() const { return from_.size(); }                 // of the last update

    void reset(size_t sentry_count, size_t target_count);
    void restore(std::span<const Notice> notices, size_t target_count);

private:
    void aim(const Sentry& sentry, const Target& target, uint32_t pair);
    void judge(Notice& notice, const Vec3& eye, const Target& target, double seconds) const;

    SentryRules rules_;
    std::vector<Notice> notices_;
    size_t target_count_ = 0;

    // The batch, kept for its memory.
    std::vector<Vec3> from_, to_;
    std::vector<uint32_t> pairs_;
    std::vector<uint8_t> clear_;
};

} // namespace peregrine::gameplay
