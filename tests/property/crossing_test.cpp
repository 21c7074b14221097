// All hits of a ray, in order: as many as brute force finds, and closed surfaces are entered as
// often as they are left, also where rays run through vertices and along edges.
#include "query/valid_ray.h"
#include "support/query_world.h"
#include "support/world.h"

#include <gtest/gtest.h>

namespace peregrine::test {
namespace {

using math::Ray;
using math::Vec3;
using query::Hit;
using scene::MeshKind;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr base::Isa kIsas[] = {base::Isa::scalar, base::Isa::sse4, base::Isa::avx2,
                               base::Isa::avx512, base::Isa::neon};

struct Build {
    const char* name;
    trace::Structure structure;
    accel::bvh::Quality quality = accel::bvh::Quality::balanced;
    bool compact = false;
};
constexpr Build kBuilds[] = {
    {"bvh", trace::Structure::bvh},
    {"fast bvh", trace::Structure::bvh, accel::bvh::Quality::fast},
    {"best bvh", trace::Structure::bvh, accel::bvh::Quality::best},
    {"compact bvh", trace::Structure::bvh, accel::bvh::Quality::best, true},
    {"kdtree", trace::Structure::kdtree},
    {"bih", trace::Structure::bih}};

// What queries say of rays: as many hits a ray as there is room for, and how many there are.
struct Answers {
    std::vector<Hit> hits;
    std::vector<uint32_t> stored, counts;
    uint32_t most;

    Answers(const scene::Snapshot& snapshot, const std::vector<Ray>& rays, uint32_t most_)
        : hits(rays.size() * most_), stored(rays.size()), counts(rays.size()), most(most_) {
        const auto strided = [](std::vector<uint32_t>& numbers) {
            return query::Strided<uint32_t>{reinterpret_cast<std::byte*>(numbers.data()),
                                            numbers.size(), sizeof(uint32_t)};
        };
        query::all_hits(
            snapshot, rays_of(rays), {},
            {reinterpret_cast<std::byte*>(hits.data()), sizeof(Hit), most, strided(stored), {}});
        query::count_hits(snapshot, rays_of(rays), {}, strided(counts));
    }

