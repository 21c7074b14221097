#pragma once

#include "reference_tree.h"

#include <peregrine/rt.h>

#include <vector>

namespace peregrine::bench {

// When something moving meets the level, in lengths of its direction; infinity: it does not.
// `earliest` is the answer of a shape that is larger by the band and goes further by it, `latest`
// that of one that is smaller: what lies between is a matter of less than the band.
struct Contact {
    double earliest, exact, latest;
};

enum class Truth : uint8_t { no, yes, open }; // open: a matter of less than the band

// The answers of a level in double precision, from first principles and slowly. It shares no code
// with the engine, and not its methods: times of impact are found by Newton's method on distances.
class Reference {
public:
    Reference(std::span<const geometry::Triangle> triangles, double band);

    double first_hit(const rt_ray& ray) const; // t, or infinity

    // The larger "ray" is a sphere as large as the band. The smaller one's hits are those that pass
    // all edges of their triangle at more than the band.
    Contact judge_hit(const rt_ray& ray) const;
    Contact judge_sweep(const rt_sweep& sweep) const;
    Contact judge_nearest(const rt_point& point) const; // distances instead of times
    Truth judge_sight(const rt_ray& ray) const;         // yes: something is between
    Truth judge_overlap(const rt_shape& shape) const;

    // All times at which the ray crosses triangles, ascending. False: one is a matter of less than
    // the band.
    bool judge_crossings(const rt_ray& ray, std::vector<double>& t) const;

    // Of the level from a segment; infinity beyond `limit`.
    double distance(const Segment& segment, double limit) const;

private:
    struct Ray {
        math::Vec3d origin, direction;
        double t_max, length; // of the direction
    };
    struct Capsule {
        math::Vec3d center, axis;
        double radius;
    };

    static Ray widen(const rt_ray& ray);
    double hit(const Ray& ray, const Corners<double>& triangle) const;
    bool is_certain(const Ray& ray, const Corners<double>& triangle, double t) const;
    double time_of_impact(const Capsule& capsule, const Ray& way) const;
    bool overlaps(const rt_shape& shape, double growth) const;

    ReferenceTree tree_;
    double band_;
};

} // namespace peregrine::bench
