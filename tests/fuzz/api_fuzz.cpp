// Random calls of every function of the header, with good and bad arguments, from a seed:
//     api_fuzz [first seed] [seeds] [calls each]
// Arrays are exactly as long as they must be, so that a sanitizer sees any byte too far. What is
// checked besides: a known result, a sentence after an error, no internal error, and that closest
// hit and any hit agree.
#include <peregrine/rt.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <vector>

namespace {

void require(bool condition, const char* what) {
    if (condition) return;
    std::fprintf(stderr, "api_fuzz: %s; last error: %s\n", what, rt_get_last_error());
    std::abort();
}

// SplitMix64 (Steele, Lea and Flood 2014): the same numbers on every machine.
class Random {
public:
    explicit Random(uint64_t seed) : state_(seed) {}

    uint64_t bits() {
        uint64_t z = state_ += 0x9e3779b97f4a7c15u;
        z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
        z = (z ^ z >> 27) * 0x94d049bb133111ebu;
        return z ^ z >> 31;
    }
    uint32_t below(uint32_t n) { return uint32_t(bits() % n); }
    bool one_in(uint32_t n) { return below(n) == 0; }
    float unit() { return float(bits() >> 40) / float(1 << 24); }

    // Mostly tame, sometimes anything.
    float number() {
        static constexpr float kOdd[] = {0.0f,
                                         -0.0f,
                                         1.0f,
                                         -1.0f,
                                         1e-45f,
                                         1e-30f,
                                         1e30f,
                                         -1e30f,
                                         1.1e30f,
                                         3.4e38f,
                                         -3.4e38f,
                                         std::numeric_limits<float>::infinity(),
                                         -std::numeric_limits<float>::infinity(),
                                         std::numeric_limits<float>::quiet_NaN()};
        return one_in(40) ? kOdd[below(uint32_t(std::size(kOdd)))] : 8 * unit() - 4;
    }
    template <class T>
    T pick(const std::vector<T>& values) {
        return values.empty() || one_in(30) ? T{below(8), below(8)}
                                            : values[below(uint32_t(values.size()))];
    }

private:
    uint64_t state_;
};

class Fuzzer {
public:
    explicit Fuzzer(uint64_t seed) : random_(seed) {
        rt_scene_desc desc = rt_default_scene_desc();
        desc.worker_count = random_.below(4);
        check(rt_create_scene(&desc, &scene_));
        require(last_ == RT_OK, "no scene");
    }
    ~Fuzzer() { check(rt_destroy_scene(scene_)); }
    Fuzzer(const Fuzzer&) = delete;
    Fuzzer& operator=(const Fuzzer&) = delete;

    void step() {
        switch (random_.below(23)) {
        case 0:
            return add_texture();
        case 1:
            return remove(textures_, rt_remove_texture);
        case 2:
            return add_material();
        case 3:
            return update_material();
        case 4:
            return remove(materials_, rt_remove_material);
        case 5:
        case 6:
            return add_mesh();
        case 7:
        case 8:
            return update_mesh();
        case 9:
            return remove(meshes_, rt_remove_mesh);
        case 10:
            return add_light();
        case 11:
            return remove(lights_, rt_remove_light);
        case 12:
            adapt_exposure();
            return set_environment();
        case 13:
            return commit();
        case 14:
            return render();
        case 15:
            return move_mesh();
        case 16:
            return add_instance();
        case 17:
            return add_program();
        case 18:
            return remove(programs_, rt_remove_program);
        default:
            return query();
        }
    }

private:
    rt_result check(rt_result result) {
        last_ = result;
        require(result >= RT_OK && result < RT_ERROR_INTERNAL, "a result that must not be");
        require(result == RT_OK || rt_get_last_error()[0] != '\0', "an error without a sentence");
        return result;
    }

    // Now and then a byte of a struct becomes another, or its size an odd one; pointers, counts and
    // strides stay apart.
    template <class Struct>
    void spoil(Struct& desc, size_t first, size_t end = sizeof(Struct)) {
        if (random_.one_in(60)) desc.struct_size = uint32_t(random_.bits()) | 1;
        if (!random_.one_in(6)) return;
        auto* bytes = reinterpret_cast<unsigned char*>(&desc);
        bytes[first + random_.bits() % (end - first)] = uint8_t(random_.bits());
    }

    std::vector<float> numbers(size_t count) {
        std::vector<float> values(count);
        for (float& value : values) value = random_.number();
        return values;
    }

    template <class Handle, class Remove>
    void remove(std::vector<Handle>& handles, Remove call) {
        if (handles.size() < 6 && !random_.one_in(4)) return;
        const Handle handle = random_.pick(handles);
        if (check(call(scene_, handle)) != RT_OK) return;
        std::erase_if(handles, [&](Handle h) {
            return h.index == handle.index && h.generation == handle.generation;
        });
    }

