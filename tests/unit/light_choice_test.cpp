// Which lights a batch gets: those that a plain loop finds, in its order; and what may be left out.
#include "render_scene.h"
#include "shade/light/choice.h"
#include "shade/light/most_light.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace peregrine::shade {
namespace {

using math::Box;
using math::Vec3;
using math::Vec3d;

class Random {
public:
    explicit Random(uint32_t seed) : engine_(seed) {}
    float operator()(float from, float to) {
        return std::uniform_real_distribution<float>(from, to)(engine_);
    }
    Vec3 point(float reach) {
        Random& random = *this;
        return {random(-reach, reach), random(-reach, reach), random(-reach, reach)};
    }
    uint32_t below(uint32_t end) { return uint32_t(engine_() % end); }

private:
    std::mt19937 engine_;
};

constexpr float kRadii[] = {1e-45f, 1e-30f, 1e-18f, 1e-3f, 0.5f,
                            3,      20,     1e12f,  1e30f, std::numeric_limits<float>::max()};

scene::Light random_light(Random& random, const Vec3d& place, float reach) {
    scene::Light light;
    light.type = scene::LightType(random.below(16) == 0 ? 2 : random.below(2));
    light.position = place + Vec3d(random.point(reach));
    light.falloff = scene::Falloff(random.below(scene::kFalloffCount));
    light.radius = random.below(4) == 0 ? kRadii[random.below(std::size(kRadii))]
                                        : random(0.01f, 0.3f) * reach;
    if (is_inverse_square(light.falloff) && random.below(64) == 0)
        light.radius = std::numeric_limits<float>::infinity();
    light.intensity = glm::abs(random.point(100));
    if (random.below(99) == 0) light.position *= 1e20;
    return light;
}

// A set of lights as a commit makes it, and what a frame does with it.
class Lights {
public:
    explicit Lights(uint32_t count, uint32_t seed = 1, const Vec3d& place = {}, float reach = 10)
        : random_(seed), reach_(reach) {
        for (uint32_t i = 0; i < count; ++i) lights_.push_back(random_light(random_, place, reach));
        share(place);
    }

    // As a frame whose eye is at `origin`.
    void share(const Vec3d& origin) {
        origin_ = origin;
        set_ = scene::make_light_set(lights_, scene::LightViews(&memory_), Box{Vec3(-1), Vec3(1)},
                                     scheduler_, &memory_);
        moved_ = set_->prepared;
        for (size_t i = 0; i < moved_.size(); ++i)
            moved_[i].position = Vec3(set_->lights[i].position - origin);
        room_.emplace(lights_.size(), true, 1, &memory_);
        lists_ = room_->lists(0);
    }

    std::vector<uint32_t> chosen(const Box& bounds, float unseen = 0) {
        const LightChoice choice(*set_, moved_, origin_, unseen);
        const std::span<const uint32_t> found = choice.reaching(bounds, lists_);
        return {found.begin(), found.end()};
    }
    std::vector<uint32_t> looped(const Box& bounds) const {
        std::vector<uint32_t> found;
        for (uint32_t i = 0; i < moved_.size(); ++i)
            if (reaches(moved_[i], bounds)) found.push_back(i);
        return found;
    }

    Box random_box() {
        const Vec3 corner = random_.point(1.2f * reach_);
        const float size = std::pow(10.0f, random_(-4, 0.5f)) * reach_;
        return {corner, corner + glm::abs(random_.point(size))};
    }

