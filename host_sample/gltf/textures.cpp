#include "textures.h"

#include <algorithm>
#include <cmath>

#include "quote.h"
#include "value.h"

namespace host::gltf {

namespace {

Wrap to_wrap(int mode) {
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp;
    if (mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return Wrap::mirror;
    return Wrap::repeat;
}

void apply_sampler(const tinygltf::Model& model, int index, Texture& texture) {
    if (index < 0 || static_cast<size_t>(index) >= model.samplers.size()) return;
    const tinygltf::Sampler& sampler = model.samplers[static_cast<size_t>(index)];
    texture.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    texture.wrap_u = to_wrap(sampler.wrapS);
    texture.wrap_v = to_wrap(sampler.wrapT);
}

// KHR_texture_transform: translation * rotation * scale, where a positive angle turns the UVs
// counter-clockwise as seen with v pointing down.
void apply_transform(const tinygltf::Value& extension, TextureUse& use) {
    const glm::dvec2 offset = read_pair(extension, "offset", glm::dvec2(0.0));
    const glm::dvec2 scale = read_pair(extension, "scale", glm::dvec2(1.0));
    const double angle = read_number(extension, "rotation").value_or(0.0);
    const double c = std::cos(angle), s = std::sin(angle);
    const double matrix[6] = {c * scale.x,  s * scale.y, offset.x,
                              -s * scale.x, c * scale.y, offset.y};
    const bool finite = std::all_of(matrix, matrix + 6, [](double m) { return std::abs(m) < 1e6; });
    for (int i = 0; finite && i < 6; ++i) use.transform[i] = static_cast<float>(matrix[i]);
    if (read_number(extension, "texCoord"))
        use.texcoord_set = static_cast<uint32_t>(std::max(read_index(extension, "texCoord"), 0));
}

} // namespace

TextureUse Textures::use(int texture, int texcoord_set, const tinygltf::ExtensionMap& extensions,
                         bool srgb) {
    TextureUse use;
    if (texture < 0) return use;
    if (static_cast<size_t>(texture) >= model_.textures.size()) {
        notes_.add("texture " + std::to_string(texture) + " is named but does not exist");
        return use;
    }
    const tinygltf::Texture& source = model_.textures[static_cast<size_t>(texture)];
    Texture described;
    described.image = open_image(texture);
    described.srgb = srgb;
    apply_sampler(model_, source.sampler, described);

    use.texture = find_or_add(described);
    use.texcoord_set = static_cast<uint32_t>(std::max(texcoord_set, 0));
    if (const auto* transform = find_extension(extensions, "KHR_texture_transform"))
        apply_transform(*transform, use);
    if (use.texcoord_set > 1) {
        notes_.add("texture coordinate sets beyond the second are replaced by the first");
        use.texcoord_set = 0;
    }
    return use;
}

// Extensions give textures images of other formats, beside the core's or alone.
uint32_t Textures::open_image(int texture) {
    const tinygltf::Texture& source = model_.textures[static_cast<size_t>(texture)];
    if (source.source >= 0) return images_.open(source.source);
    std::string name = "texture " + std::to_string(texture);
    if (!source.name.empty()) name += " (" + quote(source.name) + ")";
    for (const auto& [extension, value] : source.extensions)
        if (read_index(value, "source") >= 0)
            return images_.replace(name, "its only image is that of the extension "
                                             + quote(extension) + ", which is not supported");
    return images_.replace(name, "it names no image");
}

uint32_t Textures::find_or_add(const Texture& texture) {
    const auto [it, added] = known_.emplace(texture, static_cast<uint32_t>(level_.textures.size()));
    if (added) level_.textures.push_back(texture);
    return it->second;
}

} // namespace host::gltf
