// What loads lack for equilibrium: the least sum of forces that must be added.
#pragma once

#include "core/limit/corner_cones.hpp"

namespace voussoir {

struct Shortfall {
  ConeProgramAnswer answer;  // value, bound: the sum, each force over its body's weight
  double doubt = 0;  // of the bound: by the gap, and by joints that close a little under the forces that press them

  bool failed() const { return answer.status != ConeStatus::optimal; }
  // the loads are supported, as far as digits tell
  bool stands() const { return !failed() && !(answer.bound > doubt); }
};

// Of forces within the cones of a program without a live load, to which forces on every free body are added.
template <int Dim>
Shortfall shortfall(const CornerAssembly<Dim>& assembly, CornerProgram<Dim> program);

}  // namespace voussoir
