#include "peregrine_queries.h"

#include <stdexcept>

namespace peregrine::bench {
namespace {

class PeregrineQueries : public QueryContestant {
public:
    PeregrineQueries(const rt_api& api, const Level& level, bool whole_sets)
        : api_(api), whole_sets_(whole_sets) {
        const rt_scene_desc desc = rt_default_scene_desc();
        require(api_.create_scene(&desc, &scene_));
        try {
            build(level);
        } catch (...) {
            api_.destroy_scene(scene_);
            throw;
        }
        for (int k = 0; k < 3; ++k) options_.origin[k] = level.offset[k];
        if (level.offset != math::Vec3d(0)) used_options_ = &options_;
    }
    ~PeregrineQueries() override { api_.destroy_scene(scene_); }
    PeregrineQueries(const PeregrineQueries&) = delete;
    PeregrineQueries& operator=(const PeregrineQueries&) = delete;

    std::string name() const override { return whole_sets_ ? "peregrine-batch" : "peregrine"; }
    bool answers(QueryKind) const override { return true; }
    void prepare(const QuerySet& set) override {
        set_ = &set;
        hits_.resize(set.kind == QueryKind::all && whole_sets_ ? set.size() * kMaxCrossings : 0);
        contacts_.resize(set.kind == QueryKind::sweep && whole_sets_ ? set.size() : 0);
        nearest_.resize(set.kind == QueryKind::nearest && whole_sets_ ? set.size() : 0);
    }

    void run(QueryAnswers& answers) const override {
        const size_t step = whole_sets_ ? set_->size() : 1;
        switch (set_->kind) {
        case QueryKind::any:
            return ask_any(answers, step);
        case QueryKind::closest:
        case QueryKind::stream:
            return step == 1 ? ask_closest(answers) : ask_stream(answers);
        case QueryKind::all:
            return ask_all(answers, step);
        case QueryKind::sweep:
            return ask_sweeps(answers, step);
        case QueryKind::overlap:
            return ask_overlaps(answers, step);
        case QueryKind::nearest:
            return ask_nearest(answers, step);
        }
    }

private:
    void build(const Level& level) {
        std::vector<math::Vec3> corners;
        for (const geometry::Triangle& triangle : level.triangles)
            corners.insert(corners.end(), {triangle.v0, triangle.v1, triangle.v2});
        rt_mesh_desc mesh = rt_default_mesh_desc();
        mesh.index_type = RT_INDEX_NONE;
        mesh.positions = {corners.data(), corners.size(), 0, 0};
        rt_mesh handle;
        require(api_.add_static_mesh(scene_, &mesh, &handle));
        require(api_.set_world_origin(scene_, &level.offset.x));
        require(api_.commit_scene(scene_, nullptr, nullptr));
    }

    void require(rt_result result) const {
        if (result != RT_OK) throw std::runtime_error(api_.get_last_error());
    }

    rt_query_desc ray_query(rt_query_kind kind, size_t count) const {
        rt_query_desc query = rt_default_query_desc();
        query.kind = kind;
        query.rays = set_->rays.data();
        query.ray_count = count;
        query.options = used_options_;
        return query;
    }

    void ask_any(QueryAnswers& answers, size_t step) const {
        rt_query_desc query = ray_query(RT_QUERY_ANY, step);
        query.occluded = answers.yes.data();
        for (size_t i = 0; i < set_->size(); i += step) {
            require(api_.trace_query(scene_, &query));
            query.rays += step;
            query.occluded += step;
        }
    }

    void ask_closest(QueryAnswers& answers) const {
        rt_query_desc query = ray_query(RT_QUERY_CLOSEST, 1);
        rt_hit hit;
        query.hits = &hit;
        for (size_t i = 0; i < set_->size(); ++i, ++query.rays) {
            require(api_.trace_query(scene_, &query));
            answers.t[i] = hit.t;
        }
    }
    void ask_stream(QueryAnswers& answers) const {
        rt_query_desc query = ray_query(RT_QUERY_CLOSEST, set_->size());
        rt_hit_arrays arrays = rt_default_hit_arrays();
        arrays.t = answers.t.data();
        query.hit_arrays = &arrays;
        require(api_.trace_query(scene_, &query));
    }

    void ask_all(QueryAnswers& answers, size_t step) const {
        rt_query_desc query = ray_query(RT_QUERY_ALL, step);
        rt_hit room[kMaxCrossings];
        query.hits = step == 1 ? room : hits_.data();
        query.max_hits = uint32_t(kMaxCrossings);
        query.hit_counts = answers.counts.data();
        for (size_t i = 0; i < set_->size(); i += step) {
            require(api_.trace_query(scene_, &query));
            for (size_t k = 0; k < step; ++k)
                for (uint32_t n = 0; n < query.hit_counts[k]; ++n)
                    answers.crossings[(i + k) * kMaxCrossings + n] =
                        query.hits[k * kMaxCrossings + n].t;
            query.rays += step;
            query.hit_counts += step;
        }
    }

    void ask_sweeps(QueryAnswers& answers, size_t step) const {
        rt_sweep_desc query = rt_default_sweep_desc();
        rt_sweep_hit room;
        query.sweeps = set_->sweeps.data();
        query.sweep_count = step;
        query.hits = step == 1 ? &room : contacts_.data();
        query.options = used_options_;
        for (size_t i = 0; i < set_->size(); i += step, query.sweeps += step) {
            require(api_.sweep_shapes(scene_, &query));
            for (size_t k = 0; k < step; ++k) answers.t[i + k] = query.hits[k].t;
        }
    }

    void ask_overlaps(QueryAnswers& answers, size_t step) const {
        rt_overlap_desc query = rt_default_overlap_desc();
        query.shapes = set_->shapes.data();
        query.shape_count = step;
        query.overlapping = answers.yes.data();
        query.options = used_options_;
        for (size_t i = 0; i < set_->size(); i += step) {
            require(api_.overlap_shapes(scene_, &query));
            query.shapes += step;
            query.overlapping += step;
        }
    }

    void ask_nearest(QueryAnswers& answers, size_t step) const {
        rt_nearest_desc query = rt_default_nearest_desc();
        rt_nearest room;
        query.points = set_->points.data();
        query.point_count = step;
        query.results = step == 1 ? &room : nearest_.data();
        query.options = used_options_;
        for (size_t i = 0; i < set_->size(); i += step, query.points += step) {
            require(api_.find_nearest(scene_, &query));
            for (size_t k = 0; k < step; ++k) answers.t[i + k] = query.results[k].distance;
        }
    }

    const rt_api& api_;
    bool whole_sets_;
    rt_scene scene_{};
    rt_query_options options_ = rt_default_query_options();
    const rt_query_options* used_options_ = nullptr;
    const QuerySet* set_ = nullptr;
    mutable std::vector<rt_hit> hits_; // of whole sets, as are the next two
    mutable std::vector<rt_sweep_hit> contacts_;
    mutable std::vector<rt_nearest> nearest_;
};

} // namespace

std::unique_ptr<QueryContestant> make_peregrine_queries(const rt_api& api, const Level& level,
                                                        bool whole_sets) {
    return std::make_unique<PeregrineQueries>(api, level, whole_sets);
}

} // namespace peregrine::bench
