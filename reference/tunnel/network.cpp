#include "reference/tunnel/network.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace voussoir::reference::network {
namespace {

// A pivot of the stiffness, scaled to a unit diagonal. Singular ones are rounding, some 1e-15 times the square root of
// the blocks; a cantilever of a thousand blocks, the softest structure that makes sense, has 1e-9.
constexpr double least_pivot = 1e-12;

constexpr int largest_row = 6;

[[noreturn]] void refuse_network(const std::string& message) {
  throw std::invalid_argument("network: " + message);
}

bool is_stiffness(double value) {
  return std::isfinite(value) && value >= 0;
}

bool is_unit(const Point& direction) {
  constexpr double of_unit_length = 1e-9;
  return std::abs(std::hypot(direction[0], direction[1]) - 1) < of_unit_length;
}

Point turned(const Point& a) {
  return {-a[1], a[0]};
}

// A generalised extension e = sum of coefficient times freedom; its force is stiffness·e + start, on the freedoms minus
// the coefficients times that. Everything in the network is a row of this kind.
struct Row {
  std::array<int, largest_row> freedom{};
  std::array<double, largest_row> coefficient{};
  int count = 0;
  double stiffness = 0, start = 0;

  void add(int at, double value) {
    freedom[count] = at;
    coefficient[count++] = value;
  }
  double extension(const std::vector<double>& moved) const {
    double sum = 0;
    for (int i = 0; i < count; ++i)
      sum += coefficient[i] * moved[freedom[i]];
    return sum;
  }
  double force(const std::vector<double>& moved) const { return stiffness * extension(moved) + start; }
};

// area, and first moments about `origin`
std::array<double, 3> moments(const Block& block, const Point& origin) {
  std::array<double, 3> sum{};
  for (const Polygon& part : block.parts)
    for (std::size_t i = 0; i < part.size(); ++i) {
      const Point a = minus(part[i], origin), b = minus(part[(i + 1) % part.size()], origin);
      const double twice = cross(a, b);
      sum[0] += twice / 2;
      for (int k = 0; k < 2; ++k)
        sum[k + 1] += twice / 6 * (a[k] + b[k]);
    }
  return sum;
}

struct Assembly {
  const Network& network;
  std::vector<Point> centre;  // of the blocks
  std::vector<Row> rows;      // springs: normal, shear, couple; bolts: axial, across; ties: normal, shear; beams: three

  int blocks() const { return static_cast<int>(network.blocks.size()); }
  int bodies() const { return blocks() + static_cast<int>(network.lining.nodes.size()); }
  int beams() const {
    const int nodes = static_cast<int>(network.lining.nodes.size());
    return nodes == 0 ? 0 : network.lining.closed ? nodes : nodes - 1;
  }

