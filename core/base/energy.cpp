#include "core/base/energy.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace voussoir {
namespace {

constexpr bool in_order() {
  for (std::size_t i = 0; i < source_count; ++i)
    if (static_cast<std::size_t>(source_table[i].source) != i) return false;
  return true;
}
static_assert(in_order(), "the rows have the order of the enum");

// A column's sum with the rows known before the program runs, so that rows of weight 0 cost nothing: the balance is
// computed in every step.
template <int SourceRow::*column, std::size_t... row>
double sum_of(const EnergyFlows& flows, std::index_sequence<row...>) {
  double sum = 0;
  ((source_table[row].*column != 0 ? void(sum += source_table[row].*column * flows.values[row]) : void()), ...);
  return sum;
}
template <int SourceRow::*column>
double sum_of(const EnergyFlows& flows) {
  return sum_of<column>(flows, std::make_index_sequence<source_count>{});
}

}  // namespace

double EnergyBalance::sum(int SourceRow::*column) const {
  double sum = 0;
  for (const SourceRow& row : source_table)
    if (row.*column != 0) sum += row.*column * flows[row.source];
  return sum;
}

void balance(EnergyBalance& energy) {
  EnergyFlows& f = energy.flows;
  if (energy.phase == BalancePhase::not_begun) f = {};  // half a kick that belongs to the time before
  const double to_motion = sum_of<&SourceRow::motion>(f), from_springs = sum_of<&SourceRow::springs>(f);

  // at the start, and when the model has changed, the errors keep their values
  if (energy.phase != BalancePhase::running) {
    const double kinetic = energy.kinetic - to_motion - energy.motion_error;
    const double elastic = energy.elastic + from_springs - energy.contact_error;
    if (energy.phase == BalancePhase::model_changed)
      f[Source::stage_changes] += (kinetic - energy.kinetic_origin) + (elastic - energy.elastic_origin);
    energy.kinetic_origin = kinetic;
    energy.elastic_origin = elastic;
    energy.phase = BalancePhase::running;
  }
  energy.motion_error = (energy.kinetic - energy.kinetic_origin) - to_motion;
  energy.contact_error = (energy.elastic - energy.elastic_origin) + from_springs;
  energy.worst_error = std::max(energy.worst_error, std::abs(energy.unexplained()));
  energy.largest_energy =
      std::max({energy.largest_energy, energy.kinetic, energy.elastic, std::abs(sum_of<&SourceRow::potential>(f)),
                f[Source::friction], sum_of<&SourceRow::damping>(f), std::abs(f[Source::stiffening]),
                std::abs(sum_of<&SourceRow::external>(f))});
}

}  // namespace voussoir
