#include "core/run/history.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/model/water_surfaces.hpp"
#include "core/output/monitor.hpp"
#include "core/run/reduction.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

// the joint properties whose friction some stage changes: each has a column in the history
template <int Dim>
std::vector<int> properties_followed(const Prepared<Dim>& scene) {
  std::set<int> followed;
  for (const StagePlan& stage : scene.stages) {
    const std::vector<int> changed = properties_changed(scene.model, stage.change);
    followed.insert(changed.begin(), changed.end());
    if (const auto* reduction = std::get_if<ReducePlan>(&stage.plan)) {
      const std::vector<int> chosen = chosen_properties(scene.model, *reduction);
      followed.insert(chosen.begin(), chosen.end());
    }
  }
  return {followed.begin(), followed.end()};
}

// monitors of the waters that some stage changes: each has columns in the history
template <int Dim>
std::vector<Monitor> waters_followed(const Prepared<Dim>& scene) {
  std::set<int> changed;
  for (const StagePlan& stage : scene.stages)
    for (const WaterPlan& plan : stage.water)
      changed.insert(plan.water);
  std::vector<Monitor> followed;
  for (const int water : changed) {
    const Water& w = scene.model.waters[water];
    followed.push_back({"water_" + w.name, {"level", Quantity::level}, water, levels_of<Dim>(w)});
  }
  return followed;
}

// whether some stage searches a factor of safety: then the history has a column for it
template <int Dim>
bool has_factor(const Prepared<Dim>& scene) {
  return std::ranges::any_of(scene.stages, [](const StagePlan& stage) {
    const auto* reduction = std::get_if<ReducePlan>(&stage.plan);
    return reduction && reduction->searched == Searched::factor;
  });
}

// whether some stage searches by trials that are taken back: then the history has a column for them
template <int Dim>
bool has_trials(const Prepared<Dim>& scene) {
  return std::any_of(scene.stages.begin(), scene.stages.end(), [](const StagePlan& stage) {
    const auto* reduction = std::get_if<ReducePlan>(&stage.plan);
    return reduction && reduction->method != ReductionMethod::rate;
  });
}

// what divides the strength of the joint properties that are searched; the others' factor is 1
double strength_factor(const Schedule& schedule) {
  const auto searched = std::ranges::find_if(schedule.strength_factor, [](double factor) { return factor != 1; });
  return searched == schedule.strength_factor.end() ? 1 : *searched;
}

}  // namespace

template <int Dim>
std::vector<int> properties_changed(const Model<Dim>& model, const Change& change) {
  std::vector<int> changed;
  for (std::size_t p = 0; p < model.properties.size(); ++p)
    if (change.friction || std::ranges::count(change.friction_of, model.properties[p].name, &FrictionPlan::properties))
      changed.push_back(static_cast<int>(p));
  return changed;
}

template <int Dim>
std::vector<std::string> history_columns(const Prepared<Dim>& scene) {
  std::vector<std::string> columns{"time_s", "stage"};
  if (has_trials(scene)) columns.push_back("trial");
  for (const int p : properties_followed(scene))
    columns.push_back("friction_" + scene.model.properties[p].name + "_deg");
  for (const Column& c : monitor_columns<Dim>(waters_followed(scene)))
    columns.push_back(c.header());
  if (has_factor(scene)) columns.push_back("strength_factor");
  for (const Column& c : monitor_columns<Dim>(scene.monitors))
    columns.push_back(c.header());
  return columns;
}

template <int Dim>
std::vector<double> history_row(const Prepared<Dim>& scene, const Model<Dim>& model, const State<Dim>& state, int stage,
                                int trial, const std::vector<StageEnd<Dim>>& ends) {
  std::vector<double> values{state.schedule.time, static_cast<double>(stage)};
  if (has_trials(scene)) values.push_back(trial);
  for (const int p : properties_followed(scene))
    values.push_back(to_degrees(state.schedule.friction[p]));
  const auto append = [&](const std::vector<Monitor>& monitors) {
    const std::vector<double> monitored = monitor_values<Dim>(monitors, model, state, ends);
    values.insert(values.end(), monitored.begin(), monitored.end());
  };
  append(waters_followed(scene));
  if (has_factor(scene)) values.push_back(strength_factor(state.schedule));
  append(scene.monitors);
  return values;
}

namespace {

// of a bar's bond in the two blocks at a joint, m: the farthest, with its sign
template <int Dim>
double most_slip(const GroutedBolt<Dim>& grouted, int joint) {
  double most = 0;
  for (std::size_t i = 0; i < grouted.stretch.size(); ++i) {
    const bool beside = grouted.stretch[i] == joint || grouted.stretch[i] == joint + 1;
    if (beside && std::abs(grouted.state.slip[i]) > std::abs(most)) most = grouted.state.slip[i];
  }
  return most;
}

}  // namespace

