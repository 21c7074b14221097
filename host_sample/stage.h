#pragma once

#include <functional>

#include <peregrine/rt.h>

#include "level.h"

namespace host {

struct Frame {
    uint32_t width = 0, height = 0;
    rt_pixel_format format = RT_FORMAT_RGBA8_SRGB;
    rt_tone_mapping tone_mapping = RT_TONE_FILMIC;
    rt_view view = RT_VIEW_SHADED;
    float exposure = 1.0f;
    float depth_range = 50.0f;
    bool no_shadows = false;
    uint32_t light_block = 0;  // rt_frame_desc::light_block
    uint32_t edge_samples = 1; // rt_frame_desc::edge_samples
    float occlusion_range = 0; // rt_frame_desc::occlusion_range, ...
    uint32_t occlusion_block = 8;
    float bloom = 0;               // rt_frame_desc::bloom
    uint32_t airlight_shadows = 0; // rt_frame_desc::airlight_shadows, in blocks of 2x2
    bool measures_luminance = false;
    rt_array particles{};   // rt_frame_desc::particles
    rt_snapshot snapshot{}; // null: the current one
    // The picture is traced so large and then enlarged; 0: as large as it is. Or the governor
    // chooses, by the last frame that it chose, if it has not seen that yet.
    uint32_t traced_width = 0, traced_height = 0;
    rt_governor* governor = nullptr;
    const rt_frame_stats* last = nullptr;
};

// A scene of the engine. Throws EngineError with the engine's own sentence.
class Stage {
public:
    Stage(const rt_api& api, uint32_t threads, rt_isa isa);
    ~Stage();
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    const rt_api& api() const { return api_; }
    rt_scene scene() const { return scene_; }

    void check(rt_result result, const char* what) const;

    // Returns the engine's report. `progress` gets the fraction done and may be null.
    rt_commit_report commit(rt_structure structure, rt_build_quality quality,
                            const std::function<void(float)>& progress,
                            rt_light_proofs proofs = RT_LIGHT_PROOFS_KEPT);

    // What light does between static meshes; commits from then on show it.
    rt_bake_report bake(rt_bake_desc desc, const std::function<void(float)>& progress);

    // `pixels` holds height rows of width pixels of the format, without gaps.
    rt_frame_stats render(const Viewpoint& viewpoint, const Frame& frame, void* pixels) const;

    rt_scene_stats stats() const;

private:
    const rt_api& api_;
    rt_scene scene_{};
};

} // namespace host