  // the displacement along `direction` of a block's point, times `sign`
  void add_block(Row& row, int block, const Point& at, const Point& direction, double sign) const {
    row.add(3 * block, sign * direction[0]);
    row.add(3 * block + 1, sign * direction[1]);
    row.add(3 * block + 2, sign * cross(minus(at, centre[block]), direction));
  }
  Row between(int first, const Point& at_first, int second, const Point& at_second, const Point& direction) const {
    Row row;
    add_block(row, first, at_first, direction, -1);
    add_block(row, second, at_second, direction, 1);
    return row;
  }
};

void check_block(const Block& block, int i) {
  const std::string name = "block " + std::to_string(i);
  if (block.parts.empty()) refuse_network(name + " has no parts");
  for (const Polygon& part : block.parts) {
    if (part.size() < 3) refuse_network(name + " has a part of fewer than three corners");
    for (const Point& corner : part)
      if (!std::isfinite(corner[0]) || !std::isfinite(corner[1]))
        refuse_network(name + " has a corner that is not finite");
    if (!(area(Block{{part}}) > 0))
      refuse_network(name + " has a part without area; give its corners counter-clockwise");
  }
  for (int k = 0; k < 3; ++k)
    if (!std::isfinite(block.load[k]) || !std::isfinite(block.imposed[k]))
      refuse_network(name + " has a load or displacement that is not finite");
}

void check_pair(const Network& network, int first, int second, const std::string& name) {
  const int count = static_cast<int>(network.blocks.size());
  if (first < 0 || second < 0 || first >= count || second >= count || first == second)
    refuse_network(name + " must lie between two different blocks of 0 to " + std::to_string(count - 1));
}

void check(const Network& network) {
  for (std::size_t i = 0; i < network.blocks.size(); ++i)
    check_block(network.blocks[i], static_cast<int>(i));
  for (std::size_t i = 0; i < network.springs.size(); ++i) {
    const Spring& s = network.springs[i];
    const std::string name = "spring " + std::to_string(i);
    check_pair(network, s.first, s.second, name);
    if (!is_unit(s.normal)) refuse_network(name + " needs a unit normal");
    if (!(std::isfinite(s.length) && s.length > 0)) refuse_network(name + " needs a positive length, in m");
    if (!is_stiffness(s.normal_stiffness) || !is_stiffness(s.shear_stiffness) || !is_stiffness(s.spread))
      refuse_network(name + " must have stiffnesses and a spread that are not negative");
  }
  for (std::size_t i = 0; i < network.bolts.size(); ++i) {
    const Bolt& b = network.bolts[i];
    const std::string name = "bolt " + std::to_string(i);
    check_pair(network, b.first, b.second, name);
    if (!is_unit(b.axis)) refuse_network(name + " needs a unit axis");
    if (!is_stiffness(b.stiffness) || !is_stiffness(b.across) || !std::isfinite(b.pretension))
      refuse_network(name + " must have stiffnesses that are not negative, and a finite pretension");
  }
}

void check(const Lining& lining, int blocks) {
  if (lining.nodes.empty()) {
    if (!lining.ties.empty()) refuse_network("ties without nodes of a lining");
    return;
  }
  const int count = static_cast<int>(lining.nodes.size());
  if (count < (lining.closed ? 3 : 2)) refuse_network("a lining needs two nodes, a closed one three");
  if (!(lining.axial > 0 && lining.bending > 0) || !std::isfinite(lining.axial) || !std::isfinite(lining.bending))
    refuse_network("a lining needs positive stiffnesses EA and EI");
  double twice_area = 0;
  for (int i = 0; i < count; ++i) {
    const Node& node = lining.nodes[i];
    for (int k = 0; k < 3; ++k)
      if (!std::isfinite(node.load[k]) || !std::isfinite(node.imposed[k]))
        refuse_network("node " + std::to_string(i) + " has a load or displacement that is not finite");
    twice_area += cross(node.at, lining.nodes[(i + 1) % count].at);
  }
  if (lining.closed && !(twice_area > 0)) refuse_network("nodes of a closed lining run counter-clockwise");
  for (std::size_t i = 0; i < lining.ties.size(); ++i) {
    const Tie& tie = lining.ties[i];
    const std::string name = "tie " + std::to_string(i);
    if (tie.node < 0 || tie.node >= count) refuse_network(name + " names a node that does not exist");
    if (tie.block < 0 || tie.block >= blocks) refuse_network(name + " names a block that does not exist");
    if (!is_unit(tie.normal)) refuse_network(name + " needs a unit normal");
    if (!(std::isfinite(tie.length) && tie.length > 0)) refuse_network(name + " needs a positive length, in m");
    if (!is_stiffness(tie.normal_stiffness) || !is_stiffness(tie.shear_stiffness))
      refuse_network(name + " must have stiffnesses that are not negative");
  }
}

void add_joints(Assembly& a) {
  for (const Spring& s : a.network.springs) {
    Row normal = a.between(s.first, s.at, s.second, s.at, s.normal);
    normal.stiffness = s.normal_stiffness * s.length;
    Row shear = a.between(s.first, s.at, s.second, s.at, turned(s.normal));
    shear.stiffness = s.shear_stiffness * s.length;
    Row couple;
    couple.add(3 * s.first + 2, -1);
    couple.add(3 * s.second + 2, 1);
    couple.stiffness = s.normal_stiffness * s.length * s.spread;
    a.rows.insert(a.rows.end(), {normal, shear, couple});
  }
  for (const Bolt& b : a.network.bolts) {
    Row axial = a.between(b.first, b.first_anchor, b.second, b.second_anchor, b.axis);
    axial.stiffness = b.stiffness;
    axial.start = b.pretension - b.stiffness * b.installed[0];
    Row across = a.between(b.first, b.second_anchor, b.second, b.second_anchor, turned(b.axis));
    across.stiffness = b.across;
    across.start = -b.across * b.installed[1];
    a.rows.insert(a.rows.end(), {axial, across});
  }
}

void add_ties(Assembly& a) {
  const Lining& lining = a.network.lining;
  for (const Tie& tie : lining.ties)
    for (const bool along : {false, true}) {
      const Point direction = along ? turned(tie.normal) : tie.normal;
      Row row;
      a.add_block(row, tie.block, lining.nodes[tie.node].at, direction, -1);
      row.add(3 * (a.blocks() + tie.node), direction[0]);
      row.add(3 * (a.blocks() + tie.node) + 1, direction[1]);
      row.stiffness = (along ? tie.shear_stiffness : tie.normal_stiffness) * tie.length;
      row.start = -row.stiffness * tie.installed[along];
      a.rows.push_back(row);
    }
}

// Three modes of a beam, with w the displacement across to the left: stretching; opposite turns of the ends, e = t2 -
// t1, EI/l; equal turns, e = t1 + t2 - 2 (w2 - w1)/l, 3 EI/l. Together M = (EI/l)(4 t1 + 2 t2 - 6 w/l), and the others
// alike.
void add_beams(Assembly& a) {
  const Lining& lining = a.network.lining;
  const int count = static_cast<int>(lining.nodes.size());
  for (int i = 0; i < a.beams(); ++i) {
    const int first = 3 * (a.blocks() + i), second = 3 * (a.blocks() + (i + 1) % count);
    const Point chord = minus(lining.nodes[(i + 1) % count].at, lining.nodes[i].at);
    const double length = std::hypot(chord[0], chord[1]);
    if (!(std::isfinite(length) && length > 0)) refuse_network("beam " + std::to_string(i) + " has no length");
    const Point along{chord[0] / length, chord[1] / length}, left = turned(along);
    Row stretch, opposite, alike;
    for (int k = 0; k < 2; ++k) {
      stretch.add(first + k, -along[k]);
      stretch.add(second + k, along[k]);
      alike.add(first + k, 2 * left[k] / length);
      alike.add(second + k, -2 * left[k] / length);
    }
    opposite.add(first + 2, -1);
    opposite.add(second + 2, 1);
    alike.add(first + 2, 1);
    alike.add(second + 2, 1);
    stretch.stiffness = lining.axial / length;
    opposite.stiffness = lining.bending / length;
    alike.stiffness = 3 * lining.bending / length;
    a.rows.insert(a.rows.end(), {stretch, opposite, alike});
  }
}

std::string name_of(const Assembly& a, int freedom) {
  const int body = freedom / 3;
  const std::string name = body < a.blocks() ? "block " + std::to_string(body)
                                             : "node " + std::to_string(body - a.blocks()) + " of the lining";
  static constexpr std::array ways{"moving in x", "moving in y", "turning"};
  return name + " is loose, " + ways[static_cast<std::size_t>(freedom % 3)];
}

// bodies that no chain of springs joins to one that is held
void refuse_loose(const Assembly& a, const std::vector<char>& held) {
  std::vector<int> leader(static_cast<std::size_t>(a.bodies()));
  for (int i = 0; i < a.bodies(); ++i)
    leader[i] = i;
  const auto find = [&](int i) {
    while (leader[i] != i)
      i = leader[i] = leader[leader[i]];
    return i;
  };
  for (const Row& row : a.rows)
    if (row.stiffness > 0)
      for (int i = 1; i < row.count; ++i)
        leader[find(row.freedom[i] / 3)] = find(row.freedom[0] / 3);
  std::vector<char> anchored(leader.size(), 0);
  for (int i = 0; i < 3 * a.bodies(); ++i)
    if (held[i]) anchored[find(i / 3)] = 1;
  for (int i = 0; i < a.bodies(); ++i)
    if (!anchored[find(i)])
      refuse_network(name_of(a, 3 * i) + ": neither it nor any body joined to it by springs is held");
}

// The free freedoms from K u = f, scaled to a unit diagonal.
void find_displacements(const Assembly& a, const std::vector<char>& held, const std::vector<double>& force,
                        std::vector<double>& moved) {
  std::vector<int> number(held.size(), -1), freedom;
  for (std::size_t i = 0; i < held.size(); ++i)
    if (!held[i]) {
      number[i] = static_cast<int>(freedom.size());
      freedom.push_back(static_cast<int>(i));
    }
  if (freedom.empty()) return;
  const auto count = static_cast<Eigen::Index>(freedom.size());
  Eigen::VectorXd right(count), scale = Eigen::VectorXd::Zero(count);
  for (Eigen::Index i = 0; i < count; ++i)
    right[i] = force[freedom[i]];
  std::vector<Eigen::Triplet<double>> entries;
  for (const Row& row : a.rows) {
    const double start = row.force(moved);  // of held freedoms, and pretension
    for (int i = 0; i < row.count; ++i) {
      const int p = number[row.freedom[i]];
      if (p < 0) continue;
      right[p] -= row.coefficient[i] * start;
      scale[p] += row.stiffness * row.coefficient[i] * row.coefficient[i];
      for (int k = 0; k < row.count; ++k)
        if (const int q = number[row.freedom[k]]; q >= 0 && q <= p)
          entries.emplace_back(p, q, row.stiffness * row.coefficient[i] * row.coefficient[k]);
    }
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    if (!(scale[i] > 0)) refuse_network(name_of(a, freedom[i]) + ": no spring holds it");
    scale[i] = 1 / std::sqrt(scale[i]);
  }
  Eigen::SparseMatrix<double> stiffness(count, count);
  stiffness.setFromTriplets(entries.begin(), entries.end());
  stiffness = scale.asDiagonal() * stiffness * scale.asDiagonal();
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(stiffness);
  const Eigen::VectorXd pivots = factors.vectorD();
  for (Eigen::Index i = 0; i < count; ++i)
    if (!(pivots[i] > least_pivot))
      refuse_network(name_of(a, freedom[factors.permutationPinv().indices()[i]]) +
                     ": its springs leave it a mechanism");
  const Eigen::VectorXd solved = scale.cwiseProduct(factors.solve(scale.cwiseProduct(right)));
  for (Eigen::Index i = 0; i < count; ++i)
    moved[freedom[i]] = solved[i];
}

double unbalanced(const Assembly& a, const std::vector<char>& held, const std::vector<double>& force,
                  const std::vector<double>& moved) {
  std::vector<double> left = force, largest(force.size());
  for (std::size_t i = 0; i < force.size(); ++i)
    largest[i] = std::abs(force[i]);
  for (const Row& row : a.rows)
    for (int i = 0; i < row.count; ++i) {
      const double part = row.coefficient[i] * row.force(moved);
      left[row.freedom[i]] -= part;
      largest[row.freedom[i]] = std::max(largest[row.freedom[i]], std::abs(part));
    }
  double most = 0, scale = 0;
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (!held[i]) most = std::max(most, std::abs(left[i]));
    scale = std::max(scale, largest[i]);
  }
  return scale > 0 ? most / scale : 0;
}

