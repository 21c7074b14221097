// Figures 6 to 8 of the paper (Bikker 2007), ours: fall-offs, the spots that they make on a wall,
// and lights that overlap; and shadows of glass.
#include "canvas.h"

#include "image_file.h"
#include "pictures/glass_scene.h"
#include "plugin.h"
#include "stage.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>

namespace peregrine::report {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr float kRadius = 10; // of the lamps

struct Kind {
    rt_falloff falloff;
    Color color; // of its curve
};
constexpr Kind kKinds[] = {{RT_FALLOFF_INVERSE_SQUARE, {0.13, 0.55, 0.25}},
                           {RT_FALLOFF_WINDOWED_INVERSE_SQUARE, {0.12, 0.13, 0.16}},
                           {RT_FALLOFF_COSINE_LINEAR, {0.10, 0.36, 0.75}},
                           {RT_FALLOFF_SCHLICK_LINEAR, {0.82, 0.16, 0.12}},
                           {RT_FALLOFF_LINEAR, {0.90, 0.62, 0.10}}};

// A scene of boxes without ambient light.
class Room {
public:
    explicit Room(const rt_api& api) : stage_(api, 1, RT_ISA_BEST) {
        rt_environment dark = rt_default_environment();
        for (float& part : dark.ambient) part = 0;
        for (float& part : dark.background) part = 0;
        stage_.check(api.set_environment(stage_.scene(), &dark), "setting the environment");
    }

    void add_box(const std::array<float, 3>& lower, const std::array<float, 3>& upper) {
        constexpr uint32_t kSides[] = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                                       2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
        std::array<float, 24> corners{};
        for (size_t i = 0; i < 24; ++i) {
            const size_t corner = i / 3, axis = i % 3;
            corners[i] = (corner >> axis & 1) != 0 ? upper[axis] : lower[axis];
        }
        rt_mesh_desc desc = rt_default_mesh_desc();
        desc.positions = {corners.data(), 8, 0, 0};
        desc.indices = {kSides, std::size(kSides), 0, 0};
        rt_mesh mesh{};
        stage_.check(stage_.api().add_static_mesh(stage_.scene(), &desc, &mesh), "adding a box");
    }

    rt_light add_lamp(rt_falloff falloff, const std::array<double, 3>& place,
                      const std::array<float, 3>& candela) {
        rt_light_desc lamp = rt_default_light_desc();
        lamp.falloff = falloff;
        std::copy(place.begin(), place.end(), lamp.position);
        std::copy(candela.begin(), candela.end(), lamp.intensity);
        lamp.radius = kRadius;
        rt_light light{};
        stage_.check(stage_.api().add_light(stage_.scene(), &lamp, &light), "adding a lamp");
        return light;
    }
    void remove(rt_light light) {
        stage_.check(stage_.api().remove_light(stage_.scene(), light), "removing a lamp");
    }

