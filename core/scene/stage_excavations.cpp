#include "core/scene/stage_excavations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "core/scene/keys.hpp"

namespace voussoir {
namespace {

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

// `acting`: before the stage
void check_remaining(const StageSpec& stage, const ActingForces& acting) {
  const ExcavationForcesPlan& plan = *stage.plan.excavation_forces;
  if (!stage.plan.change.excavate.empty() || plan.remaining <= acting.remaining) return;
  const Subject table = *child(stage.subject, "excavation_forces");
  if (acting.stage.empty())
    refuse(
        table, "remaining",
        "none of these forces acts any more: the stages that excavate state no excavation_forces, which removes them "
        "at once; state excavation_forces in the stage that excavates, or remove this one");
  refuse(table, "remaining",
         fmt::format("exceeds the fraction that acts: {:g} remains after stage.{}, and forces that were removed do not "
                     "come back; write at most {:g}, or a larger fraction before",
                     acting.remaining, one_line(acting.stage, 60), acting.remaining));
}

}  // namespace

void ActingForces::follow(const StagePlan& plan) {
  if (!plan.excavation_forces) return;
  remaining = std::min(plan.change.excavate.empty() ? remaining : 1.0, plan.excavation_forces->remaining);
  stage = plan.name;
}

std::string remaining_text(double remaining) {
  const auto text = [](double fraction) {
    const std::string shortest = fmt::format("{:g}", fraction);
    return shortest.size() < 4 ? fmt::format("{:.2f}", fraction) : shortest;
  };
  return fmt::format("remaining {} (relaxed λ = {})", text(remaining), text(1 - remaining));
}

void check_excavations(const Scene& scene) {
  std::vector<std::string> names, taken_out;
  ActingForces acting;
  for (const ExcavationSpec& excavation : scene.excavations)
    names.push_back(excavation.name);
  for (const StageSpec& stage : scene.stages) {
    for (const std::string& name : stage.plan.change.excavate) {
      if (!holds(names, name))
        refuse(stage.subject, "excavate",
               names.empty() ? "there are no excavations; add [[excavations]] with a name and a region"
                             : "no excavation is named '" + one_line(name, 60) + "'; " + suggestion(name, names));
      if (holds(taken_out, name))
        refuse(stage.subject, "excavate",
               "excavates '" + one_line(name, 60) + "' again; name each excavation in one stage, once");
      taken_out.push_back(name);
    }
    if (!stage.plan.excavation_forces) continue;
    if (taken_out.empty())
      refuse(stage.subject, "excavation_forces",
             "there are no such forces: neither this stage nor one before it excavates; write for example excavate = "
             "[\"tunnel\"]");
    check_remaining(stage, acting);
    acting.follow(stage.plan);
  }
}

}  // namespace voussoir
