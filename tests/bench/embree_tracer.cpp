#include "embree_tracer.h"

#include "embree_packet.h"
#include "embree_scene.h"
#include "flush_denormals.h"

#include <algorithm>

namespace peregrine::bench {
namespace {

constexpr size_t kStream = 256; // rays of a stream's call

constexpr RTCIntersectContextFlags kCoherent = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
constexpr RTCIntersectContextFlags kIncoherent = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;

// A call of Embree and what surrounds it.
struct Job {
    RTCScene scene;
    RTCIntersectContext* context;
    const math::Ray* rays;
    size_t first, count;
    Results& results;
};

void fill(const math::Ray& ray, RTCRay& out) {
    std::memcpy(&out.org_x, &ray.origin, 16); // with t_min
    std::memcpy(&out.dir_x, &ray.direction, 12);
    out.time = 0;
    out.tfar = ray.t_max;
    out.mask = 0xffffffffu;
    out.flags = 0;
}
void fill(const math::Ray& ray, RTCRayHit& out) {
    fill(ray, out.ray);
    out.hit.primID = out.hit.geomID = out.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
}
void take(const RTCRayHit& hit, Results& results, size_t i) {
    results.t[i] = hit.ray.tfar;
    results.triangle[i] = hit.hit.primID;
    results.mesh[i] = hit.hit.geomID;
}

void closest_single(const Job& job) {
    RTCRayHit hit;
    for (size_t i = job.first; i < job.first + job.count; ++i) {
        fill(job.rays[i], hit);
        rtcIntersect1(job.scene, job.context, &hit);
        take(hit, job.results, i);
    }
}
void any_single(const Job& job) {
    RTCRay ray;
    for (size_t i = job.first; i < job.first + job.count; ++i) {
        fill(job.rays[i], ray);
        rtcOccluded1(job.scene, job.context, &ray);
        job.results.occluded[i] = ray.tfar < 0;
    }
}

// Streams of rays one after the other.
void closest_stream(const Job& job) {
    RTCRayHit hits[kStream];
    for (size_t done = 0; done < job.count; done += kStream) {
        const size_t first = job.first + done, count = std::min(kStream, job.count - done);
        for (size_t i = 0; i < count; ++i) fill(job.rays[first + i], hits[i]);
        rtcIntersect1M(job.scene, job.context, hits, unsigned(count), sizeof *hits);
        for (size_t i = 0; i < count; ++i) take(hits[i], job.results, first + i);
    }
}
void any_stream(const Job& job) {
    RTCRay rays[kStream];
    for (size_t done = 0; done < job.count; done += kStream) {
        const size_t first = job.first + done, count = std::min(kStream, job.count - done);
        for (size_t i = 0; i < count; ++i) fill(job.rays[first + i], rays[i]);
        rtcOccluded1M(job.scene, job.context, rays, unsigned(count), sizeof *rays);
        for (size_t i = 0; i < count; ++i) job.results.occluded[first + i] = rays[i].tfar < 0;
    }
}

template <size_t N>
void mark_valid(int (&valid)[N], size_t count) {
    for (size_t i = 0; i < N; ++i) valid[i] = i < count ? -1 : 0;
}

// Packets, and streams of rays side by side.
template <size_t N>
void intersect(const Job& job, const int* valid, EmbreeRayHits<N>& hits) {
    void* p = &hits;
    if constexpr (N == 4) rtcIntersect4(valid, job.scene, job.context, static_cast<RTCRayHit4*>(p));
    if constexpr (N == 8) rtcIntersect8(valid, job.scene, job.context, static_cast<RTCRayHit8*>(p));
    if constexpr (N == 16)
        rtcIntersect16(valid, job.scene, job.context, static_cast<RTCRayHit16*>(p));
    if constexpr (N == kStream)
        rtcIntersectNM(job.scene, job.context, static_cast<RTCRayHitN*>(p), N, 1, sizeof hits);
}
template <size_t N>
void occluded(const Job& job, const int* valid, EmbreeRays<N>& rays) {
    void* p = &rays;
    if constexpr (N == 4) rtcOccluded4(valid, job.scene, job.context, static_cast<RTCRay4*>(p));
    if constexpr (N == 8) rtcOccluded8(valid, job.scene, job.context, static_cast<RTCRay8*>(p));
    if constexpr (N == 16) rtcOccluded16(valid, job.scene, job.context, static_cast<RTCRay16*>(p));
    if constexpr (N == kStream)
        rtcOccludedNM(job.scene, job.context, static_cast<RTCRayN*>(p), N, 1, sizeof rays);
}

// Rays are turned in blocks: a packet that is read right after it was written would wait for its
// own stores.
constexpr size_t kBlock = kStream;

template <size_t N>
void closest_packets(const Job& job) {
    alignas(64) int valid[N];
    EmbreeRayHits<N> packets[kBlock / N];
    for (auto& packet : packets) {
        initialise(packet.ray);
        std::memset(packet.instance, 0xff, sizeof packet.instance);
    }
    for (size_t done = 0; done < job.count; done += kBlock) {
        const size_t first = job.first + done, count = std::min(kBlock, job.count - done);
        for (size_t i = 0; i < count; i += N) {
            EmbreeRayHits<N>& packet = packets[i / N];
            load_rays(job.rays + first + i, count - i, packet.ray);
            std::memset(packet.triangle, 0xff, sizeof packet.triangle);
            std::memset(packet.mesh, 0xff, sizeof packet.mesh);
        }
        for (size_t i = 0; i < count; i += N) {
            mark_valid(valid, count - i);
            intersect(job, valid, packets[i / N]);
        }
        for (size_t i = 0; i < count; i += N) {
            const size_t n = std::min(N, count - i);
            std::copy_n(packets[i / N].ray.tfar, n, job.results.t.data() + first + i);
            std::copy_n(packets[i / N].triangle, n, job.results.triangle.data() + first + i);
            std::copy_n(packets[i / N].mesh, n, job.results.mesh.data() + first + i);
        }
    }
}
template <size_t N>
void any_packets(const Job& job) {
    alignas(64) int valid[N];
    EmbreeRays<N> packets[kBlock / N];
    for (auto& packet : packets) initialise(packet);
    for (size_t done = 0; done < job.count; done += kBlock) {
        const size_t first = job.first + done, count = std::min(kBlock, job.count - done);
        for (size_t i = 0; i < count; i += N)
            load_rays(job.rays + first + i, count - i, packets[i / N]);
        for (size_t i = 0; i < count; i += N) {
            mark_valid(valid, count - i);
            occluded(job, valid, packets[i / N]);
        }
        for (size_t i = 0; i < count; ++i)
            job.results.occluded[first + i] = packets[i / N].tfar[i % N] < 0;
    }
}

struct Mode {
    const char* name;
    RTCIntersectContextFlags flags;
    void (*closest)(const Job&);
    void (*any)(const Job&);
};
constexpr Mode kModes[] = {
    {"single", kIncoherent, closest_single, any_single},
    {"packets of 4, coherent", kCoherent, closest_packets<4>, any_packets<4>},
    {"packets of 4, incoherent", kIncoherent, closest_packets<4>, any_packets<4>},
    {"packets of 8, coherent", kCoherent, closest_packets<8>, any_packets<8>},
    {"packets of 8, incoherent", kIncoherent, closest_packets<8>, any_packets<8>},
    {"packets of 16, coherent", kCoherent, closest_packets<16>, any_packets<16>},
    {"packets of 16, incoherent", kIncoherent, closest_packets<16>, any_packets<16>},
    {"stream 1M, coherent", kCoherent, closest_stream, any_stream},
    {"stream 1M, incoherent", kIncoherent, closest_stream, any_stream},
    {"stream NM, coherent", kCoherent, closest_packets<kStream>, any_packets<kStream>},
    {"stream NM, incoherent", kIncoherent, closest_packets<kStream>, any_packets<kStream>},
};

class EmbreeTracer : public Tracer {
public:
    EmbreeTracer(const std::string& variant, std::span<const geometry::Triangle> triangles,
                 uint32_t threads)
        : variant_(variant),
          scene_(triangles,
                 "threads=" + std::to_string(threads)
                     + (variant == "embree-avx2" ? ",isa=avx2" : ""),
                 variant == "embree-robust" ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE) {
        build_ms_ = 1e3 * scene_.seconds();
        bytes_per_triangle_ = double(scene_.bytes()) / double(triangles.size());
    }

