#include "core/stage/install_bolts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace voussoir {
namespace {

// anchors this many diameters from the joint: Boon (2013), section 5.1
constexpr double offset_in_diameters = 1.2;

// fraction of a bolt's length: a shorter length in a block is a grazed corner
constexpr double least_chord = 1e-9;

// interval of a bolt in a block, m from its collar
struct Chord {
  int body;
  double begin, end;
  double middle() const { return 0.5 * (begin + end); }
};

template <int Dim>
struct Line {
  Vector<Dim> collar, along;  // m, unit
  double length;
  explicit Line(const Bolt<Dim>& bolt) : collar(bolt.collar), along(bolt.toe - bolt.collar), length(along.norm()) {
    along /= length;
  }
};

// intervals of the bolt in the parts of a body, which may be adjacent
template <int Dim>
void add_chords(const Model<Dim>& model, const State<Dim>& state, int b, const Line<Dim>& line,
                std::vector<Chord>& chords) {
  const Body<Dim>& body = model.bodies[b];
  const Motion<Dim>& motion = state.bodies.motions[b];
  const Vector<Dim> from_collar = body.reference + motion.displacement - line.collar;
  const double nearest = std::clamp(from_collar.dot(line.along), 0.0, line.length);
  if ((from_collar - nearest * line.along).norm() > body.radius) return;
  const Matrix<Dim> axes = matrix(motion.rotation);
  const Vector<Dim> start = -(axes.transpose() * from_collar), way = axes.transpose() * line.along;
  std::vector<Chord> own;
  for (const Polytope<Dim>& part : body.parts) {
    Chord chord{b, 0, line.length};
    for (const HalfSpace<Dim>& face : part.faces) {
      const double outside = signed_distance<Dim>(face, start), rate = face.normal.dot(way);
      if (rate > 0)
        chord.end = std::min(chord.end, -outside / rate);
      else if (rate < 0)
        chord.begin = std::max(chord.begin, -outside / rate);
      else if (outside > 0)
        chord.end = chord.begin;
    }
    if (chord.end - chord.begin > least_chord * line.length) own.push_back(chord);
  }
  std::ranges::sort(own, {}, &Chord::begin);
  for (const Chord& chord : own) {
    const bool hangs_on =
        !chords.empty() && chords.back().body == b && chord.begin - chords.back().end <= least_chord * line.length;
    if (hangs_on)
      chords.back().end = std::max(chords.back().end, chord.end);
    else
      chords.push_back(chord);
  }
}

template <int Dim>
std::vector<Chord> chords_of(const Model<Dim>& model, const State<Dim>& state, const Line<Dim>& line) {
  std::vector<Chord> chords;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (model.bodies[b].present) add_chords(model, state, static_cast<int>(b), line, chords);
  std::ranges::stable_sort(chords, {}, &Chord::middle);
  return chords;
}

// m from the joint
double anchor_of(const BoltProperties& p, const Chord& chord) {
  const double middle = 0.5 * (chord.end - chord.begin);
  if (p.anchors == BoltAnchors::at_joint) return 0;
  return p.anchors == BoltAnchors::midway ? middle : std::min(offset_in_diameters * p.diameter, middle);
}

// GroutedBolt::first_spring: both lists are in the order of the bolts
template <int Dim>
void find_first_springs(State<Dim>& state) {
  int first = 0;
  for (GroutedBolt<Dim>& g : state.supports.grouted) {
    while (state.supports.bolt_springs[first].bolt != g.bolt)
      ++first;
    g.first_spring = first;
    first += g.joints();
  }
}

template <int Dim>
Vector<Dim> in_body(const Model<Dim>& model, const State<Dim>& state, int body, const Vector<Dim>& point) {
  const Motion<Dim>& motion = state.bodies.motions[body];
  return matrix(motion.rotation).transpose() * (point - model.bodies[body].reference - motion.displacement);
}

// The length of the bolt that each spring represents: from collar to toe without gaps, divided midway between joints, m
// from the collar.
template <int Dim>
void share_out(const Model<Dim>& model, const State<Dim>& state, const Line<Dim>& line,
               const std::vector<double>& joints, std::vector<BoltSpring<Dim>>& springs) {
  for (std::size_t k = 0; k < springs.size(); ++k) {
    BoltSpring<Dim>& s = springs[k];
    const double begin = k == 0 ? 0 : 0.5 * (joints[k - 1] + joints[k]);
    const double end = k + 1 == springs.size() ? line.length : 0.5 * (joints[k] + joints[k + 1]);
    s.begin = in_body<Dim>(model, state, s.body_a, line.collar + begin * line.along);
    s.end = in_body<Dim>(model, state, s.body_b, line.collar + end * line.along);
  }
}

// positions that separate the cells of a bar's nodes, m from its start, ascending: joints, edges of air, the end of the
// free length
std::vector<double> breaks_of(const std::vector<Chord>& chords, double free_length, double spacing) {
  const double begin = chords.front().begin, length = chords.back().end - begin;
  std::vector<double> at{free_length};
  for (std::size_t k = 1; k < chords.size(); ++k) {
    const double from = chords[k - 1].end - begin, to = chords[k].begin - begin;
    if (to - from > spacing)
      at.insert(at.end(), {from, to});
    else
      at.push_back(0.5 * (from + to));
  }
  std::ranges::sort(at);
  std::vector<double> breaks;
  double last = 0;
  for (const double s : at) {
    if (s - last <= least_chord * length || length - s <= least_chord * length) continue;
    breaks.push_back(last = s);
  }
  return breaks;
}

GroutedBar bar_with(const BoltProperties& p) {
  GroutedBar bar;
  bar.axial_stiffness = p.axial_stiffness;
  if (p.yield) bar.yield_force = *p.yield;
  bar.bond_stiffness = p.bond_stiffness;
  if (p.bond_strength) bar.bond_strength = *p.bond_strength;
  bar.plate = p.plate;
  bar.plate_stiffness = p.plate_stiffness;
  return bar;
}

// whether a point along the bolt is in rock, or in a gap too narrow to matter
bool in_rock(const std::vector<Chord>& chords, double at, double spacing) {
  for (std::size_t k = 1; k < chords.size(); ++k)
    if (at > chords[k - 1].end && at < chords[k].begin) return chords[k].begin - chords[k - 1].end <= spacing;
  return true;
}

void check_pretension(const BoltProperties& p, const std::string& bolt, const GroutedBar& bar) {
  const double grout = std::accumulate(bar.bond_length.begin(), bar.bond_length.end(), 0.0);
  const double holds = grout > 0 ? bar.bond_strength * grout : 0;
  // without grout only the plate holds the bar, which cannot be tightened
  if (p.pretension > 0 && p.pretension >= holds)
    throw std::invalid_argument(bolt + " cannot take its pretension: of its grout " + std::to_string(grout) +
                                " m are in rock, with a strength of " + std::to_string(p.spacing * holds) +
                                " N; lower pretension, or lengthen the bolt");
}

}  // namespace

