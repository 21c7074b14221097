#include "trace/visibility/shaft.h"

#include <algorithm>

namespace peregrine::trace::visibility {
namespace {

constexpr double kEpsilon = 0x1p-24;
constexpr double kMargin = 17 * kEpsilon;     // times D' + C
constexpr double kGridError = 4 * kEpsilon;   // times the longest side
constexpr double kLastPart = 0x1p-12 * 1.001; // of the way: what is nearer to the lamp is not hit

double largest(const Vec3d& v) {
    return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
}

double length(const Vec3d& v) {
    return std::sqrt(glm::dot(v, v));
}

} // namespace

Setting make_setting(const Lamp& lamp, const math::Box& fixed_bounds) {
    Setting s{};
    s.lamp = lamp;
    s.position = Vec3d(lamp.position);
    const Vec3d size = Vec3d(fixed_bounds.upper) - Vec3d(fixed_bounds.lower);
    s.size = largest(size);
    s.lift = double(geometry::intersection_error(geometry::largest_side(fixed_bounds)));
    s.most_distance = std::numeric_limits<double>::infinity();
    if (lamp.is_far) {
        const Vec3d d(lamp.direction);
        s.toward = -d / length(d);
        s.far = 2 * length(size);
    }
    if (lamp.is_far
        || glm::clamp(lamp.position, fixed_bounds.lower, fixed_bounds.upper) == lamp.position)
        s.most_distance = s.size * (1 + 0x1p-18); // lifted points are a bit outside
    return s;
}

Receiver make_receiver(const Setting& setting, const Corners& corners,
                       const TreeTriangle& triangle) {
    Receiver r{};
    r.is_seen = true;
    for (int k = 0; k < 3; ++k) r.v[k] = triangle.v[k];
    const Vec3d& normal = triangle.normal;
    if (normal == Vec3d(0)) return r;
    for (int k = 0; k < 3; ++k) r.longest = std::max(r.longest, length(r.v[(k + 1) % 3] - r.v[k]));
    const double height = setting.lamp.is_far ? glm::dot(normal, setting.toward) * setting.far
                                              : glm::dot(normal, setting.position - r.v[0]);
    r.is_seen = height > 0 || !corners.single_sided;
    r.normal = height < 0 ? -normal : normal;
    r.height = std::fabs(height);
    r.plane = glm::dot(r.normal, r.v[0]);
    const Vec3d size(geometry::largest_coordinates(corners.v));
    const double own = double(geometry::kPositionError) * glm::dot(glm::abs(normal), size);
    r.lift[0] = own + setting.lift;
    r.lift[1] = own + 2 * setting.lift;
    r.error = kMargin * largest(size) + kGridError * r.longest;
    // Lower than this, the segments' heights are not those of their ends.
    r.is_usable = r.height > 2 * r.lift[1] + 4 * setting.lift;
    return r;
}

Shaft::Shaft(const Setting& setting, const Receiver& receiver, const Vec3d (&corners)[3])
    : setting_(setting), receiver_(receiver) {
    const bool is_far = setting.lamp.is_far;
    tops_ = is_far ? 3 : 1;
    lower_ = upper_ = corners[0];
    length_ = 0;
    for (int k = 0; k < 3; ++k) {
        low_[k] = corners[k] + receiver.normal * receiver.lift[0];
        high_[k] = corners[k] + receiver.normal * receiver.lift[1];
        top_[k] = is_far ? low_[k] + setting.toward * setting.far : setting.position;
        lower_ = glm::min(glm::min(lower_, top_[k]), glm::min(low_[k], high_[k]));
        upper_ = glm::max(glm::max(upper_, top_[k]), glm::max(low_[k], high_[k]));
        if (!is_far) length_ = std::max(length_, largest(top_[k] - low_[k]));
    }
    const Vec3d middle = (low_[0] + low_[1] + low_[2]) / 3.0;
    for (int k = 0; k < 3; ++k) {
        const Vec3d& a = low_[k];
        const Vec3d& b = low_[(k + 1) % 3];
        Vec3d n = glm::cross(b - a, top_[k] - a);
        const double size = length(n);
        side_[k] = size > 0 ? n / size : Vec3d(0);
        if (glm::dot(side_[k], middle - a) > 0) side_[k] = -side_[k];
        reach_[k] = glm::dot(side_[k], top_[0]);
        for (int i = 0; i < 3; ++i)
            reach_[k] = std::max({reach_[k], glm::dot(side_[k], low_[i]),
                                  glm::dot(side_[k], high_[i]), glm::dot(side_[k], top_[i])});
    }
}

double Shaft::distance_to(const Vec3d& lower, const Vec3d& upper) const {
    if (setting_.lamp.is_far) return setting_.most_distance;
    return std::max(largest(lower - setting_.position), largest(upper - setting_.position))
           + length_;
}

double Shaft::harmless_height(double distance) const {
    const double d = std::min(distance, setting_.most_distance);
    return std::max(setting_.lift - 1.7321 * kEpsilon * (8.1 * d + length_),
                    2 * kEpsilon * setting_.size);
}

// By a plane between them: the least of the corners' distances along the way to the lamp's middle.
bool Shaft::is_out_of_reach() const {
    if (setting_.lamp.is_far) return false;
    const Vec3d way = setting_.position - (low_[0] + low_[1] + low_[2]) / 3.0;
    const double size = length(way);
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3d& p : low_) least = std::min(least, glm::dot(way, setting_.position - p));
    const double slack = 0x1p-16 * (size + setting_.size) + 2 * receiver_.lift[1];
    return least > (double(setting_.lamp.reach) + slack) * size;
}

