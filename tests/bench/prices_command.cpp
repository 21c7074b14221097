// What each approximation costs or saves, and how far it is from 16 rays a pixel.
#include "commands.h"
#include "frame_stage.h"
#include "image_size.h"
#include "isa_name.h"
#include "means.h"
#include "timing.h"

#include "gltf/import.h"
#include "image_file.h"
#include "plugin.h"
#include "support/flip.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

namespace peregrine::bench {
namespace {

constexpr uint32_t kErrorTile = 32; // pixels, of the tiles of which the worst is told
constexpr uint32_t kSamples = 4;    // a side, of the truth

struct Setting {
    const char* name;
    uint32_t edge_samples = 1;
    float edge_budget = 0;
    float scale = 1;
    bool bilinear = false; // by us, for comparison
    rt_texture_filter filter = RT_TEXTURE_FINEST;
    uint32_t light_block = 1;
    float least_light = 0;
    uint32_t occlusion_block = 0; // 0: no occlusion
    uint32_t occlusion_samples = 16;
    float baked = 0; // metres between points of occlusion; 0: none is

    // Cheaper light is not meant to be nearer to the truth than one ray a pixel, but to that.
    bool is_light() const { return light_block > 1 || least_light > 0; }
};
constexpr Setting kSettings[] = {
    {.name = "one ray"},
    {.name = "mip-maps", .filter = RT_TEXTURE_MIPMAPS},
    {.name = "edges 4", .edge_samples = 4},
    {.name = "edges 4, budget", .edge_samples = 4, .edge_budget = 0.2f},
    {.name = "edges 8", .edge_samples = 8},
    {.name = "edges 8, budget", .edge_samples = 8, .edge_budget = 0.5f},
    {.name = "edges 16", .edge_samples = 16},
    {.name = "edges 8, mip-maps", .edge_samples = 8, .filter = RT_TEXTURE_MIPMAPS},
    {.name = "size 3/4", .scale = 0.75f},
    {.name = "size 3/4, bilinear", .scale = 0.75f, .bilinear = true},
    {.name = "size 1/2", .scale = 0.5f},
    {.name = "size 1/2, bilinear", .scale = 0.5f, .bilinear = true},
    {.name = "size 1/2, edges 4", .edge_samples = 4, .scale = 0.5f},
    {.name = "light, blocks of 4", .light_block = 4},
    {.name = "light, blocks of 8", .light_block = 8},
    {.name = "light, blocks of 16", .light_block = 16},
    {.name = "least light 0.5", .least_light = 0.5f},
    {.name = "least light 2", .least_light = 2},
    {.name = "least light 8", .least_light = 8},
    {.name = "occlusion", .occlusion_block = 1},
    {.name = "occlusion, blocks of 4", .occlusion_block = 4},
    {.name = "occlusion, blocks of 8", .occlusion_block = 8},
    {.name = "occlusion, blocks of 16", .occlusion_block = 16},
    {.name = "occlusion, baked, 1 m", .occlusion_block = 8, .baked = 1},
    {.name = "occlusion, baked, 0.5 m", .occlusion_block = 8, .baked = 0.5f},
    {.name = "occlusion, baked, 0.25 m", .occlusion_block = 8, .baked = 0.25f},
};
constexpr Setting kFineOcclusion = {
    .name = "occlusion, 256 rays", .occlusion_block = 1, .occlusion_samples = 256};
constexpr float kOcclusionRange = 1.0f; // metres
constexpr float kLightTolerance = 0.03f;

double to_linear(uint8_t code) {
    const double x = code / 255.0;
    return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

uint8_t to_code(double x) {
    const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    return uint8_t(encoded * 255.0 + 0.5);
}

using Pixels = std::vector<uint8_t>;

struct Image {
    ImageSize size;
    Pixels pixels;
};

// Means of squares of pixels, of light as the display gives it.
Image shrink(const Image& large, uint32_t by) {
    double linear[256];
    for (int code = 0; code < 256; ++code) linear[code] = to_linear(uint8_t(code));
    Image small{{large.size.width / by, large.size.height / by}, {}};
    small.pixels.resize(small.size.pixels() * 4, 255);
    for (size_t i = 0; i < small.size.pixels(); ++i)
        for (size_t c = 0; c < 3; ++c) {
            const size_t x = i % small.size.width * by, y = i / small.size.width * by;
            double sum = 0;
            for (uint32_t k = 0; k < by * by; ++k)
                sum += linear[large.pixels[((y + k / by) * large.size.width + x + k % by) * 4 + c]];
            small.pixels[i * 4 + c] = to_code(sum / (by * by));
        }
    return small;
}

// As a graphics card does.
Image enlarge_bilinearly(const Image& small, const ImageSize& size) {
    Image large{size, Pixels(size.pixels() * 4, 255)};
    const auto at = [&](int x, int y, uint32_t c) {
        const int cx = std::clamp(x, 0, int(small.size.width) - 1);
        const int cy = std::clamp(y, 0, int(small.size.height) - 1);
        return double(small.pixels[(size_t(cy) * small.size.width + size_t(cx)) * 4 + c]);
    };
    for (uint32_t y = 0; y < size.height; ++y)
        for (uint32_t x = 0; x < size.width; ++x) {
            const double sx = (x + 0.5) * small.size.width / size.width - 0.5;
            const double sy = (y + 0.5) * small.size.height / size.height - 0.5;
            const int ix = int(std::floor(sx)), iy = int(std::floor(sy));
            const double fx = sx - ix, fy = sy - iy;
            for (uint32_t c = 0; c < 3; ++c) {
                const double upper = at(ix, iy, c) * (1 - fx) + at(ix + 1, iy, c) * fx;
                const double lower = at(ix, iy + 1, c) * (1 - fx) + at(ix + 1, iy + 1, c) * fx;
                large.pixels[(size_t(y) * size.width + x) * 4 + c] =
                    uint8_t(upper * (1 - fy) + lower * fy + 0.5);
            }
        }
    return large;
}

struct Price {
    double ms = 0, edge_rays = 0, shadow_rays = 0, occlusion_rays = 0, flip_mean = 0,
           flip_worst_tile = 0;
};

class Pricing {
public:
    Pricing(const Options& options, const rt_api& api, const std::string& file)
        : options_(options), name_(std::filesystem::path(file).stem().string()),
          level_(host::gltf::import_file(file)), views_(standing_cameras(level_)),
          size_(parse_image_size(options.frame_size)),
          stage_(api, level_, options.threads, RT_LIGHT_PROOFS_KEPT, to_isa(options.isa)) {
        for (const Setting& setting : kSettings)
            if (setting.baked > 0) bake(setting.baked);
    }

    nlohmann::json run() {
        std::vector<Price> sums(std::size(kSettings));
        for (size_t view = 0; view < views_.size(); ++view) {
            const Image truth =
                shrink(render({.name = "", .scale = float(kSamples)}, view).image, kSamples);
            write("truth", view, truth);
            const Image one_ray = render(kSettings[0], view).image;
            const Image fine_occlusion = render(kFineOcclusion, view).image;
            write(kFineOcclusion.name, view, fine_occlusion);
            for (size_t i = 0; i < sums.size(); ++i)
                add(kSettings[i], view,
                    kSettings[i].occlusion_block > 0 ? fine_occlusion
                    : kSettings[i].is_light()        ? one_ray
                                                     : truth,
                    sums[i]);
        }
        nlohmann::json rows = nlohmann::json::array();
        for (size_t i = 0; i < sums.size(); ++i) rows.push_back(row_of(kSettings[i], sums[i]));
        return rows;
    }

private:
    struct Result {
        Image image;
        double ms, edge_rays, shadow_rays, occlusion_rays;
    };

    void bake(float spacing) {
        rt_bake_desc desc = rt_default_bake_desc();
        desc.spacing = spacing;
        desc.occlusion_range = kOcclusionRange;
        desc.bounces = 0;
        host::Stage& stage = stage_.stage();
        const rt_bake_report report = stage.bake(desc, nullptr);
        stage.check(stage.api().commit_scene(stage.scene(), nullptr, nullptr), "building");
        stage.check(stage.api().hold_snapshot(stage.scene(), &baked_[spacing]), "holding");
        std::printf("%-16s baked, %g m: %.1f s, %.1f million rays, %.1f MB\n", name_.c_str(),
                    double(spacing), report.bake_ms / 1e3, double(report.rays) / 1e6,
                    double(report.bytes) / 1e6);
    }

    // A scale above 1 is a larger frame.
    Result render(const Setting& setting, size_t view) const {
        const auto scaled = [&](uint32_t side) {
            return std::max(1u, uint32_t(float(side) * setting.scale + 0.5f));
        };
        const ImageSize traced = {scaled(size_.width), scaled(size_.height)};
        const ImageSize whole = setting.bilinear || setting.scale > 1 ? traced : size_;
        FrameMemory memory(whole.width, whole.height);
        rt_frame_desc frame = memory.frame(Look::exact);
        frame.edge_samples = setting.edge_samples;
        frame.edge_budget = setting.edge_budget;
        frame.light_block = setting.light_block;
        frame.light_tolerance = kLightTolerance;
        frame.least_light = setting.least_light;
        frame.texture_filter = setting.filter;
        frame.occlusion_range = setting.occlusion_block > 0 ? kOcclusionRange : 0;
        frame.occlusion_block = setting.occlusion_block;
        frame.occlusion_samples = setting.occlusion_samples;
        frame.baked_light = setting.baked > 0;
        if (setting.baked > 0) frame.snapshot = baked_.at(setting.baked);
        frame.render_width = traced.width;
        frame.render_height = traced.height;
        std::vector<double> ms;
        RenderedFrame rendered;
        for (uint32_t pass = 0; pass < (setting.scale > 1 ? 1 : options_.passes); ++pass) {
            rendered = stage_.render(frame, views_[view]);
            ms.push_back(
                1e3 * (options_.threads == 1 ? rendered.seconds.processor : rendered.seconds.wall));
        }
        Image image{whole, std::move(memory.pixels)};
        if (setting.bilinear) image = enlarge_bilinearly(image, size_);
        return {std::move(image), median(ms), double(rendered.stats.rays_edge),
                double(rendered.stats.rays_shadow), double(rendered.stats.rays_occlusion)};
    }

    void add(const Setting& setting, size_t view, const Image& truth, Price& sum) const {
        const Result result = render(setting, view);
        write(setting.name, view, result.image);
        const test::FlipMap error =
            test::flip(truth.pixels.data(), result.image.pixels.data(), size_.width, size_.height);
        const auto views = double(views_.size());
        sum.ms += result.ms / views;
        sum.edge_rays += result.edge_rays / views;
        sum.shadow_rays += result.shadow_rays / views;
        sum.occlusion_rays += result.occlusion_rays / views;
        sum.flip_mean += error.mean() / views;
        sum.flip_worst_tile = std::max(sum.flip_worst_tile, error.worst_tile(kErrorTile));
    }

    void write(std::string name, size_t view, const Image& image) const {
        if (options_.pictures.empty()) return;
        std::replace_if(
            name.begin(), name.end(), [](char c) { return c == '/' || c == ' ' || c == ','; }, '_');
        const std::string file = name_ + "_" + std::to_string(view) + "_" + name + ".png";
        host::write_picture_file(std::filesystem::path(options_.pictures) / file, image.size.width,
                                 image.size.height, image.pixels);
    }

    nlohmann::json row_of(const Setting& setting, const Price& price) const {
        std::printf("%-16s %-24s %8.1f %10.0f %10.0f %10.0f %8.4f %8.3f\n", name_.c_str(),
                    setting.name, price.ms, price.edge_rays, price.shadow_rays,
                    price.occlusion_rays, price.flip_mean, price.flip_worst_tile);
        return {{"scene", name_},
                {"setting", setting.name},
                {"size", size_.text()},
                {"threads", options_.threads},
                {"frame_ms", price.ms},
                {"rays_edge", price.edge_rays},
                {"rays_shadow", price.shadow_rays},
                {"rays_occlusion", price.occlusion_rays},
                {"flip_mean", price.flip_mean},
                {"flip_worst_tile", price.flip_worst_tile}};
    }

    const Options& options_;
    std::string name_;
    host::Level level_;
    std::vector<host::Viewpoint> views_;
    ImageSize size_;
    FrameStage stage_;
    std::map<float, rt_snapshot> baked_;
};

} // namespace

std::string run_prices(const Options& options) {
    const host::Plugin plugin(options.library);
    std::printf("%s a frame, mean of the scene's cameras; FLIP against %u rays a pixel (cheaper "
                "light: against one; occlusion: against one with %u rays of it)\n"
                "%-16s %-24s %8s %10s %10s %10s %8s %8s\n",
                options.threads == 1 ? "processor time" : "wall time", kSamples * kSamples,
                kFineOcclusion.occlusion_samples, "scene", "setting", "ms", "edge rays", "shadow",
                "occlusion", "flip", "tile");
    nlohmann::json rows = nlohmann::json::array();
    for (const std::string& file : options.scenes)
        for (nlohmann::json& row : Pricing(options, plugin.api(), file).run())
            rows.push_back(std::move(row));
    return rows.dump();
}

} // namespace peregrine::bench
