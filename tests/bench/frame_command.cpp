// Frames of all looks beside the primary rays of a peer, in turns.
#include "commands.h"
#include "frame_peer.h"
#include "frame_stage.h"
#include "frame_table.h"
#include "image_size.h"
#include "isa_name.h"
#include "standing_triangles.h"
#include "timing.h"

#include "gltf/import.h"
#include "plugin.h"
#include "support/flip.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

namespace peregrine::bench {
namespace {

constexpr uint32_t kErrorTile = 32; // pixels, of the tiles of which the worst is told

// A look's part in the race over one scene.
struct Entrant {
    Look look;
    std::unique_ptr<FrameStage> stage;
    Seconds pass = {}; // of the pass that runs
    std::vector<double> frame_ms = {}, first_frame_ms = {};
    std::vector<double> rate = {}, rate_per_ghz_and_core = {};
    double rays_primary = 0, rays_shadow = 0; // of a pass
    uint64_t proofs = 0;
};

class FrameRace {
public:
    FrameRace(const Options& options, const rt_api& api, TraceRunner& runner,
              const std::string& file)
        : options_(options), api_(api), name_(std::filesystem::path(file).stem().string()),
          level_(host::gltf::import_file(file)), views_(standing_cameras(level_)),
          size_(parse_image_size(options.frame_size)), memory_(size_.width, size_.height) {
        report("building");
        for (const std::string& look : options.looks)
            entrants_.push_back(
                {test::look_of(look),
                 make_stage(test::look_of(look) == Look::visibility ? RT_LIGHT_PROOFS_KEPT
                                                                    : RT_LIGHT_PROOFS_MADE)});
        if (options.peers.empty()) return;
        peer_.emplace(options.peers, standing_triangles(level_), views_, size_, runner,
                      options.threads);
    }

    std::vector<FrameRow> run() {
        if (peer_) {
            report("every mode of the peer");
            peer_->hold_trials();
        }
        report("in turns");
        for (Entrant& entrant : entrants_) // what a frame finds out is remembered by the next
            for (const host::Viewpoint& view : views_)
                entrant.stage->render(entrant.look, view, memory_);
        for (uint32_t pass = 0; pass < options_.passes; ++pass) run_pass();
        report("first frames");
        for (uint32_t pass = 0; pass < std::min(options_.passes, options_.first_passes); ++pass)
            for (Entrant& entrant : entrants_) run_first(entrant);
        std::vector<FrameRow> rows;
        for (const Entrant& entrant : entrants_) rows.push_back(row_of(entrant));
        return rows;
    }

private:
    void report(const char* what) const { std::fprintf(stderr, "%s: %s\n", name_.c_str(), what); }

    std::unique_ptr<FrameStage> make_stage(rt_light_proofs proofs) const {
        return std::make_unique<FrameStage>(api_, level_, options_.threads, proofs,
                                            to_isa(options_.isa));
    }

    // What counts: on one thread the processor's time, which a busy machine does not stretch.
    double milliseconds(const Seconds& seconds) const {
        return 1e3 * (options_.threads == 1 ? seconds.processor : seconds.wall);
    }

    // Every camera, for each look and the peer. The clock is measured before and after, since it
    // moves with the load.
    void run_pass() {
        double ghz = measure_ghz();
        for (Entrant& entrant : entrants_) {
            entrant.pass = {};
            entrant.rays_primary = entrant.rays_shadow = 0;
        }
        for (size_t view = 0; view < views_.size(); ++view) {
            for (Entrant& entrant : entrants_) {
                const RenderedFrame frame =
                    entrant.stage->render(entrant.look, views_[view], memory_);
                entrant.pass += frame.seconds;
                entrant.rays_primary += double(frame.stats.rays_primary);
                entrant.rays_shadow += double(frame.stats.rays_shadow);
                entrant.proofs = test::count_proofs(entrant.stage->report());
            }
            if (peer_) peer_->run(view);
        }
        if (peer_) peer_->end_pass();
        ghz = 0.5 * (ghz + measure_ghz());
        for (Entrant& entrant : entrants_) {
            const double mrays = 1e-6 * (entrant.rays_primary + entrant.rays_shadow);
            entrant.frame_ms.push_back(milliseconds(entrant.pass) / double(views_.size()));
            entrant.rate.push_back(1e3 * mrays / milliseconds(entrant.pass));
            entrant.rate_per_ghz_and_core.push_back(mrays / entrant.pass.processor / ghz);
        }
    }

