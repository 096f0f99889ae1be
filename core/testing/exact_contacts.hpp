// The fully converged contact of a pair: analytic centre by Newton's method in 113 bits on the exact planes, and the
// normal, overlap and section that belong to it.
#pragma once

#include <optional>
#include <vector>

#include "core/testing/exact_referee.hpp"

namespace voussoir::exact {

struct ConvergedContact {
  QuadVector from_start{};  // the centre, relative to the start
  Quad distance = 0;    // of the start from it, in the metric of the barrier's Hessian there: along any direction the
                        // error of the start is no more than this fraction of the region
  QuadVector normal{};  // unit; 0 when those of the parts are equal
  Quad overlap = 0;     // along it
  Section section;
};

// `planes`: those of A first, then those of B, then any that only close the solid. `radius` is the potential
// particle's. Nothing if the start is not inside or Newton does not end. `weights`: those of the first planes in the
// barrier and in the potentials; the others have 1.
std::optional<ConvergedContact> converged_contact(const Planes& planes, int faces_a, int faces_b, const Point& start,
                                                  double radius, std::vector<double> weights = {});

// The distance of each plane of A ahead of the point along a normal, of each plane of B behind it (Eq. 3.36); nothing
// for planes that the search never meets.
std::vector<std::optional<Quad>> distances_along(const Planes& planes, int faces_a, int faces_b, const Point& point,
                                                 const Point& normal);

// the least of `count` of them from `first` on, one of which is met
Quad nearest(const std::vector<std::optional<Quad>>& distances, int first, int count);

}  // namespace voussoir::exact
