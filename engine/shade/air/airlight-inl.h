// Light of lamps that fog scatters toward the eye. Included once for each instruction set.
#if defined(PEREGRINE_SHADE_AIRLIGHT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SHADE_AIRLIGHT_INL_H
#undef PEREGRINE_SHADE_AIRLIGHT_INL_H
#else
#define PEREGRINE_SHADE_AIRLIGHT_INL_H
#endif

#include "shade/air/air_ways.h"
#include "shade/air/angles-inl.h"
#include "shade/air/clip-inl.h"
#include "shade/air/fog-inl.h"
#include "shade/light/falloff-inl.h"
#include "shade/light/spot-inl.h"
#include "simd/compress-inl.h"

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace peregrine::shade::HWY_NAMESPACE {

// The least distance between a way and its lamp, in parts of the lamp's radius. What is nearer is
// as bright as there: of an inverse square nothing else would bound it.
constexpr float kNearest = 1.0f / 1024;

// How far shadow rays go: the last ones end on a surface.
constexpr float kBeforeEnd = 1 - 1.0f / 512;

HWY_INLINE Mf first_of(uint32_t count) {
    return hn::FirstN(kF, std::min(count, kLanes));
}

HWY_ATTR AirBounds bound_rays(const AirRays& rays, const math::Vec3& axis) {
    const V3 unit = splat(axis);
    Vf cosine = splat(1.0f), longest = hn::Zero(kF);
    for (uint32_t i = 0; i < rays.count; i += kLanes) {
        const V3 d{hn::LoadU(kF, rays.direction[0] + i), hn::LoadU(kF, rays.direction[1] + i),
                   hn::LoadU(kF, rays.direction[2] + i)};
        const Vf length = hn::Sqrt(dot(d, d));
        const Mf counts = first_of(rays.count - i);
        const Vf metres = hn::Mul(hn::LoadU(kF, rays.t + i), length);
        longest = hn::IfThenElse(counts, hn::Max(longest, metres), longest);
        cosine = hn::IfThenElse(counts, hn::Min(cosine, hn::Div(dot(d, unit), length)), cosine);
    }
    AirBounds bounds;
    bounds.axis = axis;
    bounds.least_cosine = hn::GetLane(hn::MinOfLanes(kF, cosine));
    bounds.longest = hn::GetLane(hn::MaxOfLanes(kF, longest));
    return bounds;
}

// Integrals over ways go over the angle at the lamp (Kulla and Fajardo, "Importance Sampling
// Techniques for Path Tracing in Participating Media", EGSR 2012, section 4.1): from there the
// inverse square is the same everywhere. Fall-offs that are finite at the lamp get angles as from
// farther away.
HWY_INLINE Vf spread_of(const PreparedLight& light, Vf distance) {
    // Tried: with these ten angles are within a hundredth. Schlick's is the most pointed one.
    const float part = light.falloff == scene::Falloff::schlick_linear ? 0.1f : 0.3f;
    float least = light.radius * part;
    if (scene::is_inverse_square(light.falloff))
        least =
            std::max({light.radius * kNearest, light.source_radius, 1.0f / light.inverse_nearest});
    return hn::Max(distance, splat(least));
}

// Lists the ways that are not empty; returns their number. What a wide spot lights is two parts.
HWY_ATTR uint32_t list_ways(const PreparedLight& light, const FogLayer& layer, const AirRays& rays,
                            uint32_t part, AirWays& out) {
    const Vf reach = splat(std::min(light.radius, kHorizon));
    uint32_t count = 0;
    for (uint32_t i = 0; i < rays.count; i += kLanes) {
        const V3 d{hn::LoadU(kF, rays.direction[0] + i), hn::LoadU(kF, rays.direction[1] + i),
                   hn::LoadU(kF, rays.direction[2] + i)};
        const V3 from{hn::LoadU(kF, rays.origin[0] + i), hn::LoadU(kF, rays.origin[1] + i),
                      hn::LoadU(kF, rays.origin[2] + i)};
        const Vf length = hn::Sqrt(dot(d, d));
        const V3 along = scale(d, hn::Div(splat(1.0f), length));
        const V3 offset = subtract(from, splat(light.position));
        const Vf before = hn::Neg(dot(offset, along));
        const V3 foot = add(offset, scale(along, before));
        const Vf square = dot(foot, foot);
        const Vf metres = hn::Min(hn::Mul(hn::LoadU(kF, rays.t + i), length), splat(kHorizon));
        Span way = within_sphere(hn::Mul(reach, reach), square);
        way.cut({hn::Neg(before), hn::Sub(metres, before)});
        way.cut(below(hn::Sub(splat(layer.top - light.position.y), foot.y), along.y));
        if (light.type == scene::LightType::spot)
            cut_to_cone(light, foot, along, square, part, way);
        const Mf listed = hn::And(first_of(rays.count - i), hn::Lt(way.first, way.last));
        if (hn::AllFalse(kF, listed)) continue;

        const Vf spread = spread_of(light, hn::Sqrt(square));
        const AngleRange angles(way.first, way.last, spread);
        const Compressor packed(listed);
        const auto put = [&](Vf value, float* lanes) {
            hn::StoreU(packed.pack(value), kF, lanes + count);
        };
        const Vf number = packed.pack(hn::BitCast(kF, hn::Iota(kU, i)));
        hn::StoreU(hn::BitCast(kU, number), kU, out.ray + count);
        put(foot.x, out.foot[0]);
        put(foot.y, out.foot[1]);
        put(foot.z, out.foot[2]);
        put(along.x, out.along[0]);
        put(along.y, out.along[1]);
        put(along.z, out.along[2]);
        put(from.y, out.height);
        put(before, out.before);
        put(way.first, out.first);
        put(way.last, out.last);
        put(spread, out.spread);
        put(angles.cosine, out.cosine);
        put(angles.sine, out.sine);
        put(angles.half, out.half);
        count += uint32_t(hn::CountTrue(kF, listed));
    }
    return count;
}

// From the lamp to places of ways: `at` is -1 where they begin and 1 where they end.
HWY_ATTR void place_points(const AirWays& ways, const uint32_t* way, const float* at,
                           uint32_t count, float* const to[3]) {
    for (uint32_t i = 0; i < count; i += kLanes) {
        const Vi index = hn::BitCast(kI, hn::LoadU(kU, way + i));
        const auto of = [&](const float* lanes) { return hn::GatherIndex(kF, lanes, index); };
        const Angle angle(of(ways.cosine), of(ways.sine),
                          hn::Mul(of(ways.half), hn::LoadU(kF, at + i)));
        const Vf s = angle.place(of(ways.spread), of(ways.first), of(ways.last));
        for (int k = 0; k < 3; ++k) {
            const Vf place = hn::Add(of(ways.foot[k]), hn::Mul(of(ways.along[k]), s));
            hn::StoreU(hn::Mul(place, splat(kBeforeEnd)), kF, to[k] + i);
        }
    }
}

// What a lamp's light is at places of a way, but for constants, times the metres there that an
// angle of 1 takes.
template <bool Spot, scene::Falloff Law>
struct LampOnWay {
    static constexpr bool kInverseSquare = scene::is_inverse_square(Law);

    const PreparedLight& light;
    Vf spread, inverse_spread, square;
    Vf ahead, rate; // along the spot's axis: at the foot, and by a metre

    HWY_INLINE LampOnWay(const PreparedLight& light_, const AirWays& ways, uint32_t i)
        : light(light_), spread(hn::LoadU(kF, ways.spread + i)),
          inverse_spread(hn::Div(splat(1.0f), spread)) {
        const V3 foot = load(ways.foot, i);
        square = dot(foot, foot);
        if constexpr (Spot) {
            ahead = dot(splat(light.direction), foot);
            rate = dot(splat(light.direction), load(ways.along, i));
        }
    }

    HWY_INLINE Vf at(Vf s, const Angle& angle) const {
        const Vf one = splat(1.0f);
        Vf value, inverse_distance;
        if constexpr (kInverseSquare) {
            inverse_distance = hn::Mul(angle.cosine, inverse_spread);
            value = inverse_spread;
            if constexpr (Law == scene::Falloff::windowed_inverse_square) {
                const Vf a = hn::Mul(spread, splat(light.inverse_radius));
                const Vf b = hn::Mul(s, splat(light.inverse_radius));
                const Vf xx = hn::Add(hn::Mul(a, a), hn::Mul(b, b));
                value = hn::Mul(value, hn::Max(hn::Sub(one, hn::Mul(xx, xx)), hn::Zero(kF)));
            }
        } else {
            const Vf distance = hn::Sqrt(hn::Add(square, hn::Mul(s, s)));
            const Vf metres =
                hn::Mul(hn::Add(hn::Mul(spread, spread), hn::Mul(s, s)), inverse_spread);
            value =
                hn::Mul(metres, paper_falloff<Law>(hn::Mul(distance, splat(light.inverse_radius))));
            if constexpr (Spot) inverse_distance = hn::Div(one, hn::Max(distance, splat(1e-20f)));
        }
        if constexpr (Spot) {
            const Vf cosine = hn::Mul(hn::Add(ahead, hn::Mul(rate, s)), inverse_distance);
            value = hn::Mul(value, cone_share(light, hn::Max(cosine, splat(light.cone_outer_cos))));
        }
        return value;
    }
};

// The light along ways, in parts of color fog_scatter density / 4 pi. `seen`: which part of each
// piece of the nodes the lamp sees; null: all of it.
template <bool Spot, scene::Falloff Law>
HWY_ATTR void add_up_airlight(const PreparedLight& light, const FogLayer& layer,
                              const AirNodes& nodes, const Surface::Lanes* seen,
                              const AirWays& ways, uint32_t count, float* sums) {
    const FogDensity density(layer);
    for (uint32_t i = 0; i < count; i += kLanes) {
        const LampOnWay<Spot, Law> lamp(light, ways, i);
        const Vf cosine = hn::LoadU(kF, ways.cosine + i), sine = hn::LoadU(kF, ways.sine + i);
        const Vf half = hn::LoadU(kF, ways.half + i), before = hn::LoadU(kF, ways.before + i);
        const Vf first = hn::LoadU(kF, ways.first + i), last = hn::LoadU(kF, ways.last + i);
        const Vf from = hn::LoadU(kF, ways.height + i), rise = hn::LoadU(kF, ways.along[1] + i);
        Vf sum = hn::Zero(kF);
        for (uint32_t j = 0; j < nodes.count; ++j) {
            const Angle angle(cosine, sine, hn::Mul(half, splat(nodes.at[j])));
            const Vf s = angle.place(lamp.spread, first, last);
            const Vf metres = hn::Max(hn::Add(before, s), hn::Zero(kF));
            const Vf height = hn::Add(from, hn::Mul(rise, metres));
            const Vf depth =
                hn::Mul(splat(layer.density), hn::Mul(metres, density.mean(from, height)));
            const Vf here = hn::Mul(density.at_any(height), exp_of_minus(depth));
            Vf weight = splat(nodes.weight[j]);
            if (seen) weight = hn::Mul(weight, hn::LoadU(kF, seen[j / nodes.in_piece] + i));
            sum = hn::Add(sum, hn::Mul(weight, hn::Mul(here, lamp.at(s, angle))));
        }
        hn::StoreU(hn::Mul(sum, half), kF, sums + i);
    }
}

} // namespace peregrine::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
