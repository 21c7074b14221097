#pragma once

#include "accel/bih/task.h"

namespace peregrine::accel::bih {

// Two children, side by side along an axis.
struct Halves {
    uint32_t axis;
    Range left, right;

    Node node(uint32_t left_child) const {
        return Node::inner(axis, left.cell.upper[axis], right.cell.lower[axis], left_child);
    }
};

// What follows from the children's references and bounds.
void finish(const Range& range, Halves& halves);

// False if the range is to be a leaf. Sorts its references.
bool split(const Task& task, const Range& range, Halves& halves);

} // namespace peregrine::accel::bih
