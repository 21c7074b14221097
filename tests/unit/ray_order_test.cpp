// The order of scattered rays: each once, like ones together, and only where there is none.
#include "query/ray_order.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>

namespace peregrine::query {
namespace {

using math::Ray;

Rays rays_of(std::vector<Ray>& rays) {
    return {rays.size(), reinterpret_cast<std::byte*>(rays.data()), sizeof(Ray), {}, {}};
}

TEST(RayOrder, TakesEachRayOnceAndLikeOnesTogether) {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> unit(-1, 1);
    std::vector<Ray> rays(RayOrder::kWindow + 5);
    for (Ray& ray : rays)
        ray = {{unit(random), 10 * unit(random), 0}, 0, {unit(random), unit(random), 1}, 1};
    rays[7].origin.x = 1e30f; // beyond what is sampled
    const Rays all = rays_of(rays);
    EXPECT_TRUE(are_scattered(all, 0, rays.size()));
    EXPECT_FALSE(are_scattered(all, 0, 1000));
    const auto order = std::make_unique<RayOrder>();
    order->sort(all, 5, RayOrder::kWindow);
    std::vector<Ray> sorted;
    std::vector<bool> seen(RayOrder::kWindow);
    for (uint32_t i = 0; i < RayOrder::kWindow; ++i) {
        ASSERT_FALSE(seen[(*order)[i]]);
        seen[(*order)[i]] = true;
        sorted.push_back(rays[5 + (*order)[i]]);
    }
    size_t turns = 0;
    for (size_t i = 1; i < sorted.size(); ++i)
        turns += (sorted[i].direction.x < 0) != (sorted[i - 1].direction.x < 0);
    EXPECT_LE(turns, 7u);
    for (Ray& ray : sorted) ray.origin = math::Vec3(1); // of one place
    EXPECT_FALSE(are_scattered(rays_of(sorted), 0, sorted.size()));
}

} // namespace
} // namespace peregrine::query