void read_forces(const Assembly& a, const std::vector<double>& moved, Solution& solution) {
  std::size_t next = 0;
  const auto force = [&] { return a.rows[next++].force(moved); };
  for (SpringForce& s : solution.springs) {
    s.normal = -force();
    s.shear = -force();
    s.couple = -force();
  }
  for (BoltForce& b : solution.bolts) {
    b.axial = force();
    b.across = -force();
  }
  for (SpringForce& t : solution.ties) {
    t.normal = -force();
    t.shear = -force();
  }
  const std::vector<Node>& nodes = a.network.lining.nodes;
  for (std::size_t i = 0; i < solution.beams.size(); ++i) {
    BeamForce& beam = solution.beams[i];
    const Point chord = minus(nodes[(i + 1) % nodes.size()].at, nodes[i].at);
    beam.thrust = -force();
    // A couple that turns the start counter-clockwise stretches the left side there, one at the end the right side.
    const double opposite = force(), alike = force();
    beam.start_moment = alike - opposite;
    beam.end_moment = -alike - opposite;
    beam.shear = -2 * alike / std::hypot(chord[0], chord[1]);
  }
}

}  // namespace

double area(const Block& block) {
  return block.parts.empty() || block.parts[0].empty() ? 0 : moments(block, block.parts[0][0])[0];
}

