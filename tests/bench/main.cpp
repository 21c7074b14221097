// peregrine_bench: the figures of README.md and docs/, measured again.
#include "commands.h"

#include "support/frame_look.h"
#include "support/world.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

namespace {

using peregrine::bench::Options;

// As Linux tells it; rates mean little without it.
std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (const size_t colon = line.find(": ");
            colon != std::string::npos && line.rfind("model name", 0) == 0)
            return line.substr(colon + 2);
    return "unknown";
}

// Under another name until it is whole.
void write_json(const Options& options, const std::string& rows) {
    const std::string part = options.json + ".part";
    std::ofstream file(part);
    file << "{\"machine\": {\"processor\": " << nlohmann::json(processor())
         << ", \"threads\": " << std::thread::hardware_concurrency() << "}, \"rows\": " << rows
         << "}\n";
    file.close();
    if (!file) throw std::runtime_error("cannot write " + part);
    std::filesystem::rename(part, options.json);
}

void add_output_options(CLI::App& command, Options& options) {
    command.add_option("--passes", options.passes, "Passes; medians are printed")
        ->capture_default_str()
        ->check(CLI::Range(1, 1000));
    command.add_option("--json", options.json, "Write the rows to this file as well");
}

void add_options(CLI::App& command, Options& options) {
    command
        .add_option("--scene", options.scenes,
                    "Scene files (.glb, .gltf); default: our hall and those of "
                    "$PEREGRINE_SCENES or ../shared/scenes")
        ->check(CLI::ExistingFile);
    add_output_options(command, options);
}

void add_threads_option(CLI::App& command, Options& options) {
    command.add_option("--threads", options.threads, "Threads")
        ->capture_default_str()
        ->check(CLI::Range(1, 256));
}

void add_isa_option(CLI::App& command, Options& options) {
    command.add_option("--isa", options.isa, "best, scalar, sse4, avx2 or avx512")
        ->capture_default_str()
        ->check(CLI::IsMember({"best", "scalar", "sse4", "avx2", "avx512"}));
}

void add_structure_options(CLI::App& command, Options& options) {
    command.add_option("--structure", options.structure, "auto, kdtree, bvh or bih")
        ->capture_default_str()
        ->check(CLI::IsMember({"auto", "kdtree", "bvh", "bih"}));
    command.add_option("--build", options.build, "balanced, fast or best")
        ->capture_default_str()
        ->check(CLI::IsMember({"balanced", "fast", "best"}));
    command.add_flag("--compact", options.compact, "The BVH in less memory");
}

void add_trace_options(CLI::App& trace, Options& options) {
    options.rays = {"P", "S", "A", "D", "R", "L", "N"};
    trace
        .add_option("--rays", options.rays,
                    "Kinds: P primary, S shadow, A ambient occlusion, D diffuse, R mirror, L line "
                    "of sight, N near; default: all")
        ->delimiter(',')
        ->check(CLI::IsMember({"P", "S", "A", "D", "R", "L", "N"}));
    add_structure_options(trace, options);
    add_isa_option(trace, options);
    trace
        .add_option("--mode", options.modes,
                    "Our modes: single, batch, \"batch, hint\", arrays, frame; default: all")
        ->check(CLI::IsMember({"single", "batch", "batch, hint", "arrays", "frame"}));
    trace
        .add_option(
            "--peer", options.peers,
            "Peers: embree, embree-avx2 (kept from using AVX-512), embree-robust, full (ours "
            "as it is by default)")
        ->delimiter(',')
        ->check(CLI::IsMember({"embree", "embree-avx2", "embree-robust", "full"}));
    trace.add_option("--size", options.size, "Width and height of the cameras' images")
        ->capture_default_str()
        ->check(CLI::Range(16, 4096));
}

void add_size_option(CLI::App& command, Options& options) {
    command.add_option("--size", options.frame_size, "Width and height, as 1280x720")
        ->capture_default_str();
}

void add_frame_options(CLI::App& frame, Options& options) {
    options.looks.assign(std::begin(peregrine::test::kLookNames),
                         std::end(peregrine::test::kLookNames));
    frame
        .add_option("--look", options.looks,
                    "visibility (depth and ids), direct (shaded, by default) or exact (shaded, "
                    "nothing approximated); default: all")
        ->delimiter(',')
        ->check(CLI::IsMember(options.looks));
    add_isa_option(frame, options);
    frame
        .add_option("--peer", options.peers,
                    "Peers, of which the fastest mode counts: embree, embree-avx2 (kept from using "
                    "AVX-512)")
        ->delimiter(',')
        ->check(CLI::IsMember({"embree", "embree-avx2"}));
    frame
        .add_option(
            "--first-passes", options.first_passes,
            "In how many passes, at most, first frames are measured: each takes a new scene")
        ->capture_default_str();
}

void add_prices_options(CLI::App& prices, Options& options) {
    add_isa_option(prices, options);
    prices.add_option("--size", options.frame_size, "Width and height, as 1280x720")
        ->capture_default_str();
    prices.add_option("--pictures", options.pictures, "Write all pictures to this folder as well");
}

