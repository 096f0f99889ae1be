#include "reference/slump/elastoplastic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace voussoir::reference {
namespace {

// a trial rests when no block's force is farther from balance than this fraction of the mean weight
constexpr double balanced = 1e-7;
// it has collapsed when a corner has moved by this many times the elastic displacement under the whole height's weight
constexpr double far_away = 30;
constexpr int most_sweeps = 4'000'000;  // of one trial: a hundred times what those far from the critical angle take
constexpr double mass_reserve = 1.1;    // above the bound on the stiffest mode: slip and gaps never stiffen a spring

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

// an end of an interface: the spring between two blocks (-1: the fixed rock), from `a` to `b`
struct End {
  int a = -1, b = -1;
  Point place, normal;
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

  double u(int layer) const { return layer * slope.thickness / across; }
  double v(int row) const { return row * slope.spacing / across; }
  double top(double at_u) const { return (slope.height + at_u * std::sin(slope.base_dip)) / std::sin(slope.dip); }
  Point point(double at_u, double at_v) const {
    return {at_u * std::cos(slope.base_dip) + at_v * std::cos(slope.dip),
            -at_u * std::sin(slope.base_dip) + at_v * std::sin(slope.dip)};
  }
};

void add_interface(Assembly& assembly, int a, int b, Point from, Point to, Point normal) {
  const double half = 0.5 * std::hypot(to.x - from.x, to.y - from.y);
  for (const Point& place : {from, to})
    assembly.ends.push_back({a, b, place, normal, half, 0});
}

Assembly build(const LayeredSlope& slope) {
  Assembly assembly;
  const Grid grid{slope};
  int rows = 0;
  while (grid.v(rows) < grid.top(0))
    ++rows;
  const auto id = [&](int layer, int row) { return layer < slope.layers && row >= 0 ? layer * rows + row : -1; };
  const Point up{std::sin(slope.base_dip), std::cos(slope.base_dip)};  // across the base
  const Point out{-std::sin(slope.dip), std::cos(slope.dip)};          // across the layers
  for (int layer = 0; layer < slope.layers; ++layer)
    for (int row = 0; row < rows; ++row) {
      const double left = grid.u(layer), right = grid.u(layer + 1), foot = grid.v(row), head = grid.v(row + 1);
      const Point low_left = grid.point(left, foot), low_right = grid.point(right, foot),
                  high_right = grid.point(right, std::min(head, grid.top(right))),
                  high_left = grid.point(left, std::min(head, grid.top(left)));
      SlopeBlock block{layer, row, {low_left, low_right, high_right, high_left}, {}, 0};
      find_centroid(block);
      assembly.blocks.push_back(block);
      add_interface(assembly, id(layer, row - 1), id(layer, row), low_left, low_right, up);
      add_interface(assembly, id(layer + 1, row), id(layer, row), low_right, high_right, out);
    }
  const std::size_t count = assembly.blocks.size();
  assembly.displacement.assign(count, {});
  assembly.velocity.assign(count, {});
  assembly.mass.assign(count, {});
  assembly.arm = 0.5 * std::max(slope.thickness, slope.spacing);
  assembly.weight_of_unit = slope.density * slope.gravity;
  assembly.kn = slope.normal_stiffness;
  assembly.ks = slope.shear_stiffness;
  return assembly;
}

// how a block's freedoms move a place along a direction
Freedoms lever(const Assembly& assembly, int block, const Point& place, const Point& direction) {
  const Point& c = assembly.blocks[block].centroid;
  const double turning = (place.x - c.x) * direction.y - (place.y - c.y) * direction.x;
  return {direction.x, direction.y, turning / assembly.arm};
}

Point along(const Point& normal) {
  return {-normal.y, normal.x};
}

// Masses for a step of 1: row sums of the stiffness over 4 bound the stiffest mode (Gershgorin).
void set_masses(Assembly& assembly) {
  for (const End& end : assembly.ends)
    for (const auto& [direction, stiffness] :
         {std::pair(end.normal, assembly.kn), std::pair(along(end.normal), assembly.ks)}) {
      double sum = 0;
      for (const int block : {end.a, end.b})
        if (block >= 0)
          for (const double l : lever(assembly, block, end.place, direction))
            sum += std::abs(l);
      for (const int block : {end.a, end.b}) {
        if (block < 0) continue;
        const Freedoms l = lever(assembly, block, end.place, direction);
        for (int k = 0; k < 3; ++k)
          assembly.mass[block][k] += 0.25 * mass_reserve * stiffness * end.length * std::abs(l[k]) * sum;
      }
    }
}

double relative(const Assembly& assembly, const std::vector<Freedoms>& motion, const End& end, const Point& direction) {
  double value = 0;
  for (const auto& [block, sign] : {std::pair(end.b, 1.0), std::pair(end.a, -1.0)}) {
    if (block < 0) continue;
    const Freedoms l = lever(assembly, block, end.place, direction);
    for (int k = 0; k < 3; ++k)
      value += sign * l[k] * motion[block][k];
  }
  return value;
}

// forces on all blocks; slip forces follow the step that was just made
std::vector<Freedoms> find_forces(Assembly& assembly, double friction) {
  std::vector<Freedoms> forces(assembly.blocks.size());
  for (std::size_t b = 0; b < forces.size(); ++b)
    forces[b] = {0, -assembly.weight_of_unit * assembly.blocks[b].area, 0};
  const double mu = std::tan(friction);
  for (End& end : assembly.ends) {
    const Point tangent = along(end.normal);
    const double closed = -relative(assembly, assembly.displacement, end, end.normal);
    const double normal = std::max(0.0, assembly.kn * end.length * closed);
    end.slip_force -= assembly.ks * end.length * relative(assembly, assembly.velocity, end, tangent);
    end.slip_force = std::clamp(end.slip_force, -mu * normal, mu * normal);
    for (const auto& [block, sign] : {std::pair(end.b, 1.0), std::pair(end.a, -1.0)}) {
      if (block < 0) continue;
      const Freedoms n = lever(assembly, block, end.place, end.normal), t = lever(assembly, block, end.place, tangent);
      for (int k = 0; k < 3; ++k)
        forces[block][k] += sign * (normal * n[k] + end.slip_force * t[k]);
    }
  }
  return forces;
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

// Relaxes until rest (true) or until a block has moved away (false). The damping is that of the softest mode in motion:
// twice the root of its stiffness over its mass, from what the last sweep changed (Underwood 1983).
bool comes_to_rest(Assembly& assembly, double friction, double away, long long& sweeps) {
  const std::vector<Freedoms> start = assembly.displacement;
  double mean_weight = 0;
  for (const SlopeBlock& block : assembly.blocks)
    mean_weight += assembly.weight_of_unit * block.area / static_cast<double>(assembly.blocks.size());
  std::vector<Freedoms> before = find_forces(assembly, friction);
  for (int sweep = 0; sweep < most_sweeps; ++sweep, ++sweeps) {
    const std::vector<Freedoms> forces = find_forces(assembly, friction);
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
    before = forces;
  }
  throw std::runtime_error("the blocks neither come to rest nor move away");
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

}  // namespace

SlopeCollapse elastoplastic_collapse(const LayeredSlope& slope, double from, double to, double tolerance) {
  SlopeCollapse collapse;
  Assembly resting = build(slope);
  set_masses(resting);
  const double elastic =
      slope.density * slope.gravity * slope.height / std::min(slope.normal_stiffness, slope.shear_stiffness);
  const double away = far_away * elastic;
  if (!comes_to_rest(resting, from, away, collapse.sweeps)) throw std::runtime_error("`from` does not hold the blocks");
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

}  // namespace voussoir::reference