Point centroid(const Block& block) {
  if (!(area(block) > 0)) refuse_network("a block without area has no centroid; give its corners counter-clockwise");
  const Point origin = block.parts[0][0];
  const std::array<double, 3> sum = moments(block, origin);
  return {origin[0] + sum[1] / sum[0], origin[1] + sum[2] / sum[0]};
}

void add_force(Block& block, const Point& at, const Point& force) {
  const Point arm = minus(at, centroid(block));
  block.load[0] += force[0];
  block.load[1] += force[1];
  block.load[2] += cross(arm, force);
}

Point displacement(const Network& network, const Solution& solution, int block, const Point& at) {
  const Freedoms& moved = solution.blocks[block];
  const Point arm = minus(at, centroid(network.blocks[block]));
  return {moved[0] - moved[2] * arm[1], moved[1] + moved[2] * arm[0]};
}

void install(Network& network, const Solution& before) {
  if (before.blocks.size() != network.blocks.size())
    refuse_network("supports are installed after a solution of the same blocks");
  for (Bolt& bolt : network.bolts) {
    const Point toe = displacement(network, before, bolt.second, bolt.second_anchor);
    const Point collar = displacement(network, before, bolt.first, bolt.first_anchor);
    const Point beside = displacement(network, before, bolt.first, bolt.second_anchor);
    bolt.installed = {dot(bolt.axis, minus(toe, collar)), dot(turned(bolt.axis), minus(toe, beside))};
  }
  for (Tie& tie : network.lining.ties) {
    const Point wall = displacement(network, before, tie.block, network.lining.nodes[tie.node].at);
    tie.installed = {-dot(wall, tie.normal), -dot(wall, turned(tie.normal))};
  }
}

