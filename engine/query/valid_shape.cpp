#include "query/valid_shape.h"

#include "base/error.h"

#include <cmath>

namespace peregrine::query {
namespace {

constexpr float kLargest = 1e30f;

// The fields of one record.
class Fields {
public:
    Fields(const char* record, uint64_t index)
        : record_(record), index_(static_cast<unsigned long long>(index)) {}

    void within(const math::Vec3& value, const char* field) const {
        constexpr const char* kAxes[] = {" x", " y", " z"};
        for (int k = 0; k < 3; ++k) within(value[k], field, kAxes[k]);
    }
    void within(float value, const char* field, const char* part = "") const {
        if (!(std::fabs(value) <= kLargest)) [[unlikely]]
            base::fail(base::Code::invalid_argument,
                       "%s %llu: %s%s is %g; it must be finite and at most 1e30 in magnitude",
                       record_, index_, field, part, double(value));
    }
    void not_negative(float value, const char* field, const char* part = "") const {
        within(value, field, part);
        if (value < 0) [[unlikely]]
            base::fail(base::Code::invalid_argument, "%s %llu: %s%s is %g; it must not be negative",
                       record_, index_, field, part, double(value));
    }
    void require(bool holds, const char* sentence) const {
        if (!holds) [[unlikely]]
            base::fail(base::Code::invalid_argument, "%s %llu: %s", record_, index_, sentence);
    }

private:
    const char* record_;
    unsigned long long index_;
};

} // namespace

void check(uint64_t index, const Sweep& sweep) {
    const Fields fields("sweep", index);
    fields.within(sweep.center, "center");
    fields.not_negative(sweep.radius, "radius");
    fields.within(sweep.axis, "axis");
    fields.within(sweep.direction, "direction");
    fields.require(sweep.direction != math::Vec3(0), "the direction is zero");
    fields.require(!std::isnan(sweep.t_max), "t_max is NaN");
    fields.require(sweep.t_max >= 0, "t_max is negative");
    fields.require(sweep.reserved == 0, "reserved must be 0");
}

void check(uint64_t index, const Shape& shape) {
    const Fields fields("shape", index);
    fields.require(shape.kind <= Shape::box, "kind is unknown; it must be 0, 1 or 2");
    fields.within(shape.center, "center");
    if (shape.kind == Shape::box) {
        fields.not_negative(shape.extent.x, "extent", " x");
        fields.not_negative(shape.extent.y, "extent", " y");
        fields.not_negative(shape.extent.z, "extent", " z");
        constexpr const char* kParts[] = {" x", " y", " z", " w"};
        bool is_zero = true;
        for (int k = 0; k < 4; ++k) {
            fields.within(shape.rotation[k], "rotation", kParts[k]);
            is_zero &= shape.rotation[k] == 0;
        }
        fields.require(!is_zero, "the rotation is zero");
        return;
    }
    fields.not_negative(shape.radius, "radius");
    if (shape.kind == Shape::capsule) fields.within(shape.extent, "extent");
}

void check(uint64_t index, const Point& point) {
    const Fields fields("point", index);
    fields.within(point.position, "position");
    fields.not_negative(point.radius, "radius");
}

} // namespace peregrine::query
