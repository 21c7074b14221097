#include "peregrine_modes.h"

#include "transpose.h"

#include <algorithm>
#include <stdexcept>

namespace peregrine::bench {
namespace {

bool for_all(const RaySet&) {
    return true;
}
bool for_batches(const RaySet& set) {
    return !set.one_by_one;
}
bool for_views(const RaySet& set) {
    return !set.views.empty();
}

// What a host knows of such rays.
rt_coherence hint_for(const RaySet& set) {
    if (set.common_origin) return RT_COHERENCE_COMMON_ORIGIN;
    return set.kind == 'R' ? RT_COHERENCE_COHERENT : RT_COHERENCE_INCOHERENT;
}

Answer answer_any(const Results& results, size_t ray) {
    return {0, results.occluded[ray] ? 0 : geometry::kNoTriangle};
}

// -------------------------------------------------------------------------------------- records

rt_query_desc query_records(const DoorJob& job) {
    rt_query_desc query = rt_default_query_desc();
    query.kind = job.set.any ? RT_QUERY_ANY : RT_QUERY_CLOSEST;
    query.rays = reinterpret_cast<const rt_ray*>(job.set.rays.data() + job.first);
    query.ray_count = job.count;
    query.hits = job.set.any ? nullptr : job.results.hits.data() + job.first;
    query.occluded = job.set.any ? job.results.occluded.data() + job.first : nullptr;
    return query;
}

void trace_singles(const DoorJob& job) {
    rt_query_desc query = query_records(job);
    query.ray_count = 1;
    for (size_t i = 0; i < job.count; ++i, ++query.rays) {
        job.require(job.api.trace_query(job.scene, &query));
        job.set.any ? void(++query.occluded) : void(++query.hits);
    }
}

void trace_batch(const DoorJob& job) {
    const rt_query_desc query = query_records(job);
    job.require(job.api.trace_query(job.scene, &query));
}

void trace_batch_with_hint(const DoorJob& job) {
    rt_query_desc query = query_records(job);
    query.coherence = hint_for(job.set);
    job.require(job.api.trace_query(job.scene, &query));
}

Answer answer_record(const RaySet& set, const Results& results, size_t ray) {
    if (set.any) return answer_any(results, ray);
    return {results.hits[ray].t, results.hits[ray].triangle};
}

// --------------------------------------------------------------------------------------- arrays

constexpr size_t kBlock = 1024; // rays that are turned into arrays and traced by one call

struct alignas(64) ArrayBlock {
    float lane[8][kBlock]; // in the order of rt_ray's members

    void load(const math::Ray* rays, size_t count) {
        static_assert(sizeof(math::Ray) == 8 * sizeof(float));
        size_t i = 0;
        for (; i + 4 <= count; i += 4) {
            const float* four = &rays[i].origin.x;
            transpose4(four, 8, lane[0] + i, lane[1] + i, lane[2] + i, lane[3] + i);
            transpose4(four + 4, 8, lane[4] + i, lane[5] + i, lane[6] + i, lane[7] + i);
        }
        for (; i < count; ++i)
            for (size_t k = 0; k < 8; ++k) lane[k][i] = (&rays[i].origin.x)[k];
    }
};

void trace_arrays(const DoorJob& job) {
    ArrayBlock block;
    rt_ray_arrays rays = rt_default_ray_arrays();
    for (size_t k = 0; k < 3; ++k) {
        rays.origin[k] = block.lane[k];
        rays.direction[k] = block.lane[4 + k];
    }
    rays.t_min = block.lane[3];
    rays.t_max = block.lane[7];
    rt_hit_arrays hits = rt_default_hit_arrays();
    rt_query_desc query = rt_default_query_desc();
    query.kind = job.set.any ? RT_QUERY_ANY : RT_QUERY_CLOSEST;
    query.coherence = hint_for(job.set);
    query.ray_arrays = &rays;
    query.hit_arrays = job.set.any ? nullptr : &hits;
    for (size_t done = 0; done < job.count; done += kBlock) {
        const size_t first = job.first + done;
        query.ray_count = std::min(kBlock, job.count - done);
        block.load(job.set.rays.data() + first, query.ray_count);
        if (job.set.any) {
            query.occluded = job.results.occluded.data() + first;
        } else {
            hits.t = job.results.t.data() + first;
            hits.triangle = job.results.triangle.data() + first;
            hits.mesh = job.results.meshes.data() + first;
        }
        job.require(job.api.trace_query(job.scene, &query));
    }
}

Answer answer_array(const RaySet& set, const Results& results, size_t ray) {
    if (set.any) return answer_any(results, ray);
    return {results.t[ray], results.triangle[ray]};
}

// --------------------------------------------------------------------------------------- frames

// The rays of P are the renderer's own. Planes lie one view after the other.
void trace_frames(const DoorJob& job) {
    const uint32_t width = job.set.image_width, height = job.set.image_height;
    const size_t pixels = size_t(width) * height;
    for (size_t view = job.first / pixels; view * pixels < job.first + job.count; ++view) {
        const host::Viewpoint& point = job.set.views[view];
        rt_camera camera = rt_default_camera();
        camera.vertical_fov = point.vertical_fov;
        for (int k = 0; k < 3; ++k) {
            camera.position[k] = point.position[k];
            camera.forward[k] = point.forward[k];
            camera.up[k] = point.up[k];
        }
        rt_frame_desc frame = rt_default_frame_desc();
        frame.width = width;
        frame.height = height;
        frame.depth = job.results.t.data() + view * pixels;
        frame.triangle_ids = job.results.triangle.data() + view * pixels;
        frame.mesh_ids = job.results.meshes.data() + view * pixels;
        job.require(job.api.render_frame(job.scene, &camera, &frame, nullptr));
    }
}

Answer answer_pixel(const RaySet& set, const Results& results, size_t ray) {
    return answer_array(set, results, set.pixels[ray]);
}

constexpr DoorMode kModes[] = {
    {"single", for_all, trace_singles, answer_record},
    {"batch", for_batches, trace_batch, answer_record},
    {"batch, hint", for_batches, trace_batch_with_hint, answer_record},
    {"arrays", for_batches, trace_arrays, answer_array},
    {"frame", for_views, trace_frames, answer_pixel, true},
};

} // namespace

void DoorJob::require(rt_result result) const {
    if (result != RT_OK) throw std::runtime_error(api.get_last_error());
}

std::span<const DoorMode> door_modes() {
    return kModes;
}

} // namespace peregrine::bench