template <int Dim>
std::vector<BoltSpring<Dim>> springs_of(const Model<Dim>& model, const State<Dim>& state, int bolt) {
  const BoltProperties& p = model.bolt_properties[model.bolts[bolt].properties];
  const Line<Dim> line(model.bolts[bolt]);
  const std::vector<Chord> chords = chords_of(model, state, line);
  std::vector<BoltSpring<Dim>> springs;
  const auto add = [&](int body_a, double at_a, int body_b, double at_b, double stiffness) {
    BoltSpring<Dim> spring;
    spring.bolt = bolt;
    spring.number = static_cast<int>(springs.size()) + 1;
    spring.body_a = body_a;
    spring.body_b = body_b;
    spring.place_a = in_body<Dim>(model, state, body_a, line.collar + at_a * line.along);
    spring.place_b = in_body<Dim>(model, state, body_b, line.collar + at_b * line.along);
    spring.axis = matrix(state.bodies.motions[body_a].rotation).transpose() * line.along;
    spring.length = at_b - at_a;
    spring.stiffness = stiffness;
    springs.push_back(spring);
  };
  std::vector<double> joints;
  if (p.kind == BoltKind::end_anchored) {
    if (chords.size() > 1 && chords.front().body != chords.back().body) {
      const double begin = chords.front().begin, end = chords.back().end;
      add(chords.front().body, begin, chords.back().body, end, p.axial_stiffness / (end - begin));
    }
    share_out(model, state, line, joints, springs);
    return springs;
  }
  for (std::size_t k = 1; k < chords.size(); ++k) {
    const Chord &a = chords[k - 1], &b = chords[k];
    if (a.body == b.body) continue;
    const double joint = 0.5 * (a.end + b.begin);
    add(a.body, joint - anchor_of(p, a), b.body, joint + anchor_of(p, b), p.stiffness);
    joints.push_back(joint);
  }
  share_out(model, state, line, joints, springs);
  return springs;
}

