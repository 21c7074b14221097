#pragma once

#include "query/shapes.h"

namespace peregrine::query {

// Throw base::Error invalid_argument that names record `index` and its field, as shapes.h says.
void check(uint64_t index, const Sweep& sweep);
void check(uint64_t index, const Shape& shape);
void check(uint64_t index, const Point& point);

// Whether they would not throw.
bool is_valid(const Sweep& sweep);
bool is_valid(const Shape& shape);
bool is_valid(const Point& point);

template <class Record>
bool is_valid(const Placed<Record>& records, const Record& record) {
    return is_valid(record) && (!records.shift || is_valid(records.moved(record)));
}

template <class Record>
void check_each(const Placed<Record>& records) {
    for (uint64_t i = 0; i < records.count; ++i) {
        const Record record = records.load(i);
        check(i, record);
        if (records.shift) check(i, records.moved(record));
    }
}

} // namespace peregrine::query
