#pragma once

#include "scene/material.h"
#include "scene/mesh.h"
#include "scene/texture.h"

#include <cmath>
#include <cstring>

// What a texture says at a point: the plain form, for one point at a time. The SIMD form of
// shade/surface/texels-inl.h does the same operations in the same order.
namespace peregrine::scene {

// A coordinate brought into [0, 1]; 0 if it is not finite.
inline float fold(float x, Wrap wrap) {
    float folded = x;
    if (wrap == Wrap::repeat) {
        folded = x - std::floor(x);
    } else if (wrap == Wrap::mirror) {
        const float m = x - 2.0f * std::floor(x * 0.5f);
        folded = m > 1.0f ? 2.0f - m : m;
    } else {
        folded = x > 0.0f ? (x < 1.0f ? x : 1.0f) : 0.0f;
    }
    return folded >= 0.0f && folded <= 1.0f ? folded : 0.0f;
}

// The two texels along one axis that a bilinear sample blends.
struct Taps {
    uint32_t first, second;
    float weight; // of the second
};

// Texel centres lie at (i + 0.5) / size.
inline Taps bilinear_taps(float coordinate, Wrap wrap, uint32_t size) {
    const float x = fold(coordinate, wrap) * float(size) - 0.5f;
    const float floor = std::floor(x);
    const auto index = int32_t(floor); // -1 to size - 1
    const auto last = int32_t(size) - 1;
    const int32_t before = wrap == Wrap::repeat ? last : 0;
    const int32_t after = wrap == Wrap::repeat ? 0 : last;
    return {uint32_t(index < 0 ? before : index), uint32_t(index == last ? after : index + 1),
            x - floor};
}

inline uint32_t nearest_tap(float coordinate, Wrap wrap, uint32_t size) {
    const auto index = uint32_t(fold(coordinate, wrap) * float(size));
    return index < size ? index : size - 1;
}

// As stored: 65535 is 1 in Storage::unorm16. See texel_scale().
inline math::Vec4 raw_texel(const Texture& texture, uint32_t x, uint32_t y) {
    const size_t index = size_t(y) * texture.width + x;
    if (texture.storage == Texture::Storage::float32) {
        float c[4];
        std::memcpy(c, texture.texels.data() + index * sizeof c, sizeof c);
        return {c[0], c[1], c[2], c[3]};
    }
    uint16_t c[4];
    std::memcpy(c, texture.texels.data() + index * sizeof c, sizeof c);
    return {float(c[0]), float(c[1]), float(c[2]), float(c[3])};
}

inline float texel_scale(const Texture& texture) {
    return texture.storage == Texture::Storage::float32 ? 1.0f : 1.0f / 65535.0f;
}

// Linear light, filtered as the texture says.
inline math::Vec4 sample(const Texture& texture, const math::Vec2& uv) {
    const float scale = texel_scale(texture);
    if (texture.sampling == Sampling::nearest)
        return raw_texel(texture, nearest_tap(uv.x, texture.wrap_u, texture.width),
                         nearest_tap(uv.y, texture.wrap_v, texture.height))
               * scale;
    const Taps x = bilinear_taps(uv.x, texture.wrap_u, texture.width);
    const Taps y = bilinear_taps(uv.y, texture.wrap_v, texture.height);
    const math::Vec4 a = raw_texel(texture, x.first, y.first);
    const math::Vec4 b = raw_texel(texture, x.second, y.first);
    const math::Vec4 c = raw_texel(texture, x.first, y.second);
    const math::Vec4 d = raw_texel(texture, x.second, y.second);
    const math::Vec4 top = a + (b - a) * x.weight;
    const math::Vec4 bottom = c + (d - c) * x.weight;
    return (top + (bottom - top) * y.weight) * scale;
}

inline math::Vec2 transform(const TextureUse& use, const math::Vec2& uv) {
    return {use.row_u.x * uv.x + use.row_u.y * uv.y + use.row_u.z,
            use.row_v.x * uv.x + use.row_v.y * uv.y + use.row_v.z};
}

// The texture coordinates of a vertex; (0, 0) if the mesh has none in this set.
inline math::Vec2 vertex_texcoord(const MeshData& mesh, uint32_t vertex, uint32_t set) {
    const base::Vector<math::Vec2>& texcoords =
        set == 0 ? mesh.surface->texcoords : mesh.surface->texcoords1;
    return texcoords.empty() ? math::Vec2(0) : texcoords[vertex];
}

// ... and inside a triangle, at barycentrics (u, v).
inline math::Vec2 texcoord_at(const MeshData& mesh, uint32_t primitive, uint32_t set, float u,
                              float v) {
    const std::array<uint32_t, 3>& vertices = mesh.triangles()[primitive];
    return vertex_texcoord(mesh, vertices[0], set) * (1.0f - u - v)
           + vertex_texcoord(mesh, vertices[1], set) * u
           + vertex_texcoord(mesh, vertices[2], set) * v;
}

} // namespace peregrine::scene
