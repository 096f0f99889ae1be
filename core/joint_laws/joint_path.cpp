#include "core/joint_laws/joint_path.hpp"

#include <algorithm>
#include <cmath>

namespace voussoir {
namespace {

// Overlap when the joint has risen by `rise` against the surroundings, a spring: the root of the joint's stress minus
// that of the spring, which grows with the overlap.
double overlap_between(const JointProperties& p, const JointPath& path, double start, double rise, bool bonded) {
  if (path.surroundings == 0) return start;
  const auto excess = [&](double overlap) {
    return normal_answer(p, overlap, bonded).stress - path.normal_stress -
           path.surroundings * (rise - (overlap - start));
  };
  double low = start, high = start + rise;
  if (rise < 0) std::swap(low, high);
  low = std::max(low, 0.0);
  for (int i = 0; i < 200 && low < high; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (excess(middle) < 0 ? low : high) = middle;
  }
  return high;
}

// a specimen of joint of 1 m²
struct Specimen {
  const JointProperties& properties;
  JointState<2> history;
  JointPathPoint now;
  std::vector<JointPathPoint> points;

  void load(double overlap, double slip) {
    JointKinematics<2> k;
    k.normal = {0, 1};
    k.overlap = overlap;
    k.area = 1;
    // the law's shear is the force on the second body, against its slip
    k.slip = {now.slip - slip, 0};
    const JointForce<2> answer = joint_law<2>(properties, properties.friction, 0, k, history);
    now.overlap = overlap;
    now.slip = slip;
    now.normal_stress = answer.force[1];
    now.shear_stress = history.shear_force[0];
    now.normal_stiffness = normal_answer(properties, overlap, history.bond == Bond::whole).stiffness;
    now.shear_stiffness = shear_stiffness_at(properties, now.normal_stress);
    now.plastic_slip = history.plastic_slip;
    now.friction =
        friction_answer(properties, properties.friction, history.plastic_slip, now.normal_stress).coefficient;
    now.elastic = answer.elastic;
    now.dissipated += answer.friction;
    now.stiffening += answer.stiffening;
    now.bond = history.bond;
    now.cohesion = cohesion_answer(properties, history.bond, history.bond_slip).stress;
    now.snap_back = answer.snap_back;
    points.push_back(now);
  }
};

}  // namespace

std::vector<JointPathPoint> follow(const JointProperties& properties, const JointPath& path) {
  Specimen specimen{properties, {}, {}, {}};
  const double closed = overlap_at(properties, path.normal_stress);
  for (int i = 0; i <= path.steps; ++i)
    specimen.load(closed * i / path.steps, 0);
  if (path.bonded) specimen.history.bond = Bond::whole;
  if (path.unload)
    for (int i = path.steps - 1; i >= 0; --i)
      specimen.load(closed * i / path.steps, 0);

  const auto shear_to = [&](double from, double to) {
    for (int i = 1; i <= path.steps; ++i) {
      const double slip = from + (to - from) * i / path.steps, rise = path.dilation * std::abs(slip);
      specimen.load(overlap_between(properties, path, closed, rise, specimen.history.bond == Bond::whole), slip);
    }
  };
  if (path.slip != 0 && path.cycles == 0) shear_to(0, path.slip);
  for (int cycle = 0; cycle < path.cycles; ++cycle) {
    shear_to(0, path.slip);
    shear_to(path.slip, -path.slip);
    shear_to(-path.slip, 0);
  }
  return std::move(specimen.points);
}

}  // namespace voussoir