    // Each camera's frame is the first of a new scene of which nothing was proved.
    void run_first(Entrant& entrant) {
        double ms = 0;
        for (const host::Viewpoint& view : views_)
            ms += milliseconds(
                make_stage(RT_LIGHT_PROOFS_KEPT)->render(entrant.look, view, memory_).seconds);
        entrant.first_frame_ms.push_back(ms / double(views_.size()));
    }

    FrameRow row_of(const Entrant& entrant) {
        const auto views = double(views_.size());
        FrameRow row;
        row.scene = name_;
        row.look = test::name_of(entrant.look);
        row.triangles = level_.triangle_count();
        row.threads = options_.threads;
        row.size = size_.text();
        row.frame_ms = median(entrant.frame_ms);
        if (!entrant.first_frame_ms.empty()) row.first_frame_ms = median(entrant.first_frame_ms);
        row.rays_primary = entrant.rays_primary / views;
        row.rays_shadow = entrant.rays_shadow / views;
        row.proofs = entrant.proofs;
        row.mrays_per_s = median(entrant.rate);
        row.mrays_per_s_per_ghz_and_core = median(entrant.rate_per_ghz_and_core);
        if (peer_) {
            const FramePeer::Best best = peer_->best();
            row.peer_mode = best.mode;
            row.peer_primary_ms = best.frame_ms;
        }
        if (entrant.look == Look::exact) row.flip_mean = row.flip_worst_tile = 0;
        if (entrant.look == Look::direct) compare_with_exact(entrant, row);
        return row;
    }

    void compare_with_exact(const Entrant& entrant, FrameRow& row) {
        report("beside the exact picture");
        const std::unique_ptr<FrameStage> exact = make_stage(RT_LIGHT_PROOFS_KEPT);
        FrameMemory truth(size_.width, size_.height);
        row.flip_mean = row.flip_worst_tile = 0;
        for (const host::Viewpoint& view : views_) {
            // Filters have a truth of their own: the command `prices`, and TextureFilter.
            rt_frame_desc exact_frame = truth.frame(Look::exact);
            exact_frame.texture_filter = truth.frame(entrant.look).texture_filter;
            exact->render(exact_frame, view);
            entrant.stage->render(entrant.look, view, memory_);
            if (truth.pixels == memory_.pixels) continue; // no error anywhere
            const test::FlipMap error =
                test::flip(truth.pixels.data(), memory_.pixels.data(), size_.width, size_.height);
            row.flip_mean += error.mean() / double(views_.size());
            row.flip_worst_tile = std::max(row.flip_worst_tile, error.worst_tile(kErrorTile));
        }
    }

    const Options& options_;
    const rt_api& api_;
    std::string name_;
    host::Level level_;
    std::vector<host::Viewpoint> views_;
    ImageSize size_;
    FrameMemory memory_;
    std::vector<Entrant> entrants_;
    std::optional<FramePeer> peer_;
};

} // namespace

std::string run_frame(const Options& options) {
    parse_image_size(options.frame_size); // complains before anything is built
    const host::Plugin plugin(options.library);
    TraceRunner runner(options.threads);
    std::printf("%s a frame, mean of the scene's cameras, median of %u passes; first: of a new "
                "scene\n",
                options.threads == 1 ? "processor time" : "wall time", options.passes);
    print_frame_header();
    std::vector<FrameRow> rows;
    for (const std::string& file : options.scenes)
        for (FrameRow& row : FrameRace(options, plugin.api(), runner, file).run()) {
            print_frame_row(row);
            rows.push_back(std::move(row));
        }
    if (!options.peers.empty()) print_frame_means(rows);
    return to_json(rows);
}

} // namespace peregrine::bench