Solution solve(const Network& network) {
  check(network);
  check(network.lining, static_cast<int>(network.blocks.size()));
  Assembly a{network, {}, {}};
  for (const Block& block : network.blocks)
    a.centre.push_back(centroid(block));
  add_joints(a);
  add_ties(a);
  add_beams(a);

  std::vector<char> held;
  std::vector<double> force, moved;
  const auto lay_out = [&](const auto& body) {
    for (int k = 0; k < 3; ++k) {
      held.push_back(body.held[k]);
      moved.push_back(body.held[k] ? body.imposed[k] : 0);
      force.push_back(body.load[k]);
    }
  };
  for (const Block& block : network.blocks)
    lay_out(block);
  for (const Node& node : network.lining.nodes)
    lay_out(node);
  refuse_loose(a, held);
  find_displacements(a, held, force, moved);

  Solution solution;
  for (int i = 0; i < a.bodies(); ++i)
    (i < a.blocks() ? solution.blocks : solution.nodes).push_back({moved[3 * i], moved[3 * i + 1], moved[3 * i + 2]});
  solution.springs.resize(network.springs.size());
  solution.bolts.resize(network.bolts.size());
  solution.ties.resize(network.lining.ties.size());
  solution.beams.resize(static_cast<std::size_t>(a.beams()));
  read_forces(a, moved, solution);
  solution.unbalanced = unbalanced(a, held, force, moved);
  return solution;
}

}  // namespace voussoir::reference::network
