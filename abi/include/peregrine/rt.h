/* Peregrine: a real-time CPU ray tracing engine for games.
 *
 * This header is the whole interface of the library. It is plain C11 and valid C++.
 *
 * The way of the data:
 *     describe (rt_add_*, rt_update_*, rt_remove_*)  ->  rt_commit_scene  ->  a frozen snapshot
 *     snapshot  ->  rt_trace_query, rt_sweep_shapes, rt_overlap_shapes, rt_find_nearest,
 *                   rt_resolve_hits, rt_resolve_surfaces, rt_render_frame
 * What was described after the last commit is invisible to queries and frames until the next one.
 *
 * Units: metres, radians, linear RGB radiance. Right-handed, Y up, front faces counter-clockwise.
 * A ray's t is measured in lengths of its direction, which need not be normalised.
 *
 * Ownership: every pointer is borrowed for the duration of the call; the library copies what it
 * keeps. Every array comes with a count and a stride in bytes (0: tightly packed), needs no
 * alignment, and no byte beyond the last element is read.
 *
 * Threads: calls that describe or commit one scene are the host's to serialise. Queries and frames
 * run at any time, from any thread, also while the scene is described or committed; each call
 * works on the snapshot that was current when it began, or on a held one. rt_destroy_scene must not
 * overlap with any other call on that scene. Different scenes never interfere.
 *
 * Errors: every call that can fail returns an rt_result. RT_OK is 0. After anything else, the
 * state is as it was before the call, no output was written, and rt_get_last_error() gives this
 * thread's sentence about the cause. The library throws nothing, prints nothing, installs no
 * signal handler and leaves the floating-point environment alone; it expects the default one (round
 * to nearest, denormals not flushed).
 *
 * Versions: a struct that begins with struct_size may grow at its end. The rt_default_* functions
 * below fill in the size that your program was compiled with; fields that your header does not
 * know read as zero in a newer library, and zero always means what the library did before.
 */
#ifndef PEREGRINE_RT_H
#define PEREGRINE_RT_H

#include <stdint.h>
#include <string.h>

#define RT_API_VERSION 1u

#if defined(_WIN32)
#if defined(PEREGRINE_BUILD)
#define RT_EXPORT __declspec(dllexport)
#else
#define RT_EXPORT __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define RT_EXPORT __attribute__((visibility("default")))
#else
#define RT_EXPORT
#endif

