#include "core/key_blocks/mass_values.hpp"

namespace voussoir {
namespace {

template <int Dim>
std::set<int> blocks_below_one(const Survey<Dim>& survey) {
  std::set<int> below;
  for (const std::vector<int>& round : survey.below_one.rounds)
    below.insert(round.begin(), round.end());
  for (const SurveyRow<Dim>& cluster : survey.clusters)
    if (cluster.bolted.factor.value_or(1) < 1) below.insert(cluster.bodies.begin(), cluster.bodies.end());
  return below;
}

}  // namespace

template <int Dim>
MassValues<Dim> mass_values(const Survey<Dim>& survey) {
  MassValues<Dim> values;
  for (const auto* list : {&survey.rows, &survey.clusters})
    for (const SurveyRow<Dim>& row : *list) {
      values.undecided |= row.kind() == BlockKind::undecided;
      const std::optional<double>& factor = row.bolted.factor;
      if (moves(row.kind()) && factor && (!values.least_factor || *factor < *values.least_factor)) {
        values.least_factor = factor;
        values.least = &row;
      }
      const std::optional<double>& critical = row.critical_coefficient;
      if (critical && (!values.least_critical_coefficient || *critical < *values.least_critical_coefficient))
        values.least_critical_coefficient = critical;
    }
  values.below_1 = blocks_below_one(survey);
  for (const SurveyRow<Dim>& row : survey.rows)
    if (values.below_1.contains(row.bodies[0])) values.volume_below_1 += row.volume;
  return values;
}

template MassValues<2> mass_values<2>(const Survey<2>&);
template MassValues<3> mass_values<3>(const Survey<3>&);

}  // namespace voussoir
