// The criteria by which a search judges its trials, as clauses of its rule, and its verdict on bolts.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/settings.hpp"
#include "core/model/state.hpp"
#include "core/run/search_estimates.hpp"

namespace voussoir {

struct TrialCriteria {
  const ReducePlan& plan;
  const Settings& settings;
  double failure_displacement;  // m
  bool watches;                 // by the strength that the motion requires
  std::string not_watched;      // why not, if the plan asks for it
};

std::string failed_rule(const TrialCriteria& criteria);
std::string stable_and_failed_rule(const TrialCriteria& criteria);
std::string bisection_rule(const TrialCriteria& criteria, CriticalBy by);

// of a search that is stable to its end, and without the strength that its factor divides; `use`: the largest force of
// a bolt there over its capacity, if any has one
std::string hangs_on_bolts(const std::optional<double>& use);

// The body that has moved farthest since the search began, as a clause, for an undecided trial that ended in true
// motion. `failure`: m, the displacement at which a body has failed.
template <int Dim>
std::string farthest_mover(const Model<Dim>& model, const State<Dim>& state, const std::vector<Vector<Dim>>& begin,
                           const std::function<double(int)>& failure);

}  // namespace voussoir
