// Tiles of primary rays: the kernels for them give the bits of brute force.
#include "support/adversaries.h"
#include "support/brute_force.h"
#include "support/world.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

namespace peregrine::test {
namespace {

using math::Vec3;
using trace::ImageTile;

constexpr uint32_t kRays = ImageTile::kSide * ImageTile::kSide;
constexpr base::Isa kIsas[] = {base::Isa::scalar, base::Isa::sse4, base::Isa::avx2,
                               base::Isa::avx512, base::Isa::neon};

// An image of any size that a camera takes, as render/camera.h has it.
struct Picture {
    Vec3 origin, corner, right, down;
    uint32_t width, height;

    Picture(const Vec3& eye, Vec3 forward, const Vec3& upward, float fov, uint32_t w, uint32_t h)
        : origin(eye), width(w), height(h) {
        forward = glm::normalize(forward);
        const Vec3 side = glm::normalize(glm::cross(forward, upward));
        const Vec3 up = glm::cross(side, forward);
        const float pixel = 2 * std::tan(fov * 0.5f) / float(h);
        right = side * pixel;
        down = -up * pixel;
        corner = forward - side * (pixel * 0.5f * float(w)) + up * (pixel * 0.5f * float(h));
    }
};

struct alignas(64) Column {
    float values[kRays + 16];
};
struct alignas(64) Numbers {
    uint32_t values[kRays + 16];
};

// The rays of a tile.
struct TileRays {
    ImageTile image;
    Column origin[3], direction[3], t_min = {}, t_max;
    std::vector<math::Ray> rays;

    TileRays(const Picture& picture, uint32_t x0, uint32_t y0)
        : image{picture.corner, picture.right, picture.down, x0, y0} {
        for (uint32_t i = 0; i < kRays; ++i) {
            uint32_t x = x0, y = y0;
            for (uint32_t bit = 0; bit < 5; ++bit) {
                x += (i >> 2 * bit & 1) << bit;
                y += (i >> (2 * bit + 1) & 1) << bit;
            }
            const Vec3 d = (picture.corner + picture.right * (float(x) + 0.5f))
                           + picture.down * (float(y) + 0.5f);
            for (int k = 0; k < 3; ++k) {
                origin[k].values[i] = picture.origin[k];
                direction[k].values[i] = d[k];
            }
            t_max.values[i] = std::numeric_limits<float>::infinity();
            rays.push_back({picture.origin, 0, d, t_max.values[i]});
        }
    }

    trace::RayStream stream() const {
        return {{origin[0].values, origin[1].values, origin[2].values},
                {direction[0].values, direction[1].values, direction[2].values},
                t_min.values,
                t_max.values,
                kRays,
                trace::Coherence::common_origin,
                &image};
    }
};

struct TileHits {
    Column t, u, v;
    Numbers triangle, back_face;

    trace::HitStream stream() {
        return {t.values, u.values, v.values, triangle.values, back_face.values, nullptr};
    }
    bool is(uint32_t i, const trace::Hit& hit) const {
        const auto bits = [](float x) { return std::bit_cast<uint32_t>(x); };
        return bits(t.values[i]) == bits(hit.t) && bits(u.values[i]) == bits(hit.u)
               && bits(v.values[i]) == bits(hit.v) && triangle.values[i] == hit.triangle
               && (back_face.values[i] != 0) == hit.back_face;
    }
};

class Comparison {
public:
    explicit Comparison(std::vector<geometry::Triangle> triangles)
        : world_(std::move(triangles)), oracle_(world_.triangles) {}

    const std::vector<geometry::Triangle>& triangles() const { return world_.triangles; }

