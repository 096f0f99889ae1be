#include "core/output/block_verdicts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/plunge_trend.hpp"
#include "core/output/paraview.hpp"
#include "text/angle.hpp"
#include "text/csv_table.hpp"

namespace voussoir {
namespace {

std::string degrees(const std::optional<double>& angle) {
  return angle ? csv_cell(to_degrees(*angle)) : "";
}

std::string round_cell(const std::vector<int>& round_of, const std::vector<int>& bodies) {
  const bool known = bodies.size() == 1 && !round_of.empty() && round_of[bodies[0]] > 0;
  return known ? fmt::format("{}", round_of[bodies[0]]) : "";
}

template <int Dim>
void add_direction(const Vector<Dim>& v, bool exists, std::vector<std::string>& cells) {
  const auto [plunge, trend] = plunge_and_trend(v);
  cells.push_back(exists ? csv_cell(plunge) : "");
  cells.push_back(exists ? csv_cell(trend) : "");
}

template <int Dim>
std::string csv_row(const Survey<Dim>& survey, const SurveyRow<Dim>& row) {
  const Verdict<Dim>& verdict = row.bolted.verdict;
  const bool moving = moves(row.kind()), single = row.cluster == 0;
  const Body<Dim>& body = survey.assembly.model.bodies[row.bodies[0]];
  const double required = survey.request.required;
  std::vector<std::string> joints, closed, forces;
  for (int k = 0; k < verdict.loaded && moving; ++k) {
    joints.push_back(survey.joint_name(row.faces[verdict.faces[k]]));
    forces.push_back(csv_cell(verdict.forces[k]));
  }
  for (const int face : row.closed_faces)
    closed.push_back(survey.joint_name(row.faces[face]));
  std::size_t parts = 0;
  for (const int b : row.bodies)
    parts += survey.assembly.model.bodies[b].parts.size();

  std::vector<std::string> cells{single ? fmt::format("{}", row.bodies[0]) : "",
                                 single ? csv_cell(body.name) : "",
                                 single ? "" : fmt::format("{}", row.cluster),
                                 fmt::format("{}", fmt::join(row.bodies, " ")),
                                 fmt::format("{}", parts),
                                 csv_cell(row.volume),
                                 csv_cell(row.weight),
                                 csv_cell(row.free_area),
                                 csv_cell(row.contact_area),
                                 word_of(row.kind()),
                                 type_of(row, required),
                                 motion_of(row),
                                 fmt::format("{}", moving ? verdict.loaded : 0),
                                 csv_cell(fmt::format("{}", fmt::join(joints, ";")))};
  const Vector<Dim> direction = moving ? verdict.direction() : Vector<Dim>::Zero();
  add_direction<Dim>(direction, moving, cells);
  for (int k = 0; k < Dim; ++k)
    cells.push_back(moving ? csv_cell(direction[k]) : "");
  const auto add = [&](const std::string& cell) { cells.push_back(cell); };
  add(csv_cell(fmt::format("{}", fmt::join(forces, ";"))));
  add(moving ? csv_cell(verdict.driving()) : "");
  add(moving ? csv_cell(verdict.friction + verdict.cohesion) : "");
  add(csv_cell(row.bolted.factor));
  add(csv_cell(verdict.factor_friction_only()));
  add(csv_cell(row.bolted.factor_passive));
  add(csv_cell(fmt::format("{}", fmt::join(row.bolts, ";"))));
  add(moving ? csv_cell(required) : "");
  add(row.force ? csv_cell(row.force->force.norm()) : "");
  add_direction<Dim>(row.force ? row.force->force : Vector<Dim>::Zero(), row.force && row.force->force.norm() > 0,
                     cells);
  add(row.force ? (row.force->least ? "1" : "0") : "");
  add(csv_cell(row.bolt_force));
  cells.push_back(row.worst.factor ? csv_cell(plunge_and_trend(row.worst.direction).second) : "");
  add(csv_cell(row.worst.factor));
  add(csv_cell(row.factor_own_trend));
  add(csv_cell(row.critical_coefficient));
  add(csv_cell(row.critical_own_trend));
  add(csv_cell(row.critical_water));
  add(csv_cell(row.critical_level));
  add(degrees(row.opening));
  add(row.opening ? csv_cell(survey.joint_name(row.faces[row.opening_face])) : "");
  add(csv_cell(fmt::format("{}", fmt::join(closed, ";"))));
  add(row.eccentricity && std::isinf(*row.eccentricity) ? "inf" : csv_cell(row.eccentricity));
  add(row.factor_moments && std::isinf(*row.factor_moments) ? "inf" : csv_cell(row.factor_moments));
  add(degrees(row.taper));
  add(round_cell(survey.below_one.round_of, row.bodies));
  add(round_cell(survey.frictionless.round_of, row.bodies));
  add(verdict.indeterminate ? "1" : "0");
  return fmt::format("{}\n", fmt::join(cells, ","));
}

template <int Dim>
std::string csv_header() {
  const char* directions = Dim == 3 ? "direction_x,direction_y,direction_z" : "direction_x,direction_y";
  const char* sizes = Dim == 3 ? "volume_m3,weight_N,free_area_m2,contact_area_m2"
                               : "area_m2,weight_N_per_m,free_length_m,contact_length_m";
  return fmt::format(
      "body,name,cluster,blocks,parts,{},verdict,type,motion,faces,joints,plunge_deg,trend_deg,{},"
      "normal_force_N,driving_N,resisting_N,factor,factor_friction_only,factor_passive,bolts,required,force_N,"
      "force_plunge_deg,force_trend_deg,force_is_least,bolt_force_N,worst_trend_deg,factor_worst,factor_own_trend,"
      "critical_coefficient,critical_coefficient_own_trend,critical_water,critical_level_m,opening_deg,opening_joint,"
      "closed_by_elastic_shear,pressure_eccentricity,factor_moments,taper_deg,round_below_1,round_moves,"
      "indeterminate\n",
      sizes, directions);
}

// by body: its row, or none
template <int Dim>
std::vector<const SurveyRow<Dim>*> rows_by_body(const Survey<Dim>& survey) {
  std::vector<const SurveyRow<Dim>*> rows(survey.assembly.model.bodies.size(), nullptr);
  for (const SurveyRow<Dim>& row : survey.rows)
    rows[row.bodies[0]] = &row;
  return rows;
}

constexpr BlockKind fixed_kind = BlockKind::undecided;  // of bodies without a row

}  // namespace

template <int Dim>
std::vector<double> normal_forces(const SurveyRow<Dim>& row) {
  std::vector<double> forces(row.faces.size(), 0);
  for (int k = 0; k < row.bolted.verdict.loaded && !row.faces.empty(); ++k)
    forces[row.bolted.verdict.faces[k]] = row.bolted.verdict.forces[k];
  return forces;
}

template <int Dim>
std::vector<std::string> loaded_joints(const Survey<Dim>& survey, const SurveyRow<Dim>& row) {
  std::vector<std::string> joints;
  for (int k = 0; k < row.bolted.verdict.loaded; ++k) {
    const std::string name = survey.joint_name(row.faces[row.bolted.verdict.faces[k]]);
    if (std::find(joints.begin(), joints.end(), name) == joints.end()) joints.push_back(name);
  }
  std::sort(joints.begin(), joints.end());
  return joints;
}

template <int Dim>
std::string blocks_csv(const Survey<Dim>& survey) {
  std::string table = csv_header<Dim>();
  for (const SurveyRow<Dim>& row : survey.rows)
    table += csv_row(survey, row);
  for (const SurveyRow<Dim>& row : survey.clusters)
    table += csv_row(survey, row);
  return table;
}

template <int Dim>
bool is_key(const Survey<Dim>& survey, const SurveyRow<Dim>& row) {
  return moves(row.kind()) && *row.bolted.factor < survey.request.required;
}

template <int Dim>
std::set<int> key_blocks(const Survey<Dim>& survey) {
  std::set<int> bodies;
  for (const auto* list : {&survey.rows, &survey.clusters})
    for (const SurveyRow<Dim>& row : *list)
      if (is_key(survey, row)) bodies.insert(row.bodies.begin(), row.bodies.end());
  return bodies;
}

template <int Dim>
PolyData block_verdict_faces(const Survey<Dim>& survey) {
  const Model<Dim>& model = survey.assembly.model;
  PolyData data = block_faces(model, initial_state<Dim>(model), 0, survey.sets);
  const auto body = std::find_if(data.cell_data.begin(), data.cell_data.end(),
                                 [](const DataArray& array) { return array.name == "body"; });
  const std::vector<const SurveyRow<Dim>*> rows = rows_by_body(survey);
  DataArray verdict{"verdict", 1, true, {}}, moving{"moves", 1, true, {}}, factor{"factor", 1, false, {}},
      direction{"direction", 3, false, {}}, cluster{"cluster", 1, true, {}}, round{"round_below_1", 1, true, {}},
      eccentricity{"pressure_eccentricity", 1, false, {}};
  std::vector<int> cluster_of(model.bodies.size(), 0);
  for (auto row = survey.clusters.rbegin(); row != survey.clusters.rend(); ++row)
    for (const int b : row->bodies)
      cluster_of[b] = row->cluster;
  for (const double place : body->values) {
    const auto b = static_cast<std::size_t>(place);
    const SurveyRow<Dim>* row = rows[b];
    const bool goes = row && moves(row->kind());
    verdict.values.push_back(static_cast<int>(row ? row->kind() : fixed_kind));
    moving.values.push_back(goes);
    factor.values.push_back(goes ? *row->bolted.factor : 0);
    const Vector<Dim> along = goes ? row->bolted.verdict.direction() : Vector<Dim>::Zero();
    for (int k = 0; k < 3; ++k)
      direction.values.push_back(k < Dim ? along[k] : 0);
    cluster.values.push_back(cluster_of[b]);
    round.values.push_back(survey.below_one.round_of[b]);
    eccentricity.values.push_back(goes ? row->eccentricity.value_or(0) : 0);
  }
  for (DataArray* array : {&verdict, &moving, &factor, &direction, &cluster, &round, &eccentricity})
    data.cell_data.push_back(std::move(*array));
  std::vector<std::string> words;
  for (int kind = 0; kind < static_cast<int>(fixed_kind); ++kind)
    words.emplace_back(word_of(static_cast<BlockKind>(kind)));
  words.emplace_back("fixed or undecided");
  data.names.emplace_back("verdict_names", words);
  return data;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                  \
  template std::vector<double> normal_forces<Dim>(const SurveyRow<Dim>&);                          \
  template std::vector<std::string> loaded_joints<Dim>(const Survey<Dim>&, const SurveyRow<Dim>&); \
  template std::string blocks_csv<Dim>(const Survey<Dim>&);                                        \
  template PolyData block_verdict_faces<Dim>(const Survey<Dim>&);                                  \
  template bool is_key<Dim>(const Survey<Dim>&, const SurveyRow<Dim>&);                            \
  template std::set<int> key_blocks<Dim>(const Survey<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
