// Alternatives to the kernel. Each library in one file, built only if it is found; none is linked to the core. They run
// as shipped: cold, unless the name contains warm; bodies and shapes are made beforehand.
#pragma once

#include "benchmarks/method.hpp"

namespace voussoir::benchmarks {

std::vector<Method> glpk_methods();    // decision: the feasibility program
std::vector<Method> ipopt_methods();   // point: the analytic centre
std::vector<Method> ccd_methods();     // GJK, expanding polytope, Minkowski portals
std::vector<Method> fcl_methods();     // collide with a contact, by its libccd solver
std::vector<Method> bullet_methods();  // in double precision, margins 0
std::vector<Method> clip_methods();    // the overlap polyhedron itself

// of the collision libraries that the program was built with
inline std::vector<Method> library_methods() {
  std::vector<Method> list;
  [[maybe_unused]] const auto add = [&](const std::vector<Method>& more) {
    list.insert(list.end(), more.begin(), more.end());
  };
#ifdef VOUSSOIR_PEER_CCD
  add(ccd_methods());
#endif
#ifdef VOUSSOIR_PEER_FCL
  add(fcl_methods());
#endif
#ifdef VOUSSOIR_PEER_BULLET
  add(bullet_methods());
#endif
  return list;
}

}  // namespace voussoir::benchmarks
