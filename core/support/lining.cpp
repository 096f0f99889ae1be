#include "core/support/lining.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <Eigen/LU>

#include "core/joint_laws/joint_law.hpp"

namespace voussoir {
namespace {

// of a side's length: a node this near to a corner is in it
constexpr double at_corner = 1e-9;

// of their corners
Vector<2> middle_of(const std::vector<LiningSide>& sides) {
  Vector<2> middle = Vector<2>::Zero();
  for (const LiningSide& side : sides)
    middle += side.corner / static_cast<double>(sides.size());
  return middle;
}

struct OnOutline {
  Vector<2> place;
  std::array<int, 2> side;  // before it, after it
};

// the point at which a ray from inside a convex outline meets it
OnOutline on_outline(const std::vector<LiningSide>& sides, const Vector<2>& centre, double turn) {
  const Vector<2> ray(std::cos(turn), std::sin(turn));
  double nearest = std::numeric_limits<double>::infinity();
  int hit = -1;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const double rate = sides[k].normal.dot(ray);
    if (!(rate > 0)) continue;  // along the side, or away from it
    const double distance = sides[k].normal.dot(sides[k].corner - centre) / rate;
    if (!(distance < nearest)) continue;
    nearest = distance;
    hit = static_cast<int>(k);
  }
  assert(hit >= 0);
  const int count = static_cast<int>(sides.size());
  const LiningSide& side = sides[hit];
  const Vector<2> place = centre + nearest * ray;
  const double along = side.along().dot(place - side.corner);
  if (along <= at_corner * side.length) return {side.corner, {(hit + count - 1) % count, hit}};
  if (along >= (1 - at_corner) * side.length) return {sides[(hit + 1) % count].corner, {hit, (hit + 1) % count}};
  return {place, {hit, hit}};
}

// w of the least-squares parabola w x² + b x + c
double curvature_of(const std::vector<Vector<2>>& points) {
  double middle = 0;
  for (const Vector<2>& p : points)
    middle += p[0] / static_cast<double>(points.size());
  Matrix<3> normal = Matrix<3>::Zero();
  Vector<3> right = Vector<3>::Zero();
  for (const Vector<2>& p : points) {
    const double x = p[0] - middle;
    const Vector<3> row(x * x, x, 1);
    normal += row * row.transpose();
    right += p[1] * row;
  }
  return normal.fullPivLu().solve(right)[0];
}

// half of each beam's length and mass to each of its nodes; a node's inertia as that of a bar of its length
void weigh_nodes(Lining& lining) {
  const LiningProperties& p = lining.properties;
  for (int k = 0; k < lining.beams(); ++k) {
    const double length = lining.beam(k).chord.norm();
    if (!(length > 0)) throw std::invalid_argument("two nodes of a lining are in one place");
    lining.nodes[k].half_length[1] = lining.nodes[lining.next(k)].half_length[0] = 0.5 * length;
  }
  for (LiningNode& node : lining.nodes) {
    const double length = node.half_length[0] + node.half_length[1];
    node.mass = p.density * p.thickness * length;
    node.inertia = node.mass * (length * length + p.thickness * p.thickness) / 12;
  }
  const auto part_of = [&](int k) {
    const LiningNode& node = lining.nodes[k];
    const double fraction = node.half_length[0] > 0 && node.half_length[1] > 0 ? 0.5 : 1;
    return BeamInertia{fraction * node.mass, fraction * node.inertia};
  };
  for (int k = 0; k < lining.beams(); ++k) {
    const Beam beam = lining.beam(k);
    const double square =
        largest_eigenvalue_bound(beam_tangent(beam, beam_strain(beam, {}, {})), {part_of(k), part_of(lining.next(k))});
    for (const int node : {k, lining.next(k)})
      lining.nodes[node].square_frequency = std::max(lining.nodes[node].square_frequency, square);
  }
}

}  // namespace

