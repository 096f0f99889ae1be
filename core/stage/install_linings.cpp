#include "core/stage/install_linings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace voussoir {
namespace {

// A face belongs to a side if the angle between them is at most this, cos 20°: for polygons of at most 18 sides.
constexpr double least_cosine = 0.94;

// and if its distance is at most this, in mean lengths of a node: the rock may have moved before
constexpr double near_side = 0.5;

// of a side's length: a shorter face is a corner
constexpr double least_face = 1e-9;

double mean_length(const Lining& lining) {
  double sum = 0;
  for (const LiningNode& node : lining.nodes)
    sum += node.half_length[0] + node.half_length[1];
  return sum / static_cast<double>(lining.nodes.size());
}

// A face made by an outline, as a segment of one of the sides; zero length if it does not belong to that side.
LiningRock stretch_of(const Model<2>& model, const Motion<2>& motion, int b, const Polytope<2>& part, std::size_t face,
                      const Lining& lining, int k) {
  const LiningSide& side = lining.sides[k];
  const Body<2>& body = model.bodies[b];
  const Matrix<2> axes = matrix(motion.rotation);
  const Vector<2> centroid = body.reference + motion.displacement;
  LiningRock rock{.side = k, .body = b};
  rock.corner = axes.transpose() * (side.corner - centroid);
  rock.normal = axes.transpose() * side.normal;
  if (part.faces[face].normal.dot(rock.normal) > -least_cosine || part.loops[face].size() < 2) return rock;
  const Vector<2> a = part.vertices[part.loops[face].front()] - rock.corner,
                  b_end = part.vertices[part.loops[face].back()] - rock.corner;
  if (std::abs(rock.normal.dot(0.5 * (a + b_end))) > near_side * mean_length(lining)) return rock;
  const Vector<2> along = perpendicular(rock.normal);
  const double first = along.dot(a), last = along.dot(b_end);
  rock.from = std::max(std::min(first, last), -near_side * mean_length(lining));
  rock.to = std::min(std::max(first, last), side.length + near_side * mean_length(lining));
  return rock;
}

// distance of a point beyond the ends of a face, m
double outside_by(const LiningRock& rock, double place) {
  return std::max({0.0, rock.from - place, place - rock.to});
}

LiningState cast(const Model<2>& model, int index, State<2>& state) {
  const Lining& lining = model.linings[index];
  LiningState lined{.lining = index, .rock = rock_around(model, state, lining), .contacts = {}};
  const bool bonds = model.properties[lining.interface_properties].laws.bond;
  lined.contacts.assign(2 * lining.nodes.size(), LiningContact{.bond = bonds ? Bond::whole : Bond::lost});
  cache_poses(model, 1, state.bodies);
  for (std::size_t i = 0; i < lined.contacts.size(); ++i) {
    LiningContact& contact = lined.contacts[i];
    contact.rock = rock_opposite(lining, lined, static_cast<int>(i), state.bodies);
    if (contact.rock < 0) continue;
    const LiningRock& rock = lined.rock[contact.rock];
    const Vector<2> at = seen_from_rock(rock, lining.first_body + static_cast<int>(i / 2), state.bodies);
    contact.closure = rock.normal.dot(at);
    contact.place = perpendicular(rock.normal).dot(at);
  }
  return lined;
}

// keeps the faces for which `is_left` is true; contacts refer to their new indices
template <class IsLeft>
void keep_rock(LiningState& lined, const IsLeft& is_left) {
  std::vector<int> now(lined.rock.size(), -1);
  std::vector<LiningRock> left;
  for (std::size_t k = 0; k < lined.rock.size(); ++k) {
    if (!is_left(lined.rock[k])) continue;
    now[k] = static_cast<int>(left.size());
    left.push_back(lined.rock[k]);
  }
  for (LiningContact& contact : lined.contacts) {
    if (contact.rock >= 0) contact.rock = now[contact.rock];
    if (contact.rock < 0) contact = {.closure = contact.closure, .place = contact.place};
  }
  lined.rock = std::move(left);
}

}  // namespace

std::vector<LiningRock> rock_around(const Model<2>& model, const State<2>& state, const Lining& lining) {
  std::vector<LiningRock> found;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (!model.bodies[b].present) continue;
    for (const Polytope<2>& part : model.bodies[b].parts)
      for (std::size_t face = 0; face < part.joints.size(); ++face) {
        if (part.joints[face] == no_joint || !model.joints[part.joints[face]].holds) continue;
        for (int k = 0; k < static_cast<int>(lining.sides.size()); ++k) {
          const LiningRock rock =
              stretch_of(model, state.bodies.motions[b], static_cast<int>(b), part, face, lining, k);
          if (rock.to - rock.from > least_face * lining.sides[k].length) found.push_back(rock);
        }
      }
  }
  return found;
}

