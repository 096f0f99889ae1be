#include "core/output/bolt_output.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/output/drawn_points.hpp"
#include "text/csv_table.hpp"

namespace voussoir {
namespace {

// slip of a bar's bond in the two blocks at a joint, m: the largest, with its sign
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
void add_bolt_rows(const Model<Dim>& model, const State<Dim>& state, int stage, Results& results) {
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
  auto bar = state.supports.grouted.begin();  // the bar to which the spring belongs, if any
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
        results.bolts.push_back(row);
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
    results.bolts.push_back(row);
  }
}

template <int Dim>
std::optional<double> largest_bolt_use(const Model<Dim>& model, const State<Dim>& state) {
  Results bolts;
  add_bolt_rows(model, state, 1, bolts);
  std::optional<double> largest;
  for (const BoltRow& row : bolts.bolts)
    if (row.use && !(model.bodies[row.body_a].fixed && model.bodies[row.body_b].fixed))
      largest = std::max(largest.value_or(0), *row.use);
  return largest;
}

template <int Dim>
std::string find_bolts_again(const Model<Dim>& model, int stages, const Results& results, State<Dim>& state) {
  std::vector<const BoltRow*> last;
  for (const BoltRow& row : results.bolts)
    if (row.stage == stages && row.joint > 0) last.push_back(&row);  // not of a grouted bolt's plate
  if (last.size() != state.supports.bolt_springs.size()) return "lists other bolts than it contains";
  std::map<int, int> now;
  for (std::size_t i = 0; i < last.size(); ++i) {
    const auto is_it = [&](const Bolt<Dim>& b) {
      return model.bolt_properties[b.properties].name == last[i]->bolts && b.number == last[i]->bolt;
    };
    const auto found = std::ranges::find_if(model.bolts, is_it);
    if (found == model.bolts.end()) return "contains bolts that this scene does not have";
    now[state.supports.bolt_springs[i].bolt] = static_cast<int>(found - model.bolts.begin());
  }
  const auto renumber = [&](auto& installed) {
    for (auto& one : installed)
      if (const auto found = now.find(one.bolt); found != now.end()) one.bolt = found->second;
  };
  for (SupportsState<Dim>* supports : {&state.supports, &state.increment.base.supports}) {
    renumber(supports->bolt_springs);
    renumber(supports->grouted);
  }
  return {};
}

std::string bolts_csv(const Results& results) {
  if (results.bolts.empty()) return {};
  std::string text = csv_line({"stage", "bolts", "bolt", "joint", "x_m", "y_m", "z_m", "body_a", "body_b", "force_N",
                               "shear_N", "extension_m", "plastic_m", "use", "broken", "slip_m"}) +
                     "\n";
  for (const BoltRow& r : results.bolts) {
    std::vector<std::string> cells{std::to_string(r.stage), r.bolts, std::to_string(r.bolt), std::to_string(r.joint)};
    for (const double x : {r.x, r.y, r.z})
      cells.push_back(csv_cell(x));
    cells.push_back(std::to_string(r.body_a));
    cells.push_back(std::to_string(r.body_b));
    for (const double x : {r.force, r.shear, r.extension, r.plastic})
      cells.push_back(csv_cell(x));
    cells.push_back(r.use ? csv_cell(*r.use) : "");
    cells.push_back(r.broken ? "1" : "0");
    cells.push_back(r.slip ? csv_cell(*r.slip) : "");
    text += csv_line(cells) + "\n";
  }
  return text;
}

namespace {

template <int Dim>
Vector<Dim> place_of(const Model<Dim>& model, const State<Dim>& state, int body, const Vector<Dim>& place) {
  const Motion<Dim>& m = state.bodies.motions[body];
  return model.origin + model.bodies[body].reference + m.displacement + matrix(m.rotation) * place;
}

// The nodes of a bar, the first and last moved to collar and toe, if these still exist.
template <int Dim>
std::vector<Vector<Dim>> drawn_nodes(const Model<Dim>& model, const State<Dim>& state, const GroutedBolt<Dim>& g) {
  std::vector<Vector<Dim>> nodes;
  for (std::size_t i = 0; i < g.body.size(); ++i)
    nodes.push_back(place_of(model, state, g.body[i], g.place[i]));
  const BoltSpring<Dim>&first = state.supports.bolt_springs[g.first_spring],
        &last = state.supports.bolt_springs[g.first_spring + g.joints() - 1];
  const Vector<Dim> along = matrix(state.bodies.motions[first.body_a].rotation) * first.axis;
  const Vector<Dim> collar = place_of(model, state, first.body_a, first.begin),
                    toe = place_of(model, state, last.body_b, last.end);
  if (along.dot(nodes.front() - collar) > 0) nodes.front() = collar;
  if (along.dot(toe - nodes.back()) > 0) nodes.back() = toe;
  return nodes;
}

}  // namespace

template <int Dim>
PolyData bolt_lines(const Model<Dim>& model, const State<Dim>& state, double time) {
  PolyData data;
  data.kind = PolyData::Cells::lines;
  data.time = time;
  DataArray bolts{"bolts", 1, true, {}}, number{"bolt", 1, true, {}}, joint{"joint", 1, true, {}},
      force{"force_N", 1, false, {}}, shear{"shear_N", 1, false, {}}, plastic{"plastic_m", 1, false, {}},
      use{"use", 1, false, {}}, broken{"broken", 1, true, {}};
  const auto anchor = [&](int body, const Vector<Dim>& place) { return place_of(model, state, body, place); };
  const std::vector<BoltSpring<Dim>>& springs = state.supports.bolt_springs;
  const auto add = [&](const Vector<Dim>& begin, const Vector<Dim>& end, int of, int at_joint, double f,
                       double plastic_f) {
    const int first = static_cast<int>(data.points.size());
    data.points.push_back(in_space(begin));
    data.points.push_back(in_space(end));
    data.cells.push_back({first, first + 1});
    const Bolt<Dim>& bolt = model.bolts[of];
    const BoltProperties& p = model.bolt_properties[bolt.properties];
    bolts.values.push_back(bolt.properties);
    number.values.push_back(bolt.number);
    joint.values.push_back(at_joint);
    force.values.push_back(p.spacing * f);
    plastic.values.push_back(plastic_f);
    use.values.push_back(p.yield ? std::abs(f) / *p.yield : 0);
  };
  for (const BoltSpring<Dim>& s : springs) {
    const BoltProperties& p = model.bolt_properties[model.bolts[s.bolt].properties];
    if (p.kind == BoltKind::grouted) continue;
    add(anchor(s.body_a, s.begin), anchor(s.body_b, s.end), s.bolt, s.number, s.force, s.plastic);
    shear.values.push_back(p.spacing * s.shear.norm());
    broken.values.push_back(s.broken);
  }
  for (const GroutedBolt<Dim>& g : state.supports.grouted) {
    const std::vector<Vector<Dim>> nodes = drawn_nodes(model, state, g);
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      const int next = std::min(g.stretch[i], g.joints() - 1);
      add(nodes[i], nodes[i + 1], g.bolt, springs[g.first_spring + next].number, g.state.bar_force[i],
          g.state.plastic_stretch[i]);
      shear.values.push_back(0);
      broken.values.push_back(0);
    }
  }
  data.cell_data = {bolts, number, joint, force, shear, plastic, use, broken};
  data.names = {{"bolt_names", names_of(model.bolt_properties)}};
  return data;
}

