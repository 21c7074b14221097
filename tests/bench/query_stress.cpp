#include "query_stress.h"

#include "sampling.h"

#include <cmath>
#include <map>

namespace peregrine::bench {
namespace {

using math::Vec3;
using Triangles = std::vector<geometry::Triangle>;

constexpr double kAway[] = {1e4, 1e5, 1e6, 1e7};
constexpr double kLeaksAway = 2300;
constexpr float kSmall = 1e-4f;
constexpr float kRadius = 10, kInner = 0.3f; // of closed meshes; of it, where rays start
constexpr int kSplits = 3;

void add(Triangles& triangles, const Vec3& a, const Vec3& b, const Vec3& c) {
    triangles.push_back({a, 0, b, uint32_t(triangles.size()), c, 0});
}

// Each triangle becomes four. Neighbours halve their edge alike, since addition commutes.
Triangles split(const Triangles& coarse, bool onto_sphere) {
    const auto middle = [&](const Vec3& a, const Vec3& b) {
        const Vec3 m = 0.5f * (a + b);
        return onto_sphere ? kRadius / glm::length(m) * m : m;
    };
    Triangles fine;
    for (const geometry::Triangle& t : coarse) {
        const Vec3 a = middle(t.v0, t.v1), b = middle(t.v1, t.v2), c = middle(t.v2, t.v0);
        add(fine, t.v0, a, c);
        add(fine, a, t.v1, b);
        add(fine, c, b, t.v2);
        add(fine, a, b, c);
    }
    return fine;
}

// From an octahedron's corners or, cut off, a box's.
Triangles make_sphere() {
    Triangles triangles;
    for (int octant = 0; octant < 8; ++octant) {
        const auto sign = [&](int axis) { return octant >> axis & 1 ? -kRadius : kRadius; };
        const Vec3 x(sign(0), 0, 0), y(0, sign(1), 0), z(0, 0, sign(2));
        add(triangles, x, y, z);
    }
    for (int i = 0; i < kSplits; ++i) triangles = split(triangles, true);
    return triangles;
}

Triangles make_box() {
    const Vec3 half(kRadius, 0.6f * kRadius, 0.8f * kRadius);
    Triangles triangles;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            Vec3 corner[4];
            for (int k = 0; k < 4; ++k) {
                corner[k][axis] = side;
                corner[k][(axis + 1) % 3] = k & 1 ? 1.0f : -1.0f;
                corner[k][(axis + 2) % 3] = k & 2 ? 1.0f : -1.0f;
                corner[k] *= half;
            }
            add(triangles, corner[0], corner[1], corner[2]);
            add(triangles, corner[3], corner[2], corner[1]);
        }
    for (int i = 0; i < kSplits; ++i) triangles = split(triangles, false);
    return triangles;
}

// From random places well inside; twice as far as the target.
QuerySet aim(const Triangles& triangles, bool at_edges, size_t count) {
    QuerySet set{QueryKind::any, {}, {}, {}, {}};
    Random random(17);
    const auto coordinate = [&] { return kInner * kRadius * (2 * random.uniform() - 1); };
    for (size_t i = 0; i < count; ++i) {
        const geometry::Triangle& t = triangles[i % triangles.size()];
        const Vec3 corners[3] = {t.v0, t.v1, t.v2};
        const size_t k = i / triangles.size() % 3;
        const Vec3 target = at_edges ? 0.5f * (corners[k] + corners[(k + 1) % 3]) : corners[k];
        const Vec3 from(coordinate(), coordinate(), coordinate());
        const Vec3 d = target - from;
        set.rays.push_back({{from.x, from.y, from.z}, 0, {d.x, d.y, d.z}, 2});
    }
    return set;
}

// Against what they should have said.
Accuracy compare(const std::vector<uint8_t>& said, const std::vector<uint8_t>& right) {
    size_t missed = 0, wrong = 0;
    for (size_t i = 0; i < said.size(); ++i) {
        missed += right[i] && !said[i];
        wrong += said[i] && !right[i];
    }
    const double share = 1e6 / double(said.size()), none = std::nan("");
    return {share * double(missed), share * double(wrong), none, none, said.size()};
}

} // namespace

void race_leaks(QueryRace& race, size_t count) {
    const std::map<std::string, Triangles> meshes = {{"sphere", make_sphere()},
                                                     {"box", make_box()}};
    for (const auto& [name, triangles] : meshes) {
        for (const double away : {0.0, kLeaksAway}) {
            const std::string scene = away > 0 ? name + ", 2.3 km away" : name;
            print_query_header(scene);
            const QueryContestants contestants = race.gather({triangles, math::Vec3d(away, 0, 0)});
            for (const bool at_edges : {false, true}) {
                const QuerySet set = aim(triangles, at_edges, count);
                const std::vector<uint8_t> closed(set.size(), 1);
                race.hold(scene, at_edges ? "leak-edges" : "leak-vertices", contestants, set,
                          [&](size_t, const QueryAnswers& answers) {
                              return compare(answers.yes, closed);
                          });
            }
        }
    }
}

void race_far(QueryRace& race, const TraceScene& scene, const QuerySet& sight) {
    std::vector<std::vector<uint8_t>> home;
    for (const auto& contestant : race.gather({scene.triangles})) {
        QueryAnswers answers;
        answers.make_room(sight);
        contestant->prepare(sight);
        contestant->run(answers);
        home.push_back(answers.yes);
    }
    for (const double away : kAway) {
        char item[32];
        std::snprintf(item, sizeof item, "far-1e%.0f", std::log10(away));
        race.hold(scene.name, item, race.gather({scene.triangles, math::Vec3d(away, 0, 0)}), sight,
                  [&](size_t contestant, const QueryAnswers& answers) {
                      return compare(answers.yes, home[contestant]);
                  });
    }
}

void race_small(QueryRace& race, const TraceScene& scene, const std::string& item,
                const QuerySet& set) {
    Triangles triangles = scene.triangles;
    for (geometry::Triangle& triangle : triangles)
        for (Vec3* v : {&triangle.v0, &triangle.v1, &triangle.v2}) *v *= kSmall;
    const QuerySet small = scaled(set, kSmall);
    const Reference reference(triangles, kBand * double(kSmall));
    const ReferenceAnswers right = answer_by_reference(reference, small, small.size());
    race.hold(scene.name, "1e-4-" + item, race.gather({triangles}), small,
              [&](size_t, const QueryAnswers& answers) {
                  return judge(small, answers, right, double(kSmall));
              });
}

} // namespace peregrine::bench
