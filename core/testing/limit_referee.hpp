// Limit analysis by linear programs that GLPK solves with its simplex method: the referee of the cone programs. In the
// plane a cone is its two edges, and the answer is the same; in space a pyramid inside or around it encloses the
// answer.
#pragma once

#include "core/limit/limit.hpp"

namespace voussoir {

struct RefereedFactor {
  bool solved = false;  // optimal by the simplex method; none if the load is carried without bound or nothing is
  double factor = 0;
  double gap = 0, violation = 0;  // by independent sums over the program's own numbers
};

// The largest factor of the live load. `edges`: of each pyramid, from 3; `around`: the cones are inside, else their
// pyramids are. In the plane both are ignored. Cohesion must be zero.
template <int Dim>
RefereedFactor refereed_factor(const CornerAssembly<Dim>& assembly, const Loads<Dim>& dead, const Loads<Dim>& live,
                               int edges = 16, bool around = false);

}  // namespace voussoir
