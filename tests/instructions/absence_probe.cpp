// Renders a plain scene, and the same with one feature after the other, for valgrind's callgrind to
// tell which functions run: absence.py runs it and reads that. No feature may take memory for
// triangles.
#include "pictures/shapes.h"
#include "stage.h"

#include "camera.h"

#include <cstdio>
#include <exception>
#include <functional>
#include <stdexcept>

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#else // absence.py says that there is no valgrind
#define CALLGRIND_START_INSTRUMENTATION
#define CALLGRIND_STOP_INSTRUMENTATION
#define CALLGRIND_ZERO_STATS
#define CALLGRIND_DUMP_STATS_AT(name) (void)(name)
#endif

namespace {

using namespace peregrine::test;

class Probe {
public:
    Probe() : stage_(*rt_get_api(RT_API_VERSION), 1, RT_ISA_AVX2) { // what valgrind knows
        material_ = add(rt_default_material_desc());
        add(make_grid({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}, 4));
        add(make_ball({0, 1, 0}, 0.8f, 6));
        rt_light_desc lamp = rt_default_light_desc();
        lamp.position[0] = 1;
        lamp.position[1] = 4;
        lamp.position[2] = 2;
        lamp.radius = 20;
        for (float& part : lamp.intensity) part = 40;
        check(rt_add_light(scene(), &lamp, &lamp_));
        lamp_desc_ = lamp;
        view_.position = {0, 2, 6};
        view_.forward = {0, -0.2f, -1};
        frame_ = rt_default_frame_desc();
        frame_.width = 96;
        frame_.height = 64;
        frame_.pixels = pixels_.data();
    }

    void run() {
        count("plain", [] {});
        with_material("mirrors", [](rt_material_desc& desc) { desc.reflectivity = 0.5f; });
        with_material("glass", [](rt_material_desc& desc) { desc.transmission = 1; });
        with_lamp("soft shadows", [](rt_light_desc& desc) { desc.source_radius = 0.2f; });
        count("fog", [&] { set_fog(0.2f); });
        set_fog(0);
        count("sky", [&] { set_sky(true); });
        set_sky(false);
        with_frame("bloom", [](rt_frame_desc& desc) { desc.bloom = 0.3f; });
        with_frame("occlusion", [](rt_frame_desc& desc) { desc.occlusion_range = 1; });
        with_frame("edges", [](rt_frame_desc& desc) { desc.edge_samples = 4; });
        with_frame("blocks", [](rt_frame_desc& desc) { desc.light_block = 8; });
        const rt_particle sparks[] = {{{0, 2, 1}, 0.3f, {1, 1, 1}}, {{1, 1, 1}, 0.2f, {2, 1, 0}}};
        with_frame("particles", [&](rt_frame_desc& desc) { desc.particles = {sparks, 2, 0, 0}; });
        count("plain again", [] {});
    }

private:
    rt_scene scene() const { return stage_.scene(); }
    void check(rt_result result) const { stage_.check(result, "a call"); }

    rt_material add(const rt_material_desc& desc) {
        rt_material material{};
        check(rt_add_material(scene(), &desc, &material));
        return material;
    }
    void add(const Shape& shape) {
        rt_mesh_desc desc = shape.desc();
        desc.material = material_;
        rt_mesh mesh{};
        check(rt_add_static_mesh(scene(), &desc, &mesh));
    }
    void set_fog(float density) {
        rt_fog fog = rt_default_fog();
        fog.density = density;
        fog.top = 2;
        check(rt_set_fog(scene(), &fog));
    }
    void set_sky(bool has) {
        rt_environment environment = rt_default_environment();
        if (has) environment.sky = RT_SKY_GRADIENT;
        check(rt_set_environment(scene(), &environment));
    }

    // The second frame: memory is there then. The commit is counted, too.
    void count(const char* name, const std::function<void()>& change) {
        change();
        commit_and_render();
        CALLGRIND_START_INSTRUMENTATION;
        CALLGRIND_ZERO_STATS;
        commit_and_render();
        CALLGRIND_DUMP_STATS_AT(name);
        CALLGRIND_STOP_INSTRUMENTATION;
    }
    void commit_and_render() {
        rt_commit_report report = rt_default_commit_report();
        check(rt_commit_scene(scene(), nullptr, &report));
        const uint64_t bytes = report.bytes_triangles + report.bytes_nodes + report.bytes_references
                               + report.bytes_attributes;
        if (bytes_ == 0) bytes_ = bytes;
        if (bytes != bytes_) throw std::runtime_error("a feature takes memory for triangles");
        const rt_camera camera = host::camera_of(view_);
        check(rt_render_frame(scene(), &camera, &frame_, nullptr));
    }
    void with_material(const char* name, const std::function<void(rt_material_desc&)>& change) {
        const rt_material_desc plain = rt_default_material_desc();
        rt_material_desc desc = plain;
        change(desc);
        count(name, [&] { check(rt_update_material(scene(), material_, &desc)); });
        check(rt_update_material(scene(), material_, &plain));
    }
    void with_lamp(const char* name, const std::function<void(rt_light_desc&)>& change) {
        rt_light_desc desc = lamp_desc_;
        change(desc);
        count(name, [&] { check(rt_update_light(scene(), lamp_, &desc)); });
        check(rt_update_light(scene(), lamp_, &lamp_desc_));
    }
    void with_frame(const char* name, const std::function<void(rt_frame_desc&)>& change) {
        const rt_frame_desc plain = frame_;
        count(name, [&] { change(frame_); });
        frame_ = plain;
    }

    host::Stage stage_;
    host::Viewpoint view_;
    rt_frame_desc frame_;
    std::vector<uint8_t> pixels_ = std::vector<uint8_t>(96 * 64 * 4);
    rt_material material_{};
    rt_light lamp_{};
    rt_light_desc lamp_desc_;
    uint64_t bytes_ = 0; // of the plain scene's triangles
};

} // namespace

int main() {
    try {
        Probe().run();
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "absence_probe: %s\n", error.what());
        return 1;
    }
}
