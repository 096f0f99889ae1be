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

double EnergyLedger::sum(int SourceRow::*column) const {
  double sum = 0;
  for (const SourceRow& row : source_table)
    if (row.*column != 0) sum += row.*column * flows[row.source];
  return sum;
}

void balance(EnergyLedger& ledger) {
  EnergyFlows& f = ledger.flows;
  if (ledger.phase == LedgerPhase::not_begun) f = {};  // half a kick that belongs to the time before
  const double to_motion = sum_of<&SourceRow::motion>(f), from_springs = sum_of<&SourceRow::springs>(f);

  // at the start, and when the model has changed, the errors keep their values
  if (ledger.phase != LedgerPhase::running) {
    const double kinetic = ledger.kinetic - to_motion - ledger.motion_error;
    const double elastic = ledger.elastic + from_springs - ledger.contact_error;
    if (ledger.phase == LedgerPhase::model_changed)
      f[Source::stage_changes] += (kinetic - ledger.kinetic_origin) + (elastic - ledger.elastic_origin);
    ledger.kinetic_origin = kinetic;
    ledger.elastic_origin = elastic;
    ledger.phase = LedgerPhase::running;
  }
  ledger.motion_error = (ledger.kinetic - ledger.kinetic_origin) - to_motion;
  ledger.contact_error = (ledger.elastic - ledger.elastic_origin) + from_springs;
  ledger.worst_error = std::max(ledger.worst_error, std::abs(ledger.unexplained()));
  ledger.largest_energy =
      std::max({ledger.largest_energy, ledger.kinetic, ledger.elastic, std::abs(sum_of<&SourceRow::potential>(f)),
                f[Source::friction], sum_of<&SourceRow::damping>(f), std::abs(f[Source::stiffening]),
                std::abs(sum_of<&SourceRow::external>(f))});
}

}  // namespace voussoir
