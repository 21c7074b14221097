#include "commands.h"
#include "embree_tracer.h"
#include "peregrine_tracer.h"
#include "timing.h"
#include "trace_check.h"
#include "trace_rays.h"
#include "trace_run.h"
#include "trace_scene.h"
#include "trace_table.h"

#include "plugin.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>

namespace peregrine::bench {
namespace {

constexpr size_t kFinalists = 3; // modes of a peer that run in every pass

struct Contestant {
    std::unique_ptr<Tracer> tracer;
    bool peer;
};

// A mode of a contestant in the race over one set of rays.
struct Entrant {
    const Contestant* contestant;
    size_t mode;
    double trial; // seconds of its first run
    uint64_t mismatches;
    std::vector<double> seconds = {};
};

class Race {
public:
    Race(const Options& options, TraceRunner& runner, const std::vector<Contestant>& contestants,
         const RaySet& set)
        : options_(options), runner_(runner), contestants_(contestants), set_(set) {}

    // Every mode once, checked.
    void hold_trials(const std::vector<Answer>& exact) {
        for (const Contestant& contestant : contestants_) {
            const Tracer& tracer = *contestant.tracer;
            tracer.prepare(set_, results_);
            const size_t first = entrants_.size();
            for (size_t mode = 0; mode < tracer.mode_count(); ++mode) {
                if (!tracer.suits(mode, set_) || !is_wanted(contestant, mode)) continue;
                double seconds = runner_.run(tracer, mode, set_, results_);
                if (contestant.peer) // the choice between its modes should not be left to chance
                    seconds = std::min(seconds, runner_.run(tracer, mode, set_, results_));
                const uint64_t mismatches =
                    count_mismatches(tracer, mode, !contestant.peer, set_, results_, exact);
                entrants_.push_back({&contestant, mode, seconds, mismatches});
                std::fprintf(stderr, "  %c %-14s %-26s %8.2f MRays/s\n", set_.kind,
                             tracer.name().c_str(), tracer.mode_name(mode).c_str(),
                             rate(entrants_.back()));
            }
            if (contestant.peer) keep_fastest(first, kFinalists);
        }
    }

    bool is_empty() const { return entrants_.empty(); }

    // All that are left in turns, so that what else the machine does meets all of them.
    void hold_passes() {
        for (uint32_t pass = 0; pass < options_.passes; ++pass)
            for (Entrant& entrant : entrants_)
                entrant.seconds.push_back(
                    runner_.run(*entrant.contestant->tracer, entrant.mode, set_, results_));
        for (Entrant& entrant : entrants_) entrant.trial = median(entrant.seconds);
        for (const Contestant& contestant : contestants_)
            if (contestant.peer) keep_fastest(find_first(contestant), 1);
    }

    std::vector<TraceRow> rows(const std::string& scene) const {
        double best_peer = std::numeric_limits<double>::quiet_NaN();
        for (const Entrant& entrant : entrants_)
            if (entrant.contestant->peer && !(rate(entrant) <= best_peer))
                best_peer = rate(entrant);
        std::vector<TraceRow> rows;
        for (const Entrant& entrant : entrants_) {
            const Tracer& tracer = *entrant.contestant->tracer;
            rows.push_back({scene, set_.kind, tracer.name(), tracer.mode_name(entrant.mode),
                            options_.compact && !entrant.contestant->peer, options_.threads,
                            rate(entrant), rate(entrant) / best_peer, set_.rays.size(),
                            entrant.mismatches, tracer.build_ms(), tracer.bytes_per_triangle()});
        }
        return rows;
    }

private:
    double rate(const Entrant& entrant) const {
        return 1e-6 * double(set_.rays.size()) / entrant.trial;
    }

    size_t find_first(const Contestant& contestant) const {
        size_t i = 0;
        while (entrants_[i].contestant != &contestant) ++i;
        return i;
    }

