#include "reference/slump/elastoplastic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

namespace voussoir::reference {
namespace {

// a trial is in equilibrium when no block's residual force exceeds this fraction of the mean weight
constexpr double balanced = 1e-7;
// it has collapsed when a corner has moved by this many times the elastic displacement under the whole height's weight
constexpr double far_away = 30;
// of one trial: hundreds of times the number that trials far from the critical angle take; a slide whose forces are
// nearly in balance, 2e-6 of the mean weight, takes six million
constexpr int most_sweeps = 20'000'000;
constexpr double mass_reserve = 1.1;  // above the bound on the stiffest mode: slip and gaps never stiffen a spring

struct Point {
  double x = 0, y = 0;
};

// motion, force, mass of a block: x, y and the angle times `arm`
using Freedoms = std::array<double, 3>;

struct SlopeBlock {
  int layer = 0, row = 0;
  std::vector<Point> corners;
  Point centroid;
  double area = 0;
};

// how a spring's closure or slip follows from the motion of a block (-1: the fixed rock)
struct Lever {
  int block = -1;
  Freedoms normal{}, tangent{};
};

// an end of an interface: the spring between two blocks, from `a` to `b`
struct End {
  Lever a, b;
  double length = 0;  // half of the interface's
  double slip_force = 0;
};

struct Assembly {
  std::vector<SlopeBlock> blocks;
  std::vector<End> ends;
  std::vector<Freedoms> displacement, velocity, mass;
  double arm = 1;  // m: makes an angle a length
  double weight_of_unit = 0, kn = 0, ks = 0;
};

void find_centroid(SlopeBlock& block) {
  double area = 0, x = 0, y = 0;
  const Point& o = block.corners[0];
  for (std::size_t i = 1; i + 1 < block.corners.size(); ++i) {
    const Point &p = block.corners[i], &q = block.corners[i + 1];
    const double part = 0.5 * ((p.x - o.x) * (q.y - o.y) - (q.x - o.x) * (p.y - o.y));
    area += part;
    x += part * (o.x + p.x + q.x) / 3;
    y += part * (o.y + p.y + q.y) / 3;
  }
  block.area = area;
  block.centroid = {x / area, y / area};
}

// Oblique coordinates: u along the base into the slope, v up along the layers.
struct Grid {
  const LayeredSlope& slope;
  double across = std::sin(slope.dip + slope.base_dip);

