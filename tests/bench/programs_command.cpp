// What shading programs of the host take, beside what the library does itself: a floor that fills
// the picture, of large and of small triangles.
#include "../pictures/shapes.h"

#include "commands.h"
#include "image_size.h"
#include "timing.h"

#include "plugin.h"
#include "stage.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace peregrine::bench {
namespace {

void shade_as_library(void*, const rt_program_batch* hits) {
    for (int k = 0; k < 3; ++k) {
        const float *const color = hits->base_color[k], *const light = hits->diffuse[k],
                           *const highlight = hits->highlight[k], *const glow = hits->emissive[k];
        float* const out = hits->radiance[k];
        for (uint32_t i = 0; i < hits->padded_count; ++i)
            out[i] = color[i] * light[i] + highlight[i] + glow[i];
    }
}

void shade_bands(void*, const rt_program_batch* hits) {
    for (uint32_t i = 0; i < hits->padded_count; ++i) {
        const float u = hits->texcoord[0][i], v = hits->texcoord[1][i];
        for (int k = 0; k < 3; ++k) hits->radiance[k][i] = 4 * u * (1 - u) * v;
    }
}

void mirror(void*, const rt_program_batch* hits) {
    const auto& [x, y, z] = hits->direction;
    const auto& [nx, ny, nz] = hits->shading_normal;
    for (uint32_t i = 0; i < hits->padded_count; ++i) {
        const float twice = 2 * (x[i] * nx[i] + y[i] * ny[i] + z[i] * nz[i]);
        hits->ray_direction[0][i] = x[i] - twice * nx[i];
        hits->ray_direction[1][i] = y[i] - twice * ny[i];
        hits->ray_direction[2][i] = z[i] - twice * nz[i];
        for (int k = 0; k < 3; ++k) hits->ray_weight[k][i] = 1;
    }
}

constexpr uint32_t kLight =
    RT_PROGRAM_BASE_COLOR | RT_PROGRAM_DIFFUSE | RT_PROGRAM_HIGHLIGHT | RT_PROGRAM_EMISSIVE;

// Each beside a material without a program.
struct Setting {
    const char* name;
    uint32_t fields;
    rt_program_function shade;
    float reflectivity; // of the material without
};
constexpr Setting kSettings[] = {
    {"what the library does", kLight, shade_as_library, 0},
    {"all fields", (RT_PROGRAM_RAYS - 1), shade_as_library, 0},
    {"bands, no light", RT_PROGRAM_TEXCOORD, shade_bands, 0},
    {"a mirror", RT_PROGRAM_RAYS | RT_PROGRAM_DIRECTION | RT_PROGRAM_SHADING_NORMAL, mirror, 1},
};

class Floor {
public:
    Floor(const Options& options, const rt_api& api, uint32_t cells)
        : stage_(api, options.threads, RT_ISA_BEST), size_(parse_image_size(options.frame_size)),
          pixels_(size_t(size_.width) * size_.height * 4), is_alone_(options.threads == 1) {
        const test::Shape shape = test::make_grid({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}, cells);
        rt_mesh_desc mesh = shape.desc();
        const rt_material_desc desc = material(nullptr, 0);
        check(api.add_material(stage_.scene(), &desc, &material_));
        mesh.material = material_;
        rt_mesh handle;
        check(api.add_static_mesh(stage_.scene(), &mesh, &handle));
        rt_light_desc lamp = rt_default_light_desc();
        lamp.position[1] = 2;
        rt_light light;
        check(api.add_light(stage_.scene(), &lamp, &light));
    }

    void show(const Setting* setting, float reflectivity) {
        const rt_material_desc desc = material(setting, reflectivity);
        check(stage_.api().update_material(stage_.scene(), material_, &desc));
        check(stage_.api().commit_scene(stage_.scene(), nullptr, nullptr));
    }

    double render() {
        rt_frame_desc frame = rt_default_frame_desc();
        frame.width = size_.width;
        frame.height = size_.height;
        frame.pixels = pixels_.data();
        rt_camera camera = rt_default_camera();
        camera.position[1] = 3;
        camera.forward[1] = -1;
        camera.forward[2] = -0.2f;
        const double start = is_alone_ ? thread_seconds() : wall_seconds();
        check(stage_.api().render_frame(stage_.scene(), &camera, &frame, nullptr));
        return 1e3 * ((is_alone_ ? thread_seconds() : wall_seconds()) - start);
    }

    double pixel_count() const { return double(size_.width) * size_.height; }

private:
    void check(rt_result result) const { stage_.check(result, "measuring"); }

    rt_material_desc material(const Setting* setting, float reflectivity) {
        rt_material_desc desc = rt_default_material_desc();
        desc.specular[0] = 0.1f;
        desc.emissive[1] = 0.1f;
        desc.reflectivity = reflectivity;
        if (!setting) return desc;
        rt_program_desc program = rt_default_program_desc();
        program.fields = setting->fields;
        program.shade = setting->shade;
        check(stage_.api().add_program(stage_.scene(), &program, &desc.program));
        return desc;
    }

    host::Stage stage_;
    ImageSize size_;
    std::vector<uint8_t> pixels_;
    bool is_alone_;
    rt_material material_{};
};

nlohmann::json measure(const Options& options, Floor& floor, uint32_t cells,
                       const Setting& setting) {
    std::vector<double> none_ms, ms;
    for (uint32_t pass = 0; pass <= options.passes; ++pass) {
        floor.show(nullptr, setting.reflectivity);
        const double none = floor.render();
        floor.show(&setting, 0);
        const double with = floor.render();
        if (pass == 0) continue; // nothing is in the caches yet
        none_ms.push_back(none);
        ms.push_back(with);
    }
    const double none = median(none_ms), with = median(ms);
    const double ns = 1e6 * (with - none) / floor.pixel_count();
    std::printf("%10u %-24s %9.2f %9.2f %+9.2f\n", 2 * cells * cells, setting.name, none, with, ns);
    std::fflush(stdout);
    return {{"triangles", 2 * cells * cells},
            {"setting", setting.name},
            {"without_ms", none},
            {"frame_ms", with},
            {"more_ns_per_hit", ns},
            {"threads", options.threads},
            {"size", options.frame_size}};
}

} // namespace

std::string run_programs(const Options& options) {
    const host::Plugin plugin(options.library);
    std::printf("%10s %-24s %9s %9s %9s\n", "triangles", "program", "none, ms", "with, ms",
                "ns a hit");
    nlohmann::json rows = nlohmann::json::array();
    for (const uint32_t cells : {8u, 256u}) {
        Floor floor(options, plugin.api(), cells);
        for (const Setting& setting : kSettings)
            rows.push_back(measure(options, floor, cells, setting));
    }
    return rows.dump(2);
}

} // namespace peregrine::bench