bool Shaft::meets(const math::Box& box) const {
    const Vec3d lower(box.lower), upper(box.upper);
    const double distance = distance_to(lower, upper);
    const double margin = kMargin * distance + receiver_.error;
    for (int k = 0; k < 3; ++k)
        if (lower[k] > upper_[k] + margin || upper[k] < lower_[k] - margin) return false;
    // The box's least along each side's normal, and its most along the plane's.
    const auto least = [&](const Vec3d& n) {
        return (n.x > 0 ? n.x * lower.x : n.x * upper.x) + (n.y > 0 ? n.y * lower.y : n.y * upper.y)
               + (n.z > 0 ? n.z * lower.z : n.z * upper.z);
    };
    for (int k = 0; k < 3; ++k)
        if (least(side_[k]) > reach_[k] + margin) return false;
    return -least(-receiver_.normal) > harmless_height(distance) + receiver_.plane;
}

Shaft::Verdict Shaft::judge(const TreeTriangle& b) const {
    const double distance = distance_to(glm::min(glm::min(b.v[0], b.v[1]), b.v[2]),
                                        glm::max(glm::max(b.v[0], b.v[1]), b.v[2]));
    if (!(distance < 1e30)) return Verdict::in_the_way;
    const double margin = kMargin * distance + receiver_.error;

    // Below the receiver's plane, or in it.
    const double highest = harmless_height(distance) + receiver_.plane;
    if (glm::dot(receiver_.normal, b.v[0]) <= highest
        && glm::dot(receiver_.normal, b.v[1]) <= highest
        && glm::dot(receiver_.normal, b.v[2]) <= highest)
        return Verdict::apart;
    for (int k = 0; k < 3; ++k) {
        const double reach = reach_[k] + margin;
        if (glm::dot(side_[k], b.v[0]) > reach && glm::dot(side_[k], b.v[1]) > reach
            && glm::dot(side_[k], b.v[2]) > reach)
            return Verdict::apart;
    }
    for (int k = 0; k < 3; ++k) {
        const double above = upper_[k] + margin, below = lower_[k] - margin;
        if ((b.v[0][k] > above && b.v[1][k] > above && b.v[2][k] > above)
            || (b.v[0][k] < below && b.v[1][k] < below && b.v[2][k] < below))
            return Verdict::apart;
    }

    if (b.normal == Vec3d(0)) return Verdict::in_the_way;
    const double plane = glm::dot(b.normal, b.v[0]);
    const double lamp_height = glm::dot(b.normal, top_[0]) - plane;
    double least = lamp_height, most = lamp_height;
    const auto add = [&](const Vec3d& p) {
        const double h = glm::dot(b.normal, p) - plane;
        least = std::min(least, h);
        most = std::max(most, h);
    };
    for (int k = 0; k < 3; ++k) {
        add(low_[k]);
        add(high_[k]);
        if (k > 0 && k < tops_) add(top_[k]);
    }
    if (least > margin || most < -margin) return Verdict::apart;
    if (b.masked) return Verdict::in_the_way;
    return is_covered_by(b, lamp_height < 0 ? -b.normal : b.normal, std::fabs(lamp_height), margin)
               ? Verdict::covers
               : Verdict::in_the_way;
}

