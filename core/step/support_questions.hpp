// Questions to supports that do not depend on their kinds.
#pragma once

#include <functional>

namespace voussoir {

using TwoBodies = std::function<void(int body_a, int body_b)>;

struct ForceSum {
  double forces = 0;  // N
  long long acting = 0;

  double mean() const { return acting > 0 ? forces / static_cast<double>(acting) : 0; }
};

// the reference of unbalanced forces: the mean force of contacts and supports
struct ForcesAtRest {
  ForceSum all, supports;  // contacts and supports; supports only

  void add_support(double force, long long acting) {
    for (ForceSum* const sum : {&all, &supports}) {
      sum->forces += force;
      sum->acting += acting;
    }
  }
};

}  // namespace voussoir
