#include "sound/waves.h"

#include <cmath>
#include <cstdlib>
#include <numeric>

#include <gtest/gtest.h>

#include "sound/synthesis.h"

using namespace host::sound;

namespace {

double loudness(const std::vector<int16_t>& samples, size_t first, size_t count) {
    double sum = 0.0;
    for (size_t i = first; i < first + count; ++i) sum += double(samples[i]) * samples[i];
    return std::sqrt(sum / static_cast<double>(count)) / 32767.0;
}

class Waves : public testing::TestWithParam<uint32_t> {};

TEST_P(Waves, CanBeHeardAndDoNotClick) {
    const Wave wave = static_cast<Wave>(GetParam());
    const auto samples = make_wave(wave);
    ASSERT_GT(samples.size(), size_t{sample_rate} / 50);
    ASSERT_LT(samples.size(), size_t{sample_rate} * 15);
    EXPECT_GT(loudness(samples, 0, samples.size()), 0.01);
    const long mean =
        std::accumulate(samples.begin(), samples.end(), 0L) / static_cast<long>(samples.size());
    EXPECT_LT(std::labs(mean), 1000) << "no steady pressure";
    if (is_loop(wave)) {
        int steepest = 0;
        for (size_t i = 1; i < samples.size(); ++i)
            steepest = std::max(steepest, std::abs(samples[i] - samples[i - 1]));
        EXPECT_LE(std::abs(samples.front() - samples.back()), steepest) << "the seam is heard";
    } else {
        EXPECT_LT(std::abs(int{samples.back()}), 100);
        EXPECT_LT(std::abs(int{samples.front()}), 6000);
    }
    EXPECT_EQ(samples, make_wave(wave));
}

INSTANTIATE_TEST_SUITE_P(All, Waves, testing::Range(0u, wave_count));

TEST(Track, ALowPassTakesTheHeights) {
    const auto brightness = [](double cutoff) {
        Track track(0.2);
        track.add_noise(0.0, 0.2, {Pass::low, {cutoff, cutoff}}, {0.001, 9.0}, 1.0);
        double change = 0.0, height = 0.0;
        for (size_t i = 1; i < track.samples().size(); ++i) {
            change += std::abs(track.samples()[i] - track.samples()[i - 1]);
            height += std::abs(track.samples()[i]);
        }
        return change / height;
    };
    EXPECT_LT(brightness(300.0), 0.2 * brightness(6000.0));
}

TEST(Track, AToneHasItsPitch) {
    Track track(1.0);
    track.add_tone(0.0, 1.0, {440.0, 440.0}, {0.01, 99.0}, 1.0);
    int crossings = 0;
    for (size_t i = 1; i < track.samples().size(); ++i)
        crossings += (track.samples()[i - 1] < 0.0f) != (track.samples()[i] < 0.0f);
    EXPECT_NEAR(crossings, 880, 2);
}

} // namespace
