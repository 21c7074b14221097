#include "emissive_lamps.h"
#include "texture_mean.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include <glm/gtc/constants.hpp>

namespace host {

namespace {

struct Emitter {
    glm::dvec3 corner[3];
    glm::dvec3 area; // vector: along the normal of the side that shines
    glm::dvec3 radiance;
    uint32_t patch; // what hangs together

    double size() const { return glm::length(area); }
    glm::dvec3 center() const { return (corner[0] + corner[1] + corner[2]) / 3.0; }
};

using Emitters = std::vector<Emitter>;

double mean(const glm::dvec3& color) {
    return (color.x + color.y + color.z) / 3.0;
}

// Which vertices of a mesh hang together by triangles of one material.
class Patches {
public:
    explicit Patches(const Mesh& mesh) : parent_(mesh.positions.size()) {
        std::iota(parent_.begin(), parent_.end(), 0u);
        std::map<std::tuple<float, float, float, uint32_t>, uint32_t> known;
        for (size_t t = 0; t < mesh.triangle_count(); ++t)
            for (size_t k = 0; k < 3; ++k) {
                const uint32_t vertex = mesh.indices[3 * t + k];
                const glm::vec3& p = mesh.positions[vertex];
                const auto [it, added] =
                    known.emplace(std::tuple(p.x, p.y, p.z, mesh.materials[t]), vertex);
                if (!added) join(it->second, vertex);
                join(vertex, mesh.indices[3 * t]);
            }
    }
    uint32_t of(uint32_t vertex) {
        while (parent_[vertex] != vertex) vertex = parent_[vertex] = parent_[parent_[vertex]];
        return vertex;
    }

private:
    void join(uint32_t a, uint32_t b) { parent_[of(a)] = of(b); }

    std::vector<uint32_t> parent_;
};

// In four and four again, so that pieces of it can be cut off.
void add_pieces(const Emitter& emitter, int depth, Emitters& out) {
    constexpr double longest_edge = 0.5; // metres
    const auto& [a, b, c] = emitter.corner;
    const double longest =
        std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
    if (longest <= longest_edge || depth == 0) {
        out.push_back(emitter);
        return;
    }
    const glm::dvec3 ab = (a + b) / 2.0, bc = (b + c) / 2.0, ca = (c + a) / 2.0;
    const glm::dvec3 corners[4][3] = {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {bc, ca, ab}};
    Emitter part = emitter;
    part.area /= 4.0;
    for (const auto& corner : corners) {
        std::copy_n(corner, 3, part.corner);
        add_pieces(part, depth - 1, out);
    }
}

// Both sides of what is double-sided shine, each as a patch of its own.
void add_mesh(const Level& level, const Mesh& mesh, const std::vector<glm::dvec3>& radiance,
              uint32_t& next_patch, Emitters& out) {
    const auto glows = [&](uint32_t m) { return m != no_index && mean(radiance[m]) > 0.0; };
    if (std::none_of(mesh.materials.begin(), mesh.materials.end(), glows)) return;
    Patches patches(mesh);
    std::map<std::pair<uint32_t, int>, uint32_t> numbers;
    for (size_t t = 0; t < mesh.triangle_count(); ++t) {
        const uint32_t material = mesh.materials[t];
        if (!glows(material)) continue;
        Emitter emitter{};
        for (size_t k = 0; k < 3; ++k)
            emitter.corner[k] = level.origin + glm::dvec3(mesh.positions[mesh.indices[3 * t + k]]);
        emitter.area = 0.5
                       * glm::cross(emitter.corner[1] - emitter.corner[0],
                                    emitter.corner[2] - emitter.corner[0]);
        if (!(emitter.size() > 0.0) || !std::isfinite(emitter.size())) continue;
        emitter.radiance = radiance[material];
        const int sides = level.materials[material].double_sided ? 2 : 1;
        for (int side = 0; side < sides; ++side, emitter.area = -emitter.area) {
            const auto [it, added] =
                numbers.emplace(std::pair(patches.of(mesh.indices[3 * t]), side), next_patch);
            next_patch += added;
            emitter.patch = it->second;
            add_pieces(emitter, 4, out);
        }
    }
}

// Emitters that one lamp stands for.
struct Piece {
    Emitters emitters;
    glm::dvec3 area{0.0}, radiance{0.0}, center{0.0};
    glm::dvec3 lower{1e300}, upper{-1e300};
    double size = 0.0; // of the surface

    explicit Piece(Emitters emitters_) : emitters(std::move(emitters_)) {
        for (const Emitter& e : emitters) {
            area += e.area;
            radiance += e.radiance * e.size();
            center += e.center() * e.size();
            size += e.size();
            for (const glm::dvec3& corner : e.corner) {
                lower = glm::min(lower, corner);
                upper = glm::max(upper, corner);
            }
        }
        radiance /= size;
        center /= size;
    }

