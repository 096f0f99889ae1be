#include "reference/potential_particles/rounded_blocks.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "reference/peak.hpp"

namespace voussoir::reference {

FaceBulge face_bulge(double plane, double corner_radius, double sphericity, double sphere_radius) {
  const double r = corner_radius, k = sphericity, R = sphere_radius;
  if (!(plane >= 0 && plane < R && r > 0 && k >= 0 && k < 1))
    throw std::invalid_argument("face_bulge: 0 <= plane < R, r > 0, 0 <= k < 1");
  // (1 - k)/r² u² + k/R² (plane + u)² = 1
  const double faces = (1 - k) / (r * r), sphere = k / (R * R), sum = faces + sphere, middle = sphere * plane;
  const double left = 1 - sphere * plane * plane;
  const double u = left / (middle + std::sqrt(middle * middle + sum * left));
  const double bend = sphere;  // half of the second derivative across, over half of the first one along
  return {u, bend > 0 ? (faces * u + sphere * (plane + u)) / bend : std::numeric_limits<double>::infinity()};
}

HingedBeamLoad rounded_hinged_beam(const RoundedHingedBeam& model, double rotation) {
  const double length = model.beam.length - 2 * model.corner_radius, depth = model.beam.depth - 2 * model.corner_radius;
  if (!(model.corner_radius >= 0 && length > 0 && depth > 0 && model.midspan_stiffness > 0 && rotation > 0))
    throw std::invalid_argument("rounded_hinged_beam: 0 <= 2 r < depth, stiffness and rotation > 0");
  const double c = std::cos(rotation), s = std::sin(rotation);
  // 1 - cos θ without cancellation
  const double reach = (depth * s - length * 2 * std::pow(std::sin(rotation / 2), 2)) / 2;
  if (reach <= 0) return {rotation, 0, 0};
  // K δ_w = 2 K_m (2 δ - δ_w)
  const double at_wall = reach * 4 * model.midspan_stiffness / (model.beam.stiffness + 2 * model.midspan_stiffness);
  const double thrust = model.beam.stiffness * at_wall;
  return {rotation, thrust * (depth * c - length * s) / (model.beam.length / 2 + reach - at_wall / 2), thrust};
}

HingedBeamLoad rounded_hinged_beam_peak(const RoundedHingedBeam& model) {
  constexpr int sections = 80;  // of the rotation, to the square root of rounding
  const double r = model.corner_radius;
  const double in_line = std::atan((model.beam.depth - 2 * r) / (model.beam.length - 2 * r));
  const Peak found = peak([&](double rotation) { return rounded_hinged_beam(model, rotation).weight; },
                          std::numeric_limits<double>::epsilon(), in_line, sections);
  return rounded_hinged_beam(model, found.at);
}

double least_joint_radius(int blocks) {
  if (blocks < 1) throw std::invalid_argument("least_joint_radius: one block or more");
  Eigen::MatrixXd rolls = Eigen::MatrixXd::Zero(blocks, blocks), falls = rolls;
  for (int j = 0; j < blocks; ++j) {  // between tilt j - 1 of the list, that of the fixed block for the first, and j
    const double carried = blocks - j;
    rolls(j, j) += carried;
    falls(j, j) += carried / 2;
    if (j == 0) continue;
    rolls(j - 1, j - 1) += carried;
    rolls(j - 1, j) -= carried;
    rolls(j, j - 1) -= carried;
    falls(j - 1, j - 1) += carried / 2;
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(falls, rolls);
  return modes.eigenvalues().maxCoeff();
}

}  // namespace voussoir::reference
