#include "core/install.hpp"

#include <algorithm>
#include <cmath>

namespace voussoir {
namespace {

// anchors this many diameters from the joint: Boon (2013), section 5.1
constexpr double offset_in_diameters = 1.2;

// of a bolt's length: what it has less of in a block is a corner that it grazes
constexpr double least_chord = 1e-9;

// where a bolt lies in a block, m from its collar
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

// where the bolt lies in the parts of a body, which may hang together
template <int Dim>
void add_chords(const Model<Dim>& model, const State<Dim>& state, int b, const Line<Dim>& line,
                std::vector<Chord>& chords) {
  const Body<Dim>& body = model.bodies[b];
  const Motion<Dim>& motion = state.motions[b];
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

template <int Dim>
Vector<Dim> in_body(const Model<Dim>& model, const State<Dim>& state, int body, const Vector<Dim>& point) {
  const Motion<Dim>& motion = state.motions[body];
  return matrix(motion.rotation).transpose() * (point - model.bodies[body].reference - motion.displacement);
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
    spring.axis = matrix(state.motions[body_a].rotation).transpose() * line.along;
    spring.length = at_b - at_a;
    spring.stiffness = stiffness;
    springs.push_back(spring);
  };
  if (p.kind == BoltKind::end_anchored) {
    if (chords.size() > 1 && chords.front().body != chords.back().body) {
      const double begin = chords.front().begin, end = chords.back().end;
      add(chords.front().body, begin, chords.back().body, end, p.axial_stiffness / (end - begin));
    }
    return springs;
  }
  for (std::size_t k = 1; k < chords.size(); ++k) {
    const Chord &a = chords[k - 1], &b = chords[k];
    if (a.body == b.body) continue;
    const double joint = 0.5 * (a.end + b.begin);
    add(a.body, joint - anchor_of(p, a), b.body, joint + anchor_of(p, b), p.stiffness);
  }
  return springs;
}

template <int Dim>
bool shortened(const Model<Dim>& model, const BoltSpring<Dim>& spring) {
  constexpr double rounding = 1e-9;
  const BoltProperties& p = model.bolt_properties[model.bolts[spring.bolt].properties];
  return p.kind == BoltKind::springs && p.anchors == BoltAnchors::offset &&
         spring.length < 2 * offset_in_diameters * p.diameter * (1 - rounding);
}

template <int Dim>
bool ends_in_rock(const Model<Dim>& model, const State<Dim>& state, int bolt) {
  const Line<Dim> line(model.bolts[bolt]);
  const std::vector<Chord> chords = chords_of(model, state, line);
  return !chords.empty() && chords.back().end >= (1 - least_chord) * line.length;
}

template <int Dim>
std::vector<std::string> install(const Model<Dim>& model, const std::vector<std::string>& names, State<Dim>& state) {
  std::vector<std::string> idle;
  for (const BoltProperties& p : model.bolt_properties)
    if (std::ranges::find(names, p.name) != names.end()) idle.push_back(p.name);
  for (std::size_t i = 0; i < model.bolts.size(); ++i) {
    const std::string& name = model.bolt_properties[model.bolts[i].properties].name;
    if (std::ranges::find(names, name) == names.end()) continue;
    for (const BoltSpring<Dim>& spring : springs_of(model, state, static_cast<int>(i))) {
      state.bolt_springs.push_back(spring);
      std::erase(idle, name);
    }
  }
  std::ranges::stable_sort(state.bolt_springs, {}, &BoltSpring<Dim>::bolt);
  return idle;
}

template <int Dim>
void remove_springs(const Model<Dim>& model, State<Dim>& state) {
  std::erase_if(state.bolt_springs, [&](const BoltSpring<Dim>& spring) {
    return !model.bodies[spring.body_a].present || !model.bodies[spring.body_b].present;
  });
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                                  \
  template std::vector<BoltSpring<Dim>> springs_of<Dim>(const Model<Dim>&, const State<Dim>&, int);                \
  template bool ends_in_rock<Dim>(const Model<Dim>&, const State<Dim>&, int);                                      \
  template bool shortened<Dim>(const Model<Dim>&, const BoltSpring<Dim>&);                                         \
  template std::vector<std::string> install<Dim>(const Model<Dim>&, const std::vector<std::string>&, State<Dim>&); \
  template void remove_springs<Dim>(const Model<Dim>&, State<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
