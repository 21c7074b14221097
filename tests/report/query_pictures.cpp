// The pictures of docs/queries.md: what each query answers, asked on a level and drawn on its plan.
#include "asker.h"
#include "canvas.h"

#include "gltf/import.h"
#include "plugin.h"
#include "stage.h"
#include "upload.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <limits>

namespace peregrine::report {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kHeight = 1.2f; // of the plan, above the floor
constexpr Color kInk{0.12, 0.13, 0.16}, kPaper{0.97, 0.96, 0.93}, kBlue{0.10, 0.36, 0.75},
    kRed{0.82, 0.16, 0.12}, kGreen{0.18, 0.56, 0.30}, kGold{0.95, 0.72, 0.20};

struct Place {
    float x, z;
};
constexpr Place kWatcher{0.0f, -13.0f};
constexpr double kPlan[4] = {-23.4, -34.8, 27.6, 0.9}; // of our hall: x0, z0, x1, z1

Color mix(const Color& a, const Color& b, double part) {
    return {a.r + (b.r - a.r) * part, a.g + (b.g - a.g) * part, a.b + (b.b - a.b) * part};
}

// Something for every pixel of a canvas.
template <class Record>
std::vector<Record> per_pixel(const Canvas& canvas, const std::function<Record(float, float)>& at) {
    std::vector<Record> records;
    records.reserve(size_t(canvas.width()) * canvas.height());
    for (uint32_t row = 0; row < canvas.height(); ++row)
        for (uint32_t column = 0; column < canvas.width(); ++column)
            records.push_back(at(float(canvas.x_of(column)), float(canvas.z_of(row))));
    return records;
}

template <class Colored>
void fill(Canvas& canvas, Colored&& color) {
    size_t i = 0;
    for (uint32_t row = 0; row < canvas.height(); ++row)
        for (uint32_t column = 0; column < canvas.width(); ++column, ++i)
            canvas.set(column, row, color(i));
}

// The plan with its paper coloured.
template <class Colored>
Canvas over_walls(const Canvas& plan, Colored&& color) {
    Canvas canvas = plan;
    fill(canvas, [&](size_t i) { return plan.pixel(i).r < 0.5 ? kInk : color(i); });
    return canvas;
}

rt_ray toward(float x, float z, double angle, float reach = kInfinity) {
    return {{x, kHeight, z}, 0, {float(std::cos(angle)), 0, float(std::sin(angle))}, reach};
}

// Walls are where a surface is nearer than a line's width.
Canvas plan(const Asker& asker, double scale) {
    Canvas canvas(kPlan[0], kPlan[1], kPlan[2], kPlan[3], scale);
    const float line = float(0.9 / scale);
    const auto found = asker.nearest(per_pixel<rt_point>(canvas, [&](float x, float z) {
        return rt_point{{x, kHeight, z}, line};
    }));
    fill(canvas, [&](size_t i) { return std::isinf(found[i].distance) ? kPaper : kInk; });
    return canvas;
}

Canvas draw_closest(const Asker& asker, Canvas canvas) {
    constexpr int kRays = 240;
    std::vector<rt_ray> rays;
    for (int i = 0; i < kRays; ++i)
        rays.push_back(toward(kWatcher.x, kWatcher.z, 2 * kPi * i / kRays));
    const auto hits = asker.closest(rays);
    for (int i = 0; i < kRays; ++i) {
        const rt_ray& ray = rays[size_t(i)];
        const float t = std::min(hits[size_t(i)].t, 100.0f);
        const float x = ray.origin[0] + t * ray.direction[0],
                    z = ray.origin[2] + t * ray.direction[2];
        canvas.line(kWatcher.x, kWatcher.z, x, z, 0.04, kGold, 0.7);
    }
    for (int i = 0; i < kRays; ++i) {
        const rt_ray& ray = rays[size_t(i)];
        const float t = hits[size_t(i)].t;
        if (!std::isinf(t))
            canvas.disc(ray.origin[0] + t * ray.direction[0], ray.origin[2] + t * ray.direction[2],
                        0.13, kRed);
    }
    canvas.disc(kWatcher.x, kWatcher.z, 0.35, kBlue);
    return canvas;
}

Canvas draw_any(const Asker& asker, const Canvas& plan) {
    const auto occluded = asker.any(per_pixel<rt_ray>(plan, [](float x, float z) {
        return rt_ray{{kWatcher.x, kHeight, kWatcher.z}, 0, {x - kWatcher.x, 0, z - kWatcher.z}, 1};
    }));
    Canvas seen = over_walls(plan, [&](size_t i) {
        return occluded[i] ? mix(kPaper, kInk, 0.3) : mix(kPaper, kGold, 0.45);
    });
    seen.disc(kWatcher.x, kWatcher.z, 0.35, kBlue);
    return seen;
}

Canvas draw_all(const Asker& asker, Canvas canvas) {
    const rt_ray ray = toward(-23.2f, -16.4f, 0, 50.5f);
    const auto hits = asker.all(ray, 64);
    canvas.line(ray.origin[0], ray.origin[2], ray.origin[0] + ray.t_max, ray.origin[2], 0.08,
                kGold);
    for (const rt_hit& hit : hits)
        canvas.disc(ray.origin[0] + hit.t, ray.origin[2], 0.24, hit.back_face ? kBlue : kRed);
    return canvas;
}

Canvas draw_count(const Asker& asker, Canvas canvas) {
    const auto counts = asker.count(per_pixel<rt_ray>(canvas, [](float x, float z) {
        return rt_ray{{x, kHeight, z}, 0, {0, 1, 0}, kInfinity};
    }));
    fill(canvas, [&](size_t i) {
        return counts[i] == 0 ? kPaper
                              : mix(mix(kPaper, kGold, 0.4), kBlue, std::min(1.0, counts[i] / 9.0));
    });
    return canvas;
}

Canvas draw_sweep(const Asker& asker, Canvas canvas) {
    constexpr int kSpheres = 40;
    constexpr float kRadius = 0.4f;
    std::vector<rt_sweep> sweeps;
    for (int i = 0; i < kSpheres; ++i) {
        const double angle = 2 * kPi * i / kSpheres;
        sweeps.push_back({{kWatcher.x, kHeight, kWatcher.z},
                          kRadius,
                          {0, 0, 0},
                          60,
                          {float(std::cos(angle)), 0, float(std::sin(angle))},
                          0});
    }
    const auto hits = asker.sweep(sweeps);
    for (size_t i = 0; i < sweeps.size(); ++i) {
        const float t = std::min(hits[i].t, sweeps[i].t_max);
        const double x = kWatcher.x + t * sweeps[i].direction[0];
        const double z = kWatcher.z + t * sweeps[i].direction[2];
        canvas.line(kWatcher.x, kWatcher.z, x, z, 0.05, kGold, 0.8);
        canvas.ring(x, z, kRadius, 0.08, kBlue);
        if (hits[i].triangle == RT_NO_TRIANGLE) continue;
        const float* p = hits[i].point;
        const float* n = hits[i].normal;
        canvas.line(p[0], p[2], p[0] + n[0], p[2] + n[2], 0.08, kGreen);
        canvas.disc(p[0], p[2], 0.13, kRed);
    }
    return canvas;
}

Canvas draw_overlap(const Asker& asker, const Canvas& plan) {
    const auto touching = asker.overlap(per_pixel<rt_shape>(plan, [](float x, float z) {
        return rt_shape{{x, 1.0f, z}, 0.35f, {0, 0.55f, 0}, RT_SHAPE_CAPSULE, {0, 0, 0, 0}};
    }));
    return over_walls(plan, [&](size_t i) {
        return touching[i] ? mix(kPaper, kRed, 0.5) : mix(kPaper, kGreen, 0.35);
    });
}

Canvas draw_nearest(const Asker& asker, Canvas canvas) {
    const auto found = asker.nearest(per_pixel<rt_point>(canvas, [](float x, float z) {
        return rt_point{{x, kHeight, z}, 4.0f};
    }));
    fill(canvas, [&](size_t i) {
        const double d = std::min(double(found[i].distance), 4.0);
        if (d < 0.06) return kInk;
        const double band = std::fabs(d / 0.5 - std::round(d / 0.5)) < 0.06 ? 0.25 : 0.0;
        return mix(mix(kGold, kPaper, d / 4), kInk, band);
    });
    for (const Place& place :
         {Place{-9.2f, -15.9f}, Place{5.3f, -15.2f}, Place{-14.3f, -12.0f}, Place{26.0f, -20.0f}}) {
        const rt_nearest at = asker.nearest({{{place.x, kHeight, place.z}, 10.0f}})[0];
        canvas.line(place.x, place.z, at.point[0], at.point[2], 0.08, kGreen);
        canvas.disc(place.x, place.z, 0.25, kBlue);
        canvas.disc(at.point[0], at.point[2], 0.18, kRed);
    }
    return canvas;
}

void draw(const Asker& asker, const std::filesystem::path& folder, double scale) {
    std::filesystem::create_directories(folder);
    const Canvas base = plan(asker, scale);
    const auto write = [&](const char* name, const Canvas& canvas) {
        const auto path = folder / (std::string("query_") + name + ".png");
        canvas.write(path.string());
        std::printf("wrote %s\n", path.c_str());
    };
    write("closest", draw_closest(asker, base));
    write("any", draw_any(asker, base));
    write("all", draw_all(asker, base));
    write("count", draw_count(asker, base));
    write("sweep", draw_sweep(asker, base));
    write("overlap", draw_overlap(asker, base));
    write("nearest", draw_nearest(asker, base));
}

int run(int argc, char** argv) {
    std::string out = "docs", library;
    double scale = 14;
    CLI::App app("Draws what each query answers on the plan of content/hall.glb.");
    app.add_option("--out", out, "Folder for the PNG files")->capture_default_str();
    app.add_option("--scale", scale, "Pixels a metre")
        ->capture_default_str()
        ->check(CLI::Range(1, 100));
    app.add_option("--library", library,
                   "The engine; default: libperegrine.so beside this program");
    CLI11_PARSE(app, argc, argv);
    const host::Plugin plugin(library);
    host::Stage stage(plugin.api(), 1, RT_ISA_BEST);
    host::upload_level(stage, host::gltf::import_file(PEREGRINE_SOURCE_DIR "/content/hall.glb"),
                       0.1f);
    stage.commit(RT_STRUCTURE_AUTO, RT_BUILD_BALANCED, nullptr);
    draw(Asker(stage), out, scale);
    return 0;
}

} // namespace
} // namespace peregrine::report

int main(int argc, char** argv) {
    try {
        return peregrine::report::run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "query_pictures: %s\n", error.what());
        return 1;
    }
}
