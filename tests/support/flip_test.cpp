#include "support/flip.h"

#include <algorithm>
#include <array>
#include <utility>

#include <gtest/gtest.h>

namespace peregrine::test {
namespace {

using Color = std::array<uint8_t, 3>;

struct Picture {
    static constexpr uint32_t kWidth = 80, kHeight = 48;

    template <class ColorOf>
    explicit Picture(const ColorOf& color_of) : rgba(size_t(kWidth) * kHeight * 4, 255) {
        for (uint32_t y = 0; y < kHeight; ++y)
            for (uint32_t x = 0; x < kWidth; ++x) {
                const Color color = color_of(x, y);
                std::copy(color.begin(), color.end(), at(x, y));
            }
    }
    uint8_t* at(uint32_t x, uint32_t y) { return &rgba[(size_t(y) * kWidth + x) * 4]; }

    std::vector<uint8_t> rgba;
};

FlipMap flip_of(const Picture& a, const Picture& b, float pixels_per_degree = 67.0206f) {
    return flip(a.rgba.data(), b.rgba.data(), Picture::kWidth, Picture::kHeight, pixels_per_degree);
}

float error_at(const FlipMap& map, uint32_t x, uint32_t y) {
    return map.errors[size_t(y) * map.width + x];
}

Picture plain(const Color& color) {
    return Picture([&](uint32_t, uint32_t) { return color; });
}
Picture smooth() {
    return Picture([](uint32_t x, uint32_t y) {
        return Color{uint8_t(40 + 2 * x), uint8_t(60 + 3 * y), uint8_t(200 - x - 2 * y)};
    });
}
Picture busy() {
    return Picture([](uint32_t x, uint32_t y) {
        return Color{uint8_t(x * 37 + y * 11), uint8_t(x * x + 3 * y), uint8_t((x ^ y) * 4)};
    });
}

// A block that is redder, a black line down, an inverted one across.
Picture spoilt(Picture picture) {
    for (uint32_t y = 0; y < Picture::kHeight; ++y)
        for (uint32_t x = 0; x < Picture::kWidth; ++x) {
            uint8_t* const p = picture.at(x, y);
            if (x >= 20 && x < 36 && y >= 10 && y < 26) p[0] = uint8_t(std::min(255, p[0] + 30));
            if (x == 60) p[0] = p[1] = p[2] = 0;
            if (y == 40 && x < 40)
                for (int k = 0; k < 3; ++k) p[k] = uint8_t(255 - p[k]);
        }
    return picture;
}

TEST(Flip, IsZeroOfEqualPictures) {
    for (const Picture& picture : {plain({0, 0, 0}), smooth(), busy()}) {
        const FlipMap map = flip_of(picture, picture);
        for (const float error : map.errors) ASSERT_EQ(error, 0);
    }
}

TEST(Flip, IsSymmetric) {
    const FlipMap map = flip_of(smooth(), spoilt(smooth()));
    EXPECT_EQ(map.errors, flip_of(spoilt(smooth()), smooth()).errors);
}

TEST(Flip, DoesNotLookAtAlpha) {
    Picture other = smooth();
    for (uint32_t x = 0; x < Picture::kWidth; ++x) other.at(x, 7)[3] = 0;
    EXPECT_EQ(flip_of(smooth(), other).mean(), 0);
}

// Of plain pictures: the colour's part alone. Green and blue are what it is scaled by.
TEST(Flip, OfPlainColorsIsWhatItsAuthorsGet) {
    const std::pair<Color, double> cases[] = {{{255, 255, 255}, 0.967349},
                                              {{0, 255, 0}, 0.997008},
                                              {{255, 0, 0}, 0.970473},
                                              {{128, 128, 128}, 0.933855}};
    for (const auto& [color, expected] : cases)
        EXPECT_NEAR(flip_of(plain({0, 0, 0}), plain(color)).mean(), expected, 1e-4);
    EXPECT_NEAR(flip_of(plain({0, 255, 0}), plain({0, 0, 255})).mean(), 1, 1e-4);
}

// By flip-evaluator 1.7, the metric's authors' own program.
TEST(Flip, OfPicturesIsWhatItsAuthorsGet) {
    struct Place {
        uint32_t x, y;
    };
    constexpr Place kPlaces[] = {{28, 18}, {19, 10}, {60, 5}, {61, 40}, {5, 40}, {79, 47}};
    const struct {
        Picture picture;
        float pixels_per_degree;
        double mean;
        float errors[6];
    } cases[] = {
        {smooth(), 67.0206f, 0.087057, {0.25137f, 0.09239f, 0.44465f, 0.41507f, 0.68112f, 0}},
        {smooth(), 30, 0.070483, {0.24631f, 0.05248f, 0.83352f, 0.51736f, 0.96554f, 0}},
        {busy(), 67.0206f, 0.075123, {0.32295f, 0.10899f, 0.61284f, 0.30191f, 0.28368f, 0}},
        {busy(), 30, 0.065248, {0.41488f, 0.07751f, 0.95610f, 0.28247f, 0.50868f, 0}},
    };
    for (const auto& [picture, pixels_per_degree, mean, errors] : cases) {
        const FlipMap map = flip_of(picture, spoilt(picture), pixels_per_degree);
        EXPECT_NEAR(map.mean(), mean, 2e-5);
        for (size_t i = 0; i < std::size(kPlaces); ++i)
            EXPECT_NEAR(error_at(map, kPlaces[i].x, kPlaces[i].y), errors[i], 2e-4f) << i;
    }
}

//  tiles of 4:   0 0 0 0 | 1    the last one is cut by the picture's edge
TEST(Flip, TellsTheWorstTile) {
    const FlipMap map{5, 2, {0, 0.5f, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f}};
    EXPECT_DOUBLE_EQ(map.mean(), 0.25);
    EXPECT_DOUBLE_EQ(map.worst_tile(4), 0.75);
    EXPECT_DOUBLE_EQ(map.worst_tile(5), 0.25);
}

} // namespace
} // namespace peregrine::test
