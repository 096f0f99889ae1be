// Limit states of closed form for tests: wedges, a plane failure with crack, a slab and a gravity block. What a row's
// keys are is said at each; g is factor - 1.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/probability/correlation.hpp"
#include "core/probability/limit_state.hpp"

namespace voussoir::limit_states {

using Values = std::vector<double>;  // x, by key

// Keys with their laws, and an answer at their values; counts what it is asked.
struct Problem {
  std::vector<Distribution> laws;
  std::vector<CorrelatedPair> pairs;  // of the values
  std::function<StateAnswer(const Values&)> answer;

  std::shared_ptr<int> evaluations = std::make_shared<int>(0);

  std::size_t keys() const { return laws.size(); }
  LimitFunction function() const;
  Values values_at(const StandardPoint& u) const;
};

// keys: dip and direction of joint A, of joint B, friction of A and B, deg
Problem wedge(const Values& means, const Values& deviations, std::vector<CorrelatedPair> pairs = {});
Problem wedge_1();
Problem wedge_2();  // friction correlated
Problem wedge_3();
Problem wedge_4();  // at its design point it leaves a plane: a kink

// Keys: two normals of the pole of joint A and two of B, which scatter after Fisher, and the friction of both.
Problem fisher_wedge(const Values& dips, const Values& constants, double friction, double deviation);

// The slope of Sau Mau Ping road: cohesion t/m², friction deg, depth of the tension crack m, part of it full of water,
// acceleration g. Correlated: cohesion with friction and depth with water, -0.5.
Problem sau_mau_ping(bool correlated);

// A slab on its joint, cohesion in Pa (lognormal) and friction in deg (normal).
Problem slab(double driving, double effective_normal, double cohesion, double cohesion_deviation, double friction,
             double friction_deviation, int idle_keys = 0);
Problem dry_slab(double cohesion, double cohesion_deviation, double friction, double friction_deviation,
                 int idle_keys = 0);

// A block of 4 m by 10 m that water on one side pushes, keys: its depth in m, friction in deg. It slides or tips.
Problem gravity_block(double water, double water_deviation, double friction, double friction_deviation);

}  // namespace voussoir::limit_states