template <int Dim>
std::optional<GroutedBolt<Dim>> bar_of(const Model<Dim>& model, const State<Dim>& state, int bolt,
                                       const std::vector<BoltSpring<Dim>>& springs) {
  const BoltProperties& p = model.bolt_properties[model.bolts[bolt].properties];
  if (p.kind != BoltKind::grouted || springs.empty()) return std::nullopt;
  const Line<Dim> line(model.bolts[bolt]);
  const std::vector<Chord> chords = chords_of(model, state, line);
  const double begin = chords.front().begin, length = chords.back().end - begin;
  const double spacing = node_spacing(p, line.length);

  GroutedBolt<Dim> g;
  g.bolt = bolt;
  g.bar = bar_with(p);
  lay_nodes(length, breaks_of(chords, p.free_length, spacing), spacing, g.bar);
  std::vector<double> joints;
  for (std::size_t k = 1; k < chords.size(); ++k)
    if (chords[k - 1].body != chords[k].body) joints.push_back(0.5 * (chords[k - 1].end + chords[k].begin));
  for (std::size_t i = 0; i < g.bar.position.size(); ++i) {
    const double at = begin + g.bar.position[i];
    if (g.bar.position[i] < p.free_length || !in_rock(chords, at, spacing)) g.bar.bond_length[i] = 0;
    const auto before = std::ranges::lower_bound(joints, at) - joints.begin();
    g.stretch.push_back(static_cast<int>(before));
    g.body.push_back(before == 0 ? springs.front().body_a : springs[before - 1].body_b);
    g.place.push_back(in_body<Dim>(model, state, g.body.back(), line.collar + at * line.along));
  }
  if (!is_held(g.bar)) return std::nullopt;
  check_pretension(p, "bolt " + std::to_string(model.bolts[bolt].number) + " of '" + p.name + "'", g.bar);
  GroutWorkspace workspace;
  g.state = installed(g.bar, std::vector<double>(g.bar.position.size(), 0.0));
  if (p.pretension > 0) tighten(g.bar, p.pretension, g.state, workspace);
  bound_stiffness(g, workspace);
  return g;
}

template <int Dim>
bool shortened(const Model<Dim>& model, const BoltSpring<Dim>& spring) {
  constexpr double rounding = 1e-9;
  const BoltProperties& p = model.bolt_properties[model.bolts[spring.bolt].properties];
  return p.kind != BoltKind::end_anchored && p.anchors == BoltAnchors::offset &&
         spring.length < 2 * offset_in_diameters * p.diameter * (1 - rounding);
}

template <int Dim>
bool ends_in_rock(const Model<Dim>& model, const State<Dim>& state, int bolt) {
  const Line<Dim> line(model.bolts[bolt]);
  const std::vector<Chord> chords = chords_of(model, state, line);
  return !chords.empty() && chords.back().end >= (1 - least_chord) * line.length;
}

template <int Dim>
std::vector<std::string> install_bolts(const Model<Dim>& model, const std::vector<std::string>& names,
                                       State<Dim>& state) {
  std::vector<std::string> idle;
  for (const BoltProperties& p : model.bolt_properties)
    if (std::ranges::find(names, p.name) != names.end()) idle.push_back(p.name);
  for (std::size_t i = 0; i < model.bolts.size(); ++i) {
    const std::string& name = model.bolt_properties[model.bolts[i].properties].name;
    if (std::ranges::find(names, name) == names.end()) continue;
    const std::vector<BoltSpring<Dim>> springs = springs_of(model, state, static_cast<int>(i));
    if (std::optional<GroutedBolt<Dim>> bar = bar_of(model, state, static_cast<int>(i), springs))
      state.supports.grouted.push_back(std::move(*bar));
    else if (model.bolt_properties[model.bolts[i].properties].kind == BoltKind::grouted)
      continue;
    state.supports.bolt_springs.insert(state.supports.bolt_springs.end(), springs.begin(), springs.end());
    if (!springs.empty()) std::erase(idle, name);
  }
  std::ranges::stable_sort(state.supports.bolt_springs, {}, &BoltSpring<Dim>::bolt);
  std::ranges::stable_sort(state.supports.grouted, {}, &GroutedBolt<Dim>::bolt);
  find_first_springs(state);
  return idle;
}

