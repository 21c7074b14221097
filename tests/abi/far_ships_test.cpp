// A ship of rigid meshes that is far from the world's origin answers and looks as it does at home.
#include "ask.h"
#include "bad_input.h"
#include "far_space.h"

#include <algorithm>
#include <array>
#include <random>

namespace peregrine::test {
namespace {

// Boxes that are turned, stretched, sheared and mirrored, and a lamp; their places are exact
// wherever the ship is.
void add_ship(Space& space, const double (&place)[3], std::vector<rt_mesh>& parts,
              float light_radius = 30) {
    std::mt19937 random(7);
    const auto unit = [&] { return double(random()) / 2147483648.0 - 1; };
    for (int i = 0; i < 12; ++i) {
        rt_transform transform;
        for (int row = 0; row < 3; ++row) {
            for (int k = 0; k < 3; ++k)
                transform.m[4 * row + k] = (row == k ? 0.6 : 0.25 * unit()) * (i == 4 ? 0.1 : 1);
            transform.m[4 * row + 3] =
                place[row] + std::floor(unit() * 64) / 8 * (i < 11 ? 1 : 0.5);
        }
        if (i % 3 == 1)
            for (int k = 0; k < 3; ++k) transform.m[k] = -transform.m[k];
        parts.push_back(space.add(box_corners(), transform));
    }
    const double floor_place[3] = {place[0], place[1] - 21, place[2]};
    rt_transform floor = at(floor_place);
    floor.m[0] = floor.m[5] = floor.m[10] = 12;
    parts.push_back(space.add(box_corners(), floor));
    for (const rt_light_type type : {RT_LIGHT_POINT, RT_LIGHT_SPOT}) {
        rt_light_desc light = rt_default_light_desc();
        light.type = type;
        light.radius = light_radius;
        const double offset[3] = {type == RT_LIGHT_SPOT ? 6.0 : -7.0, 9, 2};
        for (int k = 0; k < 3; ++k) light.position[k] = place[k] + offset[k];
        light.direction[0] = -0.4f;
        for (float& part : light.intensity) part = 4000 * (light_radius / 30) * (light_radius / 30);
        light.cone_inner_cos = 0.9f;
        light.cone_outer_cos = 0.6f;
        rt_light lamp;
        EXPECT_OK(rt_add_light(space.scene, &light, &lamp));
    }
}

struct Answers {
    Bytes bytes;
    uint64_t instances = 0;

