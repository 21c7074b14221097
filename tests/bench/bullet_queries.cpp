#include "bullet_queries.h"

#include <algorithm>
#include <btBulletCollisionCommon.h>
#include <limits>

namespace peregrine::bench {
namespace {

static_assert(sizeof(btScalar) == sizeof(float), "single precision, as packages have it");

constexpr float kInfinity = std::numeric_limits<float>::infinity();

btVector3 to_bullet(const float* v) {
    return {v[0], v[1], v[2]};
}
btTransform at(const btVector3& position) {
    return btTransform(btQuaternion::getIdentity(), position);
}

// Stops at the first hit that it hears of.
struct AnyHit : btCollisionWorld::RayResultCallback {
    btScalar addSingleResult(btCollisionWorld::LocalRayResult& hit, bool) override {
        m_collisionObject = hit.m_collisionObject;
        return m_closestHitFraction = 0;
    }
};

struct ClosestHit : btCollisionWorld::RayResultCallback {
    btScalar addSingleResult(btCollisionWorld::LocalRayResult& hit, bool) override {
        m_collisionObject = hit.m_collisionObject;
        return m_closestHitFraction = hit.m_hitFraction;
    }
};

struct AllHits : btCollisionWorld::RayResultCallback {
    std::vector<float>& fractions;

    explicit AllHits(std::vector<float>& list) : fractions(list) { fractions.clear(); }
    btScalar addSingleResult(btCollisionWorld::LocalRayResult& hit, bool) override {
        fractions.push_back(hit.m_hitFraction);
        return m_closestHitFraction;
    }
};

struct FirstContact : btCollisionWorld::ConvexResultCallback {
    btScalar addSingleResult(btCollisionWorld::LocalConvexResult& hit, bool) override {
        return m_closestHitFraction = hit.m_hitFraction;
    }
};

// Contacts are reported before things touch, too.
struct AnyContact : btCollisionWorld::ContactResultCallback {
    bool found = false;

    btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                             const btCollisionObjectWrapper*, int, int) override {
        found |= point.getDistance() <= 0;
        return 0;
    }
};

// Vertices of a level, three a triangle.
class Mesh {
public:
    explicit Mesh(std::span<const geometry::Triangle> triangles) {
        for (const geometry::Triangle& triangle : triangles) {
            for (const math::Vec3& v : {triangle.v0, triangle.v1, triangle.v2}) {
                indices_.push_back(int(indices_.size()));
                corners_.push_back(v);
                bounds_.extend(v);
            }
        }
        view_ = std::make_unique<btTriangleIndexVertexArray>(
            int(triangles.size()), indices_.data(), int(3 * sizeof(int)), int(corners_.size()),
            &corners_[0].x, int(sizeof(math::Vec3)));
    }

    btTriangleIndexVertexArray* view() const { return view_.get(); }
    float diagonal() const { return glm::length(bounds_.upper - bounds_.lower); }

private:
    std::vector<int> indices_;
    std::vector<math::Vec3> corners_;
    math::Box bounds_;
    std::unique_ptr<btTriangleIndexVertexArray> view_;
};

class BulletQueries : public QueryContestant {
public:
    explicit BulletQueries(const Level& level)
        : offset_(level.offset), mesh_(level.triangles), shape_(mesh_.view(), true) {
        shape_.setMargin(0);
        body_.setCollisionShape(&shape_);
        const math::Vec3 offset(offset_);
        body_.setWorldTransform(at(to_bullet(&offset.x)));
        world_.addCollisionObject(&body_, btBroadphaseProxy::StaticFilter);
    }
    ~BulletQueries() override { world_.removeCollisionObject(&body_); }

    std::string name() const override { return "bullet"; }
    bool answers(QueryKind kind) const override { return kind != QueryKind::nearest; }
    void prepare(const QuerySet& set) override { set_ = moved(set, offset_); }

    void run(QueryAnswers& answers) const override {
        switch (set_.kind) {
        case QueryKind::any:
            return ask_any(answers);
        case QueryKind::closest:
        case QueryKind::stream: // there are no streams: one after the other
            return ask_closest(answers);
        case QueryKind::all:
            return ask_all(answers);
        case QueryKind::sweep:
            return ask_sweeps(answers);
        case QueryKind::overlap:
            return ask_overlaps(answers);
        case QueryKind::nearest:
            return;
        }
    }

private:
    // Segments have two ends there; beyond this length is nothing.
    float end_of(const rt_ray& ray) const { return std::min(ray.t_max, 2 * mesh_.diagonal()); }

