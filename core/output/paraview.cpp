#include "core/output/paraview.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <span>

#include "core/output/atomic_file.hpp"
#include "core/output/drawn_points.hpp"
#include "core/output/support_table.hpp"
#include "core/potential/particle.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

// 3-D: the faces; 2-D: one polygon, its edges chained end to start
std::vector<std::vector<int>> polygons(const Polytope<3>& part) {
  return part.loops;
}

std::vector<std::vector<int>> polygons(const Polytope<2>& part) {
  return {boundary_ring(part)};
}

struct BlockArrays {
  DataArray body{"body", 1, true, {}}, part{"part", 1, true, {}}, joint{"joint", 1, true, {}},
      fixed{"fixed", 1, true, {}}, displacement{"displacement", 3, false, {}}, velocity{"velocity", 3, false, {}};
  DataArray point_displacement{"displacement", 3, false, {}, true}, point_velocity{"velocity", 3, false, {}, true};
};

template <int Dim>
void append_part(PolyData& data, BlockArrays& arrays, const Model<Dim>& model, const State<Dim>& state, PartId id) {
  const Body<Dim>& body = model.bodies[id.body];
  const Polytope<Dim>& part = body.parts[id.part];
  const Motion<Dim>& motion = state.bodies.motions[id.body];

  // present positions of the vertices; parts share no points, because they may separate
  const int first_point = static_cast<int>(data.points.size());
  const Matrix<Dim> turn = matrix(motion.rotation);
  const Vector<Dim> centroid = body.reference + motion.displacement;
  const Spin<Dim> spin = angular_velocity(body, motion);
  const auto add_point = [&](const Vector<Dim>& point) {
    const Vector<Dim> arm = turn * point;
    data.points.push_back(in_space(Vector<Dim>(model.origin + (centroid + arm))));
    append<Dim>(arrays.point_displacement, motion.displacement + (arm - point));
    append<Dim>(arrays.point_velocity, motion.velocity + cross(spin, arm));
  };
  std::vector<std::vector<int>> outlines;
  if (is_particle(part)) {
    outlines = part.particle->drawing.cells;
    for (const Vector<Dim>& point : part.particle->drawing.points)
      add_point(part.centre + point);
  } else {
    outlines = polygons(part);
    for (const Vector<Dim>& vertex : part.vertices)
      add_point(vertex);
  }

  for (std::size_t face = 0; face < outlines.size(); ++face) {
    if (outlines[face].size() < 3) continue;  // a plane that only touches an edge or a corner
    std::vector<int>& cell = data.cells.emplace_back(outlines[face]);
    for (int& point : cell)
      point += first_point;
    arrays.body.values.push_back(id.body);
    arrays.part.values.push_back(id.part);
    arrays.joint.values.push_back(!is_particle(part) && face < part.joints.size() ? part.joints[face] : no_joint);
    arrays.fixed.values.push_back(body.fixed);
    append<Dim>(arrays.displacement, motion.displacement);
    append<Dim>(arrays.velocity, motion.velocity);
  }
}

// of every scene
constexpr std::array kinds_of_all{"blocks", "contacts", "force_lines"};

// whether every scene has frames of this kind
bool always(const std::string& kind) {
  return std::ranges::count(kinds_of_all, kind) > 0;
}

std::vector<const char*> frame_kinds() {
  std::vector<const char*> kinds(kinds_of_all.begin(), kinds_of_all.end());
  for (const OutputSupport<2>& row : output_supports<2>)
    if (row.lines) kinds.push_back(row.frames);
  return kinds;
}

std::string frame_file(const std::string& series, const char* kind, std::size_t number) {
  return fmt::format("frames/{}{}_{:04}.vtp", series, kind, number);
}

std::string collection_file(const std::string& series, const char* kind) {
  return fmt::format("{}{}.pvd", series, kind);
}

// the number in the name of one of the series' frames
std::optional<std::size_t> frame_number(const std::string& series, const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  for (const char* kind : frame_kinds()) {
    const std::string before = series + kind + "_";
    if (!name.starts_with(before)) continue;
    std::size_t number = 0;
    std::from_chars(name.data() + before.size(), name.data() + name.size(), number);
    if (frame_file(series, kind, number) == "frames/" + name) return number;
  }
  return {};
}

// the existing files of one series, relative to the folder
std::vector<std::filesystem::path> files_of(const std::filesystem::path& folder, const std::string& series) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "frames", error))
    if (frame_number(series, entry.path())) files.push_back("frames" / entry.path().filename());
  for (const char* kind : frame_kinds()) {
    const std::filesystem::path collection = folder / collection_file(series, kind);
    if (std::filesystem::is_symlink(collection, error) || std::filesystem::exists(collection, error))
      files.push_back(collection.filename());
  }
  return files;
}

