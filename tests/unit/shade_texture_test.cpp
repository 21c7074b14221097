#include "base/memory.h"
#include "scene/texture_sampling.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace peregrine::scene {
namespace {

// The definition, in double: texel i covers [i, i + 1) / size, and the image repeats, is mirrored
// or is continued by its edge.
int64_t wrapped(int64_t i, int64_t size, Wrap wrap) {
    if (wrap == Wrap::clamp) return std::clamp<int64_t>(i, 0, size - 1);
    if (wrap == Wrap::repeat) return (i % size + size) % size;
    const int64_t m = (i % (2 * size) + 2 * size) % (2 * size);
    return m < size ? m : 2 * size - 1 - m;
}

double reference(const std::vector<double>& texels, int64_t w, int64_t h, Wrap wu, Wrap wv,
                 double u, double v) {
    const double x = u * double(w) - 0.5, y = v * double(h) - 0.5;
    const double fx = x - std::floor(x), fy = y - std::floor(y);
    const auto x0 = int64_t(std::floor(x)), y0 = int64_t(std::floor(y));
    const auto texel = [&](int64_t i, int64_t j) {
        return texels[size_t(wrapped(j, h, wv) * w + wrapped(i, w, wu))];
    };
    return (texel(x0, y0) * (1 - fx) + texel(x0 + 1, y0) * fx) * (1 - fy)
           + (texel(x0, y0 + 1) * (1 - fx) + texel(x0 + 1, y0 + 1) * fx) * fy;
}

struct Fixture : testing::Test {
    Fixture() : texture(&memory), texels(kWidth * kHeight) {
        texture.width = kWidth;
        texture.height = kHeight;
        std::vector<uint16_t> raw;
        for (size_t i = 0; i < texels.size(); ++i) {
            raw.insert(raw.end(), 4, uint16_t(i * 40503u));
            texels[i] = double(raw.back()) / 65535.0;
        }
        texture.texels.resize(raw.size() * 2);
        std::memcpy(texture.texels.data(), raw.data(), texture.texels.size());
    }

    static constexpr uint32_t kWidth = 5, kHeight = 3;
    base::HostMemory memory{{}};
    Texture texture;
    std::vector<double> texels;
};

TEST_F(Fixture, BilinearFollowsTheDefinitionInEveryWrapMode) {
    for (const Wrap wu : {Wrap::repeat, Wrap::mirror, Wrap::clamp})
        for (const Wrap wv : {Wrap::repeat, Wrap::mirror, Wrap::clamp}) {
            texture.wrap_u = wu;
            texture.wrap_v = wv;
            for (float u = -2.5f; u < 2.5f; u += 0.0371f)
                for (float v = -2.5f; v < 2.5f; v += 0.0413f)
                    ASSERT_NEAR(double(sample(texture, {u, v}).x),
                                reference(texels, kWidth, kHeight, wu, wv, u, v), 1e-5)
                        << u << " " << v << " " << int(wu) << int(wv);
        }
}

TEST_F(Fixture, NearestTakesTheTexelUnderThePoint) {
    texture.sampling = Sampling::nearest;
    for (uint32_t y = 0; y < kHeight; ++y)
        for (uint32_t x = 0; x < kWidth; ++x) {
            const math::Vec2 uv((float(x) + 0.4f) / kWidth, (float(y) + 0.6f) / kHeight);
            EXPECT_NEAR(double(sample(texture, uv).x), texels[y * kWidth + x], 1e-6);
            EXPECT_EQ(sample(texture, uv), sample(texture, uv + math::Vec2(0)));
        }
}

TEST_F(Fixture, AnyCoordinateIsSafe) {
    const float inf = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp})
        for (const Sampling sampling : {Sampling::bilinear, Sampling::nearest}) {
            texture.wrap_u = texture.wrap_v = wrap;
            texture.sampling = sampling;
            for (const float u : {inf, -inf, nan, 1e30f, -1e30f, -1e-12f, -0.0f, 1.0f, 0.99999994f,
                                  16777217.0f, -3.0f})
                for (const float v : {0.5f, u}) {
                    const float value = sample(texture, {u, v}).x;
                    EXPECT_TRUE(value >= 0 && value <= 1) << u;
                }
        }
}

TEST_F(Fixture, FloatStorageIsReadAsItIs) {
    Texture floats(&memory);
    floats.width = floats.height = 1;
    floats.storage = Texture::Storage::float32;
    const float c[4] = {7.5f, -1, 1e6f, 0.25f};
    floats.texels.resize(sizeof c);
    std::memcpy(floats.texels.data(), c, sizeof c);
    EXPECT_EQ(sample(floats, {0.3f, 0.9f}), math::Vec4(7.5f, -1, 1e6f, 0.25f));
}

} // namespace
} // namespace peregrine::scene