    template <class T>
    void note(const T& value, size_t size = sizeof(T)) {
        const auto* first = reinterpret_cast<const unsigned char*>(&value);
        bytes.insert(bytes.end(), first, first + size);
    }
};

// All that is asked of a ship, relative to its place; meshes by their number in it.
Answers answers_of(rt_scene scene, const double (&place)[3], const std::vector<rt_mesh>& parts) {
    std::mt19937 random(11);
    const auto unit = [&] { return float(double(random()) / 2147483648.0 - 1); };
    const rt_query_options options = relative_to(place);
    rt_query_options counted = options;
    Answers out;
    const auto number = [&](const rt_mesh& mesh) {
        const auto found = std::find_if(parts.begin(), parts.end(), [&](const rt_mesh& part) {
            return part.index == mesh.index && part.generation == mesh.generation;
        });
        return int32_t(mesh.generation == 0 ? -1 : found - parts.begin());
    };
    std::vector<rt_ray> rays;
    for (int i = 0; i < 5000; ++i) {
        const rt_ray ray = {{10 * unit(), 10 * unit(), 10 * unit()},
                            0,
                            {unit(), unit(), unit()},
                            i % 3 ? kInfinity : 9.0f};
        rays.push_back(ray);
    }
    const auto note_hit = [&](const rt_hit& hit) {
        out.note(hit, offsetof(rt_hit, mesh));
        out.note(number(hit.mesh));
        out.note(hit.back_face);
    };
    for (const rt_coherence hint : {RT_COHERENCE_AUTO, RT_COHERENCE_COHERENT,
                                    RT_COHERENCE_COMMON_ORIGIN, RT_COHERENCE_INCOHERENT}) {
        std::vector<rt_hit> hits(rays.size());
        std::vector<uint8_t> occluded(rays.size());
        rt_query_desc desc = rt_default_query_desc();
        desc.rays = rays.data();
        desc.ray_count = rays.size();
        desc.hits = hits.data();
        desc.coherence = hint;
        desc.options = &options;
        EXPECT_OK(rt_trace_query(scene, &desc));
        desc.kind = RT_QUERY_ANY;
        desc.hits = nullptr;
        desc.occluded = occluded.data();
        EXPECT_OK(rt_trace_query(scene, &desc));
        for (const rt_hit& hit : hits) note_hit(hit);
        out.bytes.insert(out.bytes.end(), occluded.begin(), occluded.end());
    }
    for (int i = 0; i < 400; ++i) {
        const rt_ray& ray = rays[size_t(i)];
        rt_surface surface{};
        const rt_hit hit = trace_one(scene, ray, &options, &surface);
        note_hit(hit);
        out.note(surface.geometric_normal);
        out.note(surface.shading_normal);
        for (int k = 0; k < 3 && number(hit.mesh) >= 0; ++k) {
            const double along = double(ray.origin[k]) + double(hit.t) * double(ray.direction[k]);
            EXPECT_NEAR(surface.position[k] - place[k], along, 1e-5 + 1e-15 * std::fabs(place[k]));
        }
        rt_query_desc desc = rt_default_query_desc();
        std::array<rt_hit, 8> all{};
        uint32_t count = 0;
        rt_query_stats stats = rt_default_query_stats();
        counted.stats = &stats;
        desc.rays = &ray;
        desc.ray_count = 1;
        desc.kind = RT_QUERY_ALL;
        desc.hits = all.data();
        desc.hit_counts = &count;
        desc.max_hits = uint32_t(all.size());
        desc.options = &counted;
        EXPECT_OK(rt_trace_query(scene, &desc));
        out.instances += stats.instances;
        for (uint32_t k = 0; k < std::min(count, desc.max_hits); ++k) note_hit(all[k]);

        rt_sweep sweep = {{ray.origin[0], ray.origin[1], ray.origin[2]},
                          0.2f + 0.2f * unit(),
                          {0, 0, 0},
                          5,
                          {ray.direction[0], ray.direction[1], ray.direction[2]},
                          0};
        if (i % 2) sweep.axis[i % 3] = 0.5f;
        const rt_sweep_hit contact = sweep_one(scene, sweep, &options);
        out.note(contact, offsetof(rt_sweep_hit, mesh));
        out.note(number(contact.mesh));
        const rt_nearest nearest = nearest_one(
            scene, {{ray.origin[0], ray.origin[1], ray.origin[2]}, i % 2 ? 1.0f : 50.0f}, &options);
        out.note(nearest, offsetof(rt_nearest, mesh));
        out.note(number(nearest.mesh));
        const rt_shape shape = {{ray.origin[0], ray.origin[1], ray.origin[2]},
                                0.5f,
                                {0.5f, 0.25f, 0.75f},
                                uint32_t(i % 3),
                                {0.1f, 0.2f, 0.3f, 1}};
        std::array<rt_overlap, 64> touched{};
        rt_overlap_desc overlap = rt_default_overlap_desc();
        stats = rt_default_query_stats();
        overlap.shapes = &shape;
        overlap.shape_count = 1;
        overlap.overlaps = touched.data();
        overlap.max_overlaps = uint32_t(touched.size());
        overlap.overlap_counts = &count;
        overlap.options = &counted;
        EXPECT_OK(rt_overlap_shapes(scene, &overlap));
        out.instances += stats.instances;
        out.note(count);
        for (uint32_t k = 0; k < std::min(count, overlap.max_overlaps); ++k) {
            out.note(number(touched[k].mesh));
            out.note(touched[k].triangle);
        }
    }
    return out;
}

constexpr uint32_t kSide = 96;

struct Picture {
    std::vector<float> pixels = std::vector<float>(kSide * kSide * 4);
    std::vector<float> depth = std::vector<float>(kSide * kSide);
    std::vector<float> normals = std::vector<float>(kSide * kSide * 3);
    std::vector<uint32_t> triangles = std::vector<uint32_t>(kSide * kSide);
};

Picture picture_of(rt_scene scene, const double (&place)[3]) {
    rt_camera camera = rt_default_camera();
    const double offset[3] = {1.5, 6.25, 14};
    for (int k = 0; k < 3; ++k) camera.position[k] = place[k] + offset[k];
    camera.forward[1] = -0.6f;
    Picture out;
    rt_frame_desc frame = rt_default_frame_desc();
    frame.width = frame.height = kSide;
    frame.pixels = out.pixels.data();
    frame.format = RT_FORMAT_RGBA32F;
    frame.tone_mapping = RT_TONE_NONE;
    frame.depth = out.depth.data();
    frame.normals = out.normals.data();
    frame.triangle_ids = out.triangles.data();
    EXPECT_OK(rt_render_frame(scene, &camera, &frame, nullptr));
    return out;
}

// What primary rays see is the same; light may differ where rounding decides, at edges of shadows.
void expect_alike(const Picture& far, const Picture& near, float tolerance = 1e-4f) {
    EXPECT_EQ(far.depth, near.depth);
    EXPECT_EQ(far.normals, near.normals);
    EXPECT_EQ(far.triangles, near.triangles);
    size_t different = 0, lit = 0;
    for (size_t i = 0; i < near.pixels.size(); ++i) {
        different += std::fabs(far.pixels[i] - near.pixels[i]) > tolerance * (1 + near.pixels[i]);
        lit += i % 4 == 0 && near.pixels[i] > 0.2f;
    }
    EXPECT_LT(different, near.pixels.size() / 500);
    EXPECT_GT(lit, near.pixels.size() / 40) << "the test sees something";
}

TEST(FarShips, AnswerAsAtHome) {
    const double home[3] = {0, 0, 0};
    Space near;
    std::vector<rt_mesh> parts;
    add_ship(near, home, parts);
    near.commit();
    const Answers expected = answers_of(near.scene, home, parts);
    const Picture picture = picture_of(near.scene, home);
    for (const double far : {5e3, 1e5, 1e7, 3e7, 1e9, 1e12}) {
        const double place[3] = {far, -far, 0.5 * far};
        Space space;
        parts.clear();
        add_ship(space, place, parts);
        space.commit();
        const Answers got = answers_of(space.scene, place, parts);
        EXPECT_EQ(got.bytes, expected.bytes) << far;
        EXPECT_LE(got.instances, expected.instances * 5 / 4) << far;
        expect_alike(picture_of(space.scene, place), picture);
    }
}

TEST(FarShips, TwoInOneScene) {
    const double places[3][3] = {{0, 0, 0}, {1e7, 256, -512}, {-3e7, 4e8, 1e9}};
    Space near;
    std::vector<rt_mesh> parts;
    add_ship(near, places[0], parts);
    near.commit();
    const Answers expected = answers_of(near.scene, places[0], parts);
    const Picture picture = picture_of(near.scene, places[0]);
    Space all;
    std::vector<rt_mesh> ships[3];
    for (int i = 0; i < 3; ++i) add_ship(all, places[i], ships[i]);
    all.commit();
    for (int i = 0; i < 3; ++i) {
        const Answers got = answers_of(all.scene, places[i], ships[i]);
        EXPECT_EQ(got.bytes, expected.bytes) << i;
        EXPECT_LE(got.instances, expected.instances * 5 / 4) << i;
        expect_alike(picture_of(all.scene, places[i]), picture);
    }
}

// Lamps that shine much farther than a ship is large; shadow rays begin a bit higher above
// surfaces.
TEST(FarShips, LampsWithoutAnEnd) {
    constexpr float kRadius = 4e6f; // does not reach the other ship
    const double places[2][3] = {{0, 0, 0}, {1e7, 256, -512}};
    Space near, all;
    std::vector<rt_mesh> parts;
    add_ship(near, places[0], parts, kRadius);
    near.commit();
    const Picture picture = picture_of(near.scene, places[0]);
    for (const auto& place : places) add_ship(all, place, parts, kRadius);
    all.commit();
    for (const auto& place : places) expect_alike(picture_of(all.scene, place), picture, 1e-3f);
}

// The same place is the same however it is told.
TEST(FarShips, RecordsAndOriginsAreOnePlace) {
    const double place[3] = {8192, -4096, 65536};
    Space space;
    std::vector<rt_mesh> parts;
    add_ship(space, place, parts);
    space.commit();
    std::mt19937 random(5);
    const auto unit = [&] { return float(double(random()) / 2147483648.0 - 1); };
    for (int i = 0; i < 500; ++i) {
        rt_ray record{};
        double sum[3];
        for (int k = 0; k < 3; ++k) {
            record.origin[k] = float(std::floor(unit() * 1024)) / 128;
            record.direction[k] = unit();
            sum[k] = place[k] + double(record.origin[k]);
        }
        record.t_max = kInfinity;
        const rt_query_options apart = relative_to(place), at_once = relative_to(sum);
        rt_ray whole = record, nothing = record;
        for (int k = 0; k < 3; ++k) {
            whole.origin[k] = float(sum[k]);
            nothing.origin[k] = 0;
        }
        const rt_hit hit = trace_one(space.scene, record, &apart);
        const rt_hit same = trace_one(space.scene, whole);
        const rt_hit again = trace_one(space.scene, nothing, &at_once);
        EXPECT_EQ(std::memcmp(&hit, &same, sizeof hit), 0);
        EXPECT_EQ(std::memcmp(&hit, &again, sizeof hit), 0);
    }
}

} // namespace
} // namespace peregrine::test