Vector<2> LiningSide::along() const {
  return {-normal[1], normal[0]};
}

Beam Lining::beam(int k) const {
  return {nodes[next(k)].place - nodes[k].place, properties.axial(), properties.bending()};
}

Lining make_lining(const LiningProperties& properties, std::vector<LiningSide> sides, const Vector<2>& centre,
                   const std::vector<double>& turns, bool closed) {
  Lining lining{.properties = properties, .closed = closed, .sides = std::move(sides), .nodes = {}};
  for (const double turn : turns) {
    const OnOutline at = on_outline(lining.sides, centre, turn);
    lining.nodes.push_back({.place = at.place, .side = at.side});
  }
  weigh_nodes(lining);
  return lining;
}

int nearest_node(const Lining& lining, double turn) {
  const Vector<2> centre = middle_of(lining.sides), ray(std::cos(turn), std::sin(turn));
  const auto along = [&](const LiningNode& node) { return (node.place - centre).normalized().dot(ray); };
  return static_cast<int>(std::ranges::max_element(lining.nodes, {}, along) - lining.nodes.begin());
}

LiningAnswer interface_answer(const LiningJoint& joint, double length, const LiningMotion& motion,
                              LiningContact& contact) {
  const JointProperties& p = joint.properties;
  const double closed_by = motion.closure - contact.closure, slip = motion.place - contact.place;
  contact.closure = motion.closure;
  contact.place = motion.place;
  LiningAnswer answer;
  const double shear_stiffness = p.shear_stiffness * length;
  if (motion.closure < 0 && contact.bond != Bond::whole) {  // parted: the energy of the shear spring is lost
    contact.bond = Bond::lost;
    if (shear_stiffness > 0) answer.friction = 0.5 * contact.shear * contact.shear / shear_stiffness;
    contact.shear = contact.normal = contact.dashpot = 0;
    return answer;
  }

  JointState<2> history;
  history.shear_force = {0, contact.shear};
  history.plastic_slip = contact.plastic_slip;
  history.shear_stiffness = contact.shear_stiffness;
  history.bond_slip = contact.bond_slip;
  history.bond = contact.bond;
  // it is cast without stress, which a joint with tensile strength has when it is closed by its offset
  JointKinematics<2> k;
  k.normal = {1, 0};
  k.overlap = motion.closure + (p.laws.bond ? p.tension / p.normal_stiffness : 0);
  k.area = length;
  k.closing_speed = motion.seconds > 0 ? closed_by / motion.seconds : 0;
  k.slip = {0, slip};
  const JointForce<2> force = joint_law<2>(p, joint.friction, joint.dashpot, k, history, joint.strength_factor);

  answer.elastic = force.elastic;
  answer.friction = force.friction;
  if (contact.bond == Bond::whole && history.bond != Bond::whole)
    answer.friction += length * (normal_answer(p, k.overlap, true).energy - normal_answer(p, k.overlap, false).energy);
  answer.dashpots = 0.5 * (contact.dashpot + force.dashpot) * closed_by;
  contact.normal = force.force[0];
  contact.shear = history.shear_force[1];
  contact.plastic_slip = history.plastic_slip;
  contact.shear_stiffness = history.shear_stiffness;
  contact.bond_slip = history.bond_slip;
  contact.bond = history.bond;
  contact.dashpot = force.dashpot;
  return answer;
}

InterfaceSum interface_sum(const std::vector<LiningState>& linings) {
  InterfaceSum sum;
  for (const LiningState& lined : linings)
    for (const LiningContact& contact : lined.contacts) {
      if (contact.normal == 0 && contact.shear == 0) continue;
      sum.forces += std::hypot(contact.normal, contact.shear);
      ++sum.touching;
    }
  return sum;
}

std::array<SectionForces, 2> section_forces(const BeamForces& forces) {
  return {SectionForces{forces.normal_force, forces.shear_force, forces.end_moment[0]},
          SectionForces{forces.normal_force, forces.shear_force, -forces.end_moment[1]}};
}