    void add_texture() {
        if (textures_.size() > 12) return;
        rt_texture_desc desc = rt_default_texture_desc();
        desc.format = rt_pixel_format(random_.below(5));
        desc.width = 1 + random_.below(6);
        desc.height = 1 + random_.below(6);
        desc.wrap_u = rt_wrap(random_.below(3));
        desc.wrap_v = rt_wrap(random_.below(3));
        desc.filter = rt_filter(random_.below(2));
        const uint64_t row = desc.width * (desc.format == RT_FORMAT_RGBA32F ? 16u : 4u);
        desc.row_stride = random_.one_in(2) ? 0 : row + random_.below(5);
        const uint64_t stride = desc.row_stride ? desc.row_stride : row;
        std::vector<unsigned char> pixels(stride * (desc.height - 1) + row);
        for (auto& byte : pixels) byte = uint8_t(random_.bits());
        desc.pixels = pixels.data();
        spoil(desc, offsetof(rt_texture_desc, wrap_u));
        rt_texture texture;
        if (check(rt_add_texture(scene_, &desc, &texture)) == RT_OK) textures_.push_back(texture);
    }

    rt_material_desc material() {
        rt_material_desc desc = rt_default_material_desc();
        desc.alpha_mode = rt_alpha_mode(random_.below(3));
        desc.double_sided = random_.below(2);
        for (float& c : desc.base_color) c = random_.unit() * 2;
        for (float& c : desc.emissive) c = random_.one_in(3) ? random_.unit() : 0;
        for (float& c : desc.specular) c = random_.one_in(3) ? random_.unit() : 0;
        desc.shininess = 1 + 50 * random_.unit();
        if (random_.one_in(3)) desc.reflectivity = random_.unit();
        if (random_.one_in(3)) {
            desc.transmission = random_.unit();
            desc.index_of_refraction = 1 + random_.unit();
            desc.attenuation_distance = random_.unit();
            for (float& c : desc.attenuation_color) c = random_.unit();
            desc.thin = random_.below(2);
        }
        for (rt_texture_use* use :
             {&desc.base_color_texture, &desc.normal_texture, &desc.emissive_texture,
              &desc.occlusion_texture, &desc.roughness_texture}) {
            if (random_.one_in(2)) continue;
            use->texture = random_.pick(textures_);
            use->texcoord_set = random_.below(2);
            for (float& value : use->transform) value = random_.number();
        }
        for (float* value : {&desc.occlusion_strength, &desc.roughness, &desc.metalness})
            *value = random_.unit();
        if (random_.one_in(3)) {
            desc.program = random_.pick(programs_);
            if (!random_.one_in(9)) desc.reflectivity = desc.transmission = 0;
        }
        spoil(desc, 4);
        return desc;
    }

    // Reads all that it asked for, and says anything that it can: bits of what it was given.
    static void shade(void* user, const rt_program_batch* b) {
        const uint32_t fields = *static_cast<const uint32_t*>(user);
        const float* const floats[] = {
            b->position[0], b->geometric_normal[1], b->shading_normal[2], b->direction[0],
            b->distance,    b->footprint,           b->texcoord[0],       b->barycentric[1]};
        const float* const light[] = {b->base_color[0], b->emissive[1], b->diffuse[2],
                                      b->highlight[0], b->openness};
        const bool has_rays = (fields & RT_PROGRAM_RAYS) != 0;
        require(b->count > 0 && b->padded_count % 16 == 0, "an odd batch");
        require(has_rays == (b->ray_weight[0] != nullptr), "rays that were not asked for");
        for (uint32_t i = 0; i < b->padded_count; ++i) {
            float sum = 0;
            for (uint32_t k = 0; k < std::size(floats); ++k)
                if (fields >> k & 1) sum += floats[k][i];
            for (uint32_t k = 0; k < std::size(light); ++k)
                if (fields >> (11 + k) & 1) sum += light[k][i];
            if (fields & RT_PROGRAM_IDS) sum += float(b->triangle[i] + b->mesh[i].index);
            if (fields & RT_PROGRAM_BACK_FACE) sum -= float(b->back_face[i]);
            if (fields & RT_PROGRAM_USER_DATA)
                sum += float(b->mesh_user_data[i] ^ b->material_user_data[i]);
            for (int k = 0; k < 3; ++k) {
                b->radiance[k][i] = sum;
                if (!has_rays) continue;
                b->ray_direction[k][i] = k == 1 ? sum : sum - 1;
                b->ray_weight[k][i] = sum * 0.5f;
            }
        }
    }