void add_query_options(CLI::App& queries, Options& options) {
    options.items = peregrine::bench::query_item_names();
    queries.footer(peregrine::bench::query_item_legend());
    queries.add_option("--items", options.items, "Rows of the table, see below; default: all")
        ->delimiter(',')
        ->check(CLI::IsMember(options.items));
    queries.add_option("--peer", options.peers, "Peers: embree (robust and fast), bullet")
        ->delimiter(',')
        ->check(CLI::IsMember({"embree", "bullet"}));
    queries
        .add_option("--way", options.way,
                    "How far sweeps and crossings go, in metres; default: 10% of the diagonal")
        ->check(CLI::Range(0.001, 1e6));
    queries.add_option("--count", options.count, "Queries an item")
        ->capture_default_str()
        ->check(CLI::Range(1, 10'000'000));
    queries
        .add_option("--reference", options.reference,
                    "How many of them a reference in double precision answers, too")
        ->capture_default_str()
        ->check(CLI::Range(1, 10'000'000));
}

int run(int argc, char** argv) {
    Options options;
    CLI::App app("Measures Peregrine, beside its peers where they are installed.");
    app.require_subcommand(1);
    CLI::App* build = app.add_subcommand("build", "build time and memory of a structure");
    CLI::App* frame = app.add_subcommand("frame", "frames through the header");
    CLI::App* prices =
        app.add_subcommand("prices", "finer edges and smaller pictures: error and time");
    CLI::App* door = app.add_subcommand("door", "what a query costs beyond the bare traversal");
    CLI::App* trace = app.add_subcommand("trace", "rays of all kinds through the header");
    CLI::App* moving = app.add_subcommand("moving", "commits of a world that moves, and its rays");
    CLI::App* queries =
        app.add_subcommand("queries", "gameplay's queries: speed and accuracy, on one thread");
    CLI::App* grenade = app.add_subcommand("grenade", "how far a game's time step changes a throw");
    CLI::App* falloff = app.add_subcommand("falloff", "fall-offs of lamps: error and time");
    CLI::App* lamps = app.add_subcommand("lamps", "few and many lamps over a level");
    CLI::App* glass = app.add_subcommand("glass", "mirrors and glass, by the depth of paths");
    CLI::App* features =
        app.add_subcommand("features", "what each feature of a picture adds to a frame");
    CLI::App* paper = app.add_subcommand("paper", "the two tables of the paper, with our scenes");
    CLI::App* programs =
        app.add_subcommand("programs", "shading programs of the host, beside the library's own");
    CLI::App* triangles =
        app.add_subcommand("triangles", "ray/triangle tests of others and ours: error and time");
    CLI::App* kernels = app.add_subcommand("kernels", "the small pieces, beneath the header");
    for (CLI::App* command : {falloff, kernels, triangles, glass, programs})
        add_output_options(*command, options);
    for (CLI::App* command :
         {build, frame, prices, door, trace, moving, queries, grenade, lamps, features, paper})
        add_options(*command, options);
    for (CLI::App* command : {build, frame, prices, door, trace, moving, grenade, lamps, glass,
                              features, paper, programs})
        add_threads_option(*command, options);
    add_trace_options(*trace, options);
    add_query_options(*queries, options);
    add_structure_options(*build, options);
    build->add_option("--peer", options.peers, "Peers: embree")->delimiter(',');
    build->add_option("--peer-build", options.peer_build, "The peer's quality: low, medium or high")
        ->capture_default_str()
        ->check(CLI::IsMember({"low", "medium", "high"}));
    build
        ->add_option("--empty-bonus", options.empty_bonus,
                     "SAH cost of a split that cuts off empty space: times 1 - this")
        ->check(CLI::Range(0.0, 1.0));
    add_frame_options(*frame, options);
    for (CLI::App* command : {frame, lamps, features, paper, programs})
        add_size_option(*command, options);
    lamps
        ->add_option("--least-light", options.least_light,
                     "Lamps that give a place less are left out: steps of the display")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 1000.0));
    features
        ->add_option("--peer", options.peers,
                     "Peers, of which the fastest mode for primary rays is the unit: embree, "
                     "embree-avx2")
        ->delimiter(',')
        ->check(CLI::IsMember({"embree", "embree-avx2"}));
    for (CLI::App* command : {features, paper}) add_isa_option(*command, options);
    add_prices_options(*prices, options);
    add_size_option(*glass, options);
    for (CLI::App* command : {glass, features})
        command->add_option("--pictures", options.pictures, "Write a picture each to this folder");
    for (CLI::App* command : {frame, prices, door, trace, moving, queries, grenade, falloff, lamps,
                              glass, features, paper, programs})
        command->add_option("--library", options.library,
                            "The engine; default: libperegrine.so beside this program");
    CLI11_PARSE(app, argc, argv);

    if (options.scenes.empty()) options.scenes = peregrine::test::scene_files();
    const std::string rows = *build       ? peregrine::bench::run_build(options)
                             : *frame     ? peregrine::bench::run_frame(options)
                             : *prices    ? peregrine::bench::run_prices(options)
                             : *trace     ? peregrine::bench::run_trace(options)
                             : *moving    ? peregrine::bench::run_moving(options)
                             : *grenade   ? peregrine::bench::run_grenade(options)
                             : *falloff   ? peregrine::bench::run_falloff(options)
                             : *kernels   ? peregrine::bench::run_kernels(options)
                             : *triangles ? peregrine::bench::run_triangles(options)
                             : *features  ? peregrine::bench::run_features(options)
                             : *paper     ? peregrine::bench::run_paper(options)
                             : *programs  ? peregrine::bench::run_programs(options)
                             : *glass     ? peregrine::bench::run_glass(options)
                             : *lamps     ? peregrine::bench::run_lamps(options)
                             : *queries   ? peregrine::bench::run_queries(options)
                                          : peregrine::bench::run_door(options);
    if (!options.json.empty()) write_json(options, rows);
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "peregrine_bench: %s\n", error.what());
        return 1;
    }
}
