/* Shows a wall with the program of docs/extending.md. */
#include <peregrine/rt.h>

#include <math.h>
#include <stdio.h>

#include "doc_program.h"

#define OK(call)                                                                                   \
    if ((call) != RT_OK) {                                                                         \
        printf("%s: %s\n", #call, rt_get_last_error());                                            \
        return 1;                                                                                  \
    }

enum { kWidth = 64 };

/* A wall two metres wide, a metre ahead. */
static rt_result add_wall(rt_scene scene, rt_material material) {
    const float positions[] = {-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1};
    const float texcoords[] = {0, 0, 1, 0, 1, 1, 0, 1};
    const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
    rt_mesh_desc desc = rt_default_mesh_desc();
    rt_mesh mesh;
    desc.positions.data = positions;
    desc.texcoords.data = texcoords;
    desc.positions.count = desc.texcoords.count = 4;
    desc.indices.data = indices;
    desc.indices.count = 6;
    desc.material = material;
    return rt_add_static_mesh(scene, &desc, &mesh);
}

int main(void) {
    static float pixels[kWidth][4];
    const rt_scene_desc scene_desc = rt_default_scene_desc();
    rt_camera camera = rt_default_camera();
    rt_frame_desc frame = rt_default_frame_desc();
    rt_frame_stats stats = rt_default_frame_stats();
    Neon neon = {0.25f};
    rt_scene scene;
    rt_material material;
    int x, bands = 0;
    OK(rt_create_scene(&scene_desc, &scene));
    OK(add_neon(scene, &neon, &material));
    OK(add_wall(scene, material));
    OK(rt_commit_scene(scene, NULL, NULL));
    camera.vertical_fov = 0.03f;
    frame.format = RT_FORMAT_RGBA32F;
    frame.tone_mapping = RT_TONE_NONE;
    frame.pixels = pixels;
    frame.width = kWidth;
    frame.height = 1;
    OK(rt_render_frame(scene, &camera, &frame, &stats));
    OK(rt_destroy_scene(scene));
    for (x = 1; x < kWidth; ++x) bands += (pixels[x][0] > 2.0f) != (pixels[x - 1][0] > 2.0f);
    printf("%d edges of bands in the middle, %d hits, %d faults\n", bands, (int)stats.program_hits,
           (int)stats.program_faults);
    return bands < 6 || bands > 9 || stats.program_hits != kWidth || stats.program_faults != 0;
}
