// The fall-offs of lamps beside the inverse square, through the header: error and time.
#include "commands.h"
#include "timing.h"

#include "plugin.h"
#include "stage.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace peregrine::bench {
namespace {

constexpr float kRadius = 10;
constexpr uint32_t kLamps = 64, kSize = 512; // of the frames that are timed
constexpr double kPlaces[] = {0.01, 0.05, 0.1, 0.2, 0.5, 0.8, 0.95};

struct Kind {
    const char* name;
    rt_falloff falloff;
};
constexpr Kind kKinds[] = {{"Schlick x linear", RT_FALLOFF_SCHLICK_LINEAR},
                           {"cosine x linear", RT_FALLOFF_COSINE_LINEAR},
                           {"linear", RT_FALLOFF_LINEAR},
                           {"windowed inverse square", RT_FALLOFF_WINDOWED_INVERSE_SQUARE},
                           {"inverse square", RT_FALLOFF_INVERSE_SQUARE}};

// A white wall in the plane z = 0 that fills the view.
class Wall {
public:
    explicit Wall(const rt_api& api) : stage_(api, 1, RT_ISA_BEST) {
        const float corners[] = {-9, -9, 0, 9, -9, 0, 9, 9, 0, -9, -9, 0, 9, 9, 0, -9, 9, 0};
        rt_mesh_desc desc = rt_default_mesh_desc();
        desc.positions = {corners, 6, 0, 0};
        desc.index_type = RT_INDEX_NONE;
        rt_mesh mesh{};
        stage_.check(api.add_static_mesh(stage_.scene(), &desc, &mesh), "adding a wall");
        rt_environment dark = rt_default_environment();
        for (float& part : dark.ambient) part = 0;
        stage_.check(api.set_environment(stage_.scene(), &dark), "setting the environment");
        eye_.position.z = 1;
        eye_.vertical_fov = 1;
        frame_.format = RT_FORMAT_RGBA32F;
        frame_.tone_mapping = RT_TONE_NONE;
    }

    rt_light add(rt_falloff falloff, double distance) {
        rt_light_desc lamp = rt_default_light_desc();
        lamp.falloff = falloff;
        lamp.position[2] = distance;
        lamp.radius = kRadius;
        lamp.casts_no_shadow = 1;
        rt_light light{};
        stage_.check(stage_.api().add_light(stage_.scene(), &lamp, &light), "adding a lamp");
        return light;
    }
    void remove(rt_light light) {
        stage_.check(stage_.api().remove_light(stage_.scene(), light), "removing a lamp");
    }

    // What the middle gets of an inverse square's light: 1 is right.
    double part(rt_falloff falloff, double x) {
        const double distance = x * double(kRadius);
        const rt_light light = add(falloff, distance);
        render(1);
        remove(light);
        return double(pixels_[0]) * 3.14159265358979 * distance * distance;
    }

    double frame_ns(uint32_t passes) {
        std::vector<double> ns;
        for (uint32_t pass = 0; pass <= passes; ++pass) {
            const double start = thread_seconds();
            render(kSize);
            if (pass > 0) ns.push_back(1e9 * (thread_seconds() - start));
        }
        return median(ns);
    }

private:
    void render(uint32_t size) {
        stage_.commit(RT_STRUCTURE_AUTO, RT_BUILD_BALANCED, nullptr);
        frame_.width = frame_.height = size;
        pixels_.resize(size_t(4) * size * size);
        stage_.render(eye_, frame_, pixels_.data());
    }

    host::Stage stage_;
    host::Viewpoint eye_;
    host::Frame frame_;
    std::vector<float> pixels_;
};

struct Error {
    double largest = 0, root_mean_square = 0; // as factors
};

Error error_of(Wall& wall, rt_falloff falloff) {
    double largest = 0, squares = 0;
    int count = 0;
    for (double x = 0.1; x < 0.8005; x += 0.005, ++count) {
        const double error = std::log(wall.part(falloff, x));
        largest = std::max(largest, std::fabs(error));
        squares += error * error;
    }
    return {std::exp(largest), std::exp(std::sqrt(squares / count))};
}

// Nanoseconds for one lamp at one point.
double time_of(Wall& wall, rt_falloff falloff, double empty, uint32_t passes) {
    std::vector<rt_light> lamps;
    for (uint32_t i = 0; i < kLamps; ++i) lamps.push_back(wall.add(falloff, 2 + 0.05 * i));
    const double ns = wall.frame_ns(passes);
    for (const rt_light lamp : lamps) wall.remove(lamp);
    return (ns - empty) / (double(kSize) * kSize * kLamps);
}

} // namespace

std::string run_falloff(const Options& options) {
    nlohmann::json rows = nlohmann::json::array();
    const host::Plugin plugin(options.library);
    Wall wall(plugin.api());
    const double empty = wall.frame_ns(options.passes);
    std::printf("times the inverse square, at parts of the radius\n%-24s", "fall-off");
    for (const double x : kPlaces) std::printf(" %8g", x);
    std::printf(" %10s %8s %8s\n", "0.1 to 0.8", "rms", "ns");
    for (const Kind& kind : kKinds) {
        std::printf("%-24s", kind.name);
        nlohmann::json row = {{"falloff", kind.name}, {"parts", nlohmann::json::object()}};
        for (const double x : kPlaces) {
            const double part = wall.part(kind.falloff, x);
            std::printf(" %8.4f", part);
            row["parts"][std::to_string(x)] = part;
        }
        const Error error = error_of(wall, kind.falloff);
        const double ns = time_of(wall, kind.falloff, empty, options.passes);
        std::printf(" %10.3f %8.3f %8.3f\n", error.largest, error.root_mean_square, ns);
        row.update({{"factor", error.largest}, {"rms", error.root_mean_square}, {"ns", ns}});
        rows.push_back(row);
    }
    return rows.dump(2);
}

} // namespace peregrine::bench
