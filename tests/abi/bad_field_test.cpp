// Fields of textures, materials, lights, the environment and the scene itself.
#include "bad_input.h"

#include <functional>

namespace peregrine::test {
namespace {

class BadField : public BadInput {};

template <class Struct>
struct Case {
    std::function<void(Struct&)> spoil;
    rt_result expected;
    const char* words;
};

TEST_F(BadField, Scene) {
    using C = Case<rt_scene_desc>;
    const auto allocate = [](void*, uint64_t, uint64_t) -> void* { return nullptr; };
    const auto deallocate = [](void*, void*, uint64_t, uint64_t) {};
    const auto run = [](void*, uint32_t, rt_task_function, void*) {};
    const C cases[] = {
        {[&](auto& d) { d.allocator.allocate = allocate; }, RT_ERROR_INVALID_ARGUMENT,
         "rt_scene_desc.allocator.deallocate is null"},
        {[&](auto& d) { d.allocator.deallocate = deallocate; }, RT_ERROR_INVALID_ARGUMENT,
         "rt_scene_desc.allocator.allocate is null"},
        {[&](auto& d) { d.worker_count = 257; }, RT_ERROR_LIMIT, "worker_count is 257"},
        {[&](auto& d) { d.worker_count = ~0u; }, RT_ERROR_LIMIT, "worker_count"},
        {[&](auto& d) { d.scheduler.run = run; }, RT_ERROR_INVALID_ARGUMENT, "concurrency is 0"},
        {[&](auto& d) { d.scheduler.reserved = 1; }, RT_ERROR_INVALID_ARGUMENT,
         "scheduler.reserved"},
        {[&](auto& d) { d.isa = 6; }, RT_ERROR_INVALID_ARGUMENT, "rt_scene_desc.isa is 6"},
        {[&](auto& d) { d.isa = -1; }, RT_ERROR_INVALID_ARGUMENT, "rt_scene_desc.isa is -1"},
        {[&](auto& d) { d.reserved = 1; }, RT_ERROR_INVALID_ARGUMENT, "rt_scene_desc.reserved"},
#if defined(__x86_64__)
        {[&](auto& d) { d.isa = RT_ISA_NEON; }, RT_ERROR_UNSUPPORTED, "isa"},
#endif
    };
    for (const C& c : cases) {
        rt_scene_desc desc = rt_default_scene_desc();
        c.spoil(desc);
        rt_scene out = kUntouched<rt_scene>;
        expect_refused(rt_create_scene(&desc, &out), c.expected, c.words);
        EXPECT_TRUE(untouched(out));
    }
    const rt_scene_desc desc = rt_default_scene_desc();
    expect_refused(rt_create_scene(&desc, nullptr), RT_ERROR_INVALID_ARGUMENT, "out_scene");
    expect_refused(rt_get_scene_stats(scene(), nullptr), RT_ERROR_INVALID_ARGUMENT, "out_stats");
}

TEST_F(BadField, Texture) {
    using C = Case<rt_texture_desc>;
    const C cases[] = {
        {[](auto& d) { d.pixels = nullptr; }, RT_ERROR_INVALID_ARGUMENT, "pixels is null"},
        {[](auto& d) { d.width = 0; }, RT_ERROR_INVALID_ARGUMENT, "width is 0"},
        {[](auto& d) { d.height = 0; }, RT_ERROR_INVALID_ARGUMENT, "height is 0"},
        {[](auto& d) { d.width = 32769; }, RT_ERROR_LIMIT, "width is 32769"},
        {[](auto& d) { d.height = ~0u; }, RT_ERROR_LIMIT, "height is 4294967295"},
        {[](auto& d) { d.row_stride = 7; }, RT_ERROR_INVALID_ARGUMENT, "row_stride is 7"},
        {[](auto& d) { d.row_stride = ~0ull; }, RT_ERROR_LIMIT, "row_stride"},
        {[](auto& d) { d.row_stride = 1ull << 63; }, RT_ERROR_LIMIT, "row_stride"},
        {[](auto& d) { d.format = RT_FORMAT_RGBA16F; }, RT_ERROR_INVALID_ARGUMENT, "format"},
        {[](auto& d) { d.format = 5; }, RT_ERROR_INVALID_ARGUMENT, "format is 5"},
        {[](auto& d) { d.format = -1; }, RT_ERROR_INVALID_ARGUMENT, "format is -1"},
        {[](auto& d) { d.wrap_u = 3; }, RT_ERROR_INVALID_ARGUMENT, "wrap_u is 3"},
        {[](auto& d) { d.wrap_v = -7; }, RT_ERROR_INVALID_ARGUMENT, "wrap_v is -7"},
        {[](auto& d) { d.filter = 2; }, RT_ERROR_INVALID_ARGUMENT, "filter is 2"},
        {[](auto& d) { d.reserved = 1; }, RT_ERROR_INVALID_ARGUMENT, "reserved is 1"},
    };
    const std::vector<float> pixels = {0, 1, kInfinity, -1, 0, 1, 2, 3, 0, 1, 2, -1, 0, 1, 2, 3};
    rt_texture_desc good = rt_default_texture_desc();
    good.pixels = pixels.data();
    good.width = good.height = 2;
    auto out = kUntouched<rt_texture>;
    for (const C& c : cases) {
        rt_texture_desc desc = good;
        c.spoil(desc);
        expect_refused(rt_add_texture(scene(), &desc, &out), c.expected, c.words);
    }
    good.format = RT_FORMAT_RGBA32F;
    expect_refused(rt_add_texture(scene(), &good, &out), RT_ERROR_INVALID_ARGUMENT,
                   "the texel at (0, 0) is inf");
    EXPECT_TRUE(untouched(out));
    expect_refused(rt_add_texture(scene(), &good, nullptr), RT_ERROR_INVALID_ARGUMENT,
                   "out_texture");
}

// Every float of a struct in turn becomes NaN and infinite; all of them must be looked at.
template <class Struct, size_t N>
void spoil_floats(const Struct& good, const size_t (&offsets)[N],
                  const std::function<void(const Struct&)>& refuse) {
    for (const size_t offset : offsets)
        for (const float value : {kNan, kInfinity, -kInfinity}) {
            Struct bad = good;
            std::memcpy(reinterpret_cast<char*>(&bad) + offset, &value, sizeof value);
            refuse(bad);
        }
}

#define AT(type, member) offsetof(type, member)

TEST_F(BadField, MaterialFloats) {
    using M = rt_material_desc;
    const size_t offsets[] = {
        AT(M, base_color[0]),
        AT(M, base_color[3]),
        AT(M, emissive[0]),
        AT(M, emissive[2]),
        AT(M, alpha_cutoff),
        AT(M, specular[0]),
        AT(M, specular[2]),
        AT(M, shininess),
        AT(M, normal_scale),
        AT(M, reflectivity),
        AT(M, reflection_color[1]),
        AT(M, transmission),
        AT(M, index_of_refraction),
        AT(M, attenuation_color[2]),
        AT(M, attenuation_distance),
        AT(M, base_color_texture.transform[0]),
        AT(M, base_color_texture.transform[5]),
        AT(M, normal_texture.transform[2]),
        AT(M, emissive_texture.transform[4]),
        AT(M, occlusion_texture.transform[1]),
        AT(M, roughness_texture.transform[3]),
        AT(M, occlusion_strength),
        AT(M, roughness),
        AT(M, metalness),
    };
    spoil_floats<M>(rt_default_material_desc(), offsets, [&](const M& bad) {
        auto out = kUntouched<rt_material>;
        expect_refused(rt_add_material(scene(), &bad, &out), RT_ERROR_INVALID_ARGUMENT,
                       "rt_material_desc.");
        EXPECT_TRUE(untouched(out));
        expect_refused(rt_update_material(scene(), world_->material, &bad),
                       RT_ERROR_INVALID_ARGUMENT, "rt_material_desc.");
    });
}

TEST_F(BadField, Material) {
    using C = Case<rt_material_desc>;
    const C cases[] = {
        {[](auto& d) { d.alpha_mode = 3; }, RT_ERROR_INVALID_ARGUMENT, "alpha_mode is 3"},
        {[](auto& d) { d.alpha_mode = -1; }, RT_ERROR_INVALID_ARGUMENT, "alpha_mode is -1"},
        {[](auto& d) { d.base_color[1] = -0.5f; }, RT_ERROR_INVALID_ARGUMENT,
         "rt_material_desc.base_color[1] is -0.5"},
        {[](auto& d) { d.emissive[2] = -1; }, RT_ERROR_INVALID_ARGUMENT, "emissive[2] is -1"},
        {[](auto& d) { d.shininess = 0.5f; }, RT_ERROR_INVALID_ARGUMENT, "shininess is 0.5"},
        {[](auto& d) { d.double_sided = 2; }, RT_ERROR_INVALID_ARGUMENT, "double_sided is 2"},
        {[](auto& d) { d.normal_texture.texcoord_set = 2; }, RT_ERROR_INVALID_ARGUMENT,
         "rt_material_desc.normal_texture.texcoord_set is 2"},
        {[](auto& d) { d.emissive_texture.reserved = 3; }, RT_ERROR_INVALID_ARGUMENT,
         "rt_material_desc.emissive_texture.reserved is 3"},
        {[](auto& d) { d.reflectivity = 1.01f; }, RT_ERROR_INVALID_ARGUMENT,
         "rt_material_desc.reflectivity is 1.01; it must be 0 to 1"},
        {[](auto& d) { d.reflection_color[1] = 2; }, RT_ERROR_INVALID_ARGUMENT,
         "rt_material_desc.reflection_color is 2"},
        {[](auto& d) { d.transmission = -0.5f; }, RT_ERROR_INVALID_ARGUMENT,
         "transmission is -0.5"},
        {[](auto& d) { d.index_of_refraction = 0.9f; }, RT_ERROR_INVALID_ARGUMENT,
         "index_of_refraction is 0.9; it must be 0 or from 1 to 10"},
        {[](auto& d) { d.index_of_refraction = 11; }, RT_ERROR_INVALID_ARGUMENT,
         "index_of_refraction is 11"},
        {[](auto& d) { d.attenuation_color[0] = 1.5f; }, RT_ERROR_INVALID_ARGUMENT,
         "attenuation_color is 1.5"},
        {[](auto& d) { d.attenuation_distance = -1; }, RT_ERROR_INVALID_ARGUMENT,
         "attenuation_distance is -1"},
        {[](auto& d) { d.thin = 2; }, RT_ERROR_INVALID_ARGUMENT, "rt_material_desc.thin is 2"},
        {[](auto& d) { d.reserved = 1; }, RT_ERROR_INVALID_ARGUMENT,
         "rt_material_desc.reserved is 1"},
        {[](auto& d) { d.occlusion_texture.texcoord_set = 2; }, RT_ERROR_INVALID_ARGUMENT,
         "rt_material_desc.occlusion_texture.texcoord_set is 2"},
        {[](auto& d) { d.occlusion_strength = -1; }, RT_ERROR_INVALID_ARGUMENT,
         "rt_material_desc.occlusion_strength is -1; it must be 0 to 1"},
        {[](auto& d) { d.roughness = 2; }, RT_ERROR_INVALID_ARGUMENT,
         "rt_material_desc.roughness is 2"},
        {[](auto& d) { d.metalness = 1.5f; }, RT_ERROR_INVALID_ARGUMENT,
         "rt_material_desc.metalness is 1.5"},
        {[](auto& d) { d.reserved2 = 7; }, RT_ERROR_INVALID_ARGUMENT,
         "rt_material_desc.reserved2 is 7"},
    };
    for (const C& c : cases) {
        rt_material_desc desc = rt_default_material_desc();
        c.spoil(desc);
        auto out = kUntouched<rt_material>;
        expect_refused(rt_add_material(scene(), &desc, &out), c.expected, c.words);
        expect_refused(rt_update_material(scene(), world_->fence, &desc), c.expected, c.words);
        EXPECT_TRUE(untouched(out));
    }
}

TEST_F(BadField, Program) {
    rt_program_desc desc = rt_default_program_desc();
    auto out = kUntouched<rt_program>;
    expect_refused(rt_add_program(scene(), &desc, &out), RT_ERROR_INVALID_ARGUMENT,
                   "rt_program_desc.shade is null");
    desc.shade = [](void*, const rt_program_batch*) {};
    desc.fields = RT_PROGRAM_RAYS << 1;
    expect_refused(rt_add_program(scene(), &desc, &out), RT_ERROR_INVALID_ARGUMENT,
                   "rt_program_desc.fields is 0x20000; the known bits are 0x1ffff");
    expect_refused(rt_add_program(scene(), nullptr, &out), RT_ERROR_INVALID_ARGUMENT,
                   "rt_program_desc is null");
    EXPECT_TRUE(untouched(out));
    desc.fields = RT_PROGRAM_RAYS;
    expect_refused(rt_add_program(scene(), &desc, nullptr), RT_ERROR_INVALID_ARGUMENT,
                   "out_program is null");
}

TEST_F(BadField, MaterialsWithProgramsAreNoMirrors) {
    rt_program_desc program = rt_default_program_desc();
    program.shade = [](void*, const rt_program_batch*) {};
    rt_material_desc desc = rt_default_material_desc();
    ASSERT_OK(rt_add_program(scene(), &program, &desc.program));
    for (const auto& [member, words] :
         {std::pair{&rt_material_desc::reflectivity, "reflectivity"},
          std::pair{&rt_material_desc::transmission, "transmission"}}) {
        rt_material_desc bad = desc;
        bad.*member = 0.5f;
        auto out = kUntouched<rt_material>;
        expect_refused(rt_add_material(scene(), &bad, &out), RT_ERROR_INVALID_ARGUMENT,
                       std::string("rt_material_desc.") + words + " is 0.5; it must be 0");
        expect_refused(rt_update_material(scene(), world_->fence, &bad), RT_ERROR_INVALID_ARGUMENT,
                       words);
        EXPECT_TRUE(untouched(out));
    }
}

TEST_F(BadField, Light) {
    using C = Case<rt_light_desc>;
    const C cases[] = {
        {[](auto& d) { d.type = 3; }, RT_ERROR_INVALID_ARGUMENT, "type is 3"},
        {[](auto& d) { d.position[1] = std::nan(""); }, RT_ERROR_INVALID_ARGUMENT, "position[1]"},
        {[](auto& d) { d.radius = 0; }, RT_ERROR_INVALID_ARGUMENT, "radius is 0"},
        {[](auto& d) { d.radius = -1; }, RT_ERROR_INVALID_ARGUMENT, "radius is -1"},
        {[](auto& d) { d.radius = -kInfinity; }, RT_ERROR_INVALID_ARGUMENT, "radius is -inf"},
        {[](auto& d) { d.radius = kNan; }, RT_ERROR_INVALID_ARGUMENT, "radius is"},
        {[](auto& d) { d.radius = kInfinity, d.falloff = RT_FALLOFF_SCHLICK_LINEAR; },
         RT_ERROR_INVALID_ARGUMENT, "radius is infinite, but a falloff of 0 needs an end"},
        {[](auto& d) { d.radius = kInfinity, d.falloff = RT_FALLOFF_COSINE_LINEAR; },
         RT_ERROR_INVALID_ARGUMENT, "radius is infinite"},
        {[](auto& d) { d.falloff = 5; }, RT_ERROR_INVALID_ARGUMENT, "rt_light_desc.falloff is 5"},
        {[](auto& d) { d.falloff = -1; }, RT_ERROR_INVALID_ARGUMENT, "falloff is -1"},
        {[](auto& d) { d.fog_scatter = -0.1f; }, RT_ERROR_INVALID_ARGUMENT,
         "rt_light_desc.fog_scatter is -0.1; it must be 0 to 1"},
        {[](auto& d) { d.fog_scatter = 1.5f; }, RT_ERROR_INVALID_ARGUMENT, "fog_scatter is 1.5"},
        {[](auto& d) { d.fog_scatter = kNan; }, RT_ERROR_INVALID_ARGUMENT, "fog_scatter is"},
        {[](auto& d) { d.fog_scatter = 1, d.type = RT_LIGHT_DIRECTIONAL; },
         RT_ERROR_INVALID_ARGUMENT, "fog_scatter is 1, but the light is directional"},
        {[](auto& d) { d.fog_scatter = 1, d.radius = kInfinity; }, RT_ERROR_INVALID_ARGUMENT,
         "fog_scatter is 1, but the light is directional or has no end"},
        {[](auto& d) { d.source_radius = -0.1f; }, RT_ERROR_INVALID_ARGUMENT,
         "rt_light_desc.source_radius is -0.1"},
        {[](auto& d) { d.source_radius = kNan; }, RT_ERROR_INVALID_ARGUMENT,
         "rt_light_desc.source_radius"},
        {[](auto& d) { d.shadow_samples = 257; }, RT_ERROR_INVALID_ARGUMENT,
         "rt_light_desc.shadow_samples is 257; at most 256"},
        {[](auto& d) { d.intensity[0] = -1; }, RT_ERROR_INVALID_ARGUMENT, "intensity[0] is -1"},
        {[](auto& d) { d.casts_no_shadow = 7; }, RT_ERROR_INVALID_ARGUMENT, "casts_no_shadow"},
        {[](auto& d) { d.direction[1] = 0; }, RT_ERROR_INVALID_ARGUMENT, "direction is the zero"},
        {[](auto& d) { d.cone_outer_cos = 1.5f; }, RT_ERROR_INVALID_ARGUMENT, "cone_outer_cos"},
        {[](auto& d) { d.cone_inner_cos = 0.5f; }, RT_ERROR_INVALID_ARGUMENT, "cone_inner_cos"},
        {[](auto& d) { d.cone_outer_cos = -1.5f; }, RT_ERROR_INVALID_ARGUMENT, "cone_outer_cos"},
    };
    rt_light_desc good = rt_default_light_desc();
    good.type = RT_LIGHT_SPOT;
    const auto refuse = [&](const rt_light_desc& desc, rt_result expected, const char* words) {
        auto out = kUntouched<rt_light>;
        expect_refused(rt_add_light(scene(), &desc, &out), expected, words);
        expect_refused(rt_update_light(scene(), world_->lamp, &desc), expected, words);
        EXPECT_TRUE(untouched(out));
    };
    for (const C& c : cases) {
        rt_light_desc desc = good;
        c.spoil(desc);
        refuse(desc, c.expected, c.words);
    }
    using L = rt_light_desc;
    const size_t offsets[] = {AT(L, direction[0]), AT(L, direction[2]), AT(L, intensity[1]),
                              AT(L, cone_inner_cos), AT(L, cone_outer_cos)};
    for (const rt_light_type type : {RT_LIGHT_POINT, RT_LIGHT_SPOT, RT_LIGHT_DIRECTIONAL}) {
        good.type = type;
        spoil_floats<L>(good, offsets, [&](const L& bad) {
            refuse(bad, RT_ERROR_INVALID_ARGUMENT, "rt_light_desc.");
        });
    }
}

TEST_F(BadField, Environment) {
    using E = rt_environment;
    const size_t offsets[] = {AT(E, ambient[0]),    AT(E, ambient[2]),  AT(E, background[1]),
                              AT(E, zenith[0]),     AT(E, horizon[1]),  AT(E, ground[2]),
                              AT(E, sky_intensity), AT(E, sky_rotation)};
    spoil_floats<E>(rt_default_environment(), offsets, [&](const E& bad) {
        expect_refused(rt_set_environment(scene(), &bad), RT_ERROR_INVALID_ARGUMENT,
                       "rt_environment.");
    });
    E bad = rt_default_environment();
    bad.reserved = 2;
    expect_refused(rt_set_environment(scene(), &bad), RT_ERROR_INVALID_ARGUMENT,
                   "rt_environment.reserved");
    bad.reserved = 0;
    for (const int32_t sky : {-1, 3}) {
        bad.sky = sky;
        expect_refused(rt_set_environment(scene(), &bad), RT_ERROR_INVALID_ARGUMENT,
                       "rt_environment.sky is ");
    }
    bad.sky = RT_SKY_TEXTURE;
    expect_refused(rt_set_environment(scene(), &bad), RT_ERROR_INVALID_HANDLE,
                   "rt_environment.sky_texture");
    bad.sky_intensity = -1;
    expect_refused(rt_set_environment(scene(), &bad), RT_ERROR_INVALID_ARGUMENT,
                   "rt_environment.sky_intensity is -1");
}

TEST_F(BadField, Fog) {
    using F = rt_fog;
    const size_t offsets[] = {AT(F, density), AT(F, color[0]), AT(F, color[2])};
    spoil_floats<F>(rt_default_fog(), offsets, [&](const F& bad) {
        expect_refused(rt_set_fog(scene(), &bad), RT_ERROR_INVALID_ARGUMENT, "rt_fog.");
    });
    const auto refuse = [&](auto spoil, const char* words) {
        F bad = rt_default_fog();
        spoil(bad);
        expect_refused(rt_set_fog(scene(), &bad), RT_ERROR_INVALID_ARGUMENT, words);
    };
    refuse([](F& f) { f.density = -1; }, "rt_fog.density");
    refuse([](F& f) { f.color[1] = -1; }, "rt_fog.color");
    refuse([](F& f) { f.bottom = 3; }, "rt_fog.bottom is 3, above its top, 2");
    refuse([](F& f) { f.top = double(kInfinity); }, "rt_fog.top");
    refuse([](F& f) { f.bottom = double(kNan); }, "rt_fog.bottom");
    refuse([](F& f) { f.top = 2e30; }, "rt_fog.top");
    refuse([](F& f) { f.reserved = 1; }, "rt_fog.reserved");
}

TEST_F(BadField, Commit) {
    rt_commit_desc desc = rt_default_commit_desc();
    for (const float bonus : {-0.1f, 1.1f, kNan, kInfinity}) {
        desc.empty_bonus = bonus;
        expect_refused(rt_commit_scene(scene(), &desc, nullptr), RT_ERROR_INVALID_ARGUMENT,
                       "rt_commit_desc.empty_bonus");
    }
    desc = rt_default_commit_desc();
    const auto refuse = [&](rt_result expected, const char* words) {
        expect_refused(rt_commit_scene(scene(), &desc, nullptr), expected, words);
        desc = rt_default_commit_desc();
    };
    for (const int32_t value : {-1, 4, 0x7fffffff}) {
        desc.structure = value;
        refuse(RT_ERROR_INVALID_ARGUMENT, "rt_commit_desc.structure is ");
    }
    for (const int32_t value : {-1, 3}) {
        desc.quality = value;
        refuse(RT_ERROR_INVALID_ARGUMENT, "rt_commit_desc.quality is ");
    }
    for (const int32_t value : {-1, 2}) {
        desc.memory = value;
        refuse(RT_ERROR_INVALID_ARGUMENT, "rt_commit_desc.memory is ");
    }
    for (const int32_t value : {-1, 2}) {
        desc.light_proofs = value;
        refuse(RT_ERROR_INVALID_ARGUMENT, "rt_commit_desc.light_proofs is ");
    }
    for (const float size : {-1.0f, 1e31f, kNan, kInfinity}) {
        desc.proof_patch_size = size;
        refuse(RT_ERROR_INVALID_ARGUMENT, "rt_commit_desc.proof_patch_size is ");
    }
    for (const float budget : {-1.0f, kNan, kInfinity}) {
        desc.proof_budget_ms = budget;
        refuse(RT_ERROR_INVALID_ARGUMENT, "rt_commit_desc.proof_budget_ms is ");
    }
    ASSERT_OK(move_lift(*world_, 3));
    desc.empty_bonus = 0.2f;
    desc.progress = [](void*, float) -> int32_t { return 1; };
    expect_refused(rt_commit_scene(scene(), &desc, nullptr), RT_ERROR_CANCELLED, "cancelled");
    desc.progress = [](void*, float) -> int32_t { throw 1; };
    expect_refused(rt_commit_scene(scene(), &desc, nullptr), RT_ERROR_INTERNAL, "callback");
    ASSERT_OK(move_lift(*world_, 1));
}

} // namespace
} // namespace peregrine::test