Vector<2> seen_from_rock(const LiningRock& rock, int node_body, const BodiesState<2>& bodies) {
  const CachedPose<2>&block = bodies.poses[rock.body], &node = bodies.poses[node_body];
  return block.axes.transpose() * between(block, node) - rock.corner;
}

int rock_opposite(const Lining& lining, const LiningState& lined, int half_node, const BodiesState<2>& bodies) {
  const int n = half_node / 2, half = half_node % 2;
  const LiningNode& node = lining.nodes[n];
  if (!(node.half_length[half] > 0)) return -1;
  const auto outside = [&](int k) {
    const LiningRock& rock = lined.rock[k];
    const Vector<2> at = seen_from_rock(rock, lining.first_body + n, bodies);
    return outside_by(rock, perpendicular(rock.normal).dot(at));
  };
  int found = lined.contacts[half_node].rock;
  double least = found < 0 ? std::numeric_limits<double>::infinity() : outside(found);
  for (int k = 0; least > 0 && k < static_cast<int>(lined.rock.size()); ++k) {
    if (lined.rock[k].side != node.side[half]) continue;
    const double distance = outside(k);
    if (!(distance < least)) continue;
    least = distance;
    found = k;
  }
  return least <= node.half_length[half] ? found : -1;
}

int nodes_without_rock(const LiningState& lined) {
  int count = 0;
  for (std::size_t i = 0; i < lined.contacts.size(); i += 2)
    count += lined.contacts[i].rock < 0 && lined.contacts[i + 1].rock < 0;
  return count;
}

template <int Dim>
void add_lining_nodes(Model<Dim>& model, const std::vector<std::string>& names) {
  if constexpr (Dim == 2)
    for (Lining& lining : model.linings) {
      if (std::ranges::find(names, lining.properties.name) == names.end()) continue;
      lining.first_body = static_cast<int>(model.bodies.size());
      for (const LiningNode& node : lining.nodes) {
        Body<2> body;
        body.reference = node.place;
        body.mass = node.mass;
        body.inertia[0] = node.inertia;
        body.radius = body.size = 0.5 * (node.half_length[0] + node.half_length[1]);
        body.free_translation.fill(true);
        body.free_rotation.fill(true);
        model.bodies.push_back(body);
      }
      bound_water_stiffness(model);
    }
}

template <int Dim>
std::vector<std::string> install_linings(const Model<Dim>& model, const std::vector<std::string>& names,
                                         State<Dim>& state) {
  std::vector<std::string> idle;
  if constexpr (Dim == 2) {
    add_bodies(model, state.bodies, state.contacts, state.loads, state.time_step);
    for (std::size_t i = 0; i < model.linings.size(); ++i) {
      const std::string& name = model.linings[i].properties.name;
      if (std::ranges::find(names, name) == names.end()) continue;
      state.supports.linings.push_back(cast(model, static_cast<int>(i), state));
      if (state.supports.linings.back().rock.empty()) idle.push_back(name);
    }
    std::ranges::stable_sort(state.supports.linings, {}, &LiningState::lining);
  }
  return idle;
}

std::string describe_idle_lining(const std::string& name) {
  return fmt::format(
      "no block has a face on the outline of the lining '{}', so that nothing holds it; install it after its "
      "excavation",
      name);
}

template <int Dim>
void release_linings(const Model<Dim>& model, State<Dim>& state) {
  for (LiningState& lined : state.supports.linings)
    keep_rock(lined, [&](const LiningRock& rock) { return model.bodies[rock.body].present; });
}

template <int Dim>
void carry_linings(const Model<Dim>& before, const Model<Dim>& model, const Excavated<Dim>& moved, State<Dim>& state) {
  if constexpr (Dim == 2)
    for (LiningState& lined : state.supports.linings)
      keep_rock(lined, [&](LiningRock& rock) {
        Vector<2> middle = rock.corner + 0.5 * (rock.from + rock.to) * perpendicular(rock.normal);
        if (!follow(before, model, moved, rock.body, middle)) return false;
        rock.corner -= moved.shift[rock.body];
        return true;
      });
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                            \
  template std::vector<std::string> install_linings<Dim>(const Model<Dim>&, const std::vector<std::string>&, \
                                                         State<Dim>&);                                       \
  template void add_lining_nodes<Dim>(Model<Dim>&, const std::vector<std::string>&);                         \
  template void release_linings<Dim>(const Model<Dim>&, State<Dim>&);                                        \
  template void carry_linings<Dim>(const Model<Dim>&, const Model<Dim>&, const Excavated<Dim>&, State<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