    bool right(size_t ray, const std::vector<Hit>& expected) const {
        const size_t count = std::min<size_t>(most, expected.size());
        return counts[ray] == expected.size() && stored[ray] == count
               && same_hits(&hits[ray * most], expected.data(), count);
    }
};

// Calls work(name, snapshot) for each structure on each instruction set; make(world) fills worlds.
template <class Make, class Work>
void for_each_snapshot(Make&& make, Work&& work) {
    for (const base::Isa isa : kIsas) {
        if (!base::is_available(isa)) continue;
        QueryWorld world(isa);
        make(world);
        for (const Build& build : kBuilds) {
            world.scene.touch_triangles(MeshKind::fixed);
            world.commit(build.structure, build.quality, build.compact);
            const scene::SnapshotStore::Pin pin(world.scene.snapshots);
            work(std::string(build.name) + ", isa " + std::to_string(int(isa)), world, *pin.get());
        }
    }
}

template <class Make>
void expect_brute_force(Make&& make, size_t rays_each, uint32_t seed, uint32_t most) {
    std::vector<Ray> rays;
    std::vector<std::vector<Hit>> expected;
    for_each_snapshot(
        make, [&](const std::string& name, QueryWorld& world, const scene::Snapshot& snapshot) {
            if (rays.empty()) {
                for (RaySet& set : make_ray_sets(world.triangles(), {}, {}, rays_each, seed))
                    for (const Ray& ray : set.rays)
                        if (query::is_valid(ray)) rays.push_back(ray);
                for (const Ray& ray : rays)
                    expected.push_back(world.crossings(ray, [](const Hit&) { return true; }));
            }
            for (auto& hits : expected) // the only thing that differs between the worlds
                for (Hit& hit : hits) hit.mesh.generation = world.parts[0].mesh.generation;
            const Answers answers(snapshot, rays, most);
            size_t wrong = 0;
            for (size_t i = 0; i < rays.size(); ++i) wrong += !answers.right(i, expected[i]);
            EXPECT_EQ(wrong, 0u) << name << ", of " << rays.size();
        });
}

TEST(AllHits, EqualBruteForce) {
    for (const uint32_t most : {1u, 3u, 200u})
        expect_brute_force(
            [](QueryWorld& world) { world.add(soup(1, 700, 0.5f), MeshKind::fixed); },
            rays_per_set(60), most, most);
}

// More than one go of HitList's room.
TEST(AllHits, OfManyLayers) {
    const auto make = [](QueryWorld& world) {
        TriangleList list;
        for (int i = 0; i < 500; ++i) {
            const float z = float(i % 250); // each twice: equal t
            list.add({-1, -1, z}, {3, -1, z}, {-1, 3, z});
        }
        world.add(list.triangles, MeshKind::fixed);
        world.add(list.triangles, MeshKind::deforming);
    };
    expect_brute_force(make, rays_per_set(40), 1, 700);
    expect_brute_force(make, rays_per_set(20), 2, 130);
}

TEST(AllHits, OfAllKindsOfMeshes) {
    const auto make = [](QueryWorld& world) {
        std::mt19937 random(3);
        world.add(soup(2, 300, 0.4f), MeshKind::fixed);
        world.add(soup(3, 200, 0.3f), MeshKind::deforming);
        world.add(soup(4, 100, 0.5f), MeshKind::rigid);
        for (int i = 0; i < 6; ++i) world.add_instance(2);
        for (size_t i = 2; i < world.parts.size(); ++i)
            world.place(i, random_placement(random, 1.5));
    };
    expect_brute_force(make, rays_per_set(60), 4, 5);
    expect_brute_force(make, rays_per_set(60), 5, 100);
}

TEST(AllHits, OfTheHall) {
    const SceneFile hall = load_scene("hall");
    expect_brute_force([&](QueryWorld& world) { world.add(hall.triangles, MeshKind::fixed); },
                       rays_per_set(10), 7, 8);
}

TEST(AllHits, OfExtremeSizes) {
    for (const float scale : {1e-38f, 1e-20f, 1e20f, 4e29f})
        expect_brute_force(
            [&](QueryWorld& world) { world.add(soup(6, 150, 0.5f, scale), MeshKind::fixed); },
            rays_per_set(20), 6, 20);
}

// ------------------------------------------------------------------------------------- parity
//
//            ,-*-.      Every passage counts once: a ray that leaves through the vertex * meets
//      ---->/     \     five triangles there and crosses an odd number of them, with one back more
//      o--->*      *    than fronts.
//            \   /

struct Aims {
    std::vector<Ray> inside, outside;
};

// At vertices, middles of edges, points of edges, along edges and anywhere. `middle` gives points
// inside.
template <class Middle>
Aims make_aims(const std::vector<geometry::Triangle>& triangles, float scale, size_t count,
               Middle&& middle) {
    std::mt19937 random(9);
    std::uniform_real_distribution<float> unit(-1, 1);
    const auto point = [&] { return Vec3(unit(random), unit(random), unit(random)); };
    const auto aim = [&](const Vec3& origin, size_t kind) {
        const geometry::Triangle& triangle = triangles[random() % triangles.size()];
        const Vec3 a = triangle.v0, b = triangle.v1, c = triangle.v2;
        const float s = std::fabs(unit(random));
        const Vec3 targets[] = {a, 0.5f * (a + b), b + s * (c - b), origin + scale * point()};
        return Ray{origin, 0, targets[kind % 4] - origin, kInfinity};
    };
    Aims aims;
    for (size_t i = 0; i < count; ++i) {
        aims.inside.push_back(aim(middle(random), i));
        const Vec3 away = middle(random) + 8 * scale * glm::normalize(point() + Vec3(0, 0, 1e-3f));
        aims.outside.push_back(aim(away, i));
        // Along an edge, and through a vertex along an axis, from outside.
        const geometry::Triangle& triangle = triangles[random() % triangles.size()];
        const Vec3 edge = triangle.v1 - triangle.v0;
        const float steps = 16 * scale / glm::length(edge);
        aims.outside.push_back({triangle.v0 - steps * edge, 0, edge, kInfinity});
        Vec3 axis(0);
        axis[int(i % 3)] = i & 4 ? 1.0f : -1.0f;
        aims.outside.push_back({triangle.v0 - 16 * scale * axis, 0, axis, kInfinity});
    }
    return aims;
}

// Backs less fronts.
int passages(const Answers& answers, size_t ray) {
    int sum = 0;
    for (uint32_t k = 0; k < answers.stored[ray]; ++k)
        sum += answers.hits[ray * answers.most + k].back_face ? 1 : -1;
    return sum;
}

void expect_parity(const std::string& name, const scene::Snapshot& snapshot,
                   const std::vector<Ray>& rays, int expected) {
    const Answers answers(snapshot, rays, 64);
    size_t wrong = 0;
    for (size_t i = 0; i < rays.size(); ++i)
        wrong += answers.counts[i] > answers.most || answers.stored[i] != answers.counts[i]
                 || passages(answers, i) != expected || int(answers.counts[i] % 2) != expected;
    EXPECT_EQ(wrong, 0u) << name << (expected ? ", from inside" : ", from outside") << ", of "
                         << rays.size();
}

template <class Middle>
void expect_closed(const ClosedMesh& mesh, const Vec3& offset, float scale, Middle&& middle) {
    Aims aims;
    const auto make = [&](QueryWorld& world) {
        world.add(mesh, MeshKind::fixed, offset, scale);
        if (aims.inside.empty())
            aims = make_aims(world.triangles(), scale, rays_per_set(1500),
                             [&](auto& random) { return offset + scale * middle(random); });
    };
    for_each_snapshot(make,
                      [&](const std::string& name, QueryWorld&, const scene::Snapshot& snapshot) {
                          expect_parity(name, snapshot, aims.inside, 1);
                          expect_parity(name, snapshot, aims.outside, 0);
                      });
}

Vec3 near_center(std::mt19937& random) {
    std::uniform_real_distribution<float> unit(-0.4f, 0.4f);
    return {unit(random), unit(random), unit(random)};
}

Vec3 in_torus(std::mt19937& random) {
    const float a = std::uniform_real_distribution<float>(0, 6.28f)(random);
    return {std::cos(a), std::sin(a), 0};
}

TEST(Parity, Icosphere) {
    expect_closed(icosphere(0), Vec3(0), 1, near_center);
    expect_closed(icosphere(3), Vec3(0), 1, near_center);
    expect_closed(icosphere(3), Vec3(0), 1, [](auto&) { return Vec3(0); });
}
TEST(Parity, Box) {
    expect_closed(box(1), Vec3(0), 1, near_center);
    expect_closed(box(6), Vec3(0), 1, near_center);
    // On the lattice of its corners: rays run in planes of edges.
    expect_closed(box(8), Vec3(0), 1, [](std::mt19937& random) {
        const auto pick = [&] { return -0.75f + 0.25f * float(random() % 7); };
        return Vec3(pick(), pick(), pick());
    });
}
TEST(Parity, Torus) {
    expect_closed(torus(24), Vec3(0), 1, in_torus);
}
TEST(Parity, FarAway) {
    expect_closed(icosphere(3), Vec3(2300, -1700, 900), 1, near_center);
    expect_closed(box(4), Vec3(2300, -1700, 900), 3, near_center);
}
TEST(Parity, TinyAndHuge) {
    expect_closed(icosphere(2), Vec3(0), 1e-20f, near_center);
    expect_closed(icosphere(2), Vec3(0), 1e20f, near_center);
}

// A closed rigid mesh, turned and stretched, is closed in its own space.
TEST(Parity, OfMovingMeshes) {
    std::mt19937 random(10);
    Aims aims;
    const math::Affine to_world = random_placement(random, 5);
    const auto make = [&](QueryWorld& world) {
        world.add(torus(16), MeshKind::deforming, Vec3(50, 0, 0));
        world.place(world.add(torus(24), MeshKind::rigid), to_world);
        if (aims.inside.empty()) {
            auto triangles = world.triangles();
            triangles.erase(triangles.begin(), triangles.begin() + 16 * 8 * 2);
            aims = make_aims(triangles, 2, rays_per_set(1500), [&](auto& r) {
                return Vec3(to_world.point(math::Vec3d(in_torus(r))));
            });
        }
    };
    for_each_snapshot(make,
                      [&](const std::string& name, QueryWorld&, const scene::Snapshot& snapshot) {
                          expect_parity(name, snapshot, aims.inside, 1);
                          expect_parity(name, snapshot, aims.outside, 0);
                      });
}

} // namespace
} // namespace peregrine::test
