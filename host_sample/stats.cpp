#include "stats.h"

#include <fstream>
#include <utility>

#include <nlohmann/json.hpp>

#include "error.h"
#include "whole_file.h"

namespace host {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::pair<uint32_t, const char*> features[] = {
    {RT_FEATURE_TEXTURES, "textures"},
    {RT_FEATURE_NORMAL_MAPS, "normal_maps"},
    {RT_FEATURE_EMISSIVE, "emissive"},
    {RT_FEATURE_ALPHA_MASK, "alpha_mask"},
    {RT_FEATURE_SPECULAR, "specular"},
    {RT_FEATURE_LIGHTS, "lights"},
    {RT_FEATURE_SHADOWS, "shadows"},
    {RT_FEATURE_DYNAMIC_MESHES, "dynamic_meshes"},
    {RT_FEATURE_SINGLE_SIDED, "single_sided"},
    {RT_FEATURE_REFLECTION, "reflection"},
    {RT_FEATURE_TRANSMISSION, "transmission"},
    {RT_FEATURE_BLENDING, "blending"},
    {RT_FEATURE_SKY, "sky"},
    {RT_FEATURE_FOG, "fog"},
    {RT_FEATURE_PROGRAMS, "programs"},
    {RT_FEATURE_PROGRAM_RAYS, "program_rays"},
    {RT_FEATURE_AIRLIGHT, "airlight"},
    {RT_FEATURE_OCCLUSION_TEXTURES, "occlusion_textures"},
    {RT_FEATURE_ROUGHNESS_TEXTURES, "roughness_textures"}};

Json describe_left_out(uint32_t bits) {
    Json names = Json::array();
    for (const auto& [bit, name] : features)
        if (bits & bit) names.push_back(name);
    return names;
}

Json describe_bytes(const rt_commit_report& report, const rt_scene_stats& stats) {
    return {{"triangles", report.bytes_triangles},
            {"nodes", report.bytes_nodes},
            {"references", report.bytes_references},
            {"attributes", report.bytes_attributes},
            {"textures", report.bytes_textures},
            {"allocated", stats.bytes_allocated},
            {"peak", stats.bytes_peak}};
}

Json describe_tree(const rt_commit_report& report) {
    return {{"nodes", report.tree_nodes},
            {"leaves", report.tree_leaves},
            {"empty_leaves", report.tree_empty_leaves},
            {"references", report.tree_references},
            {"max_depth", report.tree_max_depth},
            {"depth_limit", report.tree_depth_limit},
            {"sah_cost", report.tree_sah_cost}};
}

// Milliseconds are medians.
Json describe_animation(const Session& session) {
    const Level& level = session.level;
    const PlayerLog& log = session.player.log();
    size_t instances = 0, vertices = 0;
    for (const RigidMesh& rigid : level.rigid_meshes) instances += rigid.count();
    for (const DeformingMesh& mesh : level.deforming_meshes) vertices += mesh.vertex_count();
    return {{"clips", level.rig.clips.size()},
            {"nodes", level.rig.nodes.size()},
            {"rigid_meshes", level.rigid_meshes.size()},
            {"rigid_instances", instances},
            {"deforming_meshes", level.deforming_meshes.size()},
            {"deforming_vertices", vertices},
            {"time", session.player.time()},
            {"pose_ms", log.pose.median()},
            {"skinning_ms", log.skinning.median()},
            {"update_ms", log.update.median()},
            {"commits", log.commit.count()},
            {"commit_ms", log.commit.median()}};
}

// The mean over all cores of what Linux says now; 0 where it says nothing.
double read_cpu_mhz() {
    std::ifstream stream("/proc/cpuinfo");
    std::string line;
    double sum = 0.0;
    int count = 0;
    while (std::getline(stream, line)) {
        const size_t colon = line.find(':');
        if (line.rfind("cpu MHz", 0) != 0 || colon == std::string::npos) continue;
        sum += std::strtod(line.c_str() + colon + 1, nullptr);
        ++count;
    }
    return count > 0 ? sum / count : 0.0;
}

} // namespace

std::string describe_stats(const Session& session) {
    const rt_scene_stats stats = session.stage.stats();
    const rt_commit_report& report = session.report;
    const FrameLog& log = session.log;
    Json json = {
        {"scene", session.level.name},
        {"camera", session.cameras[session.camera].name},
        {"size", {session.width, session.height}},
        {"view", view_name(session.options.view)},
        {"frames", log.count()},
        {"frame_ms_median", log.median_ms()},
        {"frame_ms_worst", log.worst_ms()},
        {"rays", {{"primary", log.mean_primary()}, {"shadow", log.mean_shadow()}}},
        {"mrays_per_s", log.mrays_per_second()},
        {"structure", structure_name(report.structure)},
        {"build", build_name(report.quality)},
        {"build_ms", report.build_ms},
        {"commit_ms", report.commit_ms},
        {"bytes", describe_bytes(report, stats)},
        {"triangles", report.triangle_count},
        {"degenerate", report.degenerate_count},
        {"non_finite", report.non_finite_count},
        {"lights", report.light_count},
        {"threads", stats.threads},
        {"isa", isa_name(stats.isa)},
        {"version", session.stage.api().get_version_string()},
        {"left_out", describe_left_out(report.left_out)},
        {"tree", describe_tree(report)},
    };
    if (session.player.animated()) json["animation"] = describe_animation(session);
    if (const double mhz = read_cpu_mhz(); mhz > 0.0) json["cpu_mhz"] = mhz;
    // Names in a scene file need not be UTF-8.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_stats(const std::string& path, const Session& session) {
    const std::string cause = write_whole_file(path, describe_stats(session));
    if (!cause.empty()) throw InputError("the statistics " + path + " cannot be written: " + cause);
}

} // namespace host