    void add_program() {
        if (programs_.size() > 12) return;
        rt_program_desc desc = rt_default_program_desc();
        desc.fields = uint32_t(random_.bits()) & (2 * RT_PROGRAM_RAYS - 1);
        fields_.push_back(std::make_unique<uint32_t>());
        desc.user = fields_.back().get();
        desc.shade = random_.one_in(20) ? nullptr : shade;
        if (random_.one_in(20)) desc.fields = uint32_t(random_.bits());
        spoil(desc, 4, 8);
        *fields_.back() = desc.fields;
        rt_program program;
        if (check(rt_add_program(scene_, &desc, &program)) == RT_OK) programs_.push_back(program);
    }

    void add_material() {
        if (materials_.size() > 12) return;
        const rt_material_desc desc = material();
        rt_material handle;
        if (check(rt_add_material(scene_, &desc, &handle)) == RT_OK) materials_.push_back(handle);
    }

    void update_material() {
        const rt_material_desc desc = material();
        check(rt_update_material(scene_, random_.pick(materials_), &desc));
    }

    void add_mesh() {
        if (meshes_.size() > 12) return;
        const uint32_t vertices = 3 + random_.below(30), corners = 3 * (1 + random_.below(40));
        const std::vector<float> positions = numbers(vertices * 3), normals = numbers(vertices * 3),
                                 tangents = numbers(vertices * 4), uv = numbers(vertices * 2);
        std::vector<uint32_t> indices(corners);
        for (uint32_t& index : indices) index = random_.below(vertices);
        if (random_.one_in(20)) indices[random_.below(corners)] = uint32_t(random_.bits());
        std::vector<uint16_t> narrow(indices.begin(), indices.end());
        std::vector<rt_material> materials(corners / 3);
        for (rt_material& m : materials) m = materials_.empty() ? rt_material{} : materials_[0];
        rt_mesh_desc desc = rt_default_mesh_desc();
        desc.positions = {positions.data(), vertices, 0, 0};
        if (random_.one_in(2)) desc.normals = {normals.data(), vertices, 12, 0};
        if (random_.one_in(2)) desc.tangents = {tangents.data(), vertices, 0, 0};
        if (random_.one_in(2)) desc.texcoords = {uv.data(), vertices, 0, 0};
        if (random_.one_in(2)) desc.texcoords1 = {uv.data(), vertices, 8, 0};
        if (random_.one_in(2)) desc.materials = {materials.data(), corners / 3, 0, 0};
        desc.index_type = rt_index_type(random_.below(2));
        desc.indices = {desc.index_type ? static_cast<const void*>(narrow.data()) : indices.data(),
                        corners, 0, 0};
        desc.material = random_.one_in(2) ? rt_material{} : random_.pick(materials_);
        desc.layer_mask = uint32_t(random_.bits());
        spoil(desc, offsetof(rt_mesh_desc, material));
        if (random_.one_in(30)) desc.positions.count = random_.bits(); // more than there are
        if (random_.one_in(30)) desc.normals.count = random_.bits();
        if (desc.positions.count != vertices) desc.positions.count |= uint64_t(1) << 40;
        constexpr decltype(rt_add_static_mesh)* kAdd[] = {rt_add_static_mesh, rt_add_dynamic_mesh,
                                                          rt_add_rigid_mesh};
        const uint32_t kind = random_.below(3);
        rt_mesh mesh;
        if (check(kAdd[kind](scene_, &desc, &mesh)) != RT_OK) return;
        meshes_.push_back(mesh);
        if (kind == 1) moving_.push_back({mesh, vertices});
    }

    void move_mesh() {
        rt_transform transform = rt_default_transform();
        for (double& m : transform.m)
            if (random_.one_in(2)) m = double(random_.number());
        check(rt_set_mesh_transform(scene_, random_.pick(meshes_), &transform));
        check(rt_set_mesh_layer_mask(scene_, random_.pick(meshes_), uint32_t(random_.bits())));
        check(rt_set_mesh_user_data(scene_, random_.pick(meshes_), random_.bits()));
        check(rt_set_mesh_hidden(scene_, random_.pick(meshes_), random_.below(3)));
    }

    void add_instance() {
        if (meshes_.size() > 40) return;
        rt_mesh mesh;
        if (check(rt_add_mesh_instance(scene_, random_.pick(meshes_), &mesh)) == RT_OK)
            meshes_.push_back(mesh);
    }