    void compare(const Picture& picture, uint32_t x, uint32_t y,
                 const trace::Filter& filter = {}) const {
        const TileRays tile(picture, x, y);
        std::vector<trace::Hit> expected(kRays);
        oracle_.closest(tile.rays, filter, expected.data());
        for (const bool compact : {false, true})
            for (const base::Isa isa : kIsas) {
                const auto* kernels = trace::select_kernels(trace::Structure::bvh, isa, compact);
                if (!kernels) continue;
                TileHits hits;
                kernels->closest_stream(world_.target(trace::Structure::bvh, compact),
                                        tile.stream(), filter, hits.stream());
                uint32_t wrong = 0, first = 0;
                for (uint32_t i = kRays; i-- > 0;)
                    if (!hits.is(i, expected[i])) ++wrong, first = i;
                EXPECT_EQ(wrong, 0u)
                    << "isa " << int(isa) << (compact ? ", compact" : "") << ", ray " << first
                    << ": t " << hits.t.values[first] << " triangle " << hits.triangle.values[first]
                    << ", brute force: t " << expected[first].t << " triangle "
                    << expected[first].triangle << "; eye " << picture.origin.x << ' '
                    << picture.origin.y << ' ' << picture.origin.z << ", tile " << x << ' ' << y;
            }
    }

    // One of a square picture with so many tiles a side.
    void compare_random_tile(const Picture& picture, uint32_t tiles, std::mt19937& random,
                             const trace::Filter& filter = {}) const {
        const auto pixel = [&] { return uint32_t(random() % tiles) * ImageTile::kSide; };
        const uint32_t x = pixel();
        compare(picture, x, pixel(), filter);
    }

