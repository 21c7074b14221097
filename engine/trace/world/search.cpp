#include "trace/world/search.h"

#include "trace/world/merge.h"
#include "trace/world/visit_instances.h"

namespace peregrine::trace {
namespace {

constexpr float kNothing = -std::numeric_limits<float>::infinity();

// What is wanted of the hits of one part after the other.
class Collector {
public:
    Collector(const Judge& judge, HitList& list) : judge_(judge), list_(list) {}

    void take(const WorldHit& hit, const Filter& filter, const geometry::TriangleInfo& info) {
        if (list_.wants(hit) && filter.accepts(info, hit.back_face, hit.u, hit.v)
            && (!judge_.accepts || judge_.accepts(judge_.context, hit)))
            list_.insert(hit);
    }
    float limit() const { return list_.limit(); }

private:
    const Judge& judge_;
    HitList& list_;
};

// Content with any hit.
class AnyCollector {
public:
    explicit AnyCollector(const Judge& judge) : judge_(judge) {}

    void take(const WorldHit& hit, const Filter& filter, const geometry::TriangleInfo& info) {
        found_ = found_
                 || (filter.accepts(info, hit.back_face, hit.u, hit.v)
                     && (!judge_.accepts || judge_.accepts(judge_.context, hit)));
    }
    float limit() const { return found_ ? kNothing : std::numeric_limits<float>::infinity(); }
    bool found() const { return found_; }

private:
    const Judge& judge_;
    bool found_ = false;
};

// The hits of one part, on their way to a collector.
template <class Collector>
class PartVisitor final : public Visitor {
public:
    // `instance` null: the part's triangles say themselves whose they are.
    PartVisitor(Wants wants, const Part& part, const Instance* instance, const Filter& filter,
                Collector& collector)
        : Visitor(wants), part_(part), instance_(instance), filter_(filter), collector_(collector) {
    }

    float see(uint32_t triangle, const geometry::TriangleHit& hit) override {
        const geometry::TriangleInfo info = part_.target.infos[triangle];
        const uint32_t mesh = instance_ ? instance_->mesh : info.mesh;
        collector_.take({hit.t, hit.u, hit.v, mesh, info.primitive, hit.back_face}, filter_, info);
        return collector_.limit();
    }

private:
    const Part& part_;
    const Instance* instance_;
    const Filter& filter_;
    Collector& collector_;
};

template <class Collector>
void visit_parts(const World& world, const math::Ray& ray, const Filter& filter,
                 Visitor::Wants wants, Collector& collector, Counters& counters) {
    math::Ray left = ray;
    const auto visit = [&](const Part& part, const math::Ray& local, const Filter& within,
                           const Instance* instance) {
        PartVisitor<Collector> visitor(wants, part, instance, within, collector);
        part.kernels->visit(part.target, local, visitor);
        counters += visitor.counters;
        left.t_max = std::min(ray.t_max, collector.limit());
    };
    visit(world.fixed, left, filter, nullptr);
    if (!world.deforming.empty()) visit(world.deforming, left, filter, nullptr);
    if (!world.nodes) return;
    visit_instances(world, ray, left.t_max, [&](const Instance& instance) {
        math::Ray local;
        if (!sees(filter, instance) || !to_local(instance.to_local, left, local)) return false;
        ++counters.instances;
        visit(instance.part, local, filter_within(filter, instance), &instance);
        return collector.limit() == kNothing;
    });
}

} // namespace

bool Search::closest(const math::Ray& ray, WorldHit& hit) {
    HitList list(1);
    collect(ray, list, Visitor::Wants::hits);
    if (!list.full()) return false;
    hit = list.hits().front();
    return true;
}

bool Search::occluded(const math::Ray& ray) {
    AnyCollector collector(judge_);
    visit_parts(world_, ray, filter_, Visitor::Wants::hits, collector, counters_);
    return collector.found();
}

void Search::collect(const math::Ray& ray, HitList& list, Visitor::Wants wants) {
    Collector collector(judge_, list);
    visit_parts(world_, ray, filter_, wants, collector, counters_);
}

} // namespace peregrine::trace
