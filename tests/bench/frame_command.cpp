#include "commands.h"
#include "timing.h"

#include "cameras.h"
#include "gltf/import.h"
#include "plugin.h"
#include "stage.h"
#include "upload.h"

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace peregrine::bench {
namespace {

constexpr float kAmbient = 0.1f;

struct Measured {
    std::vector<double> rate; // MRays/s, a value a pass
    std::vector<double> rate_per_ghz_and_core;
    std::vector<double> frame_ms;
};

// One frame by every camera. The clock is measured before and after, since it moves with the load.
void measure_pass(const host::Stage& stage, const std::vector<host::Viewpoint>& cameras,
                  const host::Frame& frame, std::vector<uint32_t>& pixels, Measured& measured) {
    double ghz = measure_ghz();
    uint64_t rays = 0;
    double wall = 0;
    const double start = process_seconds();
    for (const host::Viewpoint& camera : cameras) {
        const rt_frame_stats stats = stage.render(camera, frame, pixels.data());
        rays += stats.rays_primary + stats.rays_shadow;
        wall += 1e-3 * stats.frame_ms;
    }
    const double cpu = process_seconds() - start;
    ghz = 0.5 * (ghz + measure_ghz());
    measured.rate.push_back(1e-6 * double(rays) / wall);
    measured.rate_per_ghz_and_core.push_back(1e-6 * double(rays) / cpu / ghz);
    measured.frame_ms.push_back(1e3 * wall / double(cameras.size()));
}

} // namespace

std::string run_frame(const Options& options) {
    nlohmann::json rows = nlohmann::json::array();
    const host::Plugin plugin(options.library);
    std::printf("%-16s %9s %12s %12s %24s\n", "scene", "triangles", "ms a frame", "MRays/s",
                "MRays/s per GHz and core");
    for (const std::string& file : options.scenes) {
        const std::string name = std::filesystem::path(file).stem().string();
        const host::Level level = host::gltf::import_file(file);
        host::Stage stage(plugin.api(), options.threads, RT_ISA_BEST);
        host::upload_level(stage, level, kAmbient);
        stage.commit(RT_STRUCTURE_AUTO, RT_BUILD_BALANCED, nullptr);
        host::Frame frame;
        frame.width = frame.height = options.size;
        std::vector<uint32_t> pixels(size_t(options.size) * options.size);
        Measured measured;
        for (uint32_t pass = 0; pass < options.passes; ++pass)
            measure_pass(stage, host::usable_cameras(level), frame, pixels, measured);
        std::printf("%-16s %9zu %12.1f %12.2f %24.2f\n", name.c_str(), level.triangle_count(),
                    median(measured.frame_ms), median(measured.rate),
                    median(measured.rate_per_ghz_and_core));
        rows.push_back({{"scene", name},
                        {"threads", options.threads},
                        {"size", options.size},
                        {"frame_ms", median(measured.frame_ms)},
                        {"mrays_per_s", median(measured.rate)},
                        {"mrays_per_s_per_ghz_and_core", median(measured.rate_per_ghz_and_core)}});
    }
    return rows.dump(2);
}

} // namespace peregrine::bench