#if defined(__cplusplus)
#define RT_NOEXCEPT noexcept
extern "C" {
#else
#define RT_NOEXCEPT
#endif

/* ------------------------------------------------------------------------------------ results */

typedef int32_t rt_result;
enum {
    RT_OK = 0,
    RT_ERROR_INVALID_ARGUMENT = 1, /* null pointer, NaN, unknown constant, contradictory fields */
    RT_ERROR_INVALID_HANDLE = 2,   /* null, stale or foreign handle */
    RT_ERROR_INVALID_STRUCT = 3,   /* struct_size is no size that this struct ever had */
    RT_ERROR_LIMIT = 4,            /* a count or a size beyond what the library supports */
    RT_ERROR_OUT_OF_MEMORY = 5,    /* an allocation failed */
    RT_ERROR_CANCELLED = 6,        /* the progress callback asked to stop */
    RT_ERROR_NOT_COMMITTED = 7,    /* the scene has no snapshot yet */
    RT_ERROR_UNSUPPORTED = 8,      /* this machine or this build cannot do it */
    RT_ERROR_INTERNAL = 9          /* a defect of the library: please report the sentence */
};

/* The sentence for the last failed call of this thread; "" if none failed yet. Never null. Valid
 * until the next failing call of this thread. Thread safety: any thread, any time. */
RT_EXPORT const char* rt_get_last_error(void) RT_NOEXCEPT;

/* "RT_OK", "RT_ERROR_LIMIT", ...; "unknown rt_result" for any other number. Static storage.
 * Thread safety: any thread, any time. */
RT_EXPORT const char* rt_get_result_name(rt_result result) RT_NOEXCEPT;

/* "major.minor.patch" of the library. Static storage. Thread safety: any thread, any time. */
RT_EXPORT const char* rt_get_version_string(void) RT_NOEXCEPT;

/* ------------------------------------------------------------------------------------ handles */

/* Small values, copied freely. All zero is the null handle. A handle whose object was removed is
 * stale: calls refuse it. Handles of one scene mean nothing to another. */
typedef struct rt_scene {
    uint32_t index, generation;
} rt_scene;
typedef struct rt_mesh {
    uint32_t index, generation;
} rt_mesh;
typedef struct rt_material {
    uint32_t index, generation;
} rt_material;
typedef struct rt_texture {
    uint32_t index, generation;
} rt_texture;
typedef struct rt_light {
    uint32_t index, generation;
} rt_light;
typedef struct rt_program {
    uint32_t index, generation;
} rt_program;
typedef struct rt_snapshot {
    uint32_t index, generation;
} rt_snapshot;

/* ---------------------------------------------------------------------------- the host's side */

/* Memory. Both functions are called from any thread that the library runs on. `allocate` returns
 * null when it cannot; `alignment` is a power of two. `deallocate` gets the size and alignment of
 * the allocation back. */
typedef struct rt_allocator {
    void* user;
    void* (*allocate)(void* user, uint64_t size, uint64_t alignment);
    void (*deallocate)(void* user, void* memory, uint64_t size, uint64_t alignment);
} rt_allocator;

/* Threads. `run` calls task(task_data, i) once for every i < task_count, in any order, on any
 * threads, and returns when all calls have returned. No task waits for another, so running them
 * one after the other on the calling thread is allowed. `concurrency` is the number of threads
 * that `run` normally reaches, at least 1. `run` may be called from several threads at a time. */
typedef void (*rt_task_function)(void* task_data, uint32_t task_index);
typedef struct rt_scheduler {
    void* user;
    void (*run)(void* user, uint32_t task_count, rt_task_function task, void* task_data);
    uint32_t concurrency;
    uint32_t reserved; /* 0 */
} rt_scheduler;

typedef int32_t rt_log_level;
enum { RT_LOG_INFO = 0, RT_LOG_WARNING = 1, RT_LOG_ERROR = 2 };
typedef void (*rt_log_function)(void* user, rt_log_level level, const char* message);

/* -------------------------------------------------------------------------------------- scene */

/* The instruction set that the kernels of a scene use. Every choice gives the same bits. */
typedef int32_t rt_isa;
enum {
    RT_ISA_BEST = 0,
    RT_ISA_SSE4 = 1,
    RT_ISA_AVX2 = 2,
    RT_ISA_AVX512 = 3,
    RT_ISA_SCALAR = 4,
    RT_ISA_NEON = 5
};

typedef struct rt_scene_desc {
    uint32_t struct_size;
    uint32_t
        worker_count;       /* threads that work on a commit or frame, the calling one included:
                               0 and 1 create none. Ignored when `scheduler.run` is set. At most 256. */
    rt_allocator allocator; /* both functions null: the C++ runtime's */
    rt_scheduler scheduler; /* run null: the library's own pool of worker_count - 1 threads */
    rt_log_function log;    /* null: silence. Called from the thread that commits. */
    void* log_user;
    rt_isa isa;        /* RT_ISA_BEST unless you compare */
    uint32_t reserved; /* 0 */
} rt_scene_desc;

static inline rt_scene_desc rt_default_scene_desc(void) {
    rt_scene_desc desc;
    memset(&desc, 0, sizeof desc);
    desc.struct_size = (uint32_t)sizeof desc;
    return desc;
}

/* Creates an empty scene. Errors: INVALID_ARGUMENT (half an allocator), INVALID_STRUCT, LIMIT (more
 * than 1024 scenes, more than 256 workers), UNSUPPORTED (an instruction set that this machine
 * lacks), OUT_OF_MEMORY. Thread safety: any thread, any time. */
RT_EXPORT rt_result rt_create_scene(const rt_scene_desc* desc, rt_scene* out_scene) RT_NOEXCEPT;

/* Frees the scene and everything in it, and joins its threads. Thread safety: not while another
 * call on this scene runs. */
RT_EXPORT rt_result rt_destroy_scene(rt_scene scene) RT_NOEXCEPT;

/* The point that the float coordinates of static and dynamic meshes are relative to; (0, 0, 0)
 * until it is set. Whatever is a double (transforms, lights, cameras, origins of queries, resolved
 * positions) is absolute. A level that lies 10,000 km away keeps its vertices small, puts the world
 * origin there, and gets the answers of a level at (0, 0, 0). Seen after the next commit. Errors:
 * INVALID_HANDLE, INVALID_ARGUMENT (null, a component not finite or beyond 1e30). */
RT_EXPORT rt_result rt_set_world_origin(rt_scene scene, const double* origin) RT_NOEXCEPT;

/* ----------------------------------------------------------------------------------- textures */

typedef int32_t rt_pixel_format;
enum {
    RT_FORMAT_RGBA8_SRGB = 0, /* 4 bytes; colour is sRGB-encoded, alpha linear */
    RT_FORMAT_BGRA8_SRGB = 1,
    RT_FORMAT_RGBA8_LINEAR = 2, /* 4 bytes, for normal maps and other data. Textures only. */
    RT_FORMAT_RGBA16F = 3,      /* 8 bytes, IEEE half floats. Frames only. */
    RT_FORMAT_RGBA32F = 4       /* 16 bytes */
};

typedef int32_t rt_wrap;
enum { RT_WRAP_REPEAT = 0, RT_WRAP_MIRROR = 1, RT_WRAP_CLAMP = 2 };

typedef int32_t rt_filter;
enum { RT_FILTER_BILINEAR = 0, RT_FILTER_NEAREST = 1 };

typedef struct rt_texture_desc {
    uint32_t struct_size;
    rt_pixel_format format; /* RGBA8_SRGB, BGRA8_SRGB, RGBA8_LINEAR or RGBA32F */
    const void* pixels;     /* height rows of width pixels; row 0 is at v = 0 */
    uint64_t row_stride;    /* bytes from row to row; 0: tightly packed */
    uint32_t width, height; /* 1 to 32768 each */
    rt_wrap wrap_u, wrap_v;
    rt_filter filter;
    uint32_t reserved; /* 0 */
} rt_texture_desc;

static inline rt_texture_desc rt_default_texture_desc(void) {
    rt_texture_desc desc;
    memset(&desc, 0, sizeof desc);
    desc.struct_size = (uint32_t)sizeof desc;
    return desc;
}

/* Copies the pixels. Filtering happens in linear light. Frames with RT_TEXTURE_MIPMAPS look at
 * smaller copies, too, which are made here, each half as wide and high as the one before, and take
 * a third more bytes. In these, colours count as much as their alpha says: what a mask cuts out
 * does not stain its border. A texture whose alpha means nothing should have it at 1. */
RT_EXPORT rt_result rt_add_texture(rt_scene scene, const rt_texture_desc* desc,
                                   rt_texture* out_texture) RT_NOEXCEPT;

/* The handle is stale at once; snapshots that use the texture keep it. Materials that name it are
 * refused by the next commit with a sentence. */
RT_EXPORT rt_result rt_remove_texture(rt_scene scene, rt_texture texture) RT_NOEXCEPT;

/* ------------------------------------------------------------------------- programs of the host */

/* What a program wants to know of a hit, and RT_PROGRAM_RAYS, if it may ask for rays. What it does
 * not ask for is not computed: a program without RT_PROGRAM_DIFFUSE and RT_PROGRAM_HIGHLIGHT has no
 * shadow rays traced for it, unless light is found in blocks. */
enum {
    RT_PROGRAM_POSITION = 1u << 0,
    RT_PROGRAM_GEOMETRIC_NORMAL = 1u << 1,
    RT_PROGRAM_SHADING_NORMAL = 1u << 2,
    RT_PROGRAM_DIRECTION = 1u << 3,
    RT_PROGRAM_DISTANCE = 1u << 4,
    RT_PROGRAM_FOOTPRINT = 1u << 5,
    RT_PROGRAM_TEXCOORD = 1u << 6,
    RT_PROGRAM_BARYCENTRICS = 1u << 7,
    RT_PROGRAM_IDS = 1u << 8,
    RT_PROGRAM_BACK_FACE = 1u << 9,
    RT_PROGRAM_USER_DATA = 1u << 10,
    RT_PROGRAM_BASE_COLOR = 1u << 11,
    RT_PROGRAM_EMISSIVE = 1u << 12,
    RT_PROGRAM_DIFFUSE = 1u << 13,
    RT_PROGRAM_HIGHLIGHT = 1u << 14,
    RT_PROGRAM_OPENNESS = 1u << 15,
    RT_PROGRAM_RAYS = 1u << 16
};

/* Hits of one program, as separate arrays with an element for each; null where the program did not
 * ask for the field. Arrays begin at multiples of 64 bytes and have padded_count elements, those
 * beyond `count` like the last one: a program may compute all of them, in vectors of up to 16. What
 * it says of those counts for nothing. The arrays are the library's, and the program's to use until
 * it returns. */
typedef struct rt_program_batch {
    uint32_t struct_size;  /* of the library's header */
    uint32_t count;        /* of hits, >= 1 */
    uint32_t padded_count; /* `count` rounded up to a multiple of 16 */
    uint32_t reserved;
    const float* position[3]; /* metres from the world's origin (rt_set_world_origin); where rays
                                 begin, a rounding error above the surface */
    const float* geometric_normal[3]; /* unit; to the side that is seen */
    const float* shading_normal[3];   /* unit; interpolated, with the normal map */
    const float* direction[3];        /* unit; the way of the ray that sees the hit */
    const float* distance;            /* metres from the eye, along all bounces */
    const float* footprint;   /* metres that a pixel covers across that way; finer patterns glitter.
                                 0 with RT_TEXTURE_FINEST */
    const float* texcoord[2]; /* of the first set, without any transform */
    const float* barycentric[2];    /* u and v, as in rt_hit */
    const uint32_t* triangle;       /* as in rt_hit; of RT_PROGRAM_IDS, with ... */
    const rt_mesh* mesh;            /* ... this */
    const uint32_t* back_face;      /* 0 or 1 */
    const uint64_t* mesh_user_data; /* of RT_PROGRAM_USER_DATA, with ... */
    const uint64_t* material_user_data;
    const float* base_color[3]; /* of the material, times its texture */
    const float* emissive[3];
    /* The light that arrives. A material without a program, mirror and glass shows the radiance
     * base_color * diffuse + highlight + emissive, to the bit. */
    const float* diffuse[3];   /* radiance of a white matt surface: lamps, and the ambient light */
    const float* highlight[3]; /* radiance that `specular` and `shininess` make of lamps */
    const float* openness;     /* the part of the ambient light that arrives, which `diffuse` has; 1
                                  without ambient occlusion */
    /* What the program writes; all zeros before it does. */
    float* radiance[3]; /* linear RGB toward the ray's origin, >= 0 */
    /* With RT_PROGRAM_RAYS, else null: one ray from each hit, whose radiance times the weight is
     * added. It begins on the side of the surface that it points to, and may go through. A weight
     * of 0 is no ray. It is traced together with those of mirrors, within max_depth and
     * least_importance of the frame; what is not traced brings the ambient light. */
    float* ray_direction[3]; /* of any length but 0 */
    float* ray_weight[3];    /* >= 0; 1 is the most that counts */
} rt_program_batch;

/* A shading program: says what the hits of its materials show. It is called by the threads that
 * work on a frame, several at a time, with batches that depend on the tiles of the picture. So what
 * it says of a hit must follow from the fields of that hit alone and from data that stay as they
 * are during frames. If it computes with +, -, *, / and square roots in float or double, without
 * contraction, frames have the same bits on every machine. It must not throw, must not call the
 * library, and must leave the floating-point environment as it is. */
typedef void (*rt_program_function)(void* user, const rt_program_batch* batch);

typedef struct rt_program_desc {
    uint32_t struct_size;
    uint32_t fields; /* RT_PROGRAM_* */
    rt_program_function shade;
    void* user; /* handed to it */
} rt_program_desc;

static inline rt_program_desc rt_default_program_desc(void) {
    rt_program_desc desc;
    memset(&desc, 0, sizeof desc);
    desc.struct_size = (uint32_t)sizeof desc;
    return desc;
}

/* Adds a program, for rt_material_desc.program. Its code and what `user` points to must last as
 * long as snapshots whose materials have it: until no frame of one runs, none is held, and a later
 * commit has been made or the scene is destroyed. Errors: INVALID_ARGUMENT (null, unknown bits of
 * `fields`), INVALID_HANDLE, INVALID_STRUCT, OUT_OF_MEMORY. */
RT_EXPORT rt_result rt_add_program(rt_scene scene, const rt_program_desc* desc,
                                   rt_program* out_program) RT_NOEXCEPT;

/* The handle is stale at once; snapshots that use the program keep it. Errors: INVALID_HANDLE,
 * INVALID_ARGUMENT (a material that is not removed has it). */
RT_EXPORT rt_result rt_remove_program(rt_scene scene, rt_program program) RT_NOEXCEPT;

/* ---------------------------------------------------------------------------------- materials */

typedef int32_t rt_alpha_mode;
enum {
    RT_ALPHA_OPAQUE = 0, /* alpha is ignored */
    RT_ALPHA_MASK = 1,   /* the surface is absent where alpha < alpha_cutoff */
    RT_ALPHA_BLEND = 2   /* alpha is how much of what is behind the surface covers, in frames with a
                            max_depth, unless it is the hull of a solid. Of its shadow see
                            rt_frame_desc.tinted_shadows. Queries see all of it */
};

/* A texture as a material uses it: (u', v') = (m[0] u + m[1] v + m[2], m[3] u + m[4] v + m[5]).
 * texcoord_set chooses rt_mesh_desc.texcoords (0) or texcoords1 (1). */
typedef struct rt_texture_use {
    rt_texture texture; /* null: none */
    float transform[6];
    uint32_t texcoord_set;
    uint32_t reserved; /* 0 */
} rt_texture_use;

typedef struct rt_material_desc {
    uint32_t struct_size;
    rt_alpha_mode alpha_mode;
    float base_color[4]; /* linear; multiplies the texture. Components >= 0, finite. */
    float emissive[3];   /* linear radiance, >= 0; may exceed 1 */
    float alpha_cutoff;
    float specular[3];     /* linear reflectance of the highlight, >= 0 */
    float shininess;       /* exponent n >= 1 of Schlick's rational highlight */
    float normal_scale;    /* scales x and y of the normal map */
    uint32_t double_sided; /* 0 or 1. 0: frames do not show back faces; shadows and queries see both
                              sides */
    rt_texture_use base_color_texture;
    rt_texture_use normal_texture; /* tangent space, +Y up, stored as 0.5 n + 0.5 */
    rt_texture_use emissive_texture;
    uint64_t user_data; /* handed back by rt_resolve_hits */
    /* What follows shows in frames with a max_depth. docs/rendering.md has the formulas. */
    float reflectivity; /* 0 to 1: the part of the light that a mirror gives back head on, and all
                           of it at a glance (Schlick); 0: no mirror, at no angle */
    float reflection_color[3]; /* 0 to 1: times reflectivity */
    float
        transmission; /* 0 to 1: the part of what is not mirrored that goes through, tinted by the
                         base colour; the rest is matt. Such a surface mirrors by its index, too */
    float index_of_refraction;  /* 1 to 10; 0: 1.5 */
    float attenuation_color[3]; /* 0 to 1: what is left of white light after ... */
    float attenuation_distance; /* ... so many metres within; >= 0; 0: all of it */
    uint32_t thin; /* 0: what transmits is the hull of a solid, which bends light, and both sides of
                      the hull are seen. 1: a sheet, a window pane: light goes straight on */
    uint32_t reserved;  /* 0 */
    rt_program program; /* null: none. Else what the surface shows is what the program says, and
                           reflectivity and transmission must be 0: it asks for rays itself. Masks
                           cut out, and RT_ALPHA_BLEND scales all that it says by alpha */
    /* Numbers, not colours: textures of a linear format. glTF keeps both in one image. */
    rt_texture_use occlusion_texture; /* red: the part of the ambient light that arrives */
    rt_texture_use roughness_texture; /* green: roughness, blue: metalness. With it `shininess` is
                                         not read; `specular` is the reflectance of what is not
                                         metal, base_color that of metals */
    float occlusion_strength;         /* 0 to 1: ambient light times 1 + strength (red - 1) */
    float roughness;                  /* 0 to 1: times green, and ... */
    float metalness;                  /* ... times blue; both without meaning without the texture */
    uint32_t reserved2;               /* 0 */
} rt_material_desc;

static inline rt_texture_use rt_default_texture_use(void) {
    rt_texture_use use;
    memset(&use, 0, sizeof use);
    use.transform[0] = use.transform[4] = 1.0f;
    return use;
}

static inline rt_material_desc rt_default_material_desc(void) {
    rt_material_desc desc;
    memset(&desc, 0, sizeof desc);
    desc.struct_size = (uint32_t)sizeof desc;
    desc.base_color[0] = desc.base_color[1] = desc.base_color[2] = desc.base_color[3] = 1.0f;
    desc.alpha_cutoff = 0.5f;
    desc.shininess = 32.0f;
    desc.normal_scale = 1.0f;
    desc.base_color_texture = rt_default_texture_use();
    desc.normal_texture = rt_default_texture_use();
    desc.emissive_texture = rt_default_texture_use();
    desc.reflection_color[0] = desc.reflection_color[1] = desc.reflection_color[2] = 1.0f;
    desc.index_of_refraction = 1.5f;
    desc.attenuation_color[0] = desc.attenuation_color[1] = desc.attenuation_color[2] = 1.0f;
    desc.occlusion_texture = rt_default_texture_use();
    desc.roughness_texture = rt_default_texture_use();
    desc.occlusion_strength = desc.roughness = desc.metalness = 1.0f;
    return desc;
}

RT_EXPORT rt_result rt_add_material(rt_scene scene, const rt_material_desc* desc,
                                    rt_material* out_material) RT_NOEXCEPT;
RT_EXPORT rt_result rt_update_material(rt_scene scene, rt_material material,
                                       const rt_material_desc* desc) RT_NOEXCEPT;
/* Meshes that name a removed material show the default one from the next commit on. */
RT_EXPORT rt_result rt_remove_material(rt_scene scene, rt_material material) RT_NOEXCEPT;

/* ------------------------------------------------------------------------------------- meshes */

/* `count` elements, `stride` bytes apart (0: tightly packed; otherwise at least an element). */
typedef struct rt_array {
    const void* data; /* null with count 0: absent */
    uint64_t count;
    uint32_t stride;
    uint32_t reserved; /* 0 */
} rt_array;

typedef int32_t rt_index_type;
enum {
    RT_INDEX_UINT32 = 0,
    RT_INDEX_UINT16 = 1,
    RT_INDEX_NONE = 2 /* no indices: vertices 3i, 3i+1, 3i+2 are triangle i */
};

/* Normals, tangents and texture coordinates that are not finite count as zero; where a normal is
 * zero, the face's own serves. */
typedef struct rt_mesh_desc {
    uint32_t struct_size;
    rt_index_type index_type;
    rt_array positions; /* float[3]: required */
    rt_array normals;   /* float[3], one a vertex: optional, the face normal otherwise */
    rt_array tangents;  /* float[4], one a vertex, w = +1 or -1: optional, derived from texcoords */
    rt_array texcoords; /* float[2], one a vertex: optional, (0, 0) otherwise */
    rt_array texcoords1;  /* float[2], the second set */
    rt_array indices;     /* single indices, three a triangle; absent with RT_INDEX_NONE */
    rt_array materials;   /* rt_material, one a triangle: optional; a null one means `material` */
    rt_material material; /* of triangles without one; null: white, double-sided */
    uint32_t layer_mask;  /* queries see the mesh when (layer_mask & query mask) != 0 */
    uint32_t reserved;    /* 0 */
    uint64_t user_data;   /* handed back by rt_resolve_hits */
} rt_mesh_desc;

static inline rt_mesh_desc rt_default_mesh_desc(void) {
    rt_mesh_desc desc;
    memset(&desc, 0, sizeof desc);
    desc.struct_size = (uint32_t)sizeof desc;
    desc.layer_mask = 0xffffffffu;
    return desc;
}

/* Adds a mesh whose shape stays as it is. Triangles with a vertex that is not finite or larger than
 * 1e30 in magnitude, and triangles without area, are kept out of the snapshot and counted in the
 * commit report; the others keep their indices. Errors: INVALID_ARGUMENT (null or missing arrays, a
 * stride below an element, counts that do not match, an index out of range, which is named),
 * LIMIT (more than 2^27 triangles or 2^30 vertices), OUT_OF_MEMORY. All static meshes share one
 * structure; the next commit builds it anew. */
RT_EXPORT rt_result rt_add_static_mesh(rt_scene scene, const rt_mesh_desc* desc,
                                       rt_mesh* out_mesh) RT_NOEXCEPT;

/* Adds a mesh whose vertices will move (rt_update_dynamic_mesh): a character, a flag. Each has a
 * structure of its own. A commit builds it anew if this mesh was updated, in a time that depends on
 * the triangles of this mesh alone. Errors as above. */
RT_EXPORT rt_result rt_add_dynamic_mesh(rt_scene scene, const rt_mesh_desc* desc,
                                        rt_mesh* out_mesh) RT_NOEXCEPT;

/* New vertices for a dynamic mesh; the counts are those of the mesh. An array that is absent stays
 * as it was. Seen by queries and frames after the next commit. */
typedef struct rt_mesh_update {
    uint32_t struct_size;
    uint32_t reserved; /* 0 */
    rt_array positions;
    rt_array normals;
    rt_array tangents;
} rt_mesh_update;

static inline rt_mesh_update rt_default_mesh_update(void) {
    rt_mesh_update update;
    memset(&update, 0, sizeof update);
    update.struct_size = (uint32_t)sizeof update;
    return update;
}

RT_EXPORT rt_result rt_update_dynamic_mesh(rt_scene scene, rt_mesh mesh,
                                           const rt_mesh_update* update) RT_NOEXCEPT;

/* Adds a mesh that moves as a whole (rt_set_mesh_transform): a door, a crate, a gun. Its structure
 * is built once, by the next commit; moving it costs the same for ten triangles as for a million.
 * It stands where its vertices are until it is moved. Errors as above. */
RT_EXPORT rt_result rt_add_rigid_mesh(rt_scene scene, const rt_mesh_desc* desc,
                                      rt_mesh* out_mesh) RT_NOEXCEPT;

/* Adds another mesh with the shape of a rigid one, and shares its memory. It starts with the
 * transform, layer mask and user data of that mesh, and from then on is a mesh of its own, in hits
 * too; either may be removed first. Errors: INVALID_HANDLE, INVALID_ARGUMENT (not a rigid mesh),
 * OUT_OF_MEMORY. */
RT_EXPORT rt_result rt_add_mesh_instance(rt_scene scene, rt_mesh mesh,
                                         rt_mesh* out_mesh) RT_NOEXCEPT;

/* Where a mesh stands: p' = (m[0] x + m[1] y + m[2] z + m[3],
 *                            m[4] x + m[5] y + m[6] z + m[7],
 *                            m[8] x + m[9] y + m[10] z + m[11]), any invertible affine map.
 * Rays and shapes are taken before the mesh in double (record, rt_query_options.origin, camera),
 * and rounded to float in its own space, so a mesh keeps its precision wherever it stands, as long
 * as they are told relative to a point near it. Front faces stay front faces under a mirroring map.
 */
typedef struct rt_transform {
    double m[12];
} rt_transform;

static inline rt_transform rt_default_transform(void) {
    rt_transform transform;
    memset(&transform, 0, sizeof transform);
    transform.m[0] = transform.m[5] = transform.m[10] = 1.0;
    return transform;
}

/* Seen by queries and frames after the next commit. Errors: INVALID_HANDLE, INVALID_ARGUMENT (not a
 * rigid mesh; an element that is not finite or beyond 1e30; a map that has no inverse or stretches
 * one direction 1e9 times as much as another). */
RT_EXPORT rt_result rt_set_mesh_transform(rt_scene scene, rt_mesh mesh,
                                          const rt_transform* transform) RT_NOEXCEPT;

/* Replaces rt_mesh_desc.layer_mask. Any kind of mesh; seen after the next commit. */
RT_EXPORT rt_result rt_set_mesh_layer_mask(rt_scene scene, rt_mesh mesh,
                                           uint32_t layer_mask) RT_NOEXCEPT;

/* Replaces rt_mesh_desc.user_data, or what an instance took over from the mesh that it was made of.
 * Any kind of mesh; seen after the next commit. Errors: INVALID_HANDLE. */
RT_EXPORT rt_result rt_set_mesh_user_data(rt_scene scene, rt_mesh mesh,
                                          uint64_t user_data) RT_NOEXCEPT;

/* A hidden mesh (1) is in no query and no frame from the next commit on, until it is shown (0)
 * again. Hiding or showing a static mesh makes the next commit build the static structure anew. */
RT_EXPORT rt_result rt_set_mesh_hidden(rt_scene scene, rt_mesh mesh, uint32_t hidden) RT_NOEXCEPT;

/* The handle is stale at once; the snapshot shows the mesh until the next commit. */
RT_EXPORT rt_result rt_remove_mesh(rt_scene scene, rt_mesh mesh) RT_NOEXCEPT;

/* --------------------------------------------------------------------- lights and environment */

typedef int32_t rt_light_type;
enum { RT_LIGHT_POINT = 0, RT_LIGHT_SPOT = 1, RT_LIGHT_DIRECTIONAL = 2 };

/* How the light of a point or a spot fades with the distance d, in metres: a surface that faces it
 * gets E = intensity * f(d) lux, with R = radius and x = d / R, and none from d = R on. In a cone's
 * rim a spot gives the part s^2 (3 - 2 s) of that, with c the cosine of the angle from `direction`
 * and s = (c - cone_outer_cos) / (cone_inner_cos - cone_outer_cos). A surface at an angle gets E
 * times the cosine between its normal and the way to the light; a directional light gives
 * E = intensity times that cosine everywhere. Of E, and of the ambient radiance L of the
 * environment, a matt surface of reflectance rho sends out the radiance rho * (L + E / pi).
 *
 * An inverse square is what candela mean: 3 cd light a wall at 1 m by 3 lux. It stops
 * growing at 1e20 lux. The other three are Arauna's. For x from 0.1 to 0.8 they are within a
 * factor, given below, of 1 / d^2; nearer they are far too dark. Their candela depend on the
 * radius. docs/light.md has the table. */
typedef int32_t rt_falloff;
enum {
    RT_FALLOFF_SCHLICK_LINEAR = 0, /* 93.01 (1 - x)^2 / (1 + 4.47 x) / R^2: factor 1.93. Of hosts
                                      that were compiled before there was a choice */
    RT_FALLOFF_LINEAR = 1,         /* 27.386 (1 - x) / R^2: factor 4.06 */
    RT_FALLOFF_COSINE_LINEAR = 2,  /* 42.054 cos^2(pi x / 2) (1 - x) / R^2: factor 2.71 */
    RT_FALLOFF_WINDOWED_INVERSE_SQUARE = 3, /* (1 - x^4) / d^2, as glTF's KHR_lights_punctual */
    RT_FALLOFF_INVERSE_SQUARE = 4           /* 1 / d^2, with a step at R */
};

typedef struct rt_light_desc {
    uint32_t struct_size;
    rt_light_type type;
    double position[3];   /* point, spot */
    float direction[3];   /* spot, directional: the way the light travels; any length but zero */
    float radius;         /* point, spot: the light ends here, in metres; > 0. +infinity, of the
                             inverse squares: it has no end, and no part of a frame is spared it */
    float intensity[3];   /* linear RGB, >= 0; candela (point, spot) or lux (directional) */
    float cone_inner_cos; /* spot: full inside this angle, ... */
    float cone_outer_cos; /* ... none outside this one; -1 <= outer <= inner <= 1 */
    uint32_t casts_no_shadow; /* 0 or 1; 0: shadows are traced */
    rt_falloff falloff;       /* point, spot */
    uint32_t shadow_samples;  /* of a penumbra, at most 256; 0: 16. See source_radius */
    float source_radius; /* the light is a sphere, whose shadows are soft: its radius in metres,
                            or, of a directional one, that of its disc at a distance of 1 m
                            (the sun: 0.00465). 0: a point, whose shadows are sharp. Where all of
                            the sphere or nothing of it is seen, 6 rays tell so */
    float fog_scatter;   /* point, spot of a finite radius: the part of the fog's extinction that
                            scatters this light, evenly all around; 0 to 1. So one sees a spot's
                            cone, and a halo about a point. 0: its light goes through fog unseen */
} rt_light_desc;

static inline rt_light_desc rt_default_light_desc(void) {
    rt_light_desc desc;
    memset(&desc, 0, sizeof desc);
    desc.struct_size = (uint32_t)sizeof desc;
    desc.direction[1] = -1.0f;
    desc.radius = 10.0f;
    desc.intensity[0] = desc.intensity[1] = desc.intensity[2] = 1.0f;
    desc.cone_inner_cos = 1.0f;
    desc.cone_outer_cos = 0.70710678f;
    desc.falloff = RT_FALLOFF_WINDOWED_INVERSE_SQUARE;
    return desc;
}

RT_EXPORT rt_result rt_add_light(rt_scene scene, const rt_light_desc* desc,
                                 rt_light* out_light) RT_NOEXCEPT;
RT_EXPORT rt_result rt_update_light(rt_scene scene, rt_light light,
                                    const rt_light_desc* desc) RT_NOEXCEPT;
RT_EXPORT rt_result rt_remove_light(rt_scene scene, rt_light light) RT_NOEXCEPT;

/* What rays see that leave the scene: those of the camera, and those that mirrors and glass send
 * on. It gives no light: `ambient` does. */
typedef int32_t rt_sky;
enum {
    RT_SKY_NONE = 0,     /* `background` everywhere */
    RT_SKY_GRADIENT = 1, /* h = the direction's height, -1 to 1. Upward, h (2 - h) of `zenith` and
                            the rest of `horizon`; downward, min(-8 h, 1) of `ground` */
    RT_SKY_TEXTURE = 2 /* an equirectangular image: row 0 is up (+Y), its middle column -Z, what is
                          right of that +X. It repeats around as its wrap_u says */
};

typedef struct rt_environment {
    uint32_t struct_size;
    float ambient[3];    /* radiance that reaches every surface from everywhere, >= 0 */
    float background[3]; /* radiance of rays that leave the scene */
    uint32_t reserved;   /* 0 */
    rt_sky sky;
    float zenith[3]; /* radiance, >= 0 */
    float horizon[3];
    float ground[3];
    rt_texture sky_texture; /* a commit is refused once it was removed */
    float sky_intensity;    /* times the sky's radiance, >= 0 */
    float sky_rotation;     /* of the image about +Y, in radians, counter-clockwise from above */
} rt_environment;

static inline rt_environment rt_default_environment(void) {
    rt_environment environment;
    memset(&environment, 0, sizeof environment);
    environment.struct_size = (uint32_t)sizeof environment;
    environment.ambient[0] = environment.ambient[1] = environment.ambient[2] = 0.1f;
    environment.sky_intensity = 1.0f;
    return environment;
}

/* Errors: INVALID_ARGUMENT, INVALID_HANDLE (the texture of RT_SKY_TEXTURE), INVALID_STRUCT. */
RT_EXPORT rt_result rt_set_environment(rt_scene scene,
                                       const rt_environment* environment) RT_NOEXCEPT;

/* A horizontal layer of fog. Of light that goes d metres through it at its densest, exp(-density d)
 * is left, and the rest is the fog's own colour. Frames see it on the way from the eye and on that
 * of every bounce, but not in solids of glass; queries do not. Lamps shine through it undimmed;
 * those with a fog_scatter are seen in it: L more radiance, with T what is left on the way from
 * there to the eye, k the fog's density there and E a lamp's lux at a surface that faces it,
 *     L = the integral of T k fog_scatter E / (4 pi)
 * along each way. Ways that come nearer to a lamp than 1 / 1024 of its radius, or than its
 * source_radius, get what they would get there. */
typedef struct rt_fog {
    uint32_t struct_size;
    float density;  /* per metre, >= 0; 0: there is none */
    double top;     /* y of where it ends, ... */
    double bottom;  /* ... and of where it gets thinner, evenly up to the top; <= top. Below it goes
                       on for ever */
    float color[3]; /* radiance of fog that hides everything, >= 0 */
    uint32_t reserved; /* 0 */
} rt_fog;

static inline rt_fog rt_default_fog(void) {
    rt_fog fog;
    memset(&fog, 0, sizeof fog);
    fog.struct_size = (uint32_t)sizeof fog;
    fog.density = 0.1f;
    fog.top = 2.0;
    fog.color[0] = fog.color[1] = fog.color[2] = 0.2f;
    return fog;
}

/* Seen by frames after the next commit; before the first call there is none. Errors:
 * INVALID_HANDLE, INVALID_STRUCT, INVALID_ARGUMENT. */
RT_EXPORT rt_result rt_set_fog(rt_scene scene, const rt_fog* fog) RT_NOEXCEPT;

/* ------------------------------------------------------------------------------------- commit */

/* Called now and then from the thread that commits, with the fraction done, 0 to 1, not falling.
 * Return 0 to go on; anything else cancels. */
typedef int32_t (*rt_progress_function)(void* user, float fraction);

/* The structure that rays are traced through. It changes the speed and the memory, not the answers.
 */
typedef int32_t rt_structure;
enum {
    RT_STRUCTURE_AUTO = 0, /* what is fastest: the BVH */
    RT_STRUCTURE_BVH = 1,
    RT_STRUCTURE_KDTREE = 2,
    RT_STRUCTURE_BIH = 3 /* builds quickly, traces one ray at a time */
};

/* How long to build for how much speed. The kd-tree has one quality, the BIH two: fast and the
 * rest. */
typedef int32_t rt_build_quality;
enum {
    RT_BUILD_BALANCED = 0,
    RT_BUILD_FAST = 1, /* for geometry that lives a few frames */
    RT_BUILD_BEST = 2  /* for levels that are built once */
};

/* How much memory the structure of the static meshes may take, and of those rigid meshes that the
 * commit builds. It changes the speed and the memory, not the answers. The kd-tree and the BIH have
 * one size. */
typedef int32_t rt_memory;
enum {
    RT_MEMORY_FULL = 0,   /* what is fastest: the BVH takes 58 to 72 bytes a triangle in levels */
    RT_MEMORY_COMPACT = 1 /* the BVH in a good half of that; rays one by one pay most for it */
};

/* Proofs of light: which static triangles see which lights. What is proved once is not traced
 * again: frames get faster, and stay the same bits. What moves, and what was not proved, is traced
 * as ever. */
typedef int32_t rt_light_proofs;
enum {
    RT_LIGHT_PROOFS_KEPT =
        0,                   /* what was proved before and still holds is used; nothing is proved */
    RT_LIGHT_PROOFS_MADE = 1 /* lights that are new, or stand where the last commit saw them, are
                                proved: 0.1 to 10 s for a level; for the commit that loads it */
};

typedef struct rt_commit_desc {
    uint32_t struct_size;
    float
        empty_bonus; /* 0 to 1: the SAH cost of a kd-tree split that cuts off empty space is
                        multiplied by 1 - empty_bonus (Wald and Havran 2006 use 0.2). Default 0. */
    rt_structure structure;
    rt_build_quality quality;
    rt_progress_function progress; /* null: none */
    void* progress_user;
    rt_memory memory;
    rt_light_proofs light_proofs;
    uint64_t most_proof_bytes; /* that all proofs may take: 0: 64 MiB. What is beyond is traced. */
    float proof_patch_size; /* metres, > 0; 0: 1. Triangles that are lit in parts are cut until no
                               side is longer: smaller ones prove more, and take longer */
    float proof_budget_ms; /* that proofs may take of this commit, so that the next one goes on with
                              them; >= 0; 0: no bound. A light whose proofs have not ended is
                              traced. The first commit needs some milliseconds more */
} rt_commit_desc;

static inline rt_commit_desc rt_default_commit_desc(void) {
    rt_commit_desc desc;
    memset(&desc, 0, sizeof desc);
    desc.struct_size = (uint32_t)sizeof desc;
    return desc;
}

/* Bits of rt_commit_report.left_out: what the scene does not have and the pipeline therefore skips.
 */
enum {
    RT_FEATURE_TEXTURES = 1u << 0,
    RT_FEATURE_NORMAL_MAPS = 1u << 1,
    RT_FEATURE_EMISSIVE = 1u << 2,
    RT_FEATURE_ALPHA_MASK = 1u << 3,
    RT_FEATURE_SPECULAR = 1u << 4,
    RT_FEATURE_LIGHTS = 1u << 5,
    RT_FEATURE_SHADOWS = 1u << 6,
    RT_FEATURE_DYNAMIC_MESHES = 1u << 7,
    RT_FEATURE_SINGLE_SIDED = 1u << 8,
    RT_FEATURE_REFLECTION = 1u << 9,
    RT_FEATURE_TRANSMISSION = 1u << 10,
    RT_FEATURE_BLENDING = 1u << 11,
    RT_FEATURE_SKY = 1u << 12,
    RT_FEATURE_FOG = 1u << 13,
    RT_FEATURE_PROGRAMS = 1u << 14,
    RT_FEATURE_PROGRAM_RAYS = 1u << 15, /* one of them may ask for rays */
    RT_FEATURE_AIRLIGHT = 1u << 16,     /* light that fog scatters: rt_light_desc.fog_scatter */
    RT_FEATURE_OCCLUSION_TEXTURES = 1u << 17,
    RT_FEATURE_ROUGHNESS_TEXTURES = 1u << 18
};

typedef struct rt_commit_report {
    uint32_t struct_size;
    uint32_t left_out;         /* RT_FEATURE_* */
    uint64_t triangle_count;   /* in the snapshot; those of a rigid mesh and its instances once */
    uint64_t degenerate_count; /* left out: without area */
    uint64_t non_finite_count; /* left out: a vertex not finite or beyond 1e30 */
    uint64_t bytes_triangles;  /* the records that rays are tested against, of all meshes */
    uint64_t bytes_nodes;      /* the tree of the static meshes, as are all tree_* below */
    uint64_t bytes_references; /* the tree's leaves */
    uint64_t bytes_attributes; /* positions, normals, texcoords, tangents, indices, materials */
    uint64_t bytes_textures;   /* with their smaller copies */
    uint64_t tree_nodes;
    uint64_t tree_leaves;
    uint64_t tree_empty_leaves;
    uint64_t tree_references; /* triangles in leaves, counted with repetition */
    uint32_t tree_max_depth;
    uint32_t tree_depth_limit; /* enforced by the builder */
    double tree_sah_cost;      /* expected cost of a ray through the bounds, in tests of a triangle
                                  (BVH: of a block of four) */
    double build_ms;           /* wall time of the structure alone */
    double commit_ms;          /* wall time of the whole call */
    uint32_t light_count;
    uint32_t rebuilt;                /* 1: static_rebuilt or dynamic_rebuilt is 1 */
    rt_structure structure;          /* of the static meshes; never AUTO */
    rt_build_quality quality;        /* as asked for */
    uint64_t dynamic_triangle_count; /* of triangle_count: of dynamic meshes ... */
    uint64_t rigid_triangle_count;   /* ... and of rigid ones */
    uint32_t instance_count;         /* rigid meshes and instances that are not hidden */
    uint32_t static_rebuilt;         /* 1: the structure of the static meshes was built */
    uint32_t dynamic_rebuilt;        /* 1: the structure of a dynamic mesh was built */
    uint32_t reserved;
    double dynamic_build_ms; /* of the structures of all dynamic meshes, whenever they were built */
    uint64_t proof_count;    /* tried by this commit, of RT_LIGHT_PROOFS_MADE */
    uint64_t bytes_proofs;   /* remembered, of this commit and earlier ones */
    double proof_ms;         /* wall time of this commit's */
    uint32_t proved_light_count;  /* of which something is remembered */
    uint32_t waiting_light_count; /* whose proofs have not ended: proof_budget_ms */
} rt_commit_report;

static inline rt_commit_report rt_default_commit_report(void) {
    rt_commit_report report;
    memset(&report, 0, sizeof report);
    report.struct_size = (uint32_t)sizeof report;
    return report;
}

/* Builds a snapshot of what is described and publishes it: every query and frame that begins after
 * the return sees it. Those that run on go on with the old one, which is freed later. On any
 * error the previous snapshot stays. desc and out_report may be null. Errors: INVALID_ARGUMENT (a
 * material names a removed texture), LIMIT (see below), OUT_OF_MEMORY, CANCELLED. Thread safety:
 * one describing thread at a time; queries and frames may run.
 *
 * Limits: 2^27 triangles under one structure, which is all static meshes together, or one dynamic
 * or rigid mesh; 2^32 - 2 triangles in all, those of a rigid mesh once for each instance; 2^20
 * dynamic meshes, rigid meshes and instances that are not hidden. */
RT_EXPORT rt_result rt_commit_scene(rt_scene scene, const rt_commit_desc* desc,
                                    rt_commit_report* out_report) RT_NOEXCEPT;

/* Keeps the current snapshot, so that queries and frames can ask it later (what did the shooter
 * see 100 ms ago?), until it is released or the scene is destroyed. Costs the memory of what
 * changed since. Errors: NOT_COMMITTED, LIMIT (256 are held), INVALID_ARGUMENT. Thread safety: any
 * thread, any time. */
RT_EXPORT rt_result rt_hold_snapshot(rt_scene scene, rt_snapshot* out_snapshot) RT_NOEXCEPT;

/* The handle is stale at once; queries and frames that run on go on. Its memory is recycled by the
 * next commit. Thread safety: any thread, any time. */
RT_EXPORT rt_result rt_release_snapshot(rt_scene scene, rt_snapshot snapshot) RT_NOEXCEPT;

/* Baking: what comes to the fronts of static meshes from all around, found once for all frames. */
typedef struct rt_bake_desc {
    uint32_t struct_size;
    uint32_t samples;      /* rays a point, at most 256; 0: 64 */
    float occlusion_range; /* as that of frames, and for those that have the same; 0: none is
                              baked */
    uint32_t bounces;      /* how often light goes on from surface to surface, at most 8; 0: none is
                              baked. rt_default_bake_desc() has 1 */
    float spacing;   /* metres, > 0; 0: 0.5. So near to each other are points of occlusion where it
                        changes, and those of light at four times that. A triangle has at most
                        8,385 */
    float tolerance; /* it does where a point is not what lies between its neighbours, by such a
                        part of the ambient light; of light by five times that of its own. >= 0.
                        rt_default_bake_desc() has 0.05 */
    uint64_t most_bytes;           /* 0: 64 MiB. What would be more gets fewer points */
    rt_progress_function progress; /* null: none */
    void* progress_user;
} rt_bake_desc;

static inline rt_bake_desc rt_default_bake_desc(void) {
    rt_bake_desc desc;
    memset(&desc, 0, sizeof desc);
    desc.struct_size = (uint32_t)sizeof desc;
    desc.occlusion_range = 1.0f;
    desc.bounces = 1;
    desc.tolerance = 0.05f;
    return desc;
}

typedef struct rt_bake_report {
    uint32_t struct_size;
    uint32_t reserved;
    uint64_t point_count;   /* that are kept */
    uint64_t sampled_count; /* that rays went out from, in all bounces */
    uint64_t rays;          /* with those to lamps */
    uint64_t bytes;
    double bake_ms;
} rt_bake_report;

static inline rt_bake_report rt_default_bake_report(void) {
    rt_bake_report report;
    memset(&report, 0, sizeof report);
    report.struct_size = (uint32_t)sizeof report;
    return report;
}

/* Finds it for the current snapshot, with all its lamps and with what glows, but without what moves
 * and without the sky. Commits from then on show it, until the static meshes change. Lamps and
 * materials that change later leave it as it is: bake again. Frames may go on meanwhile, and so may
 * commits. desc and out_report may be null. Errors: INVALID_ARGUMENT, NOT_COMMITTED, CANCELLED,
 * LIMIT (most_bytes is too little for three points a triangle), OUT_OF_MEMORY; what was baked
 * before then stays. Thread safety: any thread, any time. */
RT_EXPORT rt_result rt_bake_light(rt_scene scene, const rt_bake_desc* desc,
                                  rt_bake_report* out_report) RT_NOEXCEPT;

/* -------------------------------------------------------------------------------------- query */

/* A ray, or a segment: the points origin + t direction with t_min <= t <= t_max, ends included.
 * Both ends may be infinite, of either sign: no end on that side, or nothing left. What counts is
 * what a float can name: a surface more than FLT_MAX (3.4e38) lengths of the direction away is out
 * of reach for every kind of query. A direction of 1e-38 m reaches 3.4 m; directions of 1e-7 m and
 * more reach everything. */
typedef struct rt_ray {
    float origin[3];
    float t_min; /* may be infinite */
    float direction[3];
    float t_max; /* may be infinite; t_max < t_min: an empty segment, never a hit */
} rt_ray;

/* A miss has t = +infinity, a null mesh and triangle RT_NO_TRIANGLE. The barycentrics weigh vertex
 * 1 (u) and vertex 2 (v) of the triangle; vertex 0 weighs 1 - u - v. An instance that
 * rt_add_mesh_instance made is a mesh of its own, so `mesh` is all it takes to tell instances
 * apart.
 */
typedef struct rt_hit {
    float t, u, v;
    uint32_t triangle; /* the host's own index in the mesh */
    rt_mesh mesh;
    uint32_t instance;  /* always 0, and ignored when a hit is resolved: see above */
    uint32_t back_face; /* 1 if the ray came from behind (clockwise) */
} rt_hit;

#define RT_NO_TRIANGLE 0xffffffffu

typedef int32_t rt_query_kind;
enum {
    RT_QUERY_CLOSEST = 0, /* the hit with the smallest t; of equal ones a front before a back, then
                             the smallest (mesh.index, triangle) */
    RT_QUERY_ANY = 1,     /* whether there is a hit at all */
    RT_QUERY_ALL = 2,     /* the first max_hits crossings, in ascending (t, back_face, mesh.index,
                             triangle): a surface is entered before it is left */
    RT_QUERY_COUNT = 3    /* how many crossings there are */
};

/* Crossings are counted as if the ray were moved aside by an infinitely small amount: a ray through
 * an edge or a vertex crosses a closed surface there as often as a ray beside it would, and two
 * triangles that share the edge do not both report it. So a ray exactly through the open border of
 * a mesh, which RT_QUERY_CLOSEST and RT_QUERY_ANY call a hit, may be none here. */

typedef int32_t rt_faces;
enum { RT_FACES_BOTH = 0, RT_FACES_FRONT = 1, RT_FACES_BACK = 2 };

enum {
    RT_QUERY_ALPHA_TEST = 1u << 0,      /* rays pass through where a masked material is absent */
    RT_QUERY_USE_THREADS = 1u << 1,     /* spread a large batch over the scene's threads */
    RT_QUERY_SKIP_SEPARATING = 1u << 2, /* sweeps of what slides: what is touched, at the start or
                                           later, does not count if the motion goes no deeper into
                                           it. See rt_sweep_shapes. */
    RT_QUERY_MARK_INVALID = 1u << 3     /* records that are not valid refuse no batch: see below */
};

/* A record that is not valid (a ray with a NaN, a shape with a negative radius, a hit on a mesh
 * that is gone) refuses the whole call, which names the first and writes nothing. With
 * RT_QUERY_MARK_INVALID the call answers the others, returns RT_OK, and marks the results of those
 * that are not valid:
 *     rt_hit, rt_hit_arrays       t, u and v are NaN, the rest as for a miss
 *     rt_sweep_hit, rt_nearest    t or distance is NaN, the rest as where nothing was found
 *     rt_surface                  position is NaN, asked for or not; the rest is zero
 *     occluded, overlapping       RT_INVALID_BYTE
 *     all counts                  RT_INVALID_COUNT; no hit is written
 * It costs a look at each record, and nothing where it is not set. */
#define RT_INVALID_BYTE 0xffu
#define RT_INVALID_COUNT 0xffffffffu

/* What the host knows of the rays of a batch. It may change the speed, never the answers. */
typedef int32_t rt_coherence;
enum {
    RT_COHERENCE_AUTO = 0,
    RT_COHERENCE_COHERENT = 1,      /* neighbours in the batch are alike */
    RT_COHERENCE_COMMON_ORIGIN = 2, /* ... and all start at one point */
    RT_COHERENCE_INCOHERENT = 3
};

/* A batch of rays as separate arrays, of ray_count floats each, of any alignment. Arrays that begin
 * at a multiple of 64 bytes are read in place, others are copied on the way. */
typedef struct rt_ray_arrays {
    uint32_t struct_size;
    uint32_t reserved; /* 0 */
    const float* origin[3];
    const float* direction[3];
    const float* t_min; /* null: 0 */
    const float* t_max; /* null: +infinity */
} rt_ray_arrays;

static inline rt_ray_arrays rt_default_ray_arrays(void) {
    rt_ray_arrays arrays;
    memset(&arrays, 0, sizeof arrays);
    arrays.struct_size = (uint32_t)sizeof arrays;
    return arrays;
}

/* Where to put the hits of a batch, one a ray: the fields of rt_hit. Null: not wanted. */
typedef struct rt_hit_arrays {
    uint32_t struct_size;
    uint32_t reserved; /* 0 */
    float* t;
    float* u;
    float* v;
    uint32_t* triangle;
    rt_mesh* mesh;
    uint32_t* back_face;
} rt_hit_arrays;

static inline rt_hit_arrays rt_default_hit_arrays(void) {
    rt_hit_arrays arrays;
    memset(&arrays, 0, sizeof arrays);
    arrays.struct_size = (uint32_t)sizeof arrays;
    return arrays;
}

/* Asked about a triangle that would count for ray or shape `index` of the query: return 0, and it
 * does not. For rays `candidate` is the hit; for shapes it names the triangle, with t, u and v 0.
 * It is called on the thread of the query, in no particular order, possibly more than once for a
 * triangle and for triangles that are not in the answer. It must not throw, and must answer alike
 * when asked again. */
typedef int32_t (*rt_accept_function)(void* user, uint64_t index, const rt_hit* candidate);

/* What a call visited, all its rays or shapes together. Unlike the answers, this depends on the
 * structure, the instruction set and the batch. */
typedef struct rt_query_stats {
    uint32_t struct_size;
    uint32_t reserved;
    uint64_t nodes;     /* whose boxes or planes were looked at */
    uint64_t triangles; /* that were tested, one or several at a time */
    uint64_t instances; /* of rigid meshes that were entered */
} rt_query_stats;

static inline rt_query_stats rt_default_query_stats(void) {
    rt_query_stats stats;
    memset(&stats, 0, sizeof stats);
    stats.struct_size = (uint32_t)sizeof stats;
    return stats;
}

/* What few queries need. */
typedef struct rt_query_options {
    uint32_t struct_size;
    uint32_t reserved;            /* 0 */
    double origin[3];             /* positions in the records of the query, both ways, are relative
                                     to this point. Rigid meshes see the sum in double, others
                                     rounded to float, relative to the world's origin. */
    rt_snapshot snapshot;         /* null: the current one */
    const rt_mesh* ignore_meshes; /* ignore_count of them; stale ones ignore nothing */
    uint64_t ignore_count;
    rt_accept_function accept; /* null: all count. The query then uses one thread. */
    void* accept_user;
    rt_query_stats* stats; /* null: not counted, which is faster */
} rt_query_options;

static inline rt_query_options rt_default_query_options(void) {
    rt_query_options options;
    memset(&options, 0, sizeof options);
    options.struct_size = (uint32_t)sizeof options;
    return options;
}

/* What lies at a hit. */
typedef struct rt_surface {
    double position[3];        /* from the barycentrics: on the triangle to rounding. Absolute */
    float geometric_normal[3]; /* unit; counter-clockwise side */
    float shading_normal[3];   /* unit; interpolated, without normal map */
    float texcoord[2];
    rt_material material; /* null: the default material */
    uint64_t material_user_data;
    uint64_t mesh_user_data;
} rt_surface;

/* Fields of rt_surface. What is not asked for is not computed, and zero. */
enum {
    RT_SURFACE_POSITION = 1u << 0,
    RT_SURFACE_GEOMETRIC_NORMAL = 1u << 1,
    RT_SURFACE_SHADING_NORMAL = 1u << 2,
    RT_SURFACE_TEXCOORD = 1u << 3,
    RT_SURFACE_MATERIAL = 1u << 4,
    RT_SURFACE_USER_DATA = 1u << 5, /* of the material and the mesh */
    RT_SURFACE_ALL = 63u
};

/* Rays come as `rays` or as `ray_arrays`, hits go to `hits` or to `hit_arrays`: one of each pair,
 * the other null. `hits` and `hit_arrays` are for RT_QUERY_CLOSEST, `occluded` is for
 * RT_QUERY_ANY, `hit_counts` is for RT_QUERY_COUNT, and with `hits` (max_hits records a ray, of
 * which the unused ones are not written) for RT_QUERY_ALL; what the kind does not need is not
 * looked at.
 */
typedef struct rt_query_desc {
    uint32_t struct_size;
    rt_query_kind kind;
    const rt_ray* rays;
    uint64_t ray_count;     /* 0 is allowed and does nothing, also before the first commit */
    uint32_t ray_stride;    /* of rays, in bytes; 0: 32 */
    uint32_t result_stride; /* of hits or occluded, in bytes; 0: 32 or 1 */
    rt_hit* hits;           /* one a ray */
    uint8_t* occluded;      /* one a ray, 1 or 0 */
    rt_faces faces;
    uint32_t layer_mask;
    rt_mesh ignore_mesh; /* null: none */
    uint32_t flags;      /* RT_QUERY_* bits */
    rt_coherence coherence;
    const rt_ray_arrays* ray_arrays;
    const rt_hit_arrays* hit_arrays;
    const rt_query_options* options; /* null: none */
    uint32_t* hit_counts;            /* one a ray: hits stored (ALL), crossings (COUNT) */
    rt_surface* surfaces;    /* one beside each of `hits` (records only); null: not wanted */
    uint32_t surface_stride; /* in bytes; 0: packed */
    uint32_t surface_fields; /* RT_SURFACE_* bits */
    uint32_t max_hits;       /* ALL: at least 1 */
    uint32_t reserved;       /* 0 */
    uint32_t* total_counts;  /* ALL: one a ray, how many crossings there are, of which hit_counts
                                were stored; then the query takes as long as RT_QUERY_COUNT, however
                                small max_hits is. Null: not wanted. */
} rt_query_desc;

/* Field by field: a query may be a few nanoseconds, and compilers turn memset and a copy into a
 * loop and a stall. */
static inline rt_query_desc rt_default_query_desc(void) {
    const rt_query_desc desc = {(uint32_t)sizeof(rt_query_desc),
                                RT_QUERY_CLOSEST,
                                0, /* rays */
                                0,
                                0,
                                0,
                                0, /* hits */
                                0,
                                RT_FACES_BOTH,
                                0xffffffffu, /* layer_mask */
                                {0, 0},
                                0,
                                RT_COHERENCE_AUTO,
                                0, /* ray_arrays */
                                0,
                                0, /* options */
                                0,
                                0, /* surfaces */
                                0,
                                0,
                                0, /* max_hits */
                                0,
                                0};
    return desc;
}

/* Answers one ray or a million; rays that are asked for together are traced together. The answer
 * depends on the geometry and the ray alone: not on the batch, the tree, the instruction set or
 * the number of threads. Results must not overlap the rays. Starting on or inside a
 * surface: hits with t >= t_min count, whatever side they are seen from. Errors: INVALID_ARGUMENT
 * (a component that is NaN, an origin beyond 1e30 in magnitude or infinite, a direction that is
 * zero or infinite; the ray is named), INVALID_HANDLE (the scene), INVALID_STRUCT, NOT_COMMITTED.
 * A stale ignore_mesh ignores nothing. Thread safety: any thread, any time. Runs on the calling
 * thread, unless RT_QUERY_USE_THREADS is set. */
RT_EXPORT rt_result rt_trace_query(rt_scene scene, const rt_query_desc* desc) RT_NOEXCEPT;

/* Resolves hits (strides in bytes, 0: packed). A miss gives all zeros. Errors: INVALID_HANDLE (a
 * mesh that the current snapshot does not have), INVALID_ARGUMENT (a triangle out of range). Thread
 * safety: any thread, any time. */
RT_EXPORT rt_result rt_resolve_hits(rt_scene scene, const rt_hit* hits, uint64_t count,
                                    uint32_t hit_stride, rt_surface* out_surfaces,
                                    uint32_t surface_stride) RT_NOEXCEPT;

/* rt_resolve_hits with a choice of the snapshot, of the fields, and of what positions are relative
 * to. */
typedef struct rt_resolve_desc {
    uint32_t struct_size;
    uint32_t flags; /* RT_QUERY_MARK_INVALID */
    const rt_hit* hits;
    uint64_t hit_count;                  /* 0 is allowed and does nothing */
    rt_surface* surfaces;                /* one a hit */
    uint32_t hit_stride, surface_stride; /* in bytes; 0: packed */
    uint32_t surface_fields;             /* RT_SURFACE_* bits; others are zero */
    uint32_t reserved;                   /* 0 */
    rt_snapshot snapshot;                /* that the hits are of; null: the current one */
    double origin[3]; /* positions are relative to this point; (0, 0, 0): absolute */
} rt_resolve_desc;

static inline rt_resolve_desc rt_default_resolve_desc(void) {
    rt_resolve_desc desc;
    memset(&desc, 0, sizeof desc);
    desc.struct_size = (uint32_t)sizeof desc;
    desc.surface_fields = RT_SURFACE_ALL;
    return desc;
}

/* A miss, or the mark of a ray that was not valid, gives all zeros. Errors: as rt_resolve_hits
 * (the snapshot counts that is asked), INVALID_HANDLE (a snapshot that is not held),
 * INVALID_STRUCT, INVALID_ARGUMENT, NOT_COMMITTED. Thread safety: any thread, any time. */
RT_EXPORT rt_result rt_resolve_surfaces(rt_scene scene, const rt_resolve_desc* desc) RT_NOEXCEPT;

/* ------------------------------------------------------------------------------------- shapes */

/* Shapes meet triangles as surfaces, from both sides: a shape deep inside a closed mesh, away from
 * its triangles, meets nothing. Holes of masked materials are closed to shapes. What `faces` calls
 * the front of a triangle: for a sweep, that the geometric normal points against the direction; for
 * an overlap or a nearest point, that the shape's centre or the point is not behind its plane.
 *
 * Every answer is defined by one test of a shape and a triangle in double precision
 * (docs/queries.md has its error bound, far below 0.1 mm in a level of 100 m), rounded to float at
 * the end; like a ray's, it depends on the geometry and the shape alone. Triangles of rigid meshes
 * are seen from the shape's centre in double.
 *
 * rt_sweep.t_max and rt_point.radius are ends, as rt_ray.t_max is: +infinity means no end, and in
 * front of an end below 0 lies nothing, so nothing is found. As for rays, t counts up to FLT_MAX
 * (3.4e38).
 *
 * Errors of the three calls: INVALID_ARGUMENT (an end that is NaN; any other component that is NaN,
 * infinite or beyond 1e30; a negative radius or extent of a shape; a direction or a rotation of
 * length 0; the record and the field are named), INVALID_HANDLE, INVALID_STRUCT, NOT_COMMITTED.
 * Nothing is written then. Thread safety: any thread, any time. They run on the calling thread,
 * unless RT_QUERY_USE_THREADS is set. */

/* The points within `radius` (>= 0) of the segment from centre - axis to centre + axis move along
 * t direction, 0 <= t <= t_max. An axis of zero makes it a sphere. */
typedef struct rt_sweep {
    float center[3];
    float radius;
    float axis[3];
    float t_max;        /* may be infinite; below 0: an empty way, never a contact */
    float direction[3]; /* any length but zero */
    uint32_t reserved;  /* 0 */
} rt_sweep;

/* The first contact. Without one, t = +infinity, a null mesh and triangle RT_NO_TRIANGLE. */
typedef struct rt_sweep_hit {
    float t;         /* time of impact in lengths of the direction; 0 for an initial contact */
    float point[3];  /* of contact, on the triangle */
    float normal[3]; /* unit, from the surface to the shape; the face's own, against the direction,
                        where the axis itself touches; for RT_QUERY_SKIP_SEPARATING see
                        rt_sweep_shapes */
    float depth;     /* initial contact: how deep the shape is in, radius - distance; otherwise 0 */
    uint32_t triangle; /* of equal ones the smallest (mesh.index, triangle) */
    rt_mesh mesh;
    uint32_t initial_contact; /* 1: the shape touched something where it started, and this is the
                                 triangle that it is deepest in */
} rt_sweep_hit;

typedef struct rt_sweep_desc {
    uint32_t struct_size;
    uint32_t flags; /* RT_QUERY_USE_THREADS, RT_QUERY_SKIP_SEPARATING, RT_QUERY_MARK_INVALID */
    const rt_sweep* sweeps;
    uint64_t sweep_count;              /* 0 is allowed and does nothing */
    rt_sweep_hit* hits;                /* one a sweep */
    uint32_t sweep_stride, hit_stride; /* in bytes; 0: packed */
    rt_faces faces;
    uint32_t layer_mask;
    rt_mesh ignore_mesh;             /* null: none */
    const rt_query_options* options; /* null: none */
} rt_sweep_desc;

static inline rt_sweep_desc rt_default_sweep_desc(void) {
    rt_sweep_desc desc;
    memset(&desc, 0, sizeof desc);
    desc.struct_size = (uint32_t)sizeof desc;
    desc.layer_mask = 0xffffffffu;
    return desc;
}

/* When, where and against what moving spheres and capsules run.
 *
 * With RT_QUERY_SKIP_SEPARATING a contact counts only if the motion goes against its normal, by a
 * sine of more than 2^-18 and what rounding its vertices to float may have turned the triangle by
 * (up to 2^-10). A shape that is a bit inside of a surface is not stopped by the edges and corners
 * of triangles that lie in it: where another triangle at the point of contact is in the way of the
 * normal (it may be of another mesh; the query must see it), the normal is that of the surface
 * there. In a flat surface that is the face's own, in a hollow the triangle's own; at the upper
 * edge of a wall below a floor it is the floor's. t, point and depth stay those of the contact.
 * First touches of a shape that is clear of everything keep their normals. */
RT_EXPORT rt_result rt_sweep_shapes(rt_scene scene, const rt_sweep_desc* desc) RT_NOEXCEPT;

typedef uint32_t rt_shape_kind;
enum { RT_SHAPE_SPHERE = 0, RT_SHAPE_CAPSULE = 1, RT_SHAPE_BOX = 2 };

typedef struct rt_shape {
    float center[3];
    float radius;    /* sphere, capsule; >= 0 */
    float extent[3]; /* capsule: the axis, from the centre to that of a cap; box: half its sizes */
    rt_shape_kind kind;
    float rotation[4]; /* box: a quaternion x, y, z, w of any length but zero */
} rt_shape;

typedef struct rt_overlap {
    rt_mesh mesh;
    uint32_t triangle;
    uint32_t reserved; /* 0 */
} rt_overlap;

/* `overlapping` says whether a shape touches anything. `overlaps` receives which triangles, in
 * ascending (mesh.index, triangle), max_overlaps records a shape, and needs `overlap_counts`, which
 * says how many there are in all. Either or both. */
typedef struct rt_overlap_desc {
    uint32_t struct_size;
    uint32_t flags; /* RT_QUERY_USE_THREADS, RT_QUERY_MARK_INVALID */
    const rt_shape* shapes;
    uint64_t shape_count;     /* 0 is allowed and does nothing */
    uint8_t* overlapping;     /* one a shape, 1 or 0 */
    rt_overlap* overlaps;     /* max_overlaps a shape; the unused ones are not written */
    uint32_t* overlap_counts; /* one a shape */
    uint32_t max_overlaps;
    uint32_t shape_stride; /* in bytes; 0: packed */
    rt_faces faces;
    uint32_t layer_mask;
    rt_mesh ignore_mesh;             /* null: none */
    const rt_query_options* options; /* null: none */
} rt_overlap_desc;

static inline rt_overlap_desc rt_default_overlap_desc(void) {
    rt_overlap_desc desc;
    memset(&desc, 0, sizeof desc);
    desc.struct_size = (uint32_t)sizeof desc;
    desc.layer_mask = 0xffffffffu;
    return desc;
}

/* Which shapes touch triangles, and which. */
RT_EXPORT rt_result rt_overlap_shapes(rt_scene scene, const rt_overlap_desc* desc) RT_NOEXCEPT;

typedef struct rt_point {
    float position[3];
    float radius; /* how far to look; may be infinite; below 0: nowhere, nothing is found */
} rt_point;

/* The point of a surface that is nearest. Without one, distance = +infinity, a null mesh and
 * triangle RT_NO_TRIANGLE. */
typedef struct rt_nearest {
    float distance;
    float point[3];
    float normal[3];   /* unit, from the surface to the point; the face's own where distance is 0 */
    float u, v;        /* barycentrics, as in rt_hit */
    uint32_t triangle; /* of equal ones the smallest (mesh.index, triangle) */
    rt_mesh mesh;
} rt_nearest;

typedef struct rt_nearest_desc {
    uint32_t struct_size;
    uint32_t flags; /* RT_QUERY_USE_THREADS, RT_QUERY_MARK_INVALID */
    const rt_point* points;
    uint64_t point_count;                 /* 0 is allowed and does nothing */
    rt_nearest* results;                  /* one a point */
    uint32_t point_stride, result_stride; /* in bytes; 0: packed */
    rt_faces faces;
    uint32_t layer_mask;
    rt_mesh ignore_mesh;             /* null: none */
    const rt_query_options* options; /* null: none */
} rt_nearest_desc;

static inline rt_nearest_desc rt_default_nearest_desc(void) {
    rt_nearest_desc desc;
    memset(&desc, 0, sizeof desc);
    desc.struct_size = (uint32_t)sizeof desc;
    desc.layer_mask = 0xffffffffu;
    return desc;
}

/* The nearest point of any surface within a radius. */
RT_EXPORT rt_result rt_find_nearest(rt_scene scene, const rt_nearest_desc* desc) RT_NOEXCEPT;

/* -------------------------------------------------------------------------------------- frame */

typedef struct rt_camera {
    uint32_t struct_size;
    float vertical_fov; /* radians, in (0, pi) */
    double position[3];
    float forward[3]; /* any length but zero */
    float up[3];      /* not parallel to forward */
} rt_camera;

static inline rt_camera rt_default_camera(void) {
    rt_camera camera;
    memset(&camera, 0, sizeof camera);
    camera.struct_size = (uint32_t)sizeof camera;
    camera.vertical_fov = 1.0471976f;
    camera.forward[2] = -1.0f;
    camera.up[1] = 1.0f;
    return camera;
}

/* The views other than the shaded one ignore exposure and tone mapping; formats of 8 bits get their
 * values as they are, without sRGB encoding. */
typedef int32_t rt_view;
enum {
    RT_VIEW_SHADED = 0,
    RT_VIEW_NORMALS = 1, /* 0.5 n + 0.5 of the shading normal */
    RT_VIEW_DEPTH = 2,   /* near is bright; `depth_range` is black */
    RT_VIEW_STEPS =
        3, /* tree nodes visited by the primary ray as a heat map; `steps_range` is white */
    RT_VIEW_LIGHT = 4, /* how light was found: red: by shadow rays, the brighter the more, up to 8;
                         green: from what was proved, or what neighbours know; blue: interpolated;
                         black: nothing is seen */
    RT_VIEW_OCCLUSION = 5 /* how much ambient light reaches a place: white: all; in blocks, red
                             where that was found by rays */
};

typedef int32_t rt_tone_mapping;
enum {
    RT_TONE_FILMIC = 0, /* exposure, then a rational curve that reaches 1 smoothly */
    RT_TONE_CLAMP = 1,  /* exposure, then a cut at 1 */
    RT_TONE_NONE = 2    /* radiance as it is; float formats only. Exposure says no more than how
                           bright light counts where several rays are averaged or pixels enlarged */
};

typedef int32_t rt_texture_filter;
enum {
    RT_TEXTURE_FINEST = 0, /* as rt_texture_desc says, of the texture as it is */
    RT_TEXTURE_MIPMAPS = 1 /* of smaller copies where a pixel covers many texels; on surfaces that
                              lean away, up to four samples along what it covers. Masks are cut out
                              by the texture as it is. */
};

/* A point that shines: a spark, a drop of a fountain. It is seen if nothing is between its centre
 * and the eye, as a soft disc that adds its light to what is behind it, and is cut off softly by
 * what stands in it. Mirrors do not show it. 40 bytes. */
typedef struct rt_particle {
    double position[3];
    float radius;   /* metres, > 0: where its light ends */
    float color[3]; /* radiance of its middle, >= 0 */
} rt_particle;

/* Besides or instead of an image, a frame delivers what its primary rays see, as further planes of
 * height rows of width elements: any of depth, triangle_ids, mesh_ids and normals that is not null.
 * With `pixels` null nothing is shaded. A plane holds what rt_trace_query with RT_QUERY_ALPHA_TEST
 * would say of the rays from the camera through the pixels' centres, but that frames see through
 * the backs of materials that are not double_sided. */
typedef struct rt_frame_desc {
    uint32_t struct_size;
    rt_pixel_format format; /* RGBA8_SRGB, BGRA8_SRGB, RGBA16F or RGBA32F (these two linear) */
    void* pixels;           /* height rows of width pixels, top row first; alpha is 1. May be null
                               if a plane is not. */
    uint64_t row_stride;    /* bytes; 0: tightly packed */
    uint32_t width, height; /* 1 to 16384 each */
    rt_view view;
    rt_tone_mapping tone_mapping;
    float exposure;      /* multiplies radiance; > 0 */
    float depth_range;   /* metres, > 0 */
    float steps_range;   /* nodes, > 0 */
    uint32_t no_shadows; /* 0 or 1; 1: lights shine through everything */
    float* depth; /* metres along `forward`, not along the ray; +infinity where nothing is seen */
    uint32_t* triangle_ids; /* as rt_hit.triangle */
    rt_mesh* mesh_ids;      /* as rt_hit.mesh */
    float* normals; /* 3 a pixel, as rt_surface.shading_normal; zeros where nothing is seen */
    uint64_t depth_row_stride; /* these four in bytes; 0: tightly packed */
    uint64_t triangle_row_stride;
    uint64_t mesh_row_stride;
    uint64_t normal_row_stride;
    rt_snapshot snapshot; /* null: the current one */
    /* What follows trades error for time; zeros are exact. docs/rendering.md has each one's price.
     */
    uint32_t light_block;  /* pixels. 0, 1: light is found at each; 4, 8, 16: in blocks of so many,
                              only where it changes */
    float light_tolerance; /* how far light may be from what lies between, as a part of it, before
                              a block is cut; >= 0 */
    rt_texture_filter texture_filter; /* rt_default_frame_desc() has RT_TEXTURE_MIPMAPS */
    float least_light; /* steps of an 8-bit display: the dimmest lamps of a place are left out as
                          long as all of these together would change it by less; >= 0 */
    uint32_t edge_samples; /* rays through a pixel at an edge: 0, 1: one; 2 to 16 */
    float edge_budget; /* at most so many more rays, as a part of the pixels that are traced, for
                          the strongest edges; >= 0; 0: no limit */
    uint32_t
        render_width; /* the picture is traced so wide and high, at most width and height, and */
    uint32_t render_height; /* enlarged along edges; 0: width, height. Planes and views other than
                               the shaded one are not: with planes, primary rays are traced for
                               both sizes */
    /* Mirrors and glass: how far a path is followed. What is not traced brings ambient light. */
    uint32_t max_depth;     /* bounces, at most 16; 0: mirrors and glass are as matt as the rest.
                               rt_default_frame_desc() has 4 */
    float least_importance; /* paths end whose light, times exposure, counts for less than this
                               part; 0 to 1. rt_default_frame_desc() has 1 / 256 */
    /* Ambient occlusion: surfaces get less of rt_environment.ambient, the more rays of a place meet
     * a surface of any mesh. It is of the geometry: normal maps take no part. */
    float occlusion_range; /* metres; what is nearer hides the more, the nearer it is. >= 0, may be
                              +infinity; 0: ambient light is everywhere */
    uint32_t occlusion_samples; /* rays a place, at most 256, the same for all; 0: 16 */
    uint32_t occlusion_block;  /* pixels. 0, 1: it is found at each; 4, 8, 16: in blocks of so many,
                                  whose corners and middle are asked. Where these lie on a plane,
                                  have alike normals and get alike light, the rest is interpolated;
                                  else blocks are cut, down to pixels */
    float occlusion_tolerance; /* how much of the ambient light may differ within a block; >= 0 */
    float occlusion_normal_tolerance; /* how far the tips of unit normals may be apart; >= 0 */
    float occlusion_plane_tolerance;  /* how far from a plane a block may be, in its widths; >= 0 */
    /* Glow: light that is too bright for a display spreads to its surroundings. */
    float bloom; /* 0 to 1: the part of it that spreads; 0: none. 0.2 is a glow, 1 is a mist */
    float bloom_threshold; /* what is beyond this spreads, of radiance times exposure; >= 0. 0: all
                              light does. rt_default_frame_desc() has 1 */
    float bloom_radius;    /* how far, as a part of the picture's height; 0 to 1.
                              rt_default_frame_desc() has 0.15 */
    uint32_t airlight_shadows;  /* pieces, at most 32, into which a ray's way through the light of a
                                   lamp with a fog_scatter is cut, to find what the lamp sees of it:
                                   so many shadow rays and one, and three where a shadow begins. 0:
                                   in fog this light goes through walls. rt_default_frame_desc() has
                                   8 */
    rt_array particles;         /* rt_particle: at most 2^24 */
    uint32_t airlight_block;    /* pixels. 0, 1: each ray asks for its own airlight_shadows; 2, 4:
                                   one in a block of so many, for the others, too, where their ways
                                   are about the same. rt_default_frame_desc() has 2 */
    uint32_t measure_luminance; /* 0 or 1; 1: of a shaded frame, in rt_frame_stats */
    uint32_t tinted_shadows; /* 0 or 1. 1: of a lamp's light glass and blended surfaces let through
                                what they let through of a picture, but on a straight line; none of
                                it beyond 64 surfaces. 0: a shadow is whole or none, and what keeps
                                half of the light casts one. rt_default_frame_desc() has 1 */
    uint32_t baked_light;    /* 0 or 1. 1: static meshes get the light between surfaces that
                                rt_bake_light() found, and with its occlusion_range also the ambient
                                occlusion, instead of by rays. rt_default_frame_desc() has 1 */
} rt_frame_desc;

static inline rt_frame_desc rt_default_frame_desc(void) {
    rt_frame_desc desc;
    memset(&desc, 0, sizeof desc);
    desc.struct_size = (uint32_t)sizeof desc;
    desc.exposure = 1.0f;
    desc.depth_range = 50.0f;
    desc.steps_range = 100.0f;
    desc.texture_filter = RT_TEXTURE_MIPMAPS;
    desc.max_depth = 4;
    desc.least_importance = 1.0f / 256.0f;
    desc.occlusion_samples = 16;
    desc.occlusion_block = 8;
    desc.occlusion_tolerance = 0.13f;
    desc.occlusion_normal_tolerance = 0.3f;
    desc.occlusion_plane_tolerance = 0.1f;
    desc.bloom_threshold = 1.0f;
    desc.bloom_radius = 0.15f;
    desc.airlight_shadows = 8;
    desc.airlight_block = 2;
    desc.tinted_shadows = 1;
    desc.baked_light = 1;
    return desc;
}

typedef struct rt_frame_stats {
    uint32_t struct_size;
    uint32_t threads; /* that could work on the frame */
    uint64_t rays_primary;
    uint64_t rays_shadow;
    double frame_ms; /* wall time of the call */
    rt_isa isa;      /* of the kernels */
    uint32_t reserved;
    uint64_t rays_edge;      /* beside one a pixel, for edges; not in rays_primary */
    uint64_t light_points;   /* of pixels and edge rays: where light was found, not interpolated */
    uint64_t rays_bounced;   /* that mirrors and glass sent on */
    uint64_t rays_occlusion; /* for ambient occlusion; not in rays_shadow */
    uint64_t occlusion_points; /* of pixels: where it was found, not interpolated */
    uint64_t rays_particle;    /* to particles that are within the picture */
    uint64_t program_hits;     /* that programs of the host shaded, of pixels, edges and paths */
    uint64_t program_faults;   /* of these: with a radiance or weight that is negative or not
                                  finite, which counted as 0, or a ray without a direction */
    double mean_luminance;     /* with measure_luminance, else 0: the geometric mean of the pixels'
                                  radiance (0.2126 R + 0.7152 G + 0.0722 B, each at least 1 / 1024),
                                  before exposure and bloom, within a hundredth */
} rt_frame_stats;

static inline rt_frame_stats rt_default_frame_stats(void) {
    rt_frame_stats stats;
    memset(&stats, 0, sizeof stats);
    stats.struct_size = (uint32_t)sizeof stats;
    return stats;
}

/* Renders into the caller's memory and returns when the frame is complete. out_stats may be null.
 * Errors: INVALID_ARGUMENT, INVALID_HANDLE, INVALID_STRUCT, NOT_COMMITTED, OUT_OF_MEMORY.
 * Thread safety: any thread, any time; frames of one scene that overlap share its threads. */
RT_EXPORT rt_result rt_render_frame(rt_scene scene, const rt_camera* camera,
                                    const rt_frame_desc* frame,
                                    rt_frame_stats* out_stats) RT_NOEXCEPT;

/* Keeps frames in time: chooses light_block, light_tolerance, then edge_samples, edge_budget, then
 * render_width, render_height. All that it remembers is here. */
typedef struct rt_governor {
    uint32_t struct_size;
    float target_ms;      /* what a frame may take; 0: the cheapest level */
    uint32_t level;       /* that was chosen; 0: the best picture. May be set, to begin there */
    uint32_t level_count; /* is set: how many there are */
    /* What follows is the governor's own; zeros to begin with. */
    uint32_t frames;
    uint32_t patience;
    uint32_t previous_level;
    float previous_ms;
    float smooth_ms;
    float mean_ms;
    float recent_ms[2];
    float costs[16];
    float seen_at[16];
    const char* text; /* is set: what was chosen, in words. Static storage */
} rt_governor;

static inline rt_governor rt_default_governor(void) {
    rt_governor governor;
    memset(&governor, 0, sizeof governor);
    governor.struct_size = (uint32_t)sizeof governor;
    governor.target_ms = 33.0f;
    return governor;
}

/* To be called before each frame: looks at what the last one took, which must be one that this
 * governor chose, and chooses for the next one, from frame->width and frame->height. `last` may be
 * null: nothing is known, as before the first frame. Depends on its arguments alone. The level
 * stays while frames take about as long; one long frame changes nothing. Errors: INVALID_ARGUMENT,
 * INVALID_STRUCT (also for a frame of a header that lacks the fields). Thread safety: any thread,
 * any time, of different governors. */
RT_EXPORT rt_result rt_govern_frame(rt_governor* governor, rt_frame_desc* frame,
                                    const rt_frame_stats* last) RT_NOEXCEPT;

/* Exposure as an eye adapts. */
typedef struct rt_exposure {
    uint32_t struct_size;
    float key;        /* > 0: where the mean of radiance times exposure is to be */
    float adaptation; /* 0 to 1: (key / mean)^adaptation is the aim. 1: each view gets the same
                         mean; less: a dark one stays darker */
    float least;      /* exposure that it may choose: > 0, ... */
    float most;       /* ... and >= least */
    float brighten_seconds; /* >= 0: after so long 63% of a ratio are made up for, when a view is */
    float darken_seconds;   /* darker than the last, and when it is brighter. 0: at once */
    float exposure; /* is set: for the next frame. 0, as to begin with: the aim is met at once */
} rt_exposure;

static inline rt_exposure rt_default_exposure(void) {
    rt_exposure exposure;
    memset(&exposure, 0, sizeof exposure);
    exposure.struct_size = (uint32_t)sizeof exposure;
    exposure.key = 0.18f;
    exposure.adaptation = 0.7f;
    exposure.least = 0.125f;
    exposure.most = 8.0f;
    exposure.brighten_seconds = 1.0f;
    exposure.darken_seconds = 0.4f;
    return exposure;
}

/* To be called before each frame, `seconds` after the last call, with rt_frame_stats.mean_luminance
 * of the last frame that measured it; 0: none did, and exposure stays as it is, or begins with 1.
 * Depends on its arguments alone. Errors: INVALID_ARGUMENT, INVALID_STRUCT. Thread safety: any
 * thread, any time, of different exposures. */
RT_EXPORT rt_result rt_adapt_exposure(rt_exposure* exposure, float mean_luminance,
                                      float seconds) RT_NOEXCEPT;

/* -------------------------------------------------------------------------------------- stats */

typedef struct rt_scene_stats {
    uint32_t struct_size;
    uint32_t threads; /* that commits and frames use */
    uint32_t mesh_count, material_count, texture_count, light_count; /* described now */
    uint64_t snapshot_version; /* successful commits so far; 0: none */
    uint32_t snapshots_alive;  /* current and not yet freed */
    rt_isa isa;
    uint64_t bytes_allocated; /* now, through the allocator */
    uint64_t bytes_peak;
    uint64_t allocation_count; /* so far */
} rt_scene_stats;

static inline rt_scene_stats rt_default_scene_stats(void) {
    rt_scene_stats stats;
    memset(&stats, 0, sizeof stats);
    stats.struct_size = (uint32_t)sizeof stats;
    return stats;
}

/* Thread safety: with the calls that describe the scene. */
RT_EXPORT rt_result rt_get_scene_stats(rt_scene scene, rt_scene_stats* out_stats) RT_NOEXCEPT;

/* ------------------------------------------------------------------------- loading by hand */

/* The same functions as a table. It only ever grows at its end: struct_size tells how far. */
typedef struct rt_api {
    uint32_t struct_size;
    uint32_t version;
    const char* (*get_last_error)(void);
    const char* (*get_result_name)(rt_result result);
    const char* (*get_version_string)(void);
    rt_result (*create_scene)(const rt_scene_desc* desc, rt_scene* out_scene);
    rt_result (*destroy_scene)(rt_scene scene);
    rt_result (*add_texture)(rt_scene scene, const rt_texture_desc* desc, rt_texture* out_texture);
    rt_result (*remove_texture)(rt_scene scene, rt_texture texture);
    rt_result (*add_material)(rt_scene scene, const rt_material_desc* desc,
                              rt_material* out_material);
    rt_result (*update_material)(rt_scene scene, rt_material material,
                                 const rt_material_desc* desc);
    rt_result (*remove_material)(rt_scene scene, rt_material material);
    rt_result (*add_static_mesh)(rt_scene scene, const rt_mesh_desc* desc, rt_mesh* out_mesh);
    rt_result (*add_dynamic_mesh)(rt_scene scene, const rt_mesh_desc* desc, rt_mesh* out_mesh);
    rt_result (*update_dynamic_mesh)(rt_scene scene, rt_mesh mesh, const rt_mesh_update* update);
    rt_result (*remove_mesh)(rt_scene scene, rt_mesh mesh);
    rt_result (*add_light)(rt_scene scene, const rt_light_desc* desc, rt_light* out_light);
    rt_result (*update_light)(rt_scene scene, rt_light light, const rt_light_desc* desc);
    rt_result (*remove_light)(rt_scene scene, rt_light light);
    rt_result (*set_environment)(rt_scene scene, const rt_environment* environment);
    rt_result (*commit_scene)(rt_scene scene, const rt_commit_desc* desc,
                              rt_commit_report* out_report);
    rt_result (*trace_query)(rt_scene scene, const rt_query_desc* desc);
    rt_result (*resolve_hits)(rt_scene scene, const rt_hit* hits, uint64_t count,
                              uint32_t hit_stride, rt_surface* out_surfaces,
                              uint32_t surface_stride);
    rt_result (*render_frame)(rt_scene scene, const rt_camera* camera, const rt_frame_desc* frame,
                              rt_frame_stats* out_stats);
    rt_result (*get_scene_stats)(rt_scene scene, rt_scene_stats* out_stats);
    rt_result (*add_rigid_mesh)(rt_scene scene, const rt_mesh_desc* desc, rt_mesh* out_mesh);
    rt_result (*add_mesh_instance)(rt_scene scene, rt_mesh mesh, rt_mesh* out_mesh);
    rt_result (*set_mesh_transform)(rt_scene scene, rt_mesh mesh, const rt_transform* transform);
    rt_result (*set_mesh_layer_mask)(rt_scene scene, rt_mesh mesh, uint32_t layer_mask);
    rt_result (*set_mesh_hidden)(rt_scene scene, rt_mesh mesh, uint32_t hidden);
    rt_result (*set_world_origin)(rt_scene scene, const double* origin);
    rt_result (*hold_snapshot)(rt_scene scene, rt_snapshot* out_snapshot);
    rt_result (*release_snapshot)(rt_scene scene, rt_snapshot snapshot);
    rt_result (*sweep_shapes)(rt_scene scene, const rt_sweep_desc* desc);
    rt_result (*overlap_shapes)(rt_scene scene, const rt_overlap_desc* desc);
    rt_result (*find_nearest)(rt_scene scene, const rt_nearest_desc* desc);
    rt_result (*set_mesh_user_data)(rt_scene scene, rt_mesh mesh, uint64_t user_data);
    rt_result (*resolve_surfaces)(rt_scene scene, const rt_resolve_desc* desc);
    rt_result (*govern_frame)(rt_governor* governor, rt_frame_desc* frame,
                              const rt_frame_stats* last);
    rt_result (*set_fog)(rt_scene scene, const rt_fog* fog);
    rt_result (*add_program)(rt_scene scene, const rt_program_desc* desc, rt_program* out_program);
    rt_result (*remove_program)(rt_scene scene, rt_program program);
    rt_result (*adapt_exposure)(rt_exposure* exposure, float mean_luminance, float seconds);
    rt_result (*bake_light)(rt_scene scene, const rt_bake_desc* desc, rt_bake_report* out_report);
} rt_api;

/* The table for hosts that load the library by hand; look this one symbol up. `version` is the
 * RT_API_VERSION that the host was compiled with. Returns null for a version that this library does
 * not speak. Static storage. Thread safety: any thread, any time. */
RT_EXPORT const rt_api* rt_get_api(uint32_t version) RT_NOEXCEPT;
typedef const rt_api* (*rt_get_api_function)(uint32_t version);

#if defined(__cplusplus)
}
#endif

#endif /* PEREGRINE_RT_H */
