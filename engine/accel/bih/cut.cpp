#include "accel/bih/cut.h"

#include <cmath>

namespace peregrine::accel::bih {
namespace {

// Of a ray through a tight cell, about: what a ray through empty space saves.
double cost_inside(const BuildOptions& costs, uint32_t references) {
    const double leaf = double(costs.intersection_cost) * references;
    const double tree = 2 * double(costs.traversal_cost) * std::log2(double(references) + 1);
    return std::min(leaf, double(costs.intersection_cost) + tree);
}

} // namespace

bool cut(const Task& task, Range& range, uint32_t child, Node& node) {
    const double whole = half_area(range.cell);
    double least = whole;
    Bounds best = range.cell;
    uint32_t best_axis = 0;
    for (uint32_t axis = 0; axis < 3; ++axis) {
        Bounds cell = range.cell;
        cell.lower[axis] = range.extent.bounds.lower[axis];
        cell.upper[axis] = range.extent.bounds.upper[axis];
        const double area = half_area(cell);
        if (!(area < least)) continue;
        least = area;
        best = cell;
        best_axis = axis;
    }
    const double saved = (whole - least) * cost_inside(task.costs, range.size());
    if (!(saved > double(task.costs.traversal_cost) * whole)) return false;
    range.cell = best;
    node = Node::cut(best_axis, best.lower[best_axis], best.upper[best_axis], child);
    return true;
}

} // namespace peregrine::accel::bih