// `normal` is on the lamp's side. All conditions are convex in the patch's points: its corners,
// both ways lifted, speak for all.
bool Shaft::is_covered_by(const TreeTriangle& b, const Vec3d& normal, double lamp_height,
                          double margin) const {
    if (!(lamp_height > margin)) return false;
    for (int i = 0; i < 6; ++i) {
        const Vec3d& p = i < 3 ? low_[i] : high_[i - 3];
        const Vec3d way = setting_.lamp.is_far ? -setting_.toward : p - setting_.position;
        const double depth = -glm::dot(normal, p - b.v[0]); // of p behind the plane
        if (!(depth > margin)) return false;
        if (!setting_.lamp.is_far && !(lamp_height - margin >= kLastPart * (lamp_height + depth)))
            return false;
        int sign = 0;
        for (int k = 0; k < 3; ++k) {
            const Vec3d side = glm::cross(way, b.v[(k + 1) % 3] - b.v[k]);
            const double f = glm::dot(b.v[k] - p, side);
            if (!(std::fabs(f) > margin * length(side))) return false;
            const int s = f > 0 ? 1 : -1;
            if (sign != 0 && s != sign) return false;
            sign = s;
        }
    }
    return true;
}

BoxShaft::BoxShaft(const Setting& setting, const math::Box& box) {
    const Vec3d lower(box.lower), upper(box.upper);
    // Lifted points leave the box of their triangles by 2 E and what their errors are.
    const double size = largest(glm::max(glm::abs(lower), glm::abs(upper))) + setting.size
                        + largest(setting.position);
    const double margin = 0x1p-16 * size; // of which D', C and S are parts
    const Vec3d more = setting.lamp.is_far ? setting.toward * setting.far : Vec3d(0);
    const Vec3d& point = setting.position;
    lower_ = setting.lamp.is_far ? glm::min(lower, lower + more) : glm::min(lower, point);
    upper_ = setting.lamp.is_far ? glm::max(upper, upper + more) : glm::max(upper, point);
    lower_ -= margin;
    upper_ += margin;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const double x[2] = {lower[i] - margin, upper[i] + margin};
        const double y[2] = {lower[j] - margin, upper[j] + margin};
        // The two tangents from the lamp to the rectangle: each has all four corners on one side.
        int found = 0;
        for (int corner = 0; corner < 4 && found < 2; ++corner) {
            const double cx = x[corner & 1], cy = y[corner >> 1];
            const double dx = setting.lamp.is_far ? setting.toward[i] : point[i] - cx;
            const double dy = setting.lamp.is_far ? setting.toward[j] : point[j] - cy;
            for (const double turn : {1.0, -1.0}) {
                const double a = turn * dy, b = -turn * dx;
                const double c = a * cx + b * cy;
                bool is_tangent = a != 0 || b != 0;
                for (int k = 0; k < 4; ++k)
                    is_tangent &= a * x[k & 1] + b * y[k >> 1] <= c + 1e-12 * std::fabs(c);
                if (!is_tangent || found == 2) continue;
                lines_[count_++] = {i, j, a, b, c + 1e-9 * (std::fabs(a) + std::fabs(b)) * size};
                ++found;
            }
        }
    }
}

bool BoxShaft::meets(const math::Box& box) const {
    for (int k = 0; k < 3; ++k)
        if (double(box.lower[k]) > upper_[k] || double(box.upper[k]) < lower_[k]) return false;
    for (int l = 0; l < count_; ++l) {
        const Line& line = lines_[l];
        const double x = double(line.a > 0 ? box.lower[line.i] : box.upper[line.i]);
        const double y = double(line.b > 0 ? box.lower[line.j] : box.upper[line.j]);
        if (line.a * x + line.b * y > line.c) return false;
    }
    return true;
}

} // namespace peregrine::trace::visibility
