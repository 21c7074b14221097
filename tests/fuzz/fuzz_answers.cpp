// Commits, frames and queries.
#include "fuzzer.h"

namespace peregrine::test {

void Fuzzer::adapt_exposure() {
    rt_exposure exposure = rt_default_exposure();
    exposure.exposure = random_.unit();
    exposure.adaptation = random_.unit();
    spoil(exposure, 4);
    check(rt_adapt_exposure(&exposure, random_.unit(), random_.unit()));
}

void Fuzzer::commit() {
    rt_commit_desc desc = rt_default_commit_desc();
    desc.empty_bonus = random_.one_in(2) ? 0 : random_.unit();
    desc.structure = rt_structure(random_.below(5));
    desc.quality = rt_build_quality(random_.below(random_.one_in(9) ? 5 : 3));
    desc.memory = rt_memory(random_.below(random_.one_in(9) ? 3 : 2));
    if (random_.one_in(3)) {
        desc.light_proofs = rt_light_proofs(random_.below(random_.one_in(9) ? 3 : 2));
        desc.most_proof_bytes = random_.below(1u << 16);
        if (random_.one_in(2)) desc.proof_budget_ms = 0.01f * random_.unit();
        desc.proof_patch_size = random_.one_in(9) ? random_.number() : random_.unit();
    }
    rt_commit_report report = rt_default_commit_report();
    if (random_.one_in(10)) desc.empty_bonus = random_.number();
    if (random_.one_in(20)) desc.struct_size = random_.below(24);
    check(rt_commit_scene(scene_, &desc, &report));
    rt_scene_stats stats = rt_default_scene_stats();
    check(rt_get_scene_stats(scene_, &stats));
    require(last_ == RT_OK && stats.snapshots_alive <= 1, "snapshots pile up");
}

void Fuzzer::bake() {
    rt_bake_desc desc = rt_default_bake_desc();
    desc.samples = 1 + random_.below(3);
    desc.occlusion_range = random_.one_in(2) ? 1.0f : std::fabs(random_.number());
    desc.bounces = random_.below(2);
    desc.spacing = 2 + std::fabs(random_.number());
    desc.most_bytes = random_.below(1u << 16);
    int calls = int(random_.below(6));
    desc.progress = [](void* user, float) -> int32_t { return --*static_cast<int*>(user) < 0; };
    if (random_.one_in(2)) desc.progress = nullptr;
    desc.progress_user = &calls;
    check(rt_bake_light(scene_, &desc, nullptr));
}

void Fuzzer::render() {
    rt_frame_desc frame = rt_default_frame_desc();
    static constexpr uint32_t kBytes[] = {4, 4, 4, 8, 16};
    frame.format = rt_pixel_format(random_.below(5));
    frame.width = 1 + random_.below(40);
    frame.height = 1 + random_.below(40);
    frame.view = rt_view(random_.below(6));
    frame.tone_mapping = rt_tone_mapping(random_.below(3));
    frame.exposure = 4 * random_.unit();
    frame.light_block = random_.below(3) * 4;
    frame.texture_filter = rt_texture_filter(random_.below(2));
    frame.edge_samples = random_.below(6);
    frame.max_depth = random_.below(6);
    if (random_.one_in(2))
        frame.occlusion_range = random_.one_in(2) ? 1.0f : std::fabs(random_.number());
    frame.occlusion_samples = random_.below(24);
    frame.occlusion_block = random_.below(3) * 4;
    if (random_.one_in(2)) frame.bloom = random_.unit();
    frame.bloom_threshold = 2 * random_.unit();
    frame.bloom_radius = random_.unit();
    frame.airlight_shadows = random_.below(34); // one too many
    frame.airlight_block = random_.below(5);
    frame.measure_luminance = random_.below(2);
    frame.tinted_shadows = random_.below(2);
    frame.baked_light = random_.below(2);
    frame.render_width = random_.below(frame.width + 1);
    const uint64_t row = frame.width * kBytes[frame.format];
    frame.row_stride = random_.one_in(2) ? 0 : row + random_.below(20);
    const uint64_t stride = frame.row_stride ? frame.row_stride : row;
    std::vector<unsigned char> pixels(stride * (frame.height - 1) + row);
    frame.pixels = pixels.data();
    rt_camera camera = rt_default_camera();
    for (double& p : camera.position) p = double(random_.number());
    for (float& f : camera.forward) f = random_.number();
    camera.vertical_fov = 3.3f * random_.unit();
    spoil(camera, 4);
    const size_t count = size_t(frame.width) * frame.height;
    std::vector<float> depth(count), normals(3 * count);
    std::vector<uint32_t> triangles(count);
    std::vector<rt_mesh> meshes(count);
    if (random_.one_in(2)) frame.depth = depth.data();
    if (random_.one_in(2)) frame.normals = normals.data();
    if (random_.one_in(2)) frame.triangle_ids = triangles.data();
    if (random_.one_in(2)) frame.mesh_ids = meshes.data();
    if (random_.one_in(3)) frame.pixels = nullptr;
    spoil(frame, offsetof(rt_frame_desc, view), offsetof(rt_frame_desc, depth));
    spoil(frame, offsetof(rt_frame_desc, light_block), offsetof(rt_frame_desc, particles));
    std::vector<rt_particle> particles(random_.one_in(3) ? random_.below(1200) : 0);
    for (rt_particle& particle : particles) {
        for (double& p : particle.position)
            p = double(random_.one_in(500) ? random_.number() : 8 * random_.unit() - 4);
        particle.radius = random_.one_in(2000) ? random_.number() : 0.01f + random_.unit();
        for (float& c : particle.color) c = random_.unit();
    }
    frame.particles = {particles.data(), particles.size(), 0, 0};
    rt_frame_stats stats = rt_default_frame_stats();
    check(rt_render_frame(scene_, &camera, &frame, &stats));
}

void Fuzzer::query() {
    std::vector<rt_ray> rays(random_.one_in(4) ? random_.below(1300) : random_.below(20));
    for (rt_ray& ray : rays) {
        for (float& value : ray.origin)
            value = random_.one_in(200) ? random_.number() : 8 * random_.unit() - 4;
        for (float& value : ray.direction)
            value = random_.one_in(100) ? random_.number() : random_.unit() - 0.5f;
        ray.t_min = random_.one_in(10) ? random_.number() : 0;
        ray.t_max = random_.one_in(3) ? std::numeric_limits<float>::infinity() : 10;
    }
    std::vector<rt_hit> hits(rays.size());
    std::vector<uint8_t> occluded(rays.size());
    rt_query_desc desc = rt_default_query_desc();
    desc.rays = rays.data();
    desc.ray_count = rays.size();
    desc.hits = hits.data();
    desc.occluded = occluded.data();
    desc.faces = rt_faces(random_.below(3));
    if (random_.one_in(2)) desc.layer_mask = uint32_t(random_.bits());
    if (random_.one_in(2)) desc.ignore_mesh = random_.pick(meshes_);
    desc.flags = random_.below(2) | (random_.one_in(2) ? uint32_t(RT_QUERY_MARK_INVALID) : 0u);
    desc.coherence = rt_coherence(random_.below(2) * 3);
    spoil(desc, offsetof(rt_query_desc, faces), offsetof(rt_query_desc, ray_arrays));
    desc.kind = RT_QUERY_CLOSEST;
    const rt_result closest = check(rt_trace_query(scene_, &desc));
    desc.kind = RT_QUERY_ANY;
    require(check(rt_trace_query(scene_, &desc)) == closest, "the kinds disagree on validity");
    query_arrays(desc, closest, hits);
    if (closest != RT_OK) return;
    for (size_t i = 0; i < rays.size(); ++i)
        require((hits[i].triangle != RT_NO_TRIANGLE) == (occluded[i] == 1),
                "closest hit and any hit disagree");
    resolve(hits);
}

// The same rays as separate arrays: the same result and hits.
void Fuzzer::query_arrays(rt_query_desc desc, rt_result expected, const std::vector<rt_hit>& hits) {
    const auto count = size_t(desc.ray_count);
    std::vector<float> lanes[8];
    for (size_t i = 0; i < count; ++i) {
        const rt_ray& ray = desc.rays[i];
        for (size_t k = 0; k < 3; ++k) {
            lanes[k].push_back(ray.origin[k]);
            lanes[3 + k].push_back(ray.direction[k]);
        }
        lanes[6].push_back(ray.t_min);
        lanes[7].push_back(ray.t_max);
    }
    rt_ray_arrays in = rt_default_ray_arrays();
    for (size_t k = 0; k < 3; ++k) {
        in.origin[k] = lanes[k].data();
        in.direction[k] = lanes[3 + k].data();
    }
    in.t_min = lanes[6].data();
    in.t_max = lanes[7].data();
    std::vector<float> t(count);
    std::vector<uint32_t> triangle(count);
    rt_hit_arrays out = rt_default_hit_arrays();
    out.t = t.data();
    if (random_.one_in(2)) out.triangle = triangle.data();
    desc.kind = RT_QUERY_CLOSEST;
    desc.rays = nullptr;
    desc.hits = nullptr;
    desc.ray_arrays = &in;
    desc.hit_arrays = &out;
    require(check(rt_trace_query(scene_, &desc)) == expected, "arrays are judged differently");
    for (size_t i = 0; i < count && expected == RT_OK; ++i)
        require(std::memcmp(&t[i], &hits[i].t, sizeof t[i]) == 0
                    && (!out.triangle || triangle[i] == hits[i].triangle),
                "arrays are answered differently");
    if (count > 0 && random_.one_in(8)) in.struct_size = uint32_t(random_.bits()) | 1;
    desc.hits = random_.one_in(9) ? reinterpret_cast<rt_hit*>(&t) : nullptr;
    check(rt_trace_query(scene_, &desc));
}

void Fuzzer::resolve(std::vector<rt_hit>& hits) {
    if (hits.empty()) return;
    const bool spoilt = random_.one_in(5);
    if (spoilt)
        reinterpret_cast<unsigned char*>(hits.data())[random_.bits() % (hits.size() * 32)] =
            uint8_t(random_.bits());
    std::vector<rt_surface> surfaces(hits.size());
    check(rt_resolve_hits(scene_, hits.data(), hits.size(), 0, surfaces.data(), 0));
    require(spoilt || last_ == RT_OK, "its own hits are refused");
    rt_resolve_desc desc = rt_default_resolve_desc();
    desc.flags = RT_QUERY_MARK_INVALID;
    desc.surface_fields = uint32_t(random_.bits()) & RT_SURFACE_ALL;
    desc.hits = hits.data();
    desc.hit_count = hits.size();
    desc.surfaces = surfaces.data();
    require(rt_resolve_surfaces(scene_, &desc) == RT_OK, "hits are refused, not marked");
}

} // namespace peregrine::test