template <int Dim>
ViewLine bolt_view(const Model<Dim>& model, const PolyData& lines, std::size_t line) {
  const auto value = [&](const char* name, std::size_t i) { return (*values_of(lines.cell_data, name))[i]; };
  const auto same_bolt = [&](std::size_t i) {
    return value("bolts", i) == value("bolts", line) && value("bolt", i) == value("bolt", line);
  };
  ViewLine view;
  view.force = value("force_N", line);
  if (model.bolt_properties[static_cast<std::size_t>(value("bolts", line))].yield) view.use = value("use", line);
  view.collar = value("joint", line) == 1 && (line == 0 || !same_bolt(line - 1));
  view.broken = value("broken", line) != 0;
  return view;
}

void add_bolt_columns(const Monitor& m, const AddColumn& add) {
  add(m.name + "_largest_force", "N");
  add(m.name + "_mean_force", "N");
  add(m.name + "_yielded", "1");
  add(m.name + "_broken", "1");
}

template <int Dim>
void add_bolt_values(const Monitor& monitor, const Model<Dim>& model, const State<Dim>& state,
                     std::vector<double>& values) {
  const int properties = monitor.subject;
  const BoltProperties& p = model.bolt_properties[properties];
  double largest = 0, sum = 0, count = 0, yielded = 0, broken = 0;
  for (const BoltSpring<Dim>& s : state.supports.bolt_springs) {
    if (model.bolts[s.bolt].properties != properties) continue;
    if (std::abs(s.force) > std::abs(largest)) largest = s.force;
    sum += s.force;
    count += 1;
    yielded += s.plastic != 0;
    broken += s.broken;
  }
  values.insert(values.end(), {p.spacing * largest, count > 0 ? p.spacing * sum / count : 0, yielded, broken});
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                  \
  template void add_bolt_rows<Dim>(const Model<Dim>&, const State<Dim>&, int, Results&);           \
  template std::optional<double> largest_bolt_use<Dim>(const Model<Dim>&, const State<Dim>&);      \
  template std::string find_bolts_again<Dim>(const Model<Dim>&, int, const Results&, State<Dim>&); \
  template PolyData bolt_lines<Dim>(const Model<Dim>&, const State<Dim>&, double);                 \
  template ViewLine bolt_view<Dim>(const Model<Dim>&, const PolyData&, std::size_t);               \
  template void add_bolt_values<Dim>(const Monitor&, const Model<Dim>&, const State<Dim>&, std::vector<double>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