    // Cameras anywhere around, of any opening and in any pose; `scale` is the scene's.
    void compare_cameras(uint32_t seed, size_t count, float scale = 1,
                         const trace::Filter& filter = {}) const {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> unit(-1, 1);
        const auto vector = [&] { return Vec3(unit(random), unit(random), unit(random)); };
        for (size_t i = 0; i < count; ++i) {
            const geometry::Triangle& triangle = triangles()[random() % triangles().size()];
            const Vec3 aim = (triangle.v0 + triangle.v1 + triangle.v2) / 3.0f;
            Vec3 eye = scale * vector();
            if (i % 4 == 1) eye = aim + scale * 0.01f * vector();     // close to a triangle
            if (i % 4 == 2) eye = triangle.v0;                        // at a corner
            if (i % 4 == 3) eye = 0.5f * (triangle.v0 + triangle.v1); // on an edge
            Vec3 forward = i % 3 == 0 ? aim - eye : vector();
            if (i % 5 == 0) forward = {0, 0, unit(random)}; // along an axis
            if (!(glm::dot(forward, forward) > 0)) continue;
            const uint32_t tiles = 1u << random() % 6;
            const uint32_t size = tiles * ImageTile::kSide;
            constexpr float kOpenings[] = {1.0471976f, 0.01f, 2.5f, 0.3f, 3.1f};
            const Picture picture(eye, forward, i % 7 == 0 ? Vec3(0, 1, 0.001f) : vector(),
                                  kOpenings[random() % 5], size, size);
            compare_random_tile(picture, tiles, random, filter);
        }
    }

private:
    World world_;
    BruteForce oracle_;
};

size_t cameras() {
    return std::max<size_t>(rays_per_set(4000) / 20, 20);
}

TEST(Tiles, OfSoup) {
    Comparison(soup(1, 3000, 0.1f)).compare_cameras(1, cameras());
    Comparison(soup(2, 200, 2)).compare_cameras(2, cameras());
    Comparison(soup(3, 1, 1)).compare_cameras(3, cameras());
}

TEST(Tiles, OfManyScales) {
    for (const float scale : {1e-30f, 1e-6f, 1e-3f, 1e3f, 1e5f, 1e7f, 1e20f})
        Comparison(soup(4, 200, 0.3f, scale)).compare_cameras(4, cameras() / 4, scale);
}

TEST(Tiles, OfMixedScales) {
    std::vector<geometry::Triangle> triangles = soup(5, 200, 0.3f, 1e4f);
    for (geometry::Triangle triangle : soup(6, 200, 0.3f, 1e-2f)) {
        triangle.mesh = 1;
        triangles.push_back(triangle);
    }
    Comparison(triangles).compare_cameras(5, cameras());
}

TEST(Tiles, FarFromTheOrigin) {
    std::vector<geometry::Triangle> triangles = soup(7, 500, 0.3f);
    for (geometry::Triangle& triangle : triangles)
        for (Vec3* v : {&triangle.v0, &triangle.v1, &triangle.v2}) *v += Vec3(3000, -500, 70);
    const Comparison comparison(triangles);
    comparison.compare_cameras(6, cameras());
    for (uint32_t i = 0; i < 8; ++i)
        comparison.compare({Vec3(3000, -500, 73 + 10 * float(i)), Vec3(0.1f, 0, -1), Vec3(0, 1, 0),
                            0.6f, 256, 256},
                           i * 32, 128);
}

TEST(Tiles, OfAdversaries) {
    Comparison(lattice()).compare_cameras(8, cameras());
    Comparison(coincident(200)).compare_cameras(9, cameras() / 4);
    Comparison(two_sided(200)).compare_cameras(10, cameras() / 2);
    Comparison(needles(200)).compare_cameras(11, cameras() / 2);
}

//      /\   /\          Eyes in the plane of a floor, and a hair above it.
//   __/  \_/  \__
TEST(Tiles, SeenEdgeOn) {
    TriangleList list;
    for (int i = -5; i < 5; ++i)
        for (int j = -5; j < 5; ++j) {
            const Vec3 a(i, 0, j), b(i + 1, 0, j), c(i, 0, j + 1), d(i + 1, 0, j + 1);
            list.add(a, b, c);
            list.add(b, d, c);
        }
    list.add({-5, 0, -4}, {5, 0, -4}, {0, 4, -4});
    const Comparison comparison(list.triangles);
    for (const float height : {0.0f, 1e-30f, 1e-9f, 1e-6f, 1e-4f, 0.01f, 1.7f})
        for (const float tilt : {0.0f, 1e-6f, 0.01f, -0.3f})
            for (uint32_t x = 0; x < 128; x += 32)
                for (uint32_t y = 32; y < 96; y += 32)
                    comparison.compare({Vec3(0.1f, height, 4.3f), Vec3(0.3f, tilt, -1),
                                        Vec3(0, 1, 0), 1.0f, 128, 128},
                                       x, y);
}

bool present(const void*, const geometry::TriangleInfo& triangle, float u, float v) {
    return (int(u * 8) + int(v * 8) + int(triangle.primitive)) % 2 == 0;
}

TEST(Tiles, WithFilters) {
    std::vector<geometry::Triangle> triangles = soup(12, 600, 0.4f);
    for (size_t i = 0; i < triangles.size(); ++i) {
        triangles[i].mesh = uint32_t(i / 200);
        triangles[i].flags = (i % 3 == 0 ? uint32_t(geometry::kSingleSided) : 0)
                             | (i % 5 == 0 ? uint32_t(geometry::kMasked) : 0);
    }
    const Comparison comparison(triangles);
    const uint32_t masks[] = {1, 2, 3};
    trace::Filter culling, masked, front, back, layers, ignoring;
    culling.cull_single_sided = true;
    masked.alpha = {present, nullptr};
    masked.cull_single_sided = true;
    front.faces = trace::Faces::front;
    back.faces = trace::Faces::back;
    layers.layer_mask = 2;
    layers.layer_masks = masks;
    ignoring.ignore_mesh = 1;
    for (const trace::Filter& filter : {culling, masked, front, back, layers, ignoring})
        comparison.compare_cameras(13, cameras() / 2, 1, filter);
}

TEST(Tiles, OfFiles) {
    for (const std::string& path : scene_files()) {
        const SceneFile scene = load_file(path);
        const Comparison comparison(scene.triangles);
        std::mt19937 random(14);
        for (const Eye& eye : scene.eyes)
            for (size_t i = 0; i < std::max<size_t>(cameras() / 50, 1); ++i)
                comparison.compare_random_tile(
                    {eye.position, eye.forward, Vec3(0, 1, 0.01f), 1.0471976f, 1024, 1024}, 32,
                    random);
    }
}

} // namespace
} // namespace peregrine::test