template <int Dim>
std::vector<BoltRow> bolt_rows(const Model<Dim>& model, const State<Dim>& state, int stage) {
  std::vector<BoltRow> rows;
  const auto anchor = [&](int body, const Vector<Dim>& place) {
    const Motion<Dim>& m = state.bodies.motions[body];
    return Vector<Dim>(model.origin + model.bodies[body].reference + m.displacement + matrix(m.rotation) * place);
  };
  const auto row_at = [&](int of, int joint, const Vector<Dim>& at) {
    const Bolt<Dim>& bolt = model.bolts[of];
    BoltRow row{.stage = stage,
                .bolts = model.bolt_properties[bolt.properties].name,
                .bolt = bolt.number,
                .joint = joint,
                .use = {}};
    row.x = at[0];
    row.y = at[1];
    row.z = Dim == 3 ? at[Dim - 1] : 0;
    return row;
  };
  auto bar = state.supports.grouted.begin();  // that the spring is a joint of, where it is one
  for (std::size_t i = 0; i < state.supports.bolt_springs.size(); ++i) {
    const BoltSpring<Dim>& s = state.supports.bolt_springs[i];
    const BoltProperties& p = model.bolt_properties[model.bolts[s.bolt].properties];
    if (p.kind == BoltKind::grouted) {
      while (bar->first_spring + bar->joints() <= static_cast<int>(i))
        ++bar;
      if (bar->first_spring == static_cast<int>(i) && bar->bar.plate != Plate::none) {
        BoltRow row = row_at(s.bolt, 0, anchor(bar->body[0], bar->place[0]));
        row.body_a = row.body_b = bar->body[0];
        row.force = p.spacing * bar->state.plate_force;
        row.plastic = bar->state.plastic_stretch[0];
        if (p.yield) row.use = bar->state.plate_force / *p.yield;
        rows.push_back(row);
      }
    }
    BoltRow row = row_at(s.bolt, s.number, 0.5 * (anchor(s.body_a, s.place_a) + anchor(s.body_b, s.place_b)));
    row.body_a = s.body_a;
    row.body_b = s.body_b;
    row.force = p.spacing * s.force;
    row.shear = p.spacing * s.shear.norm();
    row.extension = s.extension;
    row.plastic = s.plastic;
    if (p.yield) row.use = std::abs(s.force) / *p.yield;
    row.broken = s.broken;
    if (p.kind == BoltKind::grouted) row.slip = most_slip(*bar, static_cast<int>(i) - bar->first_spring);
    rows.push_back(row);
  }
  return rows;
}

template <int Dim>
std::vector<LiningRow> lining_rows(const Model<Dim>& model, const State<Dim>& state, int stage) {
  std::vector<LiningRow> rows;
  if constexpr (Dim == 2)
    for (const LiningState& lined : state.supports.linings) {
      const Lining& lining = model.linings[lined.lining];
      const std::vector<SectionForces> forces = forces_at_nodes(lining, forces_of_beams(lining, state.bodies));
      const std::vector<double> smoothed = smoothed_moments(lining, forces);
      for (std::size_t i = 0; i < lining.nodes.size(); ++i) {
        const LiningNode& node = lining.nodes[i];
        const LiningContact &before = lined.contacts[2 * i], &after = lined.contacts[2 * i + 1];
        const Vector<2>& moved = state.bodies.motions[lining.first_body + i].displacement;
        const Vector<2> at = model.origin + node.place + moved;
        const double length = node.half_length[0] + node.half_length[1];
        const int rock = before.rock >= 0 ? before.rock : after.rock;
        LiningRow row;
        row.stage = stage;
        row.lining = lining.properties.name;
        row.node = static_cast<int>(i) + 1;
        row.x = at[0];
        row.y = at[1];
        row.ux = moved[0];
        row.uy = moved[1];
        row.forces = forces[i];
        if (!smoothed.empty()) row.smoothed_moment = smoothed[i];
        row.pressure = (before.normal + after.normal) / length;
        row.shear = (before.shear + after.shear) / length;
        row.rock = rock < 0 ? -1 : lined.rock[rock].body;
        row.use = use_of(lining.properties, forces[i]);
        rows.push_back(row);
      }
    }
  return rows;
}

template std::vector<int> properties_changed<2>(const Model<2>&, const Change&);
template std::vector<int> properties_changed<3>(const Model<3>&, const Change&);
template std::vector<std::string> history_columns<2>(const Prepared<2>&);
template std::vector<std::string> history_columns<3>(const Prepared<3>&);
template std::vector<double> history_row<2>(const Prepared<2>&, const Model<2>&, const State<2>&, int, int,
                                            const std::vector<StageEnd<2>>&);
template std::vector<double> history_row<3>(const Prepared<3>&, const Model<3>&, const State<3>&, int, int,
                                            const std::vector<StageEnd<3>>&);

template std::vector<BoltRow> bolt_rows<2>(const Model<2>&, const State<2>&, int);
template std::vector<BoltRow> bolt_rows<3>(const Model<3>&, const State<3>&, int);
template std::vector<LiningRow> lining_rows<2>(const Model<2>&, const State<2>&, int);
template std::vector<LiningRow> lining_rows<3>(const Model<3>&, const State<3>&, int);

}  // namespace voussoir
