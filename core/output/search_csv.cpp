#include "core/output/search_csv.hpp"

#include "text/csv_table.hpp"

namespace voussoir {

std::string search_csv(const std::vector<TrialRow>& trials) {
  if (trials.empty()) return {};
  std::string text =
      csv_line({"stage", "trial", "level", "unit", "outcome", "body", "displacement_m", "elastic_displacements",
                "required", "bolts_turned_deg", "bolts_use", "water_lost", "moving_blocks", "motion"}) +
      "\n";
  for (const TrialRow& t : trials)
    text +=
        csv_line({std::to_string(t.stage), std::to_string(t.trial), csv_cell(t.level), t.unit, t.outcome,
                  t.body < 0 ? "" : std::to_string(t.body), csv_cell(t.displacement), csv_cell(t.elastic_displacements),
                  csv_cell(t.required), csv_cell(t.bolts_turned), csv_cell(t.bolts_use), csv_cell(t.water_lost),
                  t.mechanism.known() ? std::to_string(t.mechanism.bodies().size()) : "",
                  t.mechanism.known() ? word_of(t.mechanism.clusters.front().motion) : ""}) +
        "\n";
  return text;
}

}  // namespace voussoir
