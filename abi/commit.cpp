#include "check.h"
#include "guard.h"
#include "read_struct.h"
#include "scene_table.h"

namespace peregrine::abi {
namespace {

static_assert(RT_FEATURE_TEXTURES == int(scene::kTextures));
static_assert(RT_FEATURE_NORMAL_MAPS == int(scene::kNormalMaps));
static_assert(RT_FEATURE_EMISSIVE == int(scene::kEmissive));
static_assert(RT_FEATURE_ALPHA_MASK == int(scene::kAlphaMask));
static_assert(RT_FEATURE_SPECULAR == int(scene::kSpecular));
static_assert(RT_FEATURE_LIGHTS == int(scene::kLights));
static_assert(RT_FEATURE_SHADOWS == int(scene::kShadows));
static_assert(RT_FEATURE_DYNAMIC_MESHES == int(scene::kDynamicMeshes));
static_assert(RT_FEATURE_SINGLE_SIDED == int(scene::kSingleSidedMaterials));
static_assert(RT_FEATURE_REFLECTION == int(scene::kReflection));
static_assert(RT_FEATURE_TRANSMISSION == int(scene::kTransmission));
static_assert(RT_FEATURE_BLENDING == int(scene::kBlending));
static_assert(RT_FEATURE_SKY == int(scene::kSky));
static_assert(RT_FEATURE_FOG == int(scene::kFog));
static_assert(RT_FEATURE_PROGRAMS == int(scene::kPrograms));
static_assert(RT_FEATURE_PROGRAM_RAYS == int(scene::kProgramRays));
static_assert(RT_FEATURE_AIRLIGHT == int(scene::kAirlight));
static_assert(RT_FEATURE_OCCLUSION_TEXTURES == int(scene::kOcclusionTextures));
static_assert(RT_FEATURE_ROUGHNESS_TEXTURES == int(scene::kRoughnessTextures));

static_assert(RT_BUILD_BALANCED == int(accel::bvh::Quality::balanced));
static_assert(RT_BUILD_FAST == int(accel::bvh::Quality::fast));
static_assert(RT_BUILD_BEST == int(accel::bvh::Quality::best));

trace::Structure to_structure(rt_structure structure) {
    require_enum(structure, RT_STRUCTURE_BIH, "rt_commit_desc.structure");
    switch (structure) {
    case RT_STRUCTURE_KDTREE:
        return trace::Structure::kdtree;
    case RT_STRUCTURE_BIH:
        return trace::Structure::bih;
    default:
        return trace::Structure::bvh;
    }
}

rt_structure to_host(trace::Structure structure) {
    switch (structure) {
    case trace::Structure::kdtree:
        return RT_STRUCTURE_KDTREE;
    case trace::Structure::bih:
        return RT_STRUCTURE_BIH;
    default:
        return RT_STRUCTURE_BVH;
    }
}

scene::CommitOptions to_options(const rt_commit_desc* desc) {
    scene::CommitOptions options;
    if (!desc) return options;
    const rt_commit_desc fields = read_struct(desc);
    if (!(fields.empty_bonus >= 0 && fields.empty_bonus <= 1))
        base::fail(base::Code::invalid_argument,
                   "rt_commit_desc.empty_bonus is %g; it must be 0 to 1",
                   double(fields.empty_bonus));
    require_enum(fields.quality, RT_BUILD_BEST, "rt_commit_desc.quality");
    options.build.structure = to_structure(fields.structure);
    options.build.quality = accel::bvh::Quality(fields.quality);
    options.build.empty_bonus = fields.empty_bonus;
    require_enum(fields.memory, RT_MEMORY_COMPACT, "rt_commit_desc.memory");
    require_least_zero(fields.proof_budget_ms, "rt_commit_desc.proof_budget_ms");
    options.proofs.budget_ms = fields.proof_budget_ms;
    require_enum(fields.light_proofs, RT_LIGHT_PROOFS_MADE, "rt_commit_desc.light_proofs");
    if (!(fields.proof_patch_size >= 0 && fields.proof_patch_size <= 1e30f))
        base::fail(base::Code::invalid_argument,
                   "rt_commit_desc.proof_patch_size is %g; it must be 0 to 1e30",
                   double(fields.proof_patch_size));
    options.proofs.proves = fields.light_proofs == RT_LIGHT_PROOFS_MADE;
    if (fields.most_proof_bytes > 0) options.proofs.most_bytes = fields.most_proof_bytes;
    if (fields.proof_patch_size > 0) options.proofs.patch_size = fields.proof_patch_size;
    options.build.compact = fields.memory == RT_MEMORY_COMPACT;
    options.progress = {fields.progress, fields.progress_user};
    return options;
}

void report_tree(const accel::kdtree::Tree& tree, rt_commit_report& out) {
    out.bytes_nodes = tree.nodes.size() * sizeof(accel::kdtree::Node);
    out.bytes_references = tree.references.size() * sizeof(uint32_t);
    out.tree_nodes = tree.nodes.size();
    out.tree_leaves = tree.report.leaves;
    out.tree_empty_leaves = tree.report.empty_leaves;
    out.tree_references = tree.references.size();
    out.tree_max_depth = tree.report.max_depth;
    out.tree_depth_limit = tree.report.depth_limit;
    out.tree_sah_cost = tree.report.sah_cost;
    out.build_ms = tree.report.build_ms;
}

void report_tree(const accel::bvh::Tree& tree, const accel::bvh::CompactTree& compact,
                 rt_commit_report& out) {
    out.bytes_triangles = tree.blocks.size() * sizeof(accel::bvh::Block)
                          + compact.leaves.size() * sizeof(accel::bvh::LeafUnit);
    out.bytes_nodes = tree.nodes.size() * sizeof(accel::bvh::Node)
                      + compact.nodes.size() * sizeof(accel::bvh::CompactNode);
    out.tree_nodes = tree.nodes.size() + compact.nodes.size(); // one of the two is empty
    out.tree_leaves = tree.report.leaves;
    out.tree_references = tree.report.references;
    out.tree_max_depth = tree.report.max_depth;
    out.tree_depth_limit = accel::bvh::kMaxDepth;
    out.tree_sah_cost = tree.report.sah_cost;
    out.build_ms = tree.report.build_ms;
}

void report_tree(const accel::bih::Tree& tree, rt_commit_report& out) {
    out.bytes_nodes = tree.nodes.size() * sizeof(accel::bih::Node);
    out.bytes_references = tree.references.size() * sizeof(uint32_t);
    out.tree_nodes = tree.nodes.size();
    out.tree_leaves = tree.report.leaves;
    out.tree_references = tree.references.size();
    out.tree_max_depth = tree.report.max_depth;
    out.tree_depth_limit = accel::bih::kMaxDepth;
    out.tree_sah_cost = tree.report.sah_cost;
    out.build_ms = tree.report.build_ms;
}

void report_tree(const scene::Geometry& geometry, rt_commit_report& out) {
    switch (geometry.structure) {
    case trace::Structure::kdtree:
        return report_tree(geometry.kdtree, out);
    case trace::Structure::bih:
        return report_tree(geometry.bih, out);
    default:
        return report_tree(geometry.bvh, geometry.compact_bvh, out);
    }
}

rt_commit_report to_report(const scene::CommitReport& in) {
    rt_commit_report out = rt_default_commit_report();
    out.left_out = scene::kAllFeatures & ~in.features;
    out.dynamic_triangle_count = in.deforming_triangles;
    out.rigid_triangle_count = in.rigid_triangles;
    out.triangle_count =
        in.fixed->infos.size() + out.dynamic_triangle_count + out.rigid_triangle_count;
    out.degenerate_count = in.degenerate_count;
    out.non_finite_count = in.non_finite_count;
    report_tree(*in.fixed, out);
    out.bytes_triangles += in.shape_bytes + in.fixed->infos.size() * sizeof(geometry::TriangleInfo)
                           + in.fixed->triangles.size() * sizeof(geometry::Triangle);
    out.dynamic_build_ms = in.deforming_build_ms;
    out.bytes_attributes = in.bytes_attributes;
    out.bytes_textures = in.bytes_textures;
    out.commit_ms = in.commit_ms;
    out.proof_count = in.proofs.proofs;
    out.bytes_proofs = in.proofs.bytes;
    out.proof_ms = in.proofs.ms;
    out.proved_light_count = in.proofs.lights;
    out.waiting_light_count = in.proofs.waiting;
    out.light_count = in.light_count;
    out.instance_count = in.instance_count;
    out.rebuilt = in.fixed_rebuilt || in.deforming_rebuilt ? 1 : 0;
    out.static_rebuilt = in.fixed_rebuilt ? 1 : 0;
    out.dynamic_rebuilt = in.deforming_rebuilt ? 1 : 0;
    out.structure = to_host(in.fixed->structure);
    out.quality = rt_build_quality(in.build.quality);
    return out;
}

void tell(const HostScene& host, const rt_commit_report& report) {
    using Number = unsigned long long;
    if (!host.log) return;
    log_line(host, RT_LOG_INFO, "commit %llu: %llu triangles, %llu nodes (%s), %u lights, %.1f ms",
             Number(host.scene.version()), Number(report.triangle_count), Number(report.tree_nodes),
             report.rebuilt ? "rebuilt" : "kept", report.light_count, report.commit_ms);
    if (report.degenerate_count || report.non_finite_count)
        log_line(host, RT_LOG_WARNING,
                 "commit %llu left out %llu triangles without area and %llu with a vertex that is "
                 "not finite or beyond 1e30",
                 Number(host.scene.version()), Number(report.degenerate_count),
                 Number(report.non_finite_count));
}

} // namespace
} // namespace peregrine::abi

using namespace peregrine::abi;

rt_result rt_commit_scene(rt_scene scene, const rt_commit_desc* desc,
                          rt_commit_report* out_report) noexcept {
    return guard([&] {
        HostScene& host = find_scene(scene);
        const Output output(out_report);
        const rt_commit_report report = to_report(host.scene.commit(to_options(desc)));
        output.write(report);
        tell(host, report);
    });
}