    void test(const rt_ray& ray, btCollisionWorld::RayResultCallback& result) const {
        const btVector3 from = to_bullet(ray.origin);
        world_.rayTest(from, from + end_of(ray) * to_bullet(ray.direction), result);
    }

    void ask_any(QueryAnswers& answers) const {
        for (size_t i = 0; i < set_.size(); ++i) {
            AnyHit result;
            test(set_.rays[i], result);
            answers.yes[i] = result.hasHit();
        }
    }

    void ask_closest(QueryAnswers& answers) const {
        for (size_t i = 0; i < set_.size(); ++i) {
            ClosestHit result;
            test(set_.rays[i], result);
            answers.t[i] =
                result.hasHit() ? result.m_closestHitFraction * end_of(set_.rays[i]) : kInfinity;
        }
    }

    void ask_all(QueryAnswers& answers) const {
        std::vector<float> fractions;
        for (size_t i = 0; i < set_.size(); ++i) {
            AllHits result(fractions);
            test(set_.rays[i], result);
            std::sort(fractions.begin(), fractions.end());
            answers.counts[i] = uint32_t(std::min(fractions.size(), kMaxCrossings));
            for (uint32_t k = 0; k < answers.counts[i]; ++k)
                answers.crossings[i * kMaxCrossings + k] = fractions[k] * end_of(set_.rays[i]);
        }
    }

    void ask_sweeps(QueryAnswers& answers) const {
        for (size_t i = 0; i < set_.size(); ++i) {
            const rt_sweep& sweep = set_.sweeps[i];
            const btVector3 from = to_bullet(sweep.center);
            const btVector3 to = from + sweep.t_max * to_bullet(sweep.direction);
            FirstContact result;
            if (sweep.axis[1] > 0) {
                const btCapsuleShape capsule(sweep.radius, 2 * sweep.axis[1]);
                world_.convexSweepTest(&capsule, at(from), at(to), result);
            } else {
                const btSphereShape sphere(sweep.radius);
                world_.convexSweepTest(&sphere, at(from), at(to), result);
            }
            answers.t[i] = result.hasHit() ? result.m_closestHitFraction * sweep.t_max : kInfinity;
        }
    }

    bool touches(const rt_shape& shape, btCollisionShape& made) const {
        btTransform place = at(to_bullet(shape.center));
        if (shape.kind == RT_SHAPE_BOX)
            place.setRotation(btQuaternion(shape.rotation[0], shape.rotation[1], shape.rotation[2],
                                           shape.rotation[3]));
        btCollisionObject object;
        object.setCollisionShape(&made);
        object.setWorldTransform(place);
        AnyContact result;
        world_.contactTest(&object, result);
        return result.found;
    }

    void ask_overlaps(QueryAnswers& answers) const {
        for (size_t i = 0; i < set_.size(); ++i) {
            const rt_shape& shape = set_.shapes[i];
            if (shape.kind == RT_SHAPE_SPHERE) {
                btSphereShape sphere(shape.radius);
                answers.yes[i] = touches(shape, sphere);
            } else if (shape.kind == RT_SHAPE_CAPSULE) {
                btCapsuleShape capsule(shape.radius, 2 * shape.extent[1]);
                answers.yes[i] = touches(shape, capsule);
            } else {
                btBoxShape box(to_bullet(shape.extent));
                box.setMargin(0); // which would round its corners
                answers.yes[i] = touches(shape, box);
            }
        }
    }

    math::Vec3d offset_;
    Mesh mesh_;
    btBvhTriangleMeshShape shape_;
    btCollisionObject body_;
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_{&configuration_};
    btDbvtBroadphase broadphase_;
    mutable btCollisionWorld world_{&dispatcher_, &broadphase_, &configuration_}; // not const there
    QuerySet set_{};
};

} // namespace

std::unique_ptr<QueryContestant> make_bullet_queries(const Level& level) {
    return std::make_unique<BulletQueries>(level);
}

} // namespace peregrine::bench
