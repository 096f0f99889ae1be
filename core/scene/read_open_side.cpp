#include "core/scene/read_open_side.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/scene/keys.hpp"
#include "core/scene/read_motion.hpp"
#include "core/scene/read_records.hpp"
#include "core/stage/open_side.hpp"

namespace voussoir {
namespace {

// the wave is stated by velocities or by records
void read_wave(const Subject& table, const std::string& side, int dimension, QuietPlan& plan,
               std::vector<RecordSpec>& records) {
  const bool recorded = table.node->find("factor") != nullptr;
  if (table.node->find("angular_velocity")) refuse(table, "angular_velocity", "a wave has a velocity only; remove it");
  const MotionSpec motion = read_motion(table);
  const Node* input = table.node->find("input");
  if (!recorded && !motion.velocity) {
    for (const char* key : {"input", "times_s", "factors", "frequency_hz", "phase_deg"})
      if (table.node->find(key))
        refuse(table, key, "is stated but no motion that enters; state velocity or a record (factor), or remove it");
    return;
  }
  if (side != "bottom")
    refuse(table, recorded ? "factor" : "velocity",
           fmt::format("a wave enters at the base alone, and this side is {}; state it for side = [\"bottom\"]", side));
  if (!input)
    refuse(table, "input",
           "is needed with a motion that enters: \"upgoing\" if it is the wave itself, \"outcrop\" if it is that of a "
           "free surface, twice the wave");
  if (input->text == "within")
    refuse(
        table, "input",
        "a motion within the rock contains the wave that comes back, which a quiet side would let leave; prescribe it "
        "on a rigid base, [[stage.move]] of fixed blocks, or write \"outcrop\" with the motion of an outcrop");
  plan.upgoing = input->text == "outcrop" ? 0.5 : 1;
  if (!recorded) {
    plan.velocity = *motion.velocity;
    plan.factor = read_factor(table);
    return;
  }
  refuse_beside_records(table);
  for (RecordSpec& record : read_records(table)) {
    plan.records.push_back(recorded_motion(record, dimension));
    records.push_back(std::move(record));
  }
}

bool chooses_one_side(const Selector& s) {
  return s.sides.size() == 1 && !s.all && s.names.empty() && s.above.empty() && s.below.empty() && !s.inside &&
         s.low.empty();
}

bool opens_side(const StageSpec& stage) {
  return std::ranges::any_of(stage.plan.change.boundary, &BoundaryPlan::lets_waves_leave);
}

}  // namespace

bool read_open_side(const Subject& table, int dimension, BoundaryPlan& plan, std::vector<RecordSpec>& records) {
  const auto quiet = child(table, "quiet"), free_field = child(table, "free_field");
  if (!quiet && !free_field) return false;
  const char* const key = quiet ? "quiet" : "free_field";
  if (quiet && free_field)
    refuse(table, "free_field", "is stated together with quiet, and is quiet itself; remove one of the two");
  for (const char* other : {"stress", "in_situ"})
    if (table.node->find(other))
      refuse(table, other,
             fmt::format("is stated together with {}; stress the side in an earlier stage, where it is in equilibrium: "
                         "it stays as it is",
                         key));
  if (!chooses_one_side(plan.bodies))
    refuse(table, table.node->find("side") ? "side" : key,
           fmt::format("{} closes all faces of one side of the model; choose it by side = [\"bottom\"] alone, a table "
                       "for each side",
                       key));
  const std::string& side = plan.bodies.sides.front();
  if (free_field) {
    if (side == "bottom" || side == "top")
      refuse(table, "free_field", fmt::format("is beside the model, and this side is {}; write quiet = {{}}", side));
    read_keys(*free_field->node, "medium", plan.free_field.emplace());
    return true;
  }
  read_keys(*quiet->node, "medium", plan.quiet.emplace().medium);
  read_wave(*quiet, side, dimension, *plan.quiet, records);
  return true;
}

void check_open_sides(const std::vector<StageSpec>& stages) {
  const StageSpec* opened = nullptr;
  for (const StageSpec& stage : stages) {
    const bool opens = opens_side(stage);
    if (!opened && !opens) continue;
    const std::string& name = opened ? opened->plan.name : stage.plan.name;
    if (!std::holds_alternative<RunPlan>(stage.plan.plan))
      refuse(stage.subject, "kind",
             fmt::format(
                 "must be \"run\" from stage '{}' on, which opens a side to waves: there no spring holds the model "
                 "in equilibrium; seek it before",
                 name));
    if (opened)
      for (const char* key : {"excavate", "remove", "fix"})
        if (stage.subject.node->find(key))
          refuse(stage.subject, key,
                 fmt::format(
                     "changes blocks after stage '{}' has opened a side to waves, which would then creep; make the "
                     "change before",
                     name));
    if (opens && !opened) opened = &stage;
  }
}

template <int Dim>
void check_open_sides(const std::vector<StageSpec>& stages, Model<Dim> model) {
  if (std::ranges::none_of(stages, opens_side)) return;
  for (const StageSpec& stage : stages) {
    Change others = stage.plan.change;
    std::erase_if(others.boundary, [](const BoundaryPlan& plan) { return plan.lets_waves_leave(); });
    model = apply(std::move(model), others);
    // quiet sides first, as open_sides does
    for (const bool quiet : {true, false})
      for (std::size_t i = 0; i < stage.plan.change.boundary.size(); ++i) {
        const BoundaryPlan& plan = stage.plan.change.boundary[i];
        if (!plan.lets_waves_leave() || plan.quiet.has_value() != quiet) continue;
        const Subject& table = stage.chosen_by("boundary")[i].subject;
        try {
          open_side(model, plan);
        } catch (const ClosedSide& reason) {
          const auto inner = child(table, plan.quiet ? "quiet" : "free_field");
          const bool of_table = reason.key == "side" || reason.key == "free_field";
          refuse(of_table ? table : *inner, reason.key, reason.what());
        }
      }
  }
}

template void check_open_sides<2>(const std::vector<StageSpec>&, Model<2>);
template void check_open_sides<3>(const std::vector<StageSpec>&, Model<3>);

}  // namespace voussoir