namespace {

// Whether the rock at both anchors remains, to which the spring is then attached; an end whose rock is excavated is
// drawn at its anchor.
template <int Dim>
bool follow_spring(const std::function<bool(int& body, Vector<Dim>& place)>& is_left, BoltSpring<Dim>& s) {
  const auto follow_end = [&](int was, int body, const Vector<Dim>& anchor, Vector<Dim>& end) {
    if (!is_left(was, end) || was != body) end = anchor;
  };
  const int a = s.body_a, b = s.body_b;
  if (!is_left(s.body_a, s.place_a) || !is_left(s.body_b, s.place_b)) return false;
  follow_end(a, s.body_a, s.place_a, s.begin);
  follow_end(b, s.body_b, s.place_b, s.end);
  return true;
}

// The remaining pieces of a bar, and its joints, are appended to the lists.
template <int Dim>
void cut_bar(const std::function<bool(int& body, Vector<Dim>& place)>& is_left, GroutedBolt<Dim> g,
             std::vector<BoltSpring<Dim>> joints, std::vector<GroutedBolt<Dim>>& bars,
             std::vector<BoltSpring<Dim>>& springs) {
  const std::size_t nodes = g.body.size();
  std::vector<char> node_left(nodes), joint_left(joints.size());
  for (std::size_t i = 0; i < nodes; ++i)
    node_left[i] = is_left(g.body[i], g.place[i]);
  for (std::size_t j = 0; j < joints.size(); ++j)
    joint_left[j] = follow_spring(is_left, joints[j]);
  const auto holds_on = [&](std::size_t i) {  // node i to the next
    if (i + 1 == nodes || !node_left[i] || !node_left[i + 1]) return false;
    return g.stretch[i] == g.stretch[i + 1] ? g.body[i] == g.body[i + 1] : joint_left[g.stretch[i]] != 0;
  };
  GroutWorkspace workspace;
  std::size_t first = 0;
  for (std::size_t i = 0; i < nodes; ++i) {
    if (holds_on(i)) continue;
    const std::size_t from = std::exchange(first, i + 1);
    if (g.stretch[from] == g.stretch[i]) continue;
    const bool whole = from == 0 && i + 1 == nodes;
    GroutedBolt<Dim> piece = whole ? g : piece_of(g, static_cast<int>(from), static_cast<int>(i + 1), workspace);
    if (!is_held(piece.bar)) continue;
    piece.first_spring = static_cast<int>(springs.size());
    springs.insert(springs.end(), joints.begin() + g.stretch[from], joints.begin() + g.stretch[i]);
    bars.push_back(std::move(piece));
  }
}

}  // namespace

template <int Dim>
void cut_bolts(const std::function<bool(int& body, Vector<Dim>& place)>& is_left, State<Dim>& state) {
  std::vector<BoltSpring<Dim>> springs;
  std::vector<GroutedBolt<Dim>> bars;
  auto bar = state.supports.grouted.begin();
  for (auto s = state.supports.bolt_springs.begin(); s != state.supports.bolt_springs.end();) {
    if (bar != state.supports.grouted.end() && bar->first_spring == s - state.supports.bolt_springs.begin()) {
      const auto end = s + bar->joints();
      cut_bar<Dim>(is_left, *bar, {s, end}, bars, springs);
      s = end;
      ++bar;
    } else {
      if (follow_spring(is_left, *s)) springs.push_back(*s);
      ++s;
    }
  }
  state.supports.bolt_springs = std::move(springs);
  state.supports.grouted = std::move(bars);
}

template <int Dim>
void carry_bolts(const Model<Dim>& before, const Model<Dim>& model, const Excavated<Dim>& moved, State<Dim>& state) {
  if (state.supports.bolt_springs.empty()) return;
  const auto is_left = [&](int& body, Vector<Dim>& place) { return follow(before, model, moved, body, place); };
  cut_bolts<Dim>(is_left, state);
}

std::string describe_idle_bolts(const std::string& name) {
  return fmt::format(
      "the bolts '{}' cross no joint between two blocks and have no effect; lengthen or move them, or install them "
      "before their blocks are "
      "excavated",
      name);
}

template <int Dim>
void remove_springs(const Model<Dim>& model, State<Dim>& state) {
  cut_bolts<Dim>([&](int& body, Vector<Dim>&) { return model.bodies[body].present; }, state);
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                           \
  template std::vector<BoltSpring<Dim>> springs_of<Dim>(const Model<Dim>&, const State<Dim>&, int);         \
  template std::optional<GroutedBolt<Dim>> bar_of<Dim>(const Model<Dim>&, const State<Dim>&, int,           \
                                                       const std::vector<BoltSpring<Dim>>&);                \
  template void cut_bolts<Dim>(const std::function<bool(int&, Vector<Dim>&)>&, State<Dim>&);                \
  template bool ends_in_rock<Dim>(const Model<Dim>&, const State<Dim>&, int);                               \
  template bool shortened<Dim>(const Model<Dim>&, const BoltSpring<Dim>&);                                  \
  template std::vector<std::string> install_bolts<Dim>(const Model<Dim>&, const std::vector<std::string>&,  \
                                                       State<Dim>&);                                        \
  template void carry_bolts<Dim>(const Model<Dim>&, const Model<Dim>&, const Excavated<Dim>&, State<Dim>&); \
  template void remove_springs<Dim>(const Model<Dim>&, State<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
