#include "commands.h"
#include "query_race.h"
#include "query_stress.h"

#include "plugin.h"

#include <algorithm>
#include <cstdio>

namespace peregrine::bench {
namespace {

constexpr size_t kSmallSet = 2000; // some peers take milliseconds a query in tiny levels

bool wants(const Options& options, const char* item) {
    return std::ranges::find(options.items, item) != options.items.end();
}

const QueryItem& find_item(const std::string& name) {
    return *std::ranges::find(query_items(), name, &QueryItem::name);
}

void race_scene(const Options& options, const TraceScene& scene, QueryRace& race) {
    std::fprintf(stderr, "%s: finding its free space\n", scene.name.c_str());
    const Reference reference(scene.triangles, kBand);
    const QueryMaker maker(scene, reference, options.way);
    std::fprintf(stderr, "%s: building\n", scene.name.c_str());
    const QueryContestants contestants = race.gather({scene.triangles});
    print_query_header(scene.name + ", " + std::to_string(scene.triangles.size()) + " triangles");
    for (const QueryItem& item : query_items()) {
        if (!wants(options, item.name)) continue;
        const QuerySet set = maker.make(item, options.count);
        std::fprintf(stderr, "%s, %s: asking the reference\n", scene.name.c_str(), item.name);
        const ReferenceAnswers right = answer_by_reference(reference, set, options.reference);
        race.hold(
            scene.name, item.name, contestants, set,
            [&](size_t, const QueryAnswers& answers) { return judge(set, answers, right, 1); });
    }
    if (wants(options, "far")) race_far(race, scene, maker.make(find_item("sight"), options.count));
    if (wants(options, "small"))
        for (const char* item : {"sight", "sphere-0.4"}) {
            const size_t count = std::min({options.count, options.reference, kSmallSet});
            race_small(race, scene, item, maker.make(find_item(item), count));
        }
}

} // namespace

std::vector<std::string> query_item_names() {
    std::vector<std::string> names;
    for (const QueryItem& item : query_items()) names.emplace_back(item.name);
    names.insert(names.end(), {"far", "small", "leaks"});
    return names;
}

std::string query_item_legend() {
    std::string legend = "Items:\n";
    const auto add = [&](const char* name, const std::string& text) {
        std::string line = name;
        line.resize(std::max<size_t>(line.size(), 17), ' ');
        for (const char c : text)
            line += c == '\n' ? "\n" + std::string(17, ' ') : std::string(1, c);
        legend += line + "\n";
    };
    for (const QueryItem& item : query_items()) add(item.name, item.text);
    add("far", "line of sight in the level 10 to 10,000 km away: answers that changed");
    add("small", "line of sight and a sphere in the level at 1/10,000 of its size");
    add("leaks", "rays from inside closed meshes at their vertices and edges; no scene is read");
    return legend;
}

std::string run_queries(const Options& options) {
    const host::Plugin plugin(options.library);
    QueryRace race(plugin.api(), options.peers, options.passes);
    std::printf(
        "%sCPU time of one thread, one query a call (peregrine-batch: one call), %u passes, "
        "medians.\nPer million: sure hits that were missed, hits where surely nothing is; "
        "differences below 0.1 mm are\nnobody's fault. Errors are along the way.\n",
        query_item_legend().c_str(), options.passes);
    if (std::ranges::any_of(options.items, [](auto& item) { return item != "leaks"; }))
        for (const std::string& file : options.scenes)
            race_scene(options, load_trace_scene(file), race);
    if (wants(options, "leaks")) race_leaks(race, options.count);
    return to_json(race.rows());
}

} // namespace peregrine::bench
