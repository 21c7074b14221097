#include "accel/bih/cut.h"

#include <bit>

namespace peregrine::accel::bih {
namespace {

// Of a ray through a tight cell, about: what a ray through empty space saves.
double cost_inside(const BuildOptions& costs, uint32_t references) {
    const double leaf = double(costs.intersection_cost) * references;
    const double tree = 2 * double(costs.traversal_cost) * std::bit_width(references);
    return std::min(leaf, double(costs.intersection_cost) + tree);
}

} // namespace

bool cut(const Task& task, Range& range, uint32_t child, Node& node) {
    const Floats size = range.cell.upper - range.cell.lower;
    const Floats tight = range.extent.bounds.upper - range.extent.bounds.lower;
    const double sides[3] = {double(size[0]), double(size[1]), double(size[2])};
    const double whole = sides[0] * sides[1] + sides[1] * sides[2] + sides[2] * sides[0];
    double most = 0;
    uint32_t axis = 0;
    for (uint32_t k = 0; k < 3; ++k) {
        const double girth = sides[(k + 1) % 3] + sides[(k + 2) % 3];
        const double area = (sides[k] - double(tight[int(k)])) * girth;
        if (area > most) {
            most = area;
            axis = k;
        }
    }
    const double saved = most * cost_inside(task.costs, range.size());
    if (!(saved > double(task.costs.traversal_cost) * whole)) return false;
    range.cell.lower[axis] = range.extent.bounds.lower[axis];
    range.cell.upper[axis] = range.extent.bounds.upper[axis];
    node = Node::cut(axis, range.cell.lower[axis], range.cell.upper[axis], child);
    return true;
}

} // namespace peregrine::accel::bih
