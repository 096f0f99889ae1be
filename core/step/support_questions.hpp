// What supports are asked for by those who do not know their kinds.
#pragma once

#include <functional>

namespace voussoir {

using TwoBodies = std::function<void(int body_a, int body_b)>;

struct ForceSum {
  double forces = 0;  // N
  long long acting = 0;

  double mean() const { return acting > 0 ? forces / static_cast<double>(acting) : 0; }
};

// what unbalanced forces are measured against: the mean force of contacts and supports
struct ForcesAtRest {
  ForceSum all, supports;  // contacts and supports; supports alone

  void add_support(double force, long long acting) {
    for (ForceSum* const sum : {&all, &supports}) {
      sum->forces += force;
      sum->acting += acting;
    }
  }
};

}  // namespace voussoir