std::vector<SectionForces> forces_at_nodes(const Lining& lining, const std::vector<BeamForces>& beams) {
  std::vector<SectionForces> at_nodes(lining.nodes.size());
  std::vector<int> count(lining.nodes.size(), 0);
  for (int k = 0; k < lining.beams(); ++k) {
    const auto ends = section_forces(beams[k]);
    for (const int end : {0, 1}) {
      const int node = end == 0 ? k : lining.next(k);
      at_nodes[node].thrust += ends[end].thrust;
      at_nodes[node].shear += ends[end].shear;
      at_nodes[node].moment += ends[end].moment;
      ++count[node];
    }
  }
  for (std::size_t i = 0; i < at_nodes.size(); ++i)
    for (double* force : {&at_nodes[i].thrust, &at_nodes[i].shear, &at_nodes[i].moment})
      *force /= count[i];
  return at_nodes;
}

// Eqs I.1-I.4: the shear of Eq. I.1 is in the waves from n = 2 on; radial pressures have no moment, so its C is 0
std::vector<double> smoothed_moments(const Lining& lining, const std::vector<SectionForces>& at_nodes) {
  const std::size_t sides = lining.sides.size();
  if (!lining.closed || sides < 5) return {};
  std::vector<std::vector<Vector<2>>> on_side(sides);  // place along it, moment
  for (std::size_t i = 0; i < at_nodes.size(); ++i) {
    const auto& [before, after] = lining.nodes[i].side;
    for (const int side : before == after ? std::vector{after} : std::vector{before, after})
      on_side[side].emplace_back(lining.sides[side].along().dot(lining.nodes[i].place - lining.sides[side].corner),
                                 at_nodes[i].moment);
  }
  const Vector<2> centre = middle_of(lining.sides);
  double radius = 0;
  for (const LiningSide& side : lining.sides)
    radius += side.normal.dot(side.corner - centre) / static_cast<double>(sides);

  // the sides' pressures, each at its middle over the angle that it covers
  struct Sector {
    double angle, width, pressure;
  };
  std::vector<Sector> sectors;
  for (std::size_t k = 0; k < sides; ++k) {
    if (on_side[k].size() < 3) return {};
    const LiningSide& side = lining.sides[k];
    const Vector<2> middle = side.corner + 0.5 * side.length * side.along() - centre;
    sectors.push_back({std::atan2(middle[1], middle[0]), 2 * std::atan2(0.5 * side.length, middle.norm()),
                       -2 * curvature_of(on_side[k])});
  }
  std::vector<double> moments(at_nodes.size(), 0);
  for (int n = 2; n <= static_cast<int>(sides / 2); ++n) {
    // at half the number of sides a cosine and its sine are one wave
    const double share = 2 * n == static_cast<int>(sides) ? 0.5 : 1;
    double cosine = 0, sine = 0;
    for (const Sector& s : sectors) {
      cosine += share * s.pressure * s.width * std::cos(n * s.angle) / std::numbers::pi;
      sine += share * s.pressure * s.width * std::sin(n * s.angle) / std::numbers::pi;
    }
    for (std::size_t i = 0; i < moments.size(); ++i) {
      const Vector<2> at = lining.nodes[i].place - centre;
      const double angle = std::atan2(at[1], at[0]);
      moments[i] += radius * radius * (cosine * std::cos(n * angle) + sine * std::sin(n * angle)) / (n * n - 1);
    }
  }
  return moments;
}

std::optional<double> use_of(const LiningProperties& p, const SectionForces& forces) {
  if (!p.compressive_strength || !p.tensile_strength) return {};
  const double thrust = forces.thrust / p.thickness,
               bending = 6 * std::abs(forces.moment) / (p.thickness * p.thickness);
  return std::max((bending + thrust) / *p.compressive_strength, (bending - thrust) / *p.tensile_strength);
}

}  // namespace voussoir
