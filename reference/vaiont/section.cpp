#include "reference/vaiont/section.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/require.hpp"

namespace voussoir::reference {
namespace {

constexpr double right_angle = std::numbers::pi / 2;
// How near, relatively, a friction angle may come to the one at which the sum has a pole.
constexpr double before_locking = 1e-9;

constexpr Require require{"section of a slide: "};

using Polygon = std::vector<SectionPoint>;

// the part of a polygon with a x + b y <= c; the edges left along the line enclose no area, so that areas stay right if
// a polygon that is not convex falls into pieces
Polygon cut(const Polygon& polygon, double a, double b, double c) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const SectionPoint &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double at_p = a * p.x + b * p.y - c, at_q = a * q.x + b * q.y - c;
    if (at_p <= 0) kept.push_back(p);
    if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0)) {
      const double part = at_p / (at_p - at_q);
      kept.push_back({p.x + part * (q.x - p.x), p.y + part * (q.y - p.y)});
    }
  }
  return kept;
}

double area_of(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const SectionPoint &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    twice += p.x * q.y - q.x * p.y;
  }
  return 0.5 * twice;
}

// the water's force on a block: below each straight piece of its surface, level beyond the first and the last point
void add_water(SectionBlock& block, const Polygon& rock, const SectionLoads& loads) {
  const std::vector<SectionPoint>& table = loads.table;
  for (std::size_t k = 0; k <= table.size(); ++k) {
    Polygon piece = rock;
    if (k > 0) piece = cut(piece, -1, 0, -table[k - 1].x);
    if (k < table.size()) piece = cut(piece, 1, 0, table[k].x);
    const bool between = k > 0 && k < table.size();
    const SectionPoint& from = table[k == 0 ? 0 : k - 1];
    const double slope = between ? (table[k].y - from.y) / (table[k].x - from.x) : 0;
    const double lift = loads.water_unit_weight * area_of(cut(piece, -slope, 1, from.y - slope * from.x));
    block.vertical -= lift;
    block.horizontal -= lift * slope;
  }
}

double force_at_toe(const std::vector<SectionBlock>& blocks, const SectionFriction& friction) {
  return section_forces(blocks, friction).back();
}

// the root of a function that rises, to the last bit
template <typename Rising>
double root(double low, double high, const Rising& function) {
  for (double middle = 0.5 * (low + high); middle > low && middle < high; middle = 0.5 * (low + high))
    (function(middle) < 0 ? low : high) = middle;
  return 0.5 * (low + high);
}

}  // namespace

SlideSection vaiont_section(double seat_dip) {
  require(std::abs(seat_dip) < right_angle / 9, "the seat must dip less than 10 degrees");
  const SectionPoint head{20.8119, 1179.0372}, upper{718.3777, 644.0025}, lower{818.3777, 620};
  const SectionPoint front{1214.3866, 620}, crest{920, 850};
  // intersection of the seat's line with the front's
  const double fall = std::tan(seat_dip), face = (front.y - crest.y) / (front.x - crest.x);
  const double x = (lower.y - crest.y + fall * lower.x + face * crest.x) / (face + fall);
  const SectionPoint toe{x, lower.y - fall * (x - lower.x)};
  return {{head, upper, lower, toe, crest, {685, 850}, {352, 1065}}, {head, upper, lower, toe}};
}

std::vector<SectionBlock> section_blocks(const SlideSection& section, const SectionLoads& loads, double cross_dip) {
  require(section.slide.size() >= 2 && section.outline.size() >= 3, "a slide has two points, an outline three");
  require(cross_dip > 0 && cross_dip <= right_angle, "cross joints dip between 0 and pi/2 radians into the slope");
  for (std::size_t k = 1; k < loads.table.size(); ++k)
    require(loads.table[k].x > loads.table[k - 1].x, "the points of the water's surface must go downslope");
  // downslope of a cross joint through a bend: sin(beta) x - cos(beta) y is more than at the bend
  const double a = std::sin(cross_dip), b = -std::cos(cross_dip);
  std::vector<SectionBlock> blocks;
  for (std::size_t k = 0; k + 1 < section.slide.size(); ++k) {
    const SectionPoint &from = section.slide[k], &to = section.slide[k + 1];
    Polygon rock = section.outline;
    if (k > 0) rock = cut(rock, -a, -b, -a * from.x - b * from.y);
    if (k + 2 < section.slide.size()) rock = cut(rock, a, b, a * to.x + b * to.y);
    SectionBlock block;
    block.dip = std::atan2(from.y - to.y, to.x - from.x);
    block.area = area_of(rock);
    block.vertical = loads.unit_weight * block.area;
    block.horizontal = loads.horizontal_coefficient * block.vertical;
    if (!loads.table.empty()) add_water(block, rock, loads);
    blocks.push_back(block);
  }
  return blocks;
}

std::vector<double> section_forces(const std::vector<SectionBlock>& blocks, const SectionFriction& friction) {
  const double delta = std::tan(friction.cross + right_angle - friction.cross_dip);
  std::vector<double> forces;
  double force = 0;
  for (const SectionBlock& block : blocks) {
    const double slides = std::tan(block.dip - friction.slide);
    force += (block.horizontal + block.vertical * slides) / (1 + delta * slides);
    forces.push_back(force);
  }
  return forces;
}

double critical_slide_friction(const std::vector<SectionBlock>& blocks, double cross, double cross_dip) {
  // at the steepest dip every block is stable; before a slide's reaction is parallel to a cross joint, the block on it
  // holds any force
  double steepest = 0, locked = cross_dip - cross;
  for (const SectionBlock& block : blocks) {
    steepest = std::max(steepest, block.dip);
    locked = std::min(locked, block.dip + cross_dip - cross);
  }
  const double high = std::min(steepest, (1 - before_locking) * locked);
  const auto held = [&](double slide) { return -force_at_toe(blocks, {slide, cross, cross_dip}); };
  require(high > 0 && held(0) < 0 && held(high) >= 0, "no friction angle of the slide is critical");
  return root(0, high, held);
}

double critical_horizontal_coefficient(const std::vector<SectionBlock>& blocks, const SectionFriction& friction) {
  std::vector<SectionBlock> weights = blocks;
  for (SectionBlock& block : weights) {
    block.horizontal = block.vertical;
    block.vertical = 0;
  }
  // the balance is linear in the forces
  return -force_at_toe(blocks, friction) / force_at_toe(weights, friction);
}

double section_factor_of_safety(const std::vector<SectionBlock>& blocks, const SectionFriction& friction) {
  const auto driven = [&](double factor) {
    return force_at_toe(blocks, {std::atan(std::tan(friction.slide) / factor),
                                 std::atan(std::tan(friction.cross) / factor), friction.cross_dip});
  };
  double low = 1, high = 1;
  for (int doubling = 0; doubling < 10 && driven(low) >= 0; ++doubling)
    low /= 2;
  for (int doubling = 0; doubling < 10 && driven(high) < 0; ++doubling)
    high *= 2;
  require(driven(low) < 0 && driven(high) >= 0, "no factor between 1/1000 and 1000 is critical");
  return root(low, high, driven);
}

}  // namespace voussoir::reference
