#include "core/output/lining_output.hpp"

#include <algorithm>
#include <cmath>

#include "core/output/drawn_points.hpp"
#include "text/csv_table.hpp"

namespace voussoir {

template <int Dim>
void add_lining_rows(const Model<Dim>& model, const State<Dim>& state, int stage, Results& results) {
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
        results.linings.push_back(row);
      }
    }
}

template <int Dim>
std::string find_linings_again(const Model<Dim>& model, int stages, const Results& results, State<Dim>& state) {
  std::vector<std::string> names;
  for (const LiningRow& row : results.linings)
    if (row.stage == stages && std::ranges::find(names, row.lining) == names.end()) names.push_back(row.lining);
  if (names.size() != state.supports.linings.size()) return "lists other linings than it contains";
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found =
        std::ranges::find_if(model.linings, [&](const Lining& l) { return l.properties.name == names[i]; });
    if (found == model.linings.end()) return "contains a lining that this scene does not have";
    state.supports.linings[i].lining = static_cast<int>(found - model.linings.begin());
  }
  return {};
}

std::string lining_csv(const Results& results) {
  if (results.linings.empty()) return {};
  std::string text = csv_line({"stage", "lining", "node", "x_m", "y_m", "ux_m", "uy_m", "thrust_N", "shear_N",
                               "moment_Nm", "smoothed_moment_Nm", "pressure_Pa", "shear_stress_Pa", "body", "use"}) +
                     "\n";
  for (const LiningRow& r : results.linings) {
    std::vector<std::string> cells{std::to_string(r.stage), r.lining, std::to_string(r.node)};
    for (const double x : {r.x, r.y, r.ux, r.uy, r.forces.thrust, r.forces.shear, r.forces.moment})
      cells.push_back(csv_cell(x));
    cells.push_back(r.smoothed_moment ? csv_cell(*r.smoothed_moment) : "");
    cells.push_back(csv_cell(r.pressure));
    cells.push_back(csv_cell(r.shear));
    cells.push_back(r.rock < 0 ? "" : std::to_string(r.rock));
    cells.push_back(r.use ? csv_cell(*r.use) : "");
    text += csv_line(cells) + "\n";
  }
  return text;
}

namespace {

PolyData beam_lines(const Model<2>& model, const State<2>& state, double time) {
  PolyData data;
  data.kind = PolyData::Cells::lines;
  data.time = time;
  DataArray linings{"lining", 1, true, {}}, node{"node", 1, true, {}}, displacement{"displacement", 3, false, {}},
      thrust{"thrust_N", 1, false, {}}, shear{"shear_N", 1, false, {}}, moment{"moment_Nm", 1, false, {}},
      pressure{"pressure_Pa", 1, false, {}}, use{"use", 1, false, {}};
  std::vector<std::string> names;
  for (const Lining& lining : model.linings)
    names.push_back(lining.properties.name);
  for (const LiningState& lined : state.supports.linings) {
    const Lining& lining = model.linings[lined.lining];
    const int first = static_cast<int>(data.points.size());
    const std::vector<SectionForces> forces = forces_at_nodes(lining, forces_of_beams(lining, state.bodies));
    for (std::size_t i = 0; i < lining.nodes.size(); ++i) {
      const LiningNode& at = lining.nodes[i];
      const Vector<2>& moved = state.bodies.motions[lining.first_body + i].displacement;
      data.points.push_back(in_space(Vector<2>(model.origin + at.place + moved)));
      append<2>(displacement, moved);
      linings.values.push_back(lined.lining);
      node.values.push_back(static_cast<double>(i + 1));
      thrust.values.push_back(forces[i].thrust);
      shear.values.push_back(forces[i].shear);
      moment.values.push_back(forces[i].moment);
      pressure.values.push_back((lined.contacts[2 * i].normal + lined.contacts[2 * i + 1].normal) /
                                (at.half_length[0] + at.half_length[1]));
      use.values.push_back(use_of(lining.properties, forces[i]).value_or(0));
    }
    for (int k = 0; k < lining.beams(); ++k)
      data.cells.push_back({first + k, first + lining.next(k)});
  }
  data.point_data = {linings, node, displacement, thrust, shear, moment, pressure, use};
  data.names = {{"lining_names", names}};
  return data;
}

}  // namespace

template <int Dim>
PolyData lining_lines(const Model<Dim>& model, const State<Dim>& state, double time) {
  if constexpr (Dim == 2)
    return beam_lines(model, state, time);
  else
    return {};
}

template <int Dim>
ViewLine lining_view(const Model<Dim>&, const PolyData& lines, std::size_t line) {
  const auto at_ends = [&](const char* name) {
    const std::vector<double>& values = *values_of(lines.point_data, name);
    return std::array{values[lines.cells[line][0]], values[lines.cells[line][1]]};
  };
  ViewLine view;
  view.section = std::array{at_ends("thrust_N"), at_ends("moment_Nm"), at_ends("pressure_Pa")};
  view.force = -0.5 * (view.section->at(0)[0] + view.section->at(0)[1]);
  return view;
}

void add_lining_columns(const Monitor& m, const AddColumn& add) {
  const std::string name = m.name + (m.node < 0 ? "_largest" : "");
  add(name + "_thrust", "N");
  add(name + "_shear_force", "N");
  add(name + "_moment", "Nm");
  if (m.node < 0) add(name + "_use", "1");
}

template <int Dim>
void add_lining_values(const Monitor& monitor, const Model<Dim>& model, const State<Dim>& state,
                       std::vector<double>& values) {
  SectionForces found;
  double use = 0;
  if constexpr (Dim == 2)
    if (std::ranges::count(state.supports.linings, monitor.subject, &LiningState::lining) > 0) {
      const Lining& lining = model.linings[monitor.subject];
      const std::vector<SectionForces> at_nodes = forces_at_nodes(lining, forces_of_beams(lining, state.bodies));
      if (monitor.node >= 0) found = at_nodes[monitor.node];
      for (const SectionForces& at : at_nodes) {
        use = std::max(use, use_of(lining.properties, at).value_or(0));
        if (monitor.node >= 0) continue;
        for (double SectionForces::*force : {&SectionForces::thrust, &SectionForces::shear, &SectionForces::moment})
          if (std::abs(at.*force) > std::abs(found.*force)) found.*force = at.*force;
      }
    }
  values.insert(values.end(), {found.thrust, found.shear, found.moment});
  if (monitor.node < 0) values.push_back(use);
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                    \
  template void add_lining_rows<Dim>(const Model<Dim>&, const State<Dim>&, int, Results&);           \
  template std::string find_linings_again<Dim>(const Model<Dim>&, int, const Results&, State<Dim>&); \
  template PolyData lining_lines<Dim>(const Model<Dim>&, const State<Dim>&, double);                 \
  template ViewLine lining_view<Dim>(const Model<Dim>&, const PolyData&, std::size_t);               \
  template void add_lining_values<Dim>(const Monitor&, const Model<Dim>&, const State<Dim>&, std::vector<double>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