    void render(const host::Viewpoint& view, host::Frame frame, void* pixels) {
        stage_.commit(RT_STRUCTURE_AUTO, RT_BUILD_BALANCED, nullptr);
        stage_.render(view, frame, pixels);
    }

private:
    host::Stage stage_;
};

// The light on a wall head on, by the distance of its lamp, times an inverse square's at a tenth.
double light_at(Room& room, rt_falloff falloff, double part) {
    const double distance = part * double(kRadius);
    const rt_light light = room.add_lamp(falloff, {0, 0, distance}, {1, 1, 1});
    host::Viewpoint view;
    view.position = {0, 0, 0.5 * distance};
    host::Frame frame;
    frame.width = frame.height = 1;
    frame.format = RT_FORMAT_RGBA32F;
    frame.tone_mapping = RT_TONE_NONE;
    std::array<float, 4> pixel{};
    room.render(view, frame, pixel.data());
    room.remove(light);
    return kPi * double(pixel[0]);
}

// Figure 6: from a twentieth of the radius to all of it.
void draw_curves(Room& wall, const std::string& path) {
    constexpr double kFrom = 0.05, kMost = 1.6, kWide = 6.4, kHigh = 3.6;
    Canvas canvas(-0.2, -0.2, kWide + 0.2, kHigh + 0.2, 100);
    const Color paper{0.97, 0.96, 0.93}, ink{0.12, 0.13, 0.16};
    for (uint32_t row = 0; row < canvas.height(); ++row)
        for (uint32_t column = 0; column < canvas.width(); ++column) canvas.set(column, row, paper);
    for (int tenth = 0; tenth <= 10; ++tenth)
        canvas.line(kWide * tenth / 10, 0, kWide * tenth / 10, kHigh, 0.006, ink, 0.2);
    canvas.line(0, kHigh, kWide, kHigh, 0.015, ink);
    canvas.line(0, 0, 0, kHigh, 0.015, ink);
    const double unit = kHigh / kMost;
    for (const Kind& kind : kKinds) {
        double x0 = 0, y0 = 0;
        for (double part = kFrom; part < 0.9995; part += 0.005) {
            const double x = kWide * part;
            const double y = kHigh - unit * std::min(light_at(wall, kind.falloff, part), kMost);
            if (part > kFrom && (y > 0 || y0 > 0)) canvas.line(x0, y0, x, y, 0.035, kind.color);
            x0 = x;
            y0 = y;
        }
    }
    canvas.write(path);
}

// Figure 7: lamps half a metre before a wall, side by side.
void draw_spots(Room& wall, const std::string& path) {
    constexpr uint32_t kWide = 256, kHigh = 256, kCount = std::size(kKinds);
    std::vector<uint8_t> all(size_t{4} * kWide * kHigh * kCount), one(size_t{4} * kWide * kHigh);
    host::Viewpoint view;
    view.position = {0, 0, 9};
    view.vertical_fov = 0.9f;
    host::Frame frame;
    frame.width = kWide;
    frame.height = kHigh;
    frame.tone_mapping = RT_TONE_CLAMP;
    for (uint32_t i = 0; i < kCount; ++i) {
        const rt_light light = wall.add_lamp(kKinds[i].falloff, {0, 0, 1.5}, {5, 5, 5});
        wall.render(view, frame, one.data());
        wall.remove(light);
        for (uint32_t row = 0; row < kHigh; ++row)
            std::copy_n(&one[size_t{4} * kWide * row], 4 * kWide,
                        &all[size_t{4} * kWide * (size_t{kCount} * row + i)]);
    }
    host::write_picture_file(path, kWide * kCount, kHigh, all);
}

// Figure 8: three lamps between walls.
void draw_overlap(const rt_api& api, const std::string& path) {
    Room room(api);
    room.add_box({-12, -0.1f, -12}, {12, 0, 12});
    for (const float x : {-6.0f, -2.0f, 2.0f, 6.0f}) {
        room.add_box({x - 0.2f, 0, -6}, {x + 0.2f, 2.2f, -1.5f});
        room.add_box({x - 0.2f, 0, 1.5f}, {x + 0.2f, 2.2f, 6});
    }
    room.add_box({-8, 0, -6.4f}, {8, 2.2f, -6});
    room.add_box({-0.8f, 0, -0.8f}, {0.8f, 3.4f, 0.8f});
    room.add_lamp(RT_FALLOFF_WINDOWED_INVERSE_SQUARE, {4.2, 1.6, 4.2}, {2, 5, 30});
    room.add_lamp(RT_FALLOFF_WINDOWED_INVERSE_SQUARE, {-4.2, 1.8, 1.6}, {34, 5, 3});
    room.add_lamp(RT_FALLOFF_WINDOWED_INVERSE_SQUARE, {0.5, 4.6, -3.2}, {24, 24, 22});
    host::Viewpoint view;
    view.position = {5.5, 8.5, 11};
    view.forward = glm::normalize(glm::vec3(-0.42f, -0.72f, -0.9f));
    view.vertical_fov = 0.8f;
    host::Frame frame;
    frame.width = 960;
    frame.height = 540;
    frame.tone_mapping = RT_TONE_FILMIC;
    frame.exposure = 2;
    std::vector<uint8_t> pixels(size_t{4} * frame.width * frame.height);
    room.render(view, frame, pixels.data());
    host::write_picture_file(path, frame.width, frame.height, pixels);
}

// A lamp behind coloured panes, and one above glass and a veil.
void draw_tinted(const rt_api& api, const std::string& path) {
    host::Stage stage(api, 1, RT_ISA_BEST);
    test::GlassScene scene(stage, {});
    scene.shine_through();
    stage.check(api.commit_scene(stage.scene(), nullptr, nullptr), "building");
    rt_frame_desc frame = rt_default_frame_desc();
    frame.width = 960;
    frame.height = 540;
    frame.exposure = 0.5f;
    frame.edge_samples = 8;
    frame.occlusion_range = 1;
    std::vector<uint8_t> pixels(size_t{4} * frame.width * frame.height);
    frame.pixels = pixels.data();
    const rt_camera camera = scene.camera();
    stage.check(api.render_frame(stage.scene(), &camera, &frame, nullptr), "rendering a frame");
    host::write_picture_file(path, frame.width, frame.height, pixels);
}

int run(int argc, char** argv) {
    std::string out = "docs", library;
    CLI::App app("Draws fall-offs of lamps, their spots on a wall, lamps that overlap, and shadows "
                 "of glass.");
    app.add_option("--out", out, "Folder for the PNG files")->capture_default_str();
    app.add_option("--library", library,
                   "The engine; default: libperegrine.so beside this program");
    CLI11_PARSE(app, argc, argv);
    const host::Plugin plugin(library);
    const auto file = [&](const char* name) {
        return (std::filesystem::path(out) / name).string();
    };
    Room wall(plugin.api());
    wall.add_box({-9, -9, -1}, {9, 9, 0});
    draw_curves(wall, file("falloffs.png"));
    draw_spots(wall, file("falloff_spots.png"));
    draw_overlap(plugin.api(), file("lamps_overlap.png"));
    draw_tinted(plugin.api(), file("tinted_shadows.png"));
    return 0;
}

} // namespace
} // namespace peregrine::report

int main(int argc, char** argv) {
    try {
        return peregrine::report::run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "light_pictures: %s\n", error.what());
        return 1;
    }
}