    std::string name() const override { return variant_; }
    size_t mode_count() const override { return std::size(kModes); }
    std::string mode_name(size_t mode) const override { return kModes[mode].name; }
    bool suits(size_t mode, const RaySet& set) const override {
        return mode == 0 || !set.one_by_one;
    }

    void prepare(const RaySet& set, Results& results) const override {
        const size_t count = set.rays.size();
        if (set.any) {
            results.occluded.resize(count);
        } else {
            results.t.resize(count);
            results.triangle.resize(count);
            results.mesh.resize(count);
        }
    }

    void trace(size_t mode, const RaySet& set, size_t first, size_t count,
               Results& results) const override {
        const FlushDenormals flush;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = kModes[mode].flags;
        const Job job{scene_.scene(), &context, set.rays.data(), first, count, results};
        (set.any ? kModes[mode].any : kModes[mode].closest)(job);
    }

    Answer answer(size_t, const RaySet& set, const Results& results, size_t ray) const override {
        if (set.any) return {0, results.occluded[ray] ? 0 : geometry::kNoTriangle};
        return {results.t[ray], results.triangle[ray]};
    }

private:
    std::string variant_;
    EmbreeScene scene_;
};

} // namespace

std::unique_ptr<Tracer> make_embree_tracer(const std::string& variant,
                                           std::span<const geometry::Triangle> triangles,
                                           uint32_t threads) {
    return std::make_unique<EmbreeTracer>(variant, triangles, threads);
}

} // namespace peregrine::bench