    double power() const { return glm::pi<double>() * mean(radiance) * size; }
    bool is_flat() const { return glm::length(area) > 0.8 * size; }
    double longest() const {
        const glm::dvec3 side = upper - lower;
        return std::max({side.x, side.y, side.z});
    }
    // How much it matters to cut it; 0: it is flat, round and no wider than two metres.
    double wants_cut() const {
        if (emitters.size() < 2) return 0.0;
        if (!is_flat()) return 1e6 * power();
        const bool is_long = longest() * longest() > 6.0 * size;
        return is_long || longest() > 2.0 ? power() * longest() : 0.0;
    }
};

// In two, at the mean of what varies most: the axis of the normals, or that of the places.
std::pair<Emitters, Emitters> cut(const Piece& piece) {
    const bool by_normal = !piece.is_flat();
    const auto value = [&](const Emitter& e) { return by_normal ? e.area / e.size() : e.center(); };
    glm::dvec3 sum(0.0), squares(0.0);
    for (const Emitter& e : piece.emitters) {
        sum += value(e) * e.size();
        squares += value(e) * value(e) * e.size();
    }
    const glm::dvec3 middle = sum / piece.size;
    const glm::dvec3 spread = squares / piece.size - middle * middle;
    const int axis = spread.x >= spread.y && spread.x >= spread.z ? 0
                     : spread.y >= spread.z                       ? 1
                                                                  : 2;
    std::pair<Emitters, Emitters> parts;
    for (const Emitter& e : piece.emitters)
        (value(e)[axis] < middle[axis] ? parts.first : parts.second).push_back(e);
    return parts;
}

// Before the piece, as no lamp shines through it. The sphere for its shadows is an eighth as wide
// as a disc of its area: a wider one would stand farther off.
Light make_light(const Piece& piece, size_t number) {
    const double area = glm::length(piece.area);
    const glm::dvec3 forward = piece.area / area;
    const double radius = 0.125 * std::sqrt(piece.size / glm::pi<double>());
    double highest = 0.0;
    for (const Emitter& e : piece.emitters)
        for (const glm::dvec3& corner : e.corner)
            highest = std::max(highest, glm::dot(corner - piece.center, forward));
    Light light;
    light.name = "glow " + std::to_string(number);
    light.type = LightType::spot;
    light.position = piece.center + forward * (highest + 1.02 * radius);
    light.direction = glm::vec3(forward);
    light.intensity = glm::vec3(piece.radiance * piece.size);
    light.source_radius = static_cast<float>(radius);
    light.cone_inner_cos = 1.0f;
    light.cone_outer_cos = 0.0f;
    const glm::vec3& candela = light.intensity; // docs/light.md, Radius
    light.radius = 46.0f * std::sqrt(std::max({candela.x, candela.y, candela.z}));
    return light;
}

std::vector<Piece> find_patches(const Level& level) {
    std::vector<glm::dvec3> radiance;
    for (const Material& material : level.materials) {
        const bool glows = material.emissive != glm::vec3(0.0f) && !material.unlit;
        radiance.push_back(glows ? glm::dvec3(material.emissive)
                                       * mean_of(level, material.emissive_texture)
                                 : glm::dvec3(0.0));
    }
    Emitters emitters;
    uint32_t count = 0;
    for (const Mesh& mesh : level.meshes) add_mesh(level, mesh, radiance, count, emitters);
    std::vector<Emitters> patches(count);
    for (const Emitter& emitter : emitters) patches[emitter.patch].push_back(emitter);
    std::vector<Piece> pieces;
    for (Emitters& patch : patches) pieces.emplace_back(std::move(patch));
    return pieces;
}

} // namespace

EmissiveLamps find_emissive_lamps(const Level& level, uint32_t most) {
    EmissiveLamps result;
    std::vector<Piece> pieces = find_patches(level);
    std::stable_sort(pieces.begin(), pieces.end(),
                     [](const Piece& a, const Piece& b) { return a.power() > b.power(); });
    for (size_t i = 0; i < pieces.size(); ++i) {
        result.power += pieces[i].power();
        if (i >= most) result.left_out += pieces[i].power();
    }
    if (pieces.size() > most) pieces.erase(pieces.begin() + most, pieces.end());
    while (!pieces.empty() && pieces.size() < most) {
        const auto next =
            std::max_element(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) {
                return a.wants_cut() < b.wants_cut();
            });
        if (!(next->wants_cut() > 0.0)) break;
        auto [first, second] = cut(*next);
        if (first.empty() || second.empty()) break;
        *next = Piece(std::move(first));
        pieces.emplace_back(std::move(second));
    }
    for (const Piece& piece : pieces)
        if (glm::length(piece.area) > 1e-6 * piece.size)
            result.lights.push_back(make_light(piece, result.lights.size()));
    return result;
}

} // namespace host