  Point node(int layer, int row) const {
    const double u = layer * slope.thickness / across, v = row * slope.spacing / across;
    return {u * std::cos(slope.base_dip) + v * std::cos(slope.dip),
            -u * std::sin(slope.base_dip) + v * std::sin(slope.dip)};
  }
  // part of the cell above and behind it is in the slope
  bool is_block(int layer, int row) const {
    return layer < slope.layers && row >= 0 && std::min(node(layer, row).y, node(layer + 1, row).y) < slope.height;
  }
};

// the part of a convex line of points below the top; a line is closed when it has more than two
std::vector<Point> below_top(const std::vector<Point>& line, double top) {
  std::vector<Point> kept;
  const std::size_t sides = line.size() > 2 ? line.size() : line.size() - 1;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Point &p = line[i], &q = line[(i + 1) % line.size()];
    if (p.y <= top) kept.push_back(p);
    if (i >= sides || (p.y < top) == (q.y < top) || p.y == top || q.y == top) continue;
    const double share = (top - p.y) / (q.y - p.y);
    kept.push_back({p.x + share * (q.x - p.x), top});
  }
  return kept;
}

Point along(const Point& normal) {
  return {-normal.y, normal.x};
}

// the displacement of a place by a block's freedoms
Lever lever(const Assembly& assembly, int block, const Point& place, const Point& normal) {
  if (block < 0) return {};
  const Point &c = assembly.blocks[block].centroid, tangent = along(normal);
  const auto towards = [&](const Point& direction) {
    const double turning = (place.x - c.x) * direction.y - (place.y - c.y) * direction.x;
    return Freedoms{direction.x, direction.y, turning / assembly.arm};
  };
  return {block, towards(normal), towards(tangent)};
}

void add_interface(Assembly& assembly, int a, int b, const std::vector<Point>& line, const Point& normal) {
  if (line.size() < 2) return;
  const double half = 0.5 * std::hypot(line[1].x - line[0].x, line[1].y - line[0].y);
  for (const Point& place : line)
    assembly.ends.push_back({lever(assembly, a, place, normal), lever(assembly, b, place, normal), half, 0});
}

Assembly build(const LayeredSlope& slope) {
  Assembly assembly;
  assembly.arm = 0.5 * std::max(slope.thickness, slope.spacing);
  assembly.weight_of_unit = slope.density * slope.gravity;
  assembly.kn = slope.normal_stiffness;
  assembly.ks = slope.shear_stiffness;
  const Grid grid{slope};
  std::map<std::pair<int, int>, int> ids;  // by layer and row; the fixed rock has none
  for (int layer = 0; layer < slope.layers; ++layer)
    for (int row = 0; grid.is_block(layer, row); ++row) {
      const std::vector<Point> cell{grid.node(layer, row), grid.node(layer + 1, row), grid.node(layer + 1, row + 1),
                                    grid.node(layer, row + 1)};
      SlopeBlock block{layer, row, below_top(cell, slope.height), {}, 0};
      find_centroid(block);
      ids[{layer, row}] = static_cast<int>(assembly.blocks.size());
      assembly.blocks.push_back(block);
    }
  const auto id = [&](int layer, int row) {
    const auto found = ids.find({layer, row});
    return found == ids.end() ? -1 : found->second;
  };
  const Point up{std::sin(slope.base_dip), std::cos(slope.base_dip)};  // across the base
  const Point out{-std::sin(slope.dip), std::cos(slope.dip)};          // across the layers
  for (const SlopeBlock& block : assembly.blocks) {
    const int layer = block.layer, row = block.row;
    const Point low_right = grid.node(layer + 1, row);
    add_interface(assembly, id(layer, row - 1), id(layer, row),
                  below_top({grid.node(layer, row), low_right}, slope.height), up);
    add_interface(assembly, id(layer + 1, row), id(layer, row),
                  below_top({low_right, grid.node(layer + 1, row + 1)}, slope.height), out);
  }
  const std::size_t count = assembly.blocks.size();
  assembly.displacement.assign(count, {});
  assembly.velocity.assign(count, {});
  assembly.mass.assign(count, {});
  return assembly;
}

// Masses for a step of 1: row sums of the stiffness over 4 bound the stiffest mode (Gershgorin).
void set_masses(Assembly& assembly) {
  for (const End& end : assembly.ends)
    for (const auto& [direction, stiffness] :
         {std::pair(&Lever::normal, assembly.kn), std::pair(&Lever::tangent, assembly.ks)}) {
      double sum = 0;
      for (const Lever* lever : {&end.a, &end.b})
        for (const double l : lever->*direction)
          sum += std::abs(l);
      for (const Lever* lever : {&end.a, &end.b})
        for (int k = 0; lever->block >= 0 && k < 3; ++k)
          assembly.mass[lever->block][k] +=
              0.25 * mass_reserve * stiffness * end.length * std::abs((lever->*direction)[k]) * sum;
    }
}

// of b to a
double relative(const std::vector<Freedoms>& motion, const End& end, Freedoms Lever::*direction) {
  double value = 0;
  for (int k = 0; k < 3; ++k) {
    if (end.b.block >= 0) value += (end.b.*direction)[k] * motion[end.b.block][k];
    if (end.a.block >= 0) value -= (end.a.*direction)[k] * motion[end.a.block][k];
  }
  return value;
}

// forces on all blocks; slip forces follow the step that was just made
void find_forces(Assembly& assembly, double friction, std::vector<Freedoms>& forces) {
  for (std::size_t b = 0; b < forces.size(); ++b)
    forces[b] = {0, -assembly.weight_of_unit * assembly.blocks[b].area, 0};
  const double mu = std::tan(friction);
  for (End& end : assembly.ends) {
    const double closed = -relative(assembly.displacement, end, &Lever::normal);
    const double normal = std::max(0.0, assembly.kn * end.length * closed);
    end.slip_force -= assembly.ks * end.length * relative(assembly.velocity, end, &Lever::tangent);
    end.slip_force = std::clamp(end.slip_force, -mu * normal, mu * normal);
    for (const auto& [lever, sign] : {std::pair(&end.b, 1.0), std::pair(&end.a, -1.0)})
      for (int k = 0; lever->block >= 0 && k < 3; ++k)
        forces[lever->block][k] += sign * (normal * lever->normal[k] + end.slip_force * lever->tangent[k]);
  }
}

double largest_corner_motion(const Assembly& assembly, std::size_t b, const Freedoms& motion) {
  double largest = 0;
  const SlopeBlock& block = assembly.blocks[b];
  for (const Point& corner : block.corners) {
    const double turn = motion[2] / assembly.arm;
    largest = std::max(largest, std::hypot(motion[0] - turn * (corner.y - block.centroid.y),
                                           motion[1] + turn * (corner.x - block.centroid.x)));
  }
  return largest;
}

std::vector<Freedoms> moved_since(const Assembly& assembly, const std::vector<Freedoms>& start) {
  std::vector<Freedoms> moved(start.size());
  for (std::size_t b = 0; b < start.size(); ++b)
    for (int k = 0; k < 3; ++k)
      moved[b][k] = assembly.displacement[b][k] - start[b][k];
  return moved;
}

// Relaxes until equilibrium (true) or until a block has moved away (false). The damping is that of the softest mode in
// motion: twice the square root of its stiffness over its mass, from the changes in the last sweep (Underwood 1983).
bool comes_to_rest(Assembly& assembly, double friction, double away, long long& sweeps) {
  const std::vector<Freedoms> start = assembly.displacement;
  double mean_weight = 0;
  for (const SlopeBlock& block : assembly.blocks)
    mean_weight += assembly.weight_of_unit * block.area / static_cast<double>(assembly.blocks.size());
  std::vector<Freedoms> forces(start.size()), before(start.size());
  find_forces(assembly, friction, before);
  for (int sweep = 0; sweep < most_sweeps; ++sweep, ++sweeps) {
    find_forces(assembly, friction, forces);
    double unbalanced = 0, stiffness = 0, inertia = 0, farthest = 0;
    for (std::size_t b = 0; b < forces.size(); ++b)
      for (int k = 0; k < 3; ++k) {
        const double v = assembly.velocity[b][k];
        unbalanced = std::max(unbalanced, std::abs(forces[b][k]));
        stiffness += v * (before[b][k] - forces[b][k]);
        inertia += v * v * assembly.mass[b][k];
        farthest = std::max(farthest, std::abs(assembly.displacement[b][k] - start[b][k]));
      }
    if (unbalanced < balanced * mean_weight) {
      for (Freedoms& v : assembly.velocity)
        v = {};
      return true;
    }
    if (farthest > away) return false;
    const double damping = inertia > 0 && stiffness > 0 ? 2 * std::sqrt(stiffness / inertia) : 0;
    const double keep = std::max(0.0, (2 - damping) / (2 + damping)), gain = 2 / (2 + damping);
    for (std::size_t b = 0; b < forces.size(); ++b)
      for (int k = 0; k < 3; ++k) {
        assembly.velocity[b][k] = keep * assembly.velocity[b][k] + gain * forces[b][k] / assembly.mass[b][k];
        assembly.displacement[b][k] += assembly.velocity[b][k];
      }
    before.swap(forces);
  }
  throw std::runtime_error("the blocks neither reach equilibrium nor move away");
}

std::vector<SlopeBlockMotion> describe(const Assembly& assembly, const std::vector<Freedoms>& moved) {
  double fastest = 0;
  for (std::size_t b = 0; b < moved.size(); ++b)
    fastest = std::max(fastest, largest_corner_motion(assembly, b, moved[b]));
  std::vector<SlopeBlockMotion> motion;
  for (std::size_t b = 0; b < moved.size(); ++b)
    motion.push_back({assembly.blocks[b].layer, assembly.blocks[b].row, moved[b][0] / fastest, moved[b][1] / fastest,
                      moved[b][2] / assembly.arm / fastest, largest_corner_motion(assembly, b, moved[b]) / fastest});
  return motion;
}

// The blocks in equilibrium under a friction; empty if it does not hold them.
std::optional<Assembly> settle(const LayeredSlope& slope, double friction, double away, long long& sweeps) {
  Assembly assembly = build(slope);
  set_masses(assembly);
  if (!comes_to_rest(assembly, friction, away, sweeps)) return {};
  return assembly;
}

double away_of(const LayeredSlope& slope) {
  return far_away * slope.density * slope.gravity * slope.height /
         std::min(slope.normal_stiffness, slope.shear_stiffness);
}

SlopeCollapse search(Assembly resting, double from, double to, double tolerance, double away, SlopeCollapse collapse) {
  const auto holds = [&](double friction) {
    Assembly trial = resting;
    const bool rests = comes_to_rest(trial, friction, away, collapse.sweeps);
    if (!rests) collapse.motion = describe(trial, moved_since(trial, resting.displacement));
    if (rests) resting = trial;
    return rests;
  };
  collapse.stands = from;
  collapse.collapses = to;
  if (holds(to)) throw std::runtime_error("`to` holds the blocks");
  while (collapse.stands - collapse.collapses > tolerance) {
    const double middle = 0.5 * (collapse.stands + collapse.collapses);
    (holds(middle) ? collapse.stands : collapse.collapses) = middle;
  }
  return collapse;
}

}  // namespace

SlopeCollapse elastoplastic_collapse(const LayeredSlope& slope, double from, double to, double tolerance) {
  const double away = away_of(slope);
  SlopeCollapse collapse;
  const std::optional<Assembly> resting = settle(slope, from, away, collapse.sweeps);
  if (!resting) throw std::runtime_error("`from` does not hold the blocks");
  return search(*resting, from, to, tolerance, away, collapse);
}

SlopeCollapse elastoplastic_collapse(const LayeredSlope& slope, double tolerance) {
  const double away = away_of(slope);
  SlopeCollapse collapse;
  for (const double tangent : {1.0, 2.0, 4.0, 8.0})
    if (const std::optional<Assembly> resting = settle(slope, std::atan(tangent), away, collapse.sweeps))
      return search(*resting, std::atan(tangent), 0, tolerance, away, collapse);
  throw std::runtime_error("no friction holds the blocks");
}

std::vector<double> slope_block_areas(const LayeredSlope& slope) {
  std::vector<double> areas;
  for (const SlopeBlock& block : build(slope).blocks)
    areas.push_back(block.area);
  return areas;
}

}  // namespace voussoir::reference