void write_collections(const FrameSeries& series) {
  for (const char* kind : frame_kinds()) {
    std::vector<TimedFile> files;
    for (std::size_t k = 0; k < series.times.size(); ++k)
      if (const std::string file = frame_file(series.name, kind, k);
          !series.lost.contains(file) && (always(kind) || std::filesystem::exists(series.folder / file)))
        files.push_back({series.times[k], file});
    if (always(kind) || !files.empty()) write_file(series.folder / collection_file(series.name, kind), pvd(files));
  }
}

}  // namespace

template <int Dim>
PolyData block_faces(const Model<Dim>& model, const State<Dim>& state, double time, const JointSets& sets) {
  PolyData data;
  data.time = time;
  BlockArrays arrays;
  for (const PartId& id : model.parts)
    if (model.bodies[id.body].present) append_part(data, arrays, model, state, id);

  // in 2-D a cell is a complete part: no single joint made it
  data.cell_data = {arrays.body, arrays.part};
  if (Dim == 3) {
    data.cell_data.push_back(arrays.joint);
    DataArray set{"set", 1, true, {}};
    for (const double joint : arrays.joint.values)
      set.values.push_back(sets.set_of(static_cast<int>(joint)));
    data.cell_data.push_back(std::move(set));
  }
  data.cell_data.insert(data.cell_data.end(), {arrays.fixed, arrays.displacement, arrays.velocity});

  // external loads on each block, by source; N
  for (const SourceRow& row : std::span(source_table).first(load_count)) {
    const std::vector<Load<Dim>>& loads = state.loads.by_source[row.source];
    if ((row.external == 0 && row.source != Source::water) || loads.empty()) continue;
    DataArray array{fmt::format("{}_N", row.name), 3, false, {}};
    for (const double body : arrays.body.values)
      append<Dim>(array, loads[static_cast<std::size_t>(body)].force);
    data.cell_data.push_back(std::move(array));
  }

  data.point_data = {arrays.point_displacement, arrays.point_velocity};
  data.names = {{"body_names", names_of(model.bodies)}};
  if (Dim == 3) {
    data.names.emplace_back("joint_names", names_of(model.joints));
    data.names.emplace_back("set_names", sets.names);
  }
  return data;
}

namespace {

// deg: between the force and the normal; 0 in tension
template <int Dim>
double mobilised_friction(const Vector<Dim>& force, const Vector<Dim>& normal, const Vector<Dim>& shear) {
  const double pressed = force.dot(normal);
  return pressed > 0 ? to_degrees(std::atan2(shear.norm(), pressed)) : 0;
}

}  // namespace

template <int Dim>
PolyData contact_points(const Model<Dim>& model, const State<Dim>& state, double time) {
  PolyData data;
  data.kind = PolyData::Cells::vertices;
  data.time = time;
  DataArray body_a{"body_a", 1, true, {}}, body_b{"body_b", 1, true, {}}, joint{"joint", 1, true, {}},
      properties{"properties", 1, true, {}}, normal{"normal", 3, false, {}}, force{"force", 3, false, {}},
      overlap{"overlap", 1, false, {}}, area{"area", 1, false, {}}, slip{"plastic_slip", 1, false, {}},
      bond{"bonded", 1, true, {}}, mobilised{"mobilised_friction_deg", 1, false, {}}, rise{"rise", 1, false, {}};
  for (std::size_t i = 0; i < state.contacts.list.size(); ++i) {
    const Contact<Dim>& contact = state.contacts.list[i];
    if (!contact.touching()) continue;
    const int a = model.parts[contact.part_a].body, b = model.parts[contact.part_b].body;

    // the contact's geometry is relative to the centroid of its first body
    const Vector<Dim> centroid = model.bodies[a].reference + state.bodies.motions[a].displacement;
    const auto add = [&](const Vector<Dim>& point, const Vector<Dim>& carried, double closed, double wide,
                         const JointState<Dim>& history, std::size_t place) {
      data.cells.push_back({static_cast<int>(data.points.size())});
      data.points.push_back(in_space(Vector<Dim>(model.origin + (centroid + point))));
      body_a.values.push_back(a);
      body_b.values.push_back(b);
      joint.values.push_back(contact.joint);
      properties.values.push_back(contact.properties);
      append<Dim>(normal, contact.geometry.normal);
      append<Dim>(force, carried);
      overlap.values.push_back(closed);
      area.values.push_back(wide);
      slip.values.push_back(history.plastic_slip);
      bond.values.push_back(static_cast<int>(history.bond));
      mobilised.values.push_back(mobilised_friction<Dim>(carried, contact.geometry.normal, history.shear_force));
      if (const auto rises = rises_of(state.contacts, i); !rises.empty()) rise.values.push_back(rises[place].rise);
    };
    if (contact.cells == 0)
      add(contact.geometry.point, contact.force, contact.geometry.overlap, contact.geometry.area, contact.history, 0);
    const std::span<const SubContact<Dim>> cells = subs_of(state.contacts, i);
    for (std::size_t k = 0; k < cells.size(); ++k)
      if (const SubContact<Dim>& s = cells[k]; s.area > 0) add(s.point, s.force, s.overlap, s.area, s.history, k);
  }
  data.point_data = {body_a, body_b, joint, properties, normal, force, overlap, area, slip, bond, mobilised};
  if (!state.contacts.rises.empty()) data.point_data.push_back(rise);
  data.names = {{"joint_names", names_of(model.joints)}, {"property_names", names_of(model.properties)}};
  return data;
}

