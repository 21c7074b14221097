#include "base/memory.h"
#include "scene/texture_levels.h"

#include <cmath>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

namespace peregrine::scene {
namespace {

constexpr uint32_t kRed = 0, kAlpha = 3;

template <class Channel>
struct Levels {
    base::HostMemory memory{{}};
    Texture texture{&memory};

    template <class ValueOf>
    Levels(uint32_t width, uint32_t height, const ValueOf& value_of) {
        texture.width = width;
        texture.height = height;
        if (std::is_same_v<Channel, float>) texture.storage = Texture::Storage::float32;
        lay_out_levels(texture);
        for (uint32_t y = 0; y < height; ++y)
            for (uint32_t x = 0; x < width; ++x)
                for (uint32_t k = 0; k < 4; ++k) at(0, x, y)[k] = Channel(value_of(x, y, k));
        fill_levels(texture);
    }

    Channel* at(uint32_t level, uint32_t x, uint32_t y) {
        auto* texels = reinterpret_cast<Channel*>(texture.texels.data());
        return texels + (texture.level_first[level] + y * texture.level_width(level) + x) * 4;
    }
};

uint16_t noise(uint32_t x, uint32_t y, uint32_t k) {
    return k == kAlpha ? 65535 : uint16_t((x * 7 + y * 13 + k) * 40503u);
}

// The mean of what texel `i` of `after` covers of `before` texels, as weights.
std::vector<double> cover(uint32_t i, uint32_t after, uint32_t before) {
    std::vector<double> weights(before);
    const double size = double(before) / after;
    for (uint32_t k = 0; k < before; ++k) {
        const double from = std::max(double(k), i * size), to = std::min(k + 1.0, (i + 1) * size);
        weights[k] = std::max(to - from, 0.0) / size;
    }
    return weights;
}

TEST(TextureLevels, AreMeansOfTheLevelBeforeAtAnySize) {
    for (const auto& [width, height] :
         {std::pair{8u, 8u}, {7u, 5u}, {1u, 1u}, {1u, 9u}, {12u, 1u}, {3u, 2u}, {13u, 31u}}) {
        Levels<uint16_t> levels(width, height, noise);
        const Texture& texture = levels.texture;
        for (uint32_t n = 1; n < texture.level_count; ++n)
            for (uint32_t y = 0; y < texture.level_height(n); ++y)
                for (uint32_t x = 0; x < texture.level_width(n); ++x) {
                    const auto columns =
                        cover(x, texture.level_width(n), texture.level_width(n - 1));
                    const auto rows =
                        cover(y, texture.level_height(n), texture.level_height(n - 1));
                    double mean = 0;
                    for (uint32_t j = 0; j < rows.size(); ++j)
                        for (uint32_t i = 0; i < columns.size(); ++i)
                            mean += columns[i] * rows[j] * levels.at(n - 1, i, j)[kRed];
                    ASSERT_NEAR(levels.at(n, x, y)[kRed], mean, 0.5001)
                        << width << "x" << height << " level " << n << ": " << x << " " << y;
                    ASSERT_EQ(levels.at(n, x, y)[kAlpha], 65535);
                }
    }
}

TEST(TextureLevels, OfPowersOfTwoAreExact) {
    Levels<uint16_t> levels(2, 2, [](uint32_t x, uint32_t y, uint32_t k) {
        return uint16_t(k == kAlpha ? 65535 : 100 * (x + 2 * y));
    });
    EXPECT_EQ(levels.at(1, 0, 0)[kRed], 150);
    Levels<float> floats(2, 2, [](uint32_t x, uint32_t y, uint32_t k) {
        return k == kAlpha ? 1.0f : 1e6f * float(x + 2 * y);
    });
    EXPECT_EQ(floats.at(1, 0, 0)[kRed], 1.5e6f);
}

TEST(TextureLevels, EndAtOneTexelAndLieBehindEachOther) {
    for (const auto& [width, height, count, texels] : {std::array{1u, 1u, 1u, 1u},
                                                       {4u, 4u, 3u, 21u},
                                                       {5u, 3u, 3u, 18u},
                                                       {16384u, 1u, 15u, 32767u},
                                                       {1u, 3u, 2u, 4u}}) {
        Levels<uint16_t> levels(width, height, noise);
        EXPECT_EQ(levels.texture.level_count, count);
        EXPECT_EQ(levels.texture.texels.size(), texels * 8u);
    }
}

TEST(TextureLevels, OfALongRowKeepItsMean) {
    Levels<uint16_t> levels(
        16384, 1, [](uint32_t x, uint32_t, uint32_t) { return uint16_t(x % 2 ? 65535 : 0); });
    Levels<uint16_t> opaque(16384, 1, [](uint32_t x, uint32_t, uint32_t k) {
        return uint16_t(k == kAlpha || x % 2 ? 65535 : 0);
    });
    EXPECT_NEAR(opaque.at(14, 0, 0)[kRed], 32768, 8); // half a step lost a level, at most
    EXPECT_NEAR(levels.at(14, 0, 0)[kAlpha], 32768, 8);
    EXPECT_EQ(levels.at(14, 0, 0)[kRed], 65535); // what is white is all that is there
}

// What is cut out gives no colour: neither black nor any other.
TEST(TextureLevels, OfMasksCountColorsByAlpha) {
    const auto value_of = [](uint32_t x, uint32_t y, uint32_t k) {
        const bool is_there = x == 0;
        if (k == kAlpha) return is_there ? 65535 : 0;
        return is_there ? 30000 + 1000 * int(y) : 65535;
    };
    Levels<uint16_t> levels(2, 2, value_of);
    EXPECT_EQ(levels.at(1, 0, 0)[kRed], 30500);
    EXPECT_EQ(levels.at(1, 0, 0)[kAlpha], 32768);
    Levels<uint16_t> nothing(
        2, 2, [](uint32_t x, uint32_t, uint32_t k) { return uint16_t(k == kAlpha ? 0 : 100 * x); });
    EXPECT_EQ(nothing.at(1, 0, 0)[kRed], 50);
    EXPECT_EQ(nothing.at(1, 0, 0)[kAlpha], 0);
}

TEST(TextureLevels, OfAnyFloatsStayBetweenThem) {
    const float alphas[4] = {-3.0f, 1e30f, 0.25f, -1e30f};
    Levels<float> levels(2, 2, [&](uint32_t x, uint32_t y, uint32_t k) {
        return k == kAlpha ? alphas[x + 2 * y] : float(x + 2 * y);
    });
    EXPECT_GE(levels.at(1, 0, 0)[kRed], 0.0f);
    EXPECT_LE(levels.at(1, 0, 0)[kRed], 3.0f);
}

} // namespace
} // namespace peregrine::scene