    void update_mesh() {
        if (moving_.empty()) return;
        const Moving mesh = moving_[random_.below(uint32_t(moving_.size()))];
        const std::vector<float> positions = numbers(mesh.vertices * 3);
        rt_mesh_update update = rt_default_mesh_update();
        update.positions = {positions.data(), mesh.vertices, 0, 0};
        if (random_.one_in(3)) update.normals = update.positions;
        if (random_.one_in(20)) update.positions.count -= 1;
        check(rt_update_dynamic_mesh(scene_, mesh.handle, &update));
    }

    void add_light() {
        if (lights_.size() > 6) return;
        rt_light_desc desc = rt_default_light_desc();
        desc.type = rt_light_type(random_.below(3));
        desc.falloff = rt_falloff(random_.below(6)); // one too many
        for (double& p : desc.position) p = double(random_.number());
        for (float& d : desc.direction) d = random_.number();
        desc.casts_no_shadow = random_.below(2);
        if (random_.one_in(3)) desc.source_radius = random_.number();
        desc.shadow_samples = random_.below(20);
        if (random_.one_in(3)) desc.fog_scatter = random_.unit();
        spoil(desc, 4);
        rt_light light;
        if (check(rt_add_light(scene_, &desc, &light)) == RT_OK) lights_.push_back(light);
        if (!lights_.empty()) check(rt_update_light(scene_, random_.pick(lights_), &desc));
    }

    void set_environment() {
        rt_environment environment = rt_default_environment();
        for (float& c : environment.background) c = random_.number();
        environment.sky = rt_sky(random_.below(3));
        for (float& c : environment.zenith) c = random_.unit();
        environment.sky_texture = random_.pick(textures_);
        environment.sky_rotation = random_.number();
        spoil(environment, 4);
        check(rt_set_environment(scene_, &environment));
        rt_fog fog = rt_default_fog();
        fog.density = random_.one_in(2) ? 0 : random_.unit();
        fog.top = 9.0 * double(random_.unit());
        fog.bottom = 9.0 * double(random_.unit()) - 4.5;
        spoil(fog, 4);
        check(rt_set_fog(scene_, &fog));
    }

    void adapt_exposure() {
        rt_exposure exposure = rt_default_exposure();
        exposure.exposure = random_.unit();
        exposure.adaptation = random_.unit();
        spoil(exposure, 4);
        check(rt_adapt_exposure(&exposure, random_.unit(), random_.unit()));
    }

    void commit() {
        rt_commit_desc desc = rt_default_commit_desc();
        desc.empty_bonus = random_.one_in(2) ? 0 : random_.unit();
        desc.structure = rt_structure(random_.below(5));
        desc.quality = rt_build_quality(random_.below(random_.one_in(9) ? 5 : 3));
        desc.memory = rt_memory(random_.below(random_.one_in(9) ? 3 : 2));
        if (random_.one_in(3)) {
            desc.light_proofs = rt_light_proofs(random_.below(random_.one_in(9) ? 3 : 2));
            desc.most_proof_bytes = random_.below(1u << 16);
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

    void render() {
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
        if (random_.one_in(2)) frame.occlusion_range = std::fabs(random_.number());
        frame.occlusion_samples = random_.below(24);
        frame.occlusion_block = random_.below(3) * 4;
        if (random_.one_in(2)) frame.bloom = random_.unit();
        frame.bloom_threshold = 2 * random_.unit();
        frame.bloom_radius = random_.unit();
        frame.airlight_shadows = random_.below(34); // one too many
        frame.airlight_block = random_.below(5);
        frame.measure_luminance = random_.below(2);
        frame.tinted_shadows = random_.below(2);
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

    void query() {
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
    void query_arrays(rt_query_desc desc, rt_result expected, const std::vector<rt_hit>& hits) {
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

    void resolve(std::vector<rt_hit>& hits) {
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

    struct Moving {
        rt_mesh handle;
        uint32_t vertices;
    };

    Random random_;
    rt_result last_ = RT_OK;
    rt_scene scene_{};
    std::vector<rt_texture> textures_;
    std::vector<rt_material> materials_;
    std::vector<rt_program> programs_;
    std::vector<std::unique_ptr<uint32_t>> fields_; // of all programs: they outlive snapshots
    std::vector<rt_mesh> meshes_;
    std::vector<Moving> moving_;
    std::vector<rt_light> lights_;
};

} // namespace

int main(int argc, char** argv) {
    const uint64_t first = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1;
    const uint64_t seeds = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 4;
    const uint64_t calls = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 3000;
    for (uint64_t seed = first; seed < first + seeds; ++seed) {
        std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
        std::fflush(stdout);
        Fuzzer fuzzer(seed);
        for (uint64_t i = 0; i < calls; ++i) fuzzer.step();
    }
    return 0;
}
