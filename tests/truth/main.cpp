// Renders small scenes as well as this engine can, and writes them with their pictures for
// compare.py, which renders them with another program.
#include "scenes.h"

#include "plugin.h"
#include "stage.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

namespace peregrine::truth {
namespace {

constexpr uint32_t kSide = 128; // pixels

const char* name_of(Material::Kind kind) {
    constexpr const char* names[] = {"matt", "glowing", "mirror", "glass", "pane"};
    return names[int(kind)];
}

void copy(const Vec3& from, float* to) {
    std::copy_n(from.data(), 3, to);
}

rt_material_desc describe(const Material& material) {
    using enum Material::Kind;
    rt_material_desc desc = rt_default_material_desc();
    const Vec3 black{0, 0, 0};
    desc.double_sided = 1;
    copy(material.kind == matt ? material.color : black, desc.base_color);
    switch (material.kind) {
    case matt:
        break;
    case glowing:
        copy(material.color, desc.emissive);
        break;
    case mirror:
        desc.reflectivity = 1;
        break;
    case pane:
        desc.thin = 1;
        [[fallthrough]];
    case glass:
        copy({1, 1, 1}, desc.base_color);
        desc.transmission = 1;
        desc.index_of_refraction = material.index;
        copy(material.attenuation, desc.attenuation_color);
        desc.attenuation_distance = 1;
        break;
    }
    return desc;
}

class Renderer {
public:
    Renderer(const rt_api& api, const Scene& scene)
        : stage_(api, 1, RT_ISA_BEST), api_(api), scene_(scene) {
        for (const Material& material : scene.materials) {
            const rt_material_desc desc = describe(material);
            stage_.check(api.add_material(stage_.scene(), &desc, &materials_[material.name]),
                         "a material");
        }
        for (const Mesh& mesh : scene.meshes) add(mesh);
        for (const Lamp& lamp : scene.lamps) add(lamp);
        rt_environment environment = rt_default_environment();
        std::fill_n(environment.ambient, 3, scene.ambient);
        stage_.check(api.set_environment(stage_.scene(), &environment), "the environment");
        stage_.commit(RT_STRUCTURE_AUTO, RT_BUILD_BALANCED, nullptr);
    }

    // Radiance, three floats a pixel, top row first; `rays` by `rays` of them a pixel.
    std::vector<float> render(uint32_t rays) const {
        const uint32_t side = kSide * rays;
        std::vector<float> large(size_t(side) * side * 4), small(size_t(kSide) * kSide * 3);
        rt_frame_desc frame = rt_default_frame_desc();
        frame.format = RT_FORMAT_RGBA32F;
        frame.tone_mapping = RT_TONE_NONE;
        frame.pixels = large.data();
        frame.width = frame.height = side;
        frame.max_depth = scene_.max_depth;
        frame.least_importance = 0;
        if (scene_.ambient > 0) {
            frame.occlusion_range = INFINITY;
            frame.occlusion_samples = 256;
            frame.occlusion_block = 1;
        }
        const rt_camera camera = look();
        stage_.check(api_.render_frame(stage_.scene(), &camera, &frame, nullptr), "a frame");
        for (size_t y = 0; y < side; ++y)
            for (size_t x = 0; x < side; ++x)
                for (size_t c = 0; c < 3; ++c)
                    small[(y / rays * kSide + x / rays) * 3 + c] +=
                        large[(y * side + x) * 4 + c] / float(rays * rays);
        return small;
    }

private:
    void add(const Mesh& mesh) {
        rt_mesh_desc desc = rt_default_mesh_desc();
        desc.positions = {mesh.positions.data(), mesh.positions.size(), 0, 0};
        desc.indices = {mesh.triangles.data(), mesh.triangles.size() * 3, 0, 0};
        desc.index_type = RT_INDEX_UINT32;
        desc.material = materials_.at(mesh.material);
        rt_mesh handle;
        stage_.check(api_.add_static_mesh(stage_.scene(), &desc, &handle), "a mesh");
    }

    void add(const Lamp& lamp) {
        rt_light_desc desc = rt_default_light_desc();
        std::copy_n(lamp.position.data(), 3, desc.position);
        std::fill_n(desc.intensity, 3, lamp.candela);
        desc.radius = INFINITY;
        desc.falloff = RT_FALLOFF_INVERSE_SQUARE;
        desc.source_radius = lamp.source_radius;
        desc.shadow_samples = 256;
        rt_light handle;
        stage_.check(api_.add_light(stage_.scene(), &desc, &handle), "a light");
    }

    rt_camera look() const {
        rt_camera camera = rt_default_camera();
        for (size_t k = 0; k < 3; ++k) {
            camera.position[k] = double(scene_.eye[k]);
            camera.forward[k] = scene_.target[k] - scene_.eye[k];
        }
        camera.vertical_fov = scene_.vertical_fov;
        return camera;
    }

    host::Stage stage_;
    const rt_api& api_;
    const Scene& scene_;
    std::map<std::string, rt_material> materials_;
};

nlohmann::json to_json(const Scene& scene) {
    nlohmann::json materials = nlohmann::json::object(), meshes = nlohmann::json::array(),
                   lamps = nlohmann::json::array();
    for (const Material& material : scene.materials)
        materials[material.name] = {{"kind", name_of(material.kind)},
                                    {"color", material.color},
                                    {"index", material.index},
                                    {"attenuation", material.attenuation}};
    for (const Mesh& mesh : scene.meshes)
        meshes.push_back({{"material", mesh.material},
                          {"positions", mesh.positions},
                          {"triangles", mesh.triangles}});
    for (const Lamp& lamp : scene.lamps)
        lamps.push_back({{"position", lamp.position},
                         {"candela", lamp.candela},
                         {"source_radius", lamp.source_radius}});
    return {{"name", scene.name},
            {"what", scene.what},
            {"materials", materials},
            {"meshes", meshes},
            {"lamps", lamps},
            {"eye", scene.eye},
            {"target", scene.target},
            {"vertical_fov", scene.vertical_fov},
            {"max_depth", scene.max_depth},
            {"ambient", scene.ambient},
            {"side", kSide}};
}

void write(const std::filesystem::path& folder, const Scene& scene,
           const std::vector<float>& radiance) {
    std::filesystem::create_directories(folder);
    std::ofstream(folder / (scene.name + ".json")) << to_json(scene);
    std::ofstream pixels(folder / (scene.name + ".f32"), std::ios::binary);
    pixels.write(reinterpret_cast<const char*>(radiance.data()),
                 std::streamsize(radiance.size() * sizeof(float)));
    if (!pixels.flush()) throw std::runtime_error("cannot write to " + folder.string());
}

int run(int argc, char** argv) {
    std::string out, library;
    uint32_t rays = 8;
    CLI::App app("Renders small scenes for compare.py.");
    app.add_option("--out", out, "Folder for the scenes and their pictures")->required();
    app.add_option("--library", library,
                   "The engine; default: libperegrine.so beside this program");
    app.add_option("--rays", rays, "So many by so many a pixel")
        ->capture_default_str()
        ->check(CLI::Range(1u, 32u));
    CLI11_PARSE(app, argc, argv);
    const host::Plugin plugin(library);
    for (const Scene& scene : scenes()) {
        write(out, scene, Renderer(plugin.api(), scene).render(rays));
        std::printf("%s: %s\n", scene.name.c_str(), scene.what.c_str());
    }
    return 0;
}

} // namespace
} // namespace peregrine::truth

int main(int argc, char** argv) {
    try {
        return peregrine::truth::run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "truth_scenes: %s\n", error.what());
        return 1;
    }
}
