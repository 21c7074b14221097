#include "query/valid_shape.h"

#include "base/error.h"

#include <cmath>

namespace peregrine::query {
namespace {

constexpr float kLargest = 1e30f;

// The fields of one record, looked at one by one.
class Fields {
public:
    // The first that is wrong throws, and names the record.
    Fields(const char* record, uint64_t index)
        : record_(record), index_(static_cast<unsigned long long>(index)) {}
    // ... makes it invalid.
    Fields() = default;

    bool are_valid() const { return valid_; }

    void within(const math::Vec3& value, const char* field) {
        constexpr const char* kAxes[] = {" x", " y", " z"};
        for (int k = 0; k < 3; ++k) within(value[k], field, kAxes[k]);
    }
    void within(float value, const char* field, const char* part = "") {
        if (!(std::fabs(value) <= kLargest)) [[unlikely]]
            refuse("must be finite and at most 1e30 in magnitude", value, field, part);
    }
    void not_negative(float value, const char* field, const char* part = "") {
        within(value, field, part);
        if (value < 0) [[unlikely]]
            refuse("must not be negative", value, field, part);
    }
    void require(bool holds, const char* sentence) {
        if (!holds) [[unlikely]]
            refuse(sentence);
    }

private:
    [[gnu::cold]] void refuse(const char* rule, float value, const char* field, const char* part) {
        valid_ = false;
        if (record_)
            base::fail(base::Code::invalid_argument, "%s %llu: %s%s is %g; it %s", record_, index_,
                       field, part, double(value), rule);
    }
    [[gnu::cold]] void refuse(const char* sentence) {
        valid_ = false;
        if (record_)
            base::fail(base::Code::invalid_argument, "%s %llu: %s", record_, index_, sentence);
    }

    const char* record_ = nullptr; // null: nothing is thrown
    unsigned long long index_ = 0;
    bool valid_ = true;
};

void look(Fields& fields, const Sweep& sweep) {
    fields.within(sweep.center, "center");
    fields.not_negative(sweep.radius, "radius");
    fields.within(sweep.axis, "axis");
    fields.within(sweep.direction, "direction");
    fields.require(sweep.direction != math::Vec3(0), "the direction is zero");
    fields.require(!std::isnan(sweep.t_max), "t_max is NaN");
    fields.require(sweep.reserved == 0, "reserved must be 0");
}

void look(Fields& fields, const Shape& shape) {
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

void look(Fields& fields, const Point& point) {
    fields.within(point.position, "position");
    fields.require(!std::isnan(point.radius), "radius is NaN");
}

template <class Record>
bool is_good(const Record& record) {
    Fields fields;
    look(fields, record);
    return fields.are_valid();
}

} // namespace

void check(uint64_t index, const Sweep& sweep) {
    Fields fields("sweep", index);
    look(fields, sweep);
}
void check(uint64_t index, const Shape& shape) {
    Fields fields("shape", index);
    look(fields, shape);
}
void check(uint64_t index, const Point& point) {
    Fields fields("point", index);
    look(fields, point);
}

bool is_valid(const Sweep& sweep) {
    return is_good(sweep);
}
bool is_valid(const Shape& shape) {
    return is_good(shape);
}
bool is_valid(const Point& point) {
    return is_good(point);
}

} // namespace peregrine::query
