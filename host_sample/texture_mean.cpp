#include "texture_mean.h"

#include <algorithm>
#include <cmath>

namespace host {

namespace {

double to_linear(double srgb) {
    return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

} // namespace

glm::dvec3 mean_of(const Level& level, const TextureUse& use) {
    if (use.texture == no_index) return glm::dvec3(1.0);
    const Texture& texture = level.textures[use.texture];
    const std::vector<uint8_t>& rgba = level.images[texture.image].rgba;
    double value[256];
    for (int i = 0; i < 256; ++i) value[i] = texture.srgb ? to_linear(i / 255.0) : i / 255.0;
    glm::dvec3 sum(0.0);
    for (size_t i = 0; i + 3 < rgba.size(); i += 4)
        sum += glm::dvec3(value[rgba[i]], value[rgba[i + 1]], value[rgba[i + 2]]);
    return sum / std::max(1.0, static_cast<double>(rgba.size() / 4));
}

} // namespace host
