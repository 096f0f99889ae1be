// A reliability analysis of a study: design points by FORM, and the probability of failure by importance sampling.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/study/evaluations.hpp"
#include "core/probability/curvature.hpp"
#include "core/probability/importance_sampling.hpp"
#include "core/probability/other_design_points.hpp"

namespace voussoir {

// an answer that the analysis asked for
struct ReliabilityRow {
  std::string purpose;  // medians, variance, design point, second order, pilot, importance
  StandardPoint u;
  std::vector<double> values;
  EvaluatedSetting answer;
};

struct ReliabilityFound {
  std::string failure;  // why there is no probability; else empty
  double g_at_medians = 0;
  bool medians_fail = false;                      // beta is negative, the probability above one half
  std::vector<double> variance_shares;            // to first order at the medians, by component; of cheap answers
  std::vector<DesignPoint> points;                // the nearest first
  std::vector<std::vector<double>> point_values;  // of these, as DrawnKeys::at
  std::vector<std::vector<double>> importances;   // of these, by component of the drawn keys; their sum is 1
  std::optional<double> first_order;              // probability of the nearest point's pieces
  std::optional<SecondOrder> second_order;        // where a curvature costs little
  int pilots = 0;                                 // rows that looked for other points
  std::optional<SamplingEstimate> sampled;        // of failing, whatever the medians do
  std::vector<std::string> warnings;
  std::vector<ReliabilityRow> rows;
};

// Throws EvaluationsInterrupted, and what the evaluations throw.
ReliabilityFound analyse_reliability(const Sweep& sweep, const Evaluations& evaluations);

std::string reliability_json(const StudyPlan& plan, const Sweep& sweep, const ReliabilityFound& found);
std::string reliability_csv(const StudyPlan& plan, const Sweep& sweep, const ReliabilityFound& found);
// for people
std::vector<std::string> reliability_lines(const Sweep& sweep, const ReliabilityFound& found);

}  // namespace voussoir
