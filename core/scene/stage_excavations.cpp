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
void check_share(const StageSpec& stage, const ActingShare& acting) {
  const LetOffPlan& plan = *stage.plan.let_off;
  if (!stage.plan.change.excavate.empty() || plan.share <= acting.share) return;
  const Subject table = *child(stage.subject, "let_off");
  if (acting.stage.empty())
    refuse(
        table, "share",
        "nothing of these forces acts any more: the stages that excavate state no let_off, so that they were let off "
        "at once; state let_off in the stage that excavates, or remove this one");
  refuse(table, "share",
         fmt::format("exceeds what acts: {:g} still acts after stage.{}, and forces that are let off do not come back; "
                     "write at most {:g}, or let off less before",
                     acting.share, one_line(acting.stage, 60), acting.share));
}

}  // namespace

void ActingShare::follow(const StagePlan& plan) {
  if (!plan.let_off) return;
  share = std::min(plan.change.excavate.empty() ? share : 1.0, plan.let_off->share);
  stage = plan.name;
}

void check_excavations(const Scene& scene) {
  std::vector<std::string> names, taken_out;
  ActingShare acting;
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
    if (!stage.plan.let_off) continue;
    if (taken_out.empty())
      refuse(
          stage.subject, "let_off",
          "there is nothing to let off: neither this stage nor one before it excavates; write for example excavate = "
          "[\"tunnel\"]");
    check_share(stage, acting);
    acting.follow(stage.plan);
  }
}

}  // namespace voussoir
