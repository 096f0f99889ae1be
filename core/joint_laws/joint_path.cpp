#include "core/joint_laws/joint_path.hpp"

#include <algorithm>
#include <cmath>

namespace voussoir {
namespace {

// a specimen of joint of 1 m²
struct Specimen {
  const JointProperties& properties;
  JointState<2> history;
  JointRise<2> rise;
  JointPathPoint now;
  std::vector<JointPathPoint> points;

  // its force when the walls have come together by `overlap`; the closure of its spring is larger by its rise
  LawForce<2> force(double overlap, double slip, JointState<2>& after, JointRise<2>& risen) const {
    JointKinematics<2> k;
    k.normal = {0, 1};
    k.overlap = overlap + risen.rise;
    k.area = 1;
    // the law's shear is the force on the second body, against its slip
    k.slip = {now.slip - slip, 0};
    return joint_law<2>(properties, properties.friction, 0, k, after, 1, {&risen, 0});
  }

  // Overlap of the walls at a slip, when a rise from outside has moved them apart by `lifted`, against the
  // surroundings, a spring that is unloaded at `start` by no stress but the first one: the root of the joint's stress
  // minus that of the spring, which grows with the overlap. Without a spring the stress stays.
  double overlap_between(const JointPath& path, double start, double lifted, double slip) const {
    const auto excess = [&](double overlap) {
      JointState<2> after = history;
      JointRise<2> risen = rise;
      const double stress = force(overlap, slip, after, risen).force[1];
      return stress - path.normal_stress - path.surroundings * (lifted - (overlap - start));
    };
    if (!properties.dilates() && path.surroundings == 0) return start;
    // as far as a joint without stress could move, and as far as it could rise
    double low = start - std::abs(lifted), high = start + std::abs(lifted);
    const double step = std::max(start, std::abs(slip - now.slip));
    for (double reach = step; excess(low) > 0; reach *= 2)
      low -= reach;
    for (double reach = step; excess(high) < 0; reach *= 2)
      high += reach;
    for (int i = 0; i < 200 && low < high; ++i) {
      const double middle = 0.5 * (low + high);
      if (middle == low || middle == high) break;
      (excess(middle) < 0 ? low : high) = middle;
    }
    return high;
  }

  void load(double overlap, double slip) {
    const LawForce<2> answer = force(overlap, slip, history, rise);
    now.overlap = overlap;
    now.rise = rise.rise;
    now.offset = rise.offset[0];
    now.slip = slip;
    now.normal_stress = answer.force[1];
    now.shear_stress = history.shear_force[0];
    now.normal_stiffness =
        normal_answer(properties, overlap + rise.rise, history.bond == Bond::whole, rise.largest_closure).stiffness;
    now.shear_stiffness = shear_stiffness_at(properties, now.normal_stress);
    now.plastic_slip = history.plastic_slip;
    now.friction =
        friction_answer(properties, properties.friction, history.plastic_slip, now.normal_stress).coefficient;
    now.elastic = answer.elastic;
    now.dissipated += answer.friction;
    now.stiffening += answer.stiffening;
    now.dilation += answer.dilation;
    now.crushing += answer.crushing;
    now.bond = history.bond;
    now.cohesion = cohesion_answer(properties, history.bond, history.bond_slip).stress;
    now.snap_back = answer.snap_back;
    points.push_back(now);
  }
};

}  // namespace

std::vector<JointPathPoint> follow(const JointProperties& properties, const JointPath& path) {
  Specimen specimen{properties, {}, {}, {}, {}};
  const double closed = overlap_at(properties, path.normal_stress);
  for (int i = 0; i <= path.steps; ++i)
    specimen.load(closed * i / path.steps, 0);
  if (path.bonded) specimen.history.bond = Bond::whole;
  if (path.unload)
    for (int i = path.steps - 1; i >= 0; --i)
      specimen.load(closed * i / path.steps, 0);

  const auto shear_to = [&](double from, double to) {
    for (int i = 1; i <= path.steps; ++i) {
      const double slip = from + (to - from) * i / path.steps, lifted = path.dilation * std::abs(slip);
      specimen.load(specimen.overlap_between(path, closed, lifted, slip), slip);
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
