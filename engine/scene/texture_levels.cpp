#include "scene/texture_levels.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <type_traits>

namespace peregrine::scene {
namespace {

// What a texel covers along one axis of the level before: two texels, or, where that has an odd
// number of them, three, of the outer ones a part.
//
//      | 0 | 1 | 2 | 3 | 4 |
//      |    0    |    1    |     5 becomes 2: weights 2 2 1 and 1 2 2
struct Cover {
    uint32_t first, count;
    double weight[3]; // their sum is 1

    Cover(uint32_t texel, uint32_t before) {
        const uint32_t after = before / 2;
        if (before == 1) {
            *this = {0, 1, 1, 0, 0};
        } else if (before % 2 == 0) {
            *this = {2 * texel, 2, 0.5, 0.5, 0};
        } else {
            const double sum = before;
            *this = {2 * texel, 3, (after - texel) / sum, after / sum, (texel + 1) / sum};
        }
    }

private:
    Cover(uint32_t first_, uint32_t count_, double a, double b, double c)
        : first(first_), count(count_), weight{a, b, c} {}
};

// Bytes, as the host's memory may begin anywhere.
template <class Channel>
struct Texel {
    Channel c[4];
};

template <class Channel>
struct Level {
    std::byte* texels;
    uint32_t width, height;

    Level(Texture& texture, uint32_t level)
        : texels(texture.texels.data()
                 + size_t(texture.level_first[level]) * sizeof(Texel<Channel>)),
          width(texture.level_width(level)), height(texture.level_height(level)) {}

    std::byte* at(uint32_t x, uint32_t y) const {
        return texels + (size_t(y) * width + x) * sizeof(Texel<Channel>);
    }
    Texel<Channel> load(uint32_t x, uint32_t y) const {
        Texel<Channel> texel;
        std::memcpy(&texel, at(x, y), sizeof texel);
        return texel;
    }
    void store(uint32_t x, uint32_t y, const Texel<Channel>& texel) const {
        std::memcpy(at(x, y), &texel, sizeof texel);
    }
};

template <class Channel>
constexpr double kOne = std::is_same_v<Channel, float> ? 1.0 : 65535.0;

template <class Channel>
Channel rounded(double value) {
    if constexpr (std::is_same_v<Channel, float>)
        return float(value);
    else
        return Channel(value + 0.5);
}

template <class Channel>
struct Sum {
    double plain[4] = {}, by_alpha[3] = {}, opacity = 0;

    void add(const Texel<Channel>& texel, double weight) {
        const double opaque = weight * std::clamp(double(texel.c[3]), 0.0, kOne<Channel>);
        for (int k = 0; k < 4; ++k) plain[k] += weight * double(texel.c[k]);
        for (int k = 0; k < 3; ++k) by_alpha[k] += opaque * double(texel.c[k]);
        opacity += opaque;
    }

    Texel<Channel> mean() const {
        Texel<Channel> out;
        // Of what is as opaque as each other the plain mean is the more exact one.
        const bool is_plain = opacity == 0 || opacity == kOne<Channel>;
        for (int k = 0; k < 3; ++k)
            out.c[k] = rounded<Channel>(is_plain ? plain[k] : by_alpha[k] / opacity);
        out.c[3] = rounded<Channel>(plain[3]);
        return out;
    }
};

template <class Channel>
void fill(const Level<Channel>& before, const Level<Channel>& out) {
    for (uint32_t y = 0; y < out.height; ++y) {
        const Cover rows(y, before.height);
        for (uint32_t x = 0; x < out.width; ++x) {
            const Cover columns(x, before.width);
            Sum<Channel> sum;
            for (uint32_t j = 0; j < rows.count; ++j)
                for (uint32_t i = 0; i < columns.count; ++i)
                    sum.add(before.load(columns.first + i, rows.first + j),
                            columns.weight[i] * rows.weight[j]);
            out.store(x, y, sum.mean());
        }
    }
}

template <class Channel>
void fill_all(Texture& texture) {
    for (uint32_t level = 1; level < texture.level_count; ++level)
        fill(Level<Channel>(texture, level - 1), Level<Channel>(texture, level));
}

} // namespace

void lay_out_levels(Texture& texture) {
    uint64_t texels = 0;
    texture.level_count = 0;
    for (uint32_t largest = std::max(texture.width, texture.height); largest > 0; largest /= 2) {
        const uint32_t level = texture.level_count++;
        texture.level_first[level] = uint32_t(texels);
        texels += uint64_t(texture.level_width(level)) * texture.level_height(level);
    }
    texture.texels.resize(texels * texture.texel_size());
}

void fill_levels(Texture& texture) {
    if (texture.storage == Texture::Storage::float32)
        fill_all<float>(texture);
    else
        fill_all<uint16_t>(texture);
}

} // namespace peregrine::scene
