#include "embree_queries.h"

#include "embree_scene.h"
#include "flush_denormals.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace peregrine::bench {
namespace {

constexpr size_t kStream = 256; // rays of a stream's call

std::vector<geometry::Triangle> place(const Level& level) {
    std::vector<geometry::Triangle> triangles(level.triangles.begin(), level.triangles.end());
    for (geometry::Triangle& triangle : triangles)
        for (math::Vec3* v : {&triangle.v0, &triangle.v1, &triangle.v2})
            *v = math::Vec3(math::Vec3d(*v) + level.offset);
    return triangles;
}

void fill(const rt_ray& ray, RTCRay& out) {
    std::memcpy(&out.org_x, ray.origin, 16); // with t_min
    std::memcpy(&out.dir_x, ray.direction, 12);
    out.time = 0;
    out.tfar = ray.t_max;
    out.mask = 0xffffffffu;
    out.flags = 0;
}
void fill(const rt_ray& ray, RTCRayHit& out) {
    fill(ray, out.ray);
    out.hit.primID = out.hit.geomID = out.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
}
float time_of(const RTCRayHit& hit) {
    return hit.hit.geomID == RTC_INVALID_GEOMETRY_ID ? std::numeric_limits<float>::infinity()
                                                     : hit.ray.tfar;
}

// Refuses every hit after it has written it down.
struct Collector {
    RTCIntersectContext context; // first: the filter gets no other pointer
    std::vector<float> t;

    static void filter(const RTCFilterFunctionNArguments* arguments) {
        auto* self = reinterpret_cast<Collector*>(arguments->context);
        self->t.push_back(RTCRayN_tfar(arguments->ray, arguments->N, 0));
        arguments->valid[0] = 0;
    }
};

class EmbreeQueries : public QueryContestant {
public:
    EmbreeQueries(const Level& level, bool robust)
        : robust_(robust), offset_(level.offset), triangles_(place(level)),
          scene_(triangles_, "threads=1", flags()),
          // With spatial splits a filter would see some hits more than once.
          filtered_(triangles_, "threads=1", flags() | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION,
                    RTC_BUILD_QUALITY_MEDIUM) {}

    std::string name() const override { return robust_ ? "embree-robust" : "embree"; }
    bool answers(QueryKind kind) const override {
        return kind != QueryKind::sweep && kind != QueryKind::overlap;
    }
    void prepare(const QuerySet& set) override { set_ = moved(set, offset_); }

    void run(QueryAnswers& answers) const override {
        const FlushDenormals flush;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        switch (set_.kind) {
        case QueryKind::any:
            return ask_any(answers, context);
        case QueryKind::closest:
            return ask_closest(answers, context);
        case QueryKind::stream:
            return ask_stream(answers, context);
        case QueryKind::all:
            return ask_all(answers);
        case QueryKind::nearest:
            return ask_nearest(answers);
        case QueryKind::sweep:
        case QueryKind::overlap:
            return;
        }
    }

private:
    RTCSceneFlags flags() const { return robust_ ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE; }

    void ask_any(QueryAnswers& answers, RTCIntersectContext& context) const {
        RTCRay ray;
        for (size_t i = 0; i < set_.size(); ++i) {
            fill(set_.rays[i], ray);
            rtcOccluded1(scene_.scene(), &context, &ray);
            answers.yes[i] = ray.tfar < 0;
        }
    }

    void ask_closest(QueryAnswers& answers, RTCIntersectContext& context) const {
        RTCRayHit hit;
        for (size_t i = 0; i < set_.size(); ++i) {
            fill(set_.rays[i], hit);
            rtcIntersect1(scene_.scene(), &context, &hit);
            answers.t[i] = time_of(hit);
        }
    }

    void ask_stream(QueryAnswers& answers, RTCIntersectContext& context) const {
        RTCRayHit hits[kStream];
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
        for (size_t first = 0; first < set_.size(); first += kStream) {
            const size_t count = std::min(kStream, set_.size() - first);
            for (size_t i = 0; i < count; ++i) fill(set_.rays[first + i], hits[i]);
            rtcIntersect1M(scene_.scene(), &context, hits, unsigned(count), sizeof *hits);
            for (size_t i = 0; i < count; ++i) answers.t[first + i] = time_of(hits[i]);
        }
    }

    void ask_all(QueryAnswers& answers) const {
        Collector collector;
        rtcInitIntersectContext(&collector.context);
        collector.context.filter = Collector::filter;
        RTCRayHit hit;
        for (size_t i = 0; i < set_.size(); ++i) {
            collector.t.clear();
            fill(set_.rays[i], hit);
            rtcIntersect1(filtered_.scene(), &collector.context, &hit);
            std::sort(collector.t.begin(), collector.t.end());
            answers.counts[i] = uint32_t(std::min(collector.t.size(), kMaxCrossings));
            std::copy_n(collector.t.begin(), answers.counts[i],
                        answers.crossings.begin() + std::ptrdiff_t(i * kMaxCrossings));
        }
    }

    // Embree finds the triangles; the point on them is the host's to find.
    static bool shrink_to(RTCPointQueryFunctionArguments* arguments) {
        const auto& self = *static_cast<const EmbreeQueries*>(arguments->userPtr);
        const geometry::Triangle& triangle = self.triangles_[arguments->primID];
        RTCPointQuery& query = *arguments->query;
        const math::Vec3 p(query.x, query.y, query.z);
        const Corners<float> corners{{triangle.v0, triangle.v1, triangle.v2}};
        const float distance = glm::length(p - nearest_on_triangle(p, corners));
        if (distance > query.radius) return false;
        query.radius = distance;
        return true;
    }
    void ask_nearest(QueryAnswers& answers) const {
        RTCPointQueryContext context;
        for (size_t i = 0; i < set_.size(); ++i) {
            const rt_point& point = set_.points[i];
            // An ulp more, so that a radius that is no longer this one says that there was a hit.
            const float far = std::nextafter(point.radius, 2 * point.radius);
            RTCPointQuery query{point.position[0], point.position[1], point.position[2], 0, far};
            rtcInitPointQueryContext(&context);
            rtcPointQuery(scene_.scene(), &query, &context, shrink_to,
                          const_cast<EmbreeQueries*>(this));
            answers.t[i] =
                query.radius < far ? query.radius : std::numeric_limits<float>::infinity();
        }
    }

    bool robust_;
    math::Vec3d offset_;
    std::vector<geometry::Triangle> triangles_;
    EmbreeScene scene_, filtered_;
    QuerySet set_{};
};

} // namespace

std::unique_ptr<QueryContestant> make_embree_queries(const Level& level, bool robust) {
    return std::make_unique<EmbreeQueries>(level, robust);
}

} // namespace peregrine::bench
