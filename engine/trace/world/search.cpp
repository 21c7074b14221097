#include "trace/world/search.h"

#include "trace/world/merge.h"
#include "trace/world/visit_instances.h"

namespace peregrine::trace {
namespace {

constexpr float kNothing = -std::numeric_limits<float>::infinity();

// As HitList, but content with any hit.
class AnyHit {
public:
    bool wants(const WorldHit&) const { return !found_; }
    void insert(const WorldHit&) { found_ = true; }
    float limit() const { return found_ ? kNothing : std::numeric_limits<float>::infinity(); }
    bool found() const { return found_; }

private:
    bool found_ = false;
};

// The hits of one part of the world on their way to a HitList or an AnyHit.
template <class Hits>
class PartVisitor final : public Visitor {
public:
    // `instance` null: the part's triangles say themselves whose they are.
    PartVisitor(Wants wants, const Part& part, const Instance* instance, const Filter& filter,
                const Judge& judge, Hits& hits)
        : Visitor(wants), part_(part), instance_(instance), filter_(filter), judge_(judge),
          hits_(hits) {}

    float see(uint32_t triangle, const geometry::TriangleHit& hit) override {
        const geometry::TriangleInfo info = part_.target.infos[triangle];
        const uint32_t mesh = instance_ ? instance_->mesh : info.mesh;
        const WorldHit found = {hit.t, hit.u, hit.v, mesh, info.primitive, hit.back_face};
        if (hits_.wants(found) && filter_.accepts(info, hit.back_face, hit.u, hit.v)
            && (!judge_.accepts || judge_.accepts(judge_.context, found)))
            hits_.insert(found);
        return hits_.limit();
    }

private:
    const Part& part_;
    const Instance* instance_;
    const Filter& filter_;
    const Judge& judge_;
    Hits& hits_;
};

} // namespace

bool Search::closest(const math::Ray& ray, const Position& position, WorldHit& hit) {
    HitList list(1);
    visit_parts(ray, position, Visitor::Wants::hits, list);
    if (!list.full()) return false;
    hit = list.hits().front();
    return true;
}

bool Search::occluded(const math::Ray& ray, const Position& position) {
    AnyHit any;
    visit_parts(ray, position, Visitor::Wants::hits, any);
    return any.found();
}

void Search::collect_crossings(const math::Ray& ray, const Position& position, HitList& list) {
    visit_parts(ray, position, Visitor::Wants::crossings, list);
}

template <class Hits>
void Search::visit_parts(const math::Ray& ray, const Position& position, Visitor::Wants wants,
                         Hits& hits) {
    math::Ray left = ray; // what is left of it in front of the hits that are known
    const auto visit = [&](const Part& part, const math::Ray& local, const Filter& filter,
                           const Instance* instance) {
        PartVisitor<Hits> visitor(wants, part, instance, filter, judge_, hits);
        part.kernels->visit(part.target, local, visitor);
        counters_ += visitor.counters;
        left.t_max = std::min(ray.t_max, hits.limit());
        return hits.limit() == kNothing;
    };
    if (visit(world_.fixed, left, filter_, nullptr)) return;
    if (!world_.nodes) return;
    EnteredNode entered;
    const RayGate gate(world_, left, position, entered);
    visit_instances(world_, gate, entered, left.t_max, [&](const Instance& instance) {
        math::Ray local;
        if (!sees(filter_, instance) || !within(instance, left, position, local)) return false;
        counters_.instances += instance.has_own_space();
        return visit(instance.part, local, filter_within(filter_, instance), &instance);
    });
}

} // namespace peregrine::trace