    base::HostMemory memory_{{}};
    base::Scheduler scheduler_{1, {}, &memory_};
    Random random_;
    float reach_;
    base::Vector<scene::Light> lights_{&memory_};
    std::shared_ptr<const scene::LightSet> set_;
    base::Vector<scene::PreparedLight> moved_{&memory_};
    Vec3d origin_{0};
    std::optional<LightRoom> room_;
    LightLists lists_;
};

TEST(LightChoice, IsThatOfAPlainLoop) {
    for (const uint32_t count : {0u, 1u, 2u, 32u, 33u, 34u, 63u, 64u, 65u, 257u, 3000u}) {
        Lights lights(count, count + 1);
        for (int i = 0; i < 400; ++i) {
            const Box box = lights.random_box();
            ASSERT_EQ(lights.chosen(box), lights.looped(box)) << count << " " << i;
        }
    }
}

TEST(LightChoice, IsThatOfAPlainLoopOnEveryScale) {
    for (const float reach : {1e-30f, 1e-20f, 1e-6f, 1.0f, 1e6f, 1e15f, 1e19f, 1e29f}) {
        Lights lights(500, 7, {}, reach);
        for (int i = 0; i < 200; ++i) {
            const Box box = lights.random_box();
            ASSERT_EQ(lights.chosen(box), lights.looped(box)) << reach << " " << i;
        }
    }
}

// Places are rounded relative to the eye there, the tree's relative to the world's origin.
TEST(LightChoice, IsThatOfAPlainLoopFarAway) {
    for (const double far : {1e3, 1e5, 1e7, 1e9, 1e12})
        for (const float reach : {0.1f, 10.0f, 1000.0f}) {
            const Vec3d place(far, -far / 3, far / 7 + 0.1);
            Lights lights(500, 3, place, reach);
            lights.share(place + Vec3d(0.3, -0.2, 0.1) * double(reach));
            for (int i = 0; i < 200; ++i) {
                const Box box = lights.random_box();
                ASSERT_EQ(lights.chosen(box), lights.looped(box)) << far << " " << reach;
            }
        }
}

// What one batch left in the memory of lists is nothing to the next.
TEST(LightChoice, FollowsNeighboursAndJumps) {
    Lights lights(2000, 5);
    Vec3 at(0);
    for (int i = 0; i < 3000; ++i) {
        at = lights.random_.below(50) == 0 ? lights.random_.point(12)
                                           : at + lights.random_.point(0.2f);
        const Box box{at, at + glm::abs(lights.random_.point(0.3f))};
        ASSERT_EQ(lights.chosen(box), lights.looped(box));
    }
}

TEST(LightChoice, ManyLightsAtOnePoint) {
    Lights lights(0);
    lights.lights_.assign(100'000, scene::Light{});
    lights.share({});
    const Box near{Vec3(1), Vec3(2)}, far{Vec3(20), Vec3(30)};
    EXPECT_EQ(lights.chosen(near), lights.looped(near));
    EXPECT_EQ(lights.chosen(near).size(), 100'000u);
    EXPECT_TRUE(lights.chosen(far).empty());
}

// What is left out is dim, even all of it together.
TEST(LightChoice, LeavesOutNoMoreThanTold) {
    Lights lights(1000, 11);
    uint32_t left_out = 0;
    for (int i = 0; i < 300; ++i) {
        const Box box = lights.random_box();
        const std::vector<uint32_t> all = lights.looped(box);
        for (const float unseen : {1e-6f, 0.01f, 1.0f, 30.0f}) {
            const std::vector<uint32_t> kept = lights.chosen(box, unseen);
            EXPECT_TRUE(std::ranges::includes(all, kept));
            float sum = 0, dimmest_kept = std::numeric_limits<float>::infinity();
            float brightest_left = 0;
            for (const uint32_t number : all) {
                const float most = most_light(lights.moved_[number], box);
                if (std::ranges::binary_search(kept, number)) {
                    dimmest_kept = std::min(dimmest_kept, most);
                    continue;
                }
                sum += most;
                brightest_left = std::max(brightest_left, most);
                ++left_out;
            }
            EXPECT_LE(sum, unseen * 1.0001f);
            EXPECT_LE(brightest_left, dimmest_kept);
            EXPECT_GE(sum + dimmest_kept, unseen * 0.9999f) << "more could have been left out";
        }
    }
    EXPECT_GT(left_out, 5000u);
}

// Each by itself is nothing, but all of them are not.
TEST(LightChoice, ManyDimLightsAreSeen) {
    Lights lights(0);
    scene::Light dim;
    dim.intensity = Vec3(1e-3f);
    lights.lights_.assign(10'000, dim);
    lights.share({});
    const Box box{Vec3(1, -1, -1), Vec3(2, 1, 1)};
    const size_t kept = lights.chosen(box, 0.01f).size();
    EXPECT_GE(kept, 9'989u);
    EXPECT_LT(kept, 10'000u);
    EXPECT_EQ(lights.chosen(box, 20.0f).size(), 0u);
}

} // namespace
} // namespace peregrine::shade
