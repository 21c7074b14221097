#pragma once

#include "math/box.h"

#include <cstdint>

namespace peregrine::accel::kdtree {

// The surface area heuristic (Wald and Havran 2006, equations 1 and 2), all times half the cell's
// area, so that nothing is divided. In double: a cell's sides may be 1e30 or denormal floats.
struct CostModel {
    double traversal;
    double intersection;
    double empty_factor; // 1 - empty bonus

    double leaf(const math::Box& cell, uint32_t triangles) const {
        return intersection * triangles * math::half_area(cell);
    }
};

// The planes of a cell perpendicular to one axis: the half areas of both children are linear in the
// plane's position.
class PlaneCost {
public:
    PlaneCost(const CostModel& model, const math::Box& cell, uint32_t axis)
        : lower_(double(cell.lower[int(axis)])), upper_(double(cell.upper[int(axis)])),
          traversal_(model.traversal * math::half_area(cell)), intersection_(model.intersection),
          empty_factor_(model.empty_factor) {
        const double u = side(cell, (axis + 1) % 3);
        const double v = side(cell, (axis + 2) % 3);
        rim_ = u + v;
        face_ = u * v;
    }

    // Of the children's triangles alone; for one plane or a vector of planes.
    template <class Real>
    Real children(const Real& plane, const Real& left, const Real& right) const {
        return (face_ + rim_ * (plane - lower_)) * left + (face_ + rim_ * (upper_ - plane)) * right;
    }
    template <class Real>
    Real node(const Real& children) const {
        return traversal_ + intersection_ * children;
    }
    double empty_factor() const { return empty_factor_; }
    bool has_bonus() const { return empty_factor_ < 1; }

private:
    static double side(const math::Box& cell, uint32_t axis) {
        return double(cell.upper[int(axis)]) - double(cell.lower[int(axis)]);
    }

    double lower_, upper_, traversal_, intersection_, empty_factor_, rim_, face_;
};

} // namespace peregrine::accel::kdtree
