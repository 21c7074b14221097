#pragma once

#include "accel/bih/task.h"

namespace peregrine::accel::bih {

// Where the range's objects leave enough of its cell empty, shrinks the cell along one axis and
// makes the node that says so.
bool cut(const Task& task, Range& range, uint32_t child, Node& node);

} // namespace peregrine::accel::bih