template <int Dim>
PolyData force_lines(const Model<Dim>& model, const State<Dim>& state, double time) {
  struct ForceLine {
    Vector<Dim> force = Vector<Dim>::Zero();
    double normal = 0, shear = 0;
    int contacts = 0;
  };
  std::map<std::pair<int, int>, ForceLine> pairs;
  for (const Contact<Dim>& contact : state.contacts.list) {
    if (!contact.touching()) continue;
    ForceLine& carried = pairs[{model.parts[contact.part_a].body, model.parts[contact.part_b].body}];
    const double normal = contact.force.dot(contact.geometry.normal);
    carried.force += contact.force;
    carried.normal += normal;
    carried.shear += (contact.force - normal * contact.geometry.normal).norm();
    ++carried.contacts;
  }

  PolyData data;
  data.kind = PolyData::Cells::lines;
  data.time = time;
  DataArray body_a{"body_a", 1, true, {}}, body_b{"body_b", 1, true, {}}, contacts{"contacts", 1, true, {}},
      force{"force", 3, false, {}, true}, normal{"normal_N", 1, false, {}, true}, shear{"shear_N", 1, false, {}, true},
      magnitude{"magnitude_N", 1, false, {}, true};
  for (const auto& [bodies, carried] : pairs) {
    const int first = static_cast<int>(data.points.size());
    data.cells.push_back({first, first + 1});
    // separate points for each line: a tube's radius is that of its points
    for (const int body : {bodies.first, bodies.second}) {
      data.points.push_back(in_space(
          Vector<Dim>(model.origin + (model.bodies[body].reference + state.bodies.motions[body].displacement))));
      magnitude.values.push_back(carried.force.norm());
    }
    body_a.values.push_back(bodies.first);
    body_b.values.push_back(bodies.second);
    contacts.values.push_back(carried.contacts);
    append<Dim>(force, carried.force);
    normal.values.push_back(carried.normal);
    shear.values.push_back(carried.shear);
  }
  data.point_data = {magnitude};
  data.cell_data = {body_a, body_b, contacts, force, normal, shear};
  return data;
}

std::vector<std::filesystem::path> series_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files = files_of(folder, {}), trials = files_of(folder, trial_series);
  files.insert(files.end(), trials.begin(), trials.end());
  std::sort(files.begin(), files.end());
  return files;
}

FrameSeries cut_back(const std::filesystem::path& folder, const std::vector<double>& times, const std::string& name) {
  FrameSeries series{folder, times, name};
  for (const std::filesystem::path& file : files_of(folder, name)) {
    const std::optional<std::size_t> number = frame_number(name, file);
    if (number ? *number >= times.size() : times.empty()) remove_file(folder / file);
  }
  if (times.empty()) return series;
  prepare_folder(folder / "frames");
  for (const char* kind : frame_kinds())
    for (std::size_t k = 0; k < times.size(); ++k)
      if (const std::string file = frame_file(name, kind, k); always(kind) && !std::filesystem::exists(folder / file))
        series.lost.insert(file);
  write_collections(series);
  return series;
}

template <int Dim>
void write_frame(FrameSeries& series, const Model<Dim>& model, const State<Dim>& state, double time) {
  if (series.times.empty()) prepare_folder(series.folder / "frames");
  const std::size_t frame = series.times.size();
  write_file(series.folder / frame_file(series.name, "blocks", frame),
             vtp(block_faces(model, state, time, series.sets)));
  write_file(series.folder / frame_file(series.name, "contacts", frame), vtp(contact_points(model, state, time)));
  write_file(series.folder / frame_file(series.name, "force_lines", frame), vtp(force_lines(model, state, time)));
  for (const OutputSupport<Dim>& row : output_supports<Dim>)
    if (row.lines && row.has(model))
      write_file(series.folder / frame_file(series.name, row.frames, frame), vtp(row.lines(model, state, time)));
  series.times.push_back(time);
  write_collections(series);  // last: they never name a missing file
}

template PolyData block_faces<2>(const Model<2>&, const State<2>&, double, const JointSets&);
template PolyData block_faces<3>(const Model<3>&, const State<3>&, double, const JointSets&);
template PolyData force_lines<2>(const Model<2>&, const State<2>&, double);
template PolyData force_lines<3>(const Model<3>&, const State<3>&, double);
template PolyData contact_points<2>(const Model<2>&, const State<2>&, double);
template PolyData contact_points<3>(const Model<3>&, const State<3>&, double);
template void write_frame<2>(FrameSeries&, const Model<2>&, const State<2>&, double);
template void write_frame<3>(FrameSeries&, const Model<3>&, const State<3>&, double);

}  // namespace voussoir
