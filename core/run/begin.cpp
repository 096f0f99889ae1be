#include "core/run/begin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "core/base/multiples.hpp"
#include "core/output/monitor.hpp"
#include "core/output/support_table.hpp"
#include "core/run/history.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

bool holds(const std::vector<std::string>& list, const std::string& name) {
  return std::ranges::find(list, name) != list.end();
}

// The model after the last of the stages, and the friction of all joint properties within each of them.
template <int Dim>
struct Replayed {
  Model<Dim> model;
  std::vector<std::vector<double>> friction;  // rad, by stage
};

template <int Dim>
Replayed<Dim> replay(const Prepared<Dim>& scene, int stages) {
  Replayed<Dim> replayed{scene.model, {}};
  for (int s = 0; s < stages; ++s) {
    replayed.model = apply(std::move(replayed.model), scene.stages[s].change);
    std::vector<double>& friction = replayed.friction.emplace_back();
    for (const JointProperties& p : replayed.model.properties)
      friction.push_back(p.friction);
  }
  return replayed;
}

// unused joint properties are this scene's
template <int Dim>
void take_own_strength(const Replayed<Dim>& replayed, const std::vector<std::string>& own, Schedule& schedule) {
  const std::vector<JointProperties>& properties = replayed.model.properties;
  if (schedule.friction.size() > properties.size()) schedule.friction.resize(properties.size());
  for (std::size_t p = 0; p < properties.size(); ++p) {
    if (p == schedule.friction.size()) schedule.friction.push_back(0);
    if (holds(own, properties[p].name)) schedule.friction[p] = replayed.friction.back()[p];
  }
  if (!schedule.strength_factor.empty()) schedule.strength_factor.resize(properties.size(), 1);
}

// the index of this scene's column in the other's rows, or the value that replaces it
struct ColumnSource {
  std::optional<std::size_t> place;
  std::optional<std::size_t> own;  // the joint properties whose friction it contains
  double value = std::numeric_limits<double>::quiet_NaN();
};

template <int Dim>
std::vector<ColumnSource> sources_of(const Prepared<Dim>& scene, const std::vector<std::string>& theirs,
                                     const SharedStages& shared) {
  const std::vector<std::string> ours = history_columns(scene);
  const std::vector<double> before = history_row(scene, scene.model, scene.state, 1, 0);
  std::set<std::string> followed;  // columns of identical monitors
  for (const Monitor& m : scene.monitors)
    if (holds(shared.monitors, m.name))
      for (const Column& c : monitor_columns<Dim>({m}))
        followed.insert(c.header());
  const std::size_t first = ours.size() - monitor_columns<Dim>(scene.monitors).size();
  std::vector<ColumnSource> sources(ours.size());
  for (std::size_t k = 0; k < ours.size(); ++k) {
    const auto found = std::ranges::find(theirs, ours[k]);
    if (found != theirs.end() && (k < first || followed.contains(ours[k])))
      sources[k].place = static_cast<std::size_t>(found - theirs.begin());
    if (k < first) sources[k].value = before[k];  // not changed by any stage of the other
  }
  for (std::size_t p = 0; p < scene.model.properties.size(); ++p) {
    const std::string& name = scene.model.properties[p].name;
    const auto column = std::ranges::find(ours, "friction_" + name + "_deg") - ours.begin();
    if (holds(shared.own, name) && column < static_cast<std::ptrdiff_t>(first)) sources[column].own = p;
  }
  return sources;
}

template <int Dim>
void rewrite_history(const Prepared<Dim>& scene, const Replayed<Dim>& replayed, const SharedStages& shared,
                     History& history) {
  const std::vector<ColumnSource> sources = sources_of(scene, history.columns, shared);
  for (std::vector<double>& row : history.rows) {
    std::vector<double> ours;
    const std::vector<double>& friction = replayed.friction[static_cast<std::size_t>(row[1]) - 1];
    for (const ColumnSource& source : sources)
      ours.push_back(source.own ? to_degrees(friction[*source.own]) : source.place ? row[*source.place] : source.value);
    row = std::move(ours);
  }
  history.columns = history_columns(scene);
}

// the reference of this scene's monitors
template <int Dim>
std::vector<StageEnd<Dim>> ends_wanted(const Prepared<Dim>& scene, const Progress<Dim>& other) {
  std::set<int> wanted;
  for (const Monitor& m : scene.monitors)
    if (m.since >= 0 && m.since < other.stage) wanted.insert(m.since);
  std::vector<StageEnd<Dim>> ends;
  for (const int stage : wanted) {
    const auto found = std::ranges::find(other.ends, stage, &StageEnd<Dim>::stage);
    if (found == other.ends.end() && stage != other.stage - 1)
      throw BeginError(
          fmt::format("does not contain the positions of the blocks at the end of stage '{}', from which a monitor "
                      "measures; state that "
                      "monitor in its scene too, or measure from '{}'",
                      scene.stages[stage].name, scene.stages[other.stage - 1].name));
    ends.push_back(found != other.ends.end() ? *found : stage_end(stage, other.state));
  }
  return ends;
}

template <int Dim>
bool fits(const Model<Dim>& model, const State<Dim>& state) {
  const int parts = static_cast<int>(model.parts.size());
  return state.bodies.motions.size() == model.bodies.size() && state.schedule.water.size() == model.waters.size() &&
         std::ranges::all_of(state.contacts.list,
                             [&](const Contact<Dim>& c) { return c.part_a < parts && c.part_b < parts; });
}

}  // namespace

template <int Dim>
Progress<Dim> begin_at_end(const Prepared<Dim>& scene, Progress<Dim> other, const SharedStages& shared) {
  const Replayed<Dim> replayed = replay(scene, other.stage);
  if (!fits(replayed.model, other.state)) throw BeginError("has other blocks than this scene");
  other.ends = ends_wanted(scene, other);
  for (const OutputSupport<Dim>& row : output_supports<Dim>)
    if (const std::string wrong =
            row.find_again ? row.find_again(replayed.model, other.stage, other.results, other.state) : "";
        !wrong.empty())
      throw BeginError(wrong);
  take_own_strength(replayed, shared.own, other.state.schedule);
  rewrite_history(scene, replayed, shared, other.results.history);
  other.frames.clear();
  other.trial_frames.clear();
  const double interval = scene.output.frame_interval;
  other.next_frame = scene.output.any_frames() && interval > 0 ? next_multiple(other.state.schedule.time, interval) : 0;
  return other;
}

template Progress<2> begin_at_end<2>(const Prepared<2>&, Progress<2>, const SharedStages&);
template Progress<3> begin_at_end<3>(const Prepared<3>&, Progress<3>, const SharedStages&);

}  // namespace voussoir
