#include "check.h"
#include "guard.h"
#include "read_struct.h"
#include "scene/texture_levels.h"
#include "scene_table.h"
#include "srgb_table.h"

#include <cmath>

namespace peregrine::abi {
namespace {

constexpr uint32_t kLargestTexture = 32768;
constexpr uint32_t kChannels = 4;

using Texel8 = std::array<uint8_t, kChannels>;
using Texel16 = std::array<uint16_t, kChannels>;
using TexelFloat = std::array<float, kChannels>;

uint16_t widen(uint8_t value) {
    return uint16_t(value * 257u);
}

Texel16 from_rgba_srgb(const Texel8& in) {
    return {kLinearOfSrgb[in[0]], kLinearOfSrgb[in[1]], kLinearOfSrgb[in[2]], widen(in[3])};
}

Texel16 from_bgra_srgb(const Texel8& in) {
    return from_rgba_srgb({in[2], in[1], in[0], in[3]});
}

Texel16 from_rgba_linear(const Texel8& in) {
    return {widen(in[0]), widen(in[1]), widen(in[2]), widen(in[3])};
}

uint64_t bytes_per_texel(rt_pixel_format format) {
    return format == RT_FORMAT_RGBA32F ? sizeof(TexelFloat) : sizeof(Texel8);
}

// The host's rows, one texel at a time, as they may be aligned.
template <class In, class Convert>
void copy_texels(const rt_texture_desc& desc, uint64_t stride, std::byte* out, Convert&& convert) {
    const auto* row = static_cast<const std::byte*>(desc.pixels);
    for (uint32_t y = 0; y < desc.height; ++y, row += stride) {
        for (uint32_t x = 0; x < desc.width; ++x) {
            In in;
            std::memcpy(&in, row + x * sizeof in, sizeof in);
            const auto texel = convert(in, x, y);
            std::memcpy(out, &texel, sizeof texel);
            out += sizeof texel;
        }
    }
}

TexelFloat checked(const TexelFloat& texel, uint32_t x, uint32_t y) {
    for (const float value : texel)
        if (!std::isfinite(value))
            base::fail(base::Code::invalid_argument,
                       "rt_texture_desc.pixels: the texel at (%u, %u) is %g; it must be finite", x,
                       y, double(value));
    return texel;
}

uint64_t check(const rt_texture_desc& desc) {
    require_enum(desc.format, RT_FORMAT_RGBA32F, "rt_texture_desc.format");
    if (desc.format == RT_FORMAT_RGBA16F)
        base::fail(base::Code::invalid_argument,
                   "rt_texture_desc.format is RT_FORMAT_RGBA16F, which is for frames only");
    require_extent(desc.width, kLargestTexture, "rt_texture_desc.width");
    require_extent(desc.height, kLargestTexture, "rt_texture_desc.height");
    require_enum(desc.wrap_u, RT_WRAP_CLAMP, "rt_texture_desc.wrap_u");
    require_enum(desc.wrap_v, RT_WRAP_CLAMP, "rt_texture_desc.wrap_v");
    require_enum(desc.filter, RT_FILTER_NEAREST, "rt_texture_desc.filter");
    require_zero(desc.reserved, "rt_texture_desc.reserved");
    return require_rows(desc.pixels, desc.row_stride, desc.width * bytes_per_texel(desc.format),
                        desc.height, "rt_texture_desc.pixels", "rt_texture_desc.row_stride");
}

void fill(scene::Texture& texture, const rt_texture_desc& desc, uint64_t stride) {
    const bool is_float = desc.format == RT_FORMAT_RGBA32F;
    texture.width = desc.width;
    texture.height = desc.height;
    texture.storage =
        is_float ? scene::Texture::Storage::float32 : scene::Texture::Storage::unorm16;
    texture.wrap_u = scene::Wrap(desc.wrap_u);
    texture.wrap_v = scene::Wrap(desc.wrap_v);
    texture.sampling = scene::Sampling(desc.filter);
    scene::lay_out_levels(texture);
    std::byte* out = texture.texels.data();
    const auto narrow = [&](Texel16 (*convert)(const Texel8&)) {
        copy_texels<Texel8>(desc, stride, out, [convert](const Texel8& in, uint32_t, uint32_t) {
            return convert(in);
        });
    };
    switch (desc.format) {
    case RT_FORMAT_RGBA8_SRGB:
        return narrow(from_rgba_srgb);
    case RT_FORMAT_BGRA8_SRGB:
        return narrow(from_bgra_srgb);
    case RT_FORMAT_RGBA8_LINEAR:
        return narrow(from_rgba_linear);
    default:
        return copy_texels<TexelFloat>(desc, stride, out, checked);
    }
}

rt_texture add(scene::Scene& scene, const rt_texture_desc& desc) {
    const uint64_t stride = check(desc);
    using Allocator = std::pmr::polymorphic_allocator<scene::Texture>;
    auto texture = std::allocate_shared<scene::Texture>(Allocator(&scene.memory), &scene.memory);
    fill(*texture, desc, stride);
    scene::fill_levels(*texture);
    const base::Handle handle = scene.textures.insert(std::move(texture));
    scene.touch_materials();
    return to_host<rt_texture>(handle);
}

} // namespace
} // namespace peregrine::abi

using namespace peregrine::abi;

rt_result rt_add_texture(rt_scene scene, const rt_texture_desc* desc,
                         rt_texture* out_texture) noexcept {
    return guard([&] {
        HostScene& host = find_scene(scene);
        require_pointer(out_texture, "out_texture");
        *out_texture = add(host.scene, read_struct(desc));
    });
}

rt_result rt_remove_texture(rt_scene scene, rt_texture texture) noexcept {
    return guard([&] {
        HostScene& host = find_scene(scene);
        require_object(host.scene.textures, to_handle(texture), "rt_texture", "texture");
        host.scene.textures.erase(to_handle(texture));
        host.scene.touch_materials();
    });
}