    bool is_wanted(const Contestant& contestant, size_t mode) const {
        const std::vector<std::string>& modes = options_.modes;
        return contestant.peer || modes.empty()
               || std::find(modes.begin(), modes.end(), contestant.tracer->mode_name(mode))
                      != modes.end();
    }

    // Of one contestant's entrants, which begin at `first`.
    void keep_fastest(size_t first, size_t count) {
        const auto begin = entrants_.begin() + std::ptrdiff_t(first);
        auto end = begin;
        while (end != entrants_.end() && end->contestant == begin->contestant) ++end;
        std::sort(begin, end, [](const Entrant& a, const Entrant& b) { return a.trial < b.trial; });
        if (size_t(end - begin) > count) entrants_.erase(begin + std::ptrdiff_t(count), end);
    }

    const Options& options_;
    TraceRunner& runner_;
    const std::vector<Contestant>& contestants_;
    const RaySet& set_;
    Results results_;
    std::vector<Entrant> entrants_;
};

void report_progress(const TraceScene& scene, const char* what) {
    std::fprintf(stderr, "%s: %s\n", scene.name.c_str(), what);
}

void print_builds(const TraceScene& scene, const std::vector<Contestant>& contestants) {
    std::printf("\n%s, %zu triangles\n", scene.name.c_str(), scene.triangles.size());
    for (const Contestant& contestant : contestants)
        std::printf("     %-14s built in %.1f ms, %.1f bytes a triangle\n",
                    contestant.tracer->name().c_str(), contestant.tracer->build_ms(),
                    contestant.tracer->bytes_per_triangle());
    print_trace_header();
}

void trace_scene(const Options& options, const rt_api& api, const TraceScene& scene,
                 TraceRunner& runner, std::vector<TraceRow>& rows) {
    report_progress(scene, "building");
    const std::unique_ptr<Tracer> exact = make_peregrine_tracer(
        api, scene.triangles, {"kdtree", "balanced", "scalar", options.threads});
    std::vector<Contestant> contestants;
    contestants.push_back({make_peregrine_tracer(api, scene.triangles,
                                                 {options.structure, options.build, options.isa,
                                                  options.threads, options.compact}),
                           false});
    for (const std::string& peer : options.peers)
        contestants.push_back(
            {peer == "full" ? make_peregrine_tracer(
                 api, scene.triangles,
                 {.isa = options.isa, .threads = options.threads, .name = peer})
                            : make_embree_tracer(peer, scene.triangles, options.threads),
             true});
    report_progress(scene, "finding what the cameras see");
    const RayMaker maker(scene, *exact, options.size);
    print_builds(scene, contestants);
    for (const std::string& kind : options.rays) {
        const RaySet set = maker.make(kind[0]);
        if (set.rays.empty()) {
            std::printf("%-4c none\n", set.kind);
            continue;
        }
        Race race(options, runner, contestants, set);
        report_progress(scene, (kind + ", every mode once").c_str());
        race.hold_trials(exact_answers(*exact, set));
        if (race.is_empty()) {
            std::printf("%-4c takes none of these modes\n", set.kind);
            continue;
        }
        report_progress(scene, (kind + ", in turns").c_str());
        race.hold_passes();
        for (const TraceRow& row : race.rows(scene.name)) {
            print_trace_row(row);
            rows.push_back(row);
        }
    }
}

} // namespace

std::string run_trace(const Options& options) {
    const host::Plugin plugin(options.library);
    TraceRunner runner(options.threads);
    std::printf("%s%s, %u passes, medians; a ratio is a rate divided by the best peer's\n",
                kRayLegend, options.threads == 1 ? "CPU time of one thread" : "wall time",
                options.passes);
    std::vector<TraceRow> rows;
    for (const std::string& file : options.scenes)
        trace_scene(options, plugin.api(), load_trace_scene(file), runner, rows);
    print_trace_means(rows);
    return to_json(rows);
}

} // namespace peregrine::bench
