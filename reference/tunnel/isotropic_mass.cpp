#include "reference/tunnel/isotropic_mass.hpp"

#include <cmath>
#include <numbers>

#include "reference/require.hpp"

namespace voussoir::reference::network {
namespace {

using std::numbers::pi;

constexpr Require require{"isotropic mass: "};

// corners closer to a line than this of the spacing are on it
constexpr double rounding = 1e-7;

Polygon regular(int sides, double radius) {
  Polygon polygon;
  for (int i = 0; i < sides; ++i)
    polygon.push_back({radius * std::cos(2 * pi * i / sides), radius * std::sin(2 * pi * i / sides)});
  return polygon;
}

}  // namespace

IsotropicModuli isotropic_moduli(double spacing, double normal_stiffness, double shear_stiffness) {
  require(positive(spacing) && positive(normal_stiffness) && positive(shear_stiffness),
          "spacing and stiffnesses must be positive");
  const double sum = normal_stiffness + shear_stiffness;
  return {2 * spacing / 3 * normal_stiffness * shear_stiffness / sum, (normal_stiffness - shear_stiffness) / (2 * sum)};
}

std::array<double, 2> isotropic_stiffnesses(const IsotropicModuli& moduli, double spacing) {
  require(positive(spacing) && positive(moduli.shear_modulus), "spacing and shear modulus must be positive");
  require(moduli.poisson_ratio >= 0 && moduli.poisson_ratio < 0.5, "Poisson's ratio must be in 0..0.5, 0.5 excluded");
  // ks/kn = (1 - 2 nu)/(1 + 2 nu), so that kn/(kn + ks) = (1 + 2 nu)/2
  const double twice = 2 * moduli.poisson_ratio, scale = 3 * moduli.shear_modulus / spacing;
  return {scale / (1 - twice), scale / (1 + twice)};
}

double mean_crossings(double spacing) {
  require(positive(spacing), "spacing must be positive");
  return 6 / (pi * spacing);
}

OpeningNetwork build(const IsotropicOpening& opening) {
  require(positive(opening.radius) && opening.fixed_radius > opening.radius, "the mass must be held beyond the wall");
  require(opening.sides >= 3, "an outline needs three sides or more");
  const double s = opening.spacing, reach = opening.fixed_radius + 2 * s;
  const auto [kn, ks] = isotropic_stiffnesses(opening.moduli, s);
  const double first = opening.first_angle;
  const std::vector<Line> lines =
      persistent_sets({first, first + pi / 3, first + 2 * pi / 3}, {opening.shifts.begin(), opening.shifts.end()}, s,
                      std::numbers::sqrt2 * reach);
  OpeningNetwork built;
  const double corner = std::sqrt(2 * pi / (opening.sides * std::sin(2 * pi / opening.sides)));
  built.outline = regular(opening.sides, corner * opening.radius);
  const Polygon whole{{-reach, -reach}, {reach, -reach}, {reach, reach}, {-reach, reach}};
  std::vector<Block>& blocks = built.network.blocks;
  blocks = take_out(cut(whole, lines, rounding * s), built.outline, rounding * s);
  for (Block& block : blocks)
    if (const Point at = centroid(block); std::hypot(at[0], at[1]) > opening.fixed_radius)
      block.held = {true, true, true};
  built.faces = faces(blocks, 2 * rounding * s);
  built.network.springs = springs(built.faces, opening.cells, kn, ks);
  built.wall = wall(blocks, built.outline, 2 * rounding * s);
  return built;
}

void add_fan(OpeningNetwork& built, int count, double length, double stiffness, double offset) {
  require(count >= 1 && positive(length), "a fan needs bolts of positive length");
  const Polygon& outline = built.outline;
  const double apothem = std::hypot(outline[0][0] + outline[1][0], outline[0][1] + outline[1][1]) / 2;
  const double between = 2 * pi / static_cast<double>(outline.size());
  for (int k = 0; k < count; ++k) {
    const double angle = (k + 0.5) * 2 * pi / count;
    const double from_middle = std::remainder(angle - between / 2, between);
    const double collar = apothem / std::cos(from_middle), toe = collar + length;
    const double c = std::cos(angle), s = std::sin(angle);
    for (const Bolt& bolt : bolts_across(built.faces, {collar * c, collar * s}, {toe * c, toe * s}, stiffness, offset))
      built.network.bolts.push_back(bolt);
  }
}

void add_ring(OpeningNetwork& built, double axial, double bending, double interface) {
  Lining& lining = built.network.lining;
  lining = {{}, true, axial, bending, {}};
  for (const Point& corner : built.outline)
    lining.nodes.push_back({corner});
  const Point edge{built.outline[1][0] - built.outline[0][0], built.outline[1][1] - built.outline[0][1]};
  tie_to_wall(lining, built.wall, interface, interface, rounding * std::hypot(edge[0], edge[1]));
}

double sum_of_bolt_forces(const Solution& solution) {
  double sum = 0;
  for (const BoltForce& bolt : solution.bolts)
    sum += bolt.axial;
  return sum;
}

double mean_thrust(const Solution& solution) {
  double sum = 0;
  for (const BeamForce& beam : solution.beams)
    sum += beam.thrust;
  return sum / static_cast<double>(solution.beams.size());
}

}  // namespace voussoir::reference::network
