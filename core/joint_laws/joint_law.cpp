#include "core/joint_laws/joint_law.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <span>

#include "core/joint_laws/barton_bandis.hpp"
#include "core/joint_laws/dilation.hpp"

namespace voussoir {
namespace {

// ∫(e^x - 1) dx from 0: by its series if the difference would cancel
double integral_of_expm1(double x) {
  constexpr double small = 0.05;  // the first term left out is 2e-16 of the sum
  if (std::abs(x) > small) return std::expm1(x) - x;
  double sum = 0;
  for (int n = 9; n >= 3; --n)
    sum = (sum + 1) * x / n;
  return 0.5 * x * x * (1 + sum);
}

// the offset of the overlap at which there is no stress, m
double offset(const JointProperties& p) {
  return p.laws.bond ? p.tension / p.normal_stiffness : 0;
}

// a softening cohesion without a length
bool falls_at_once(const JointProperties& p) {
  return p.softens_cohesion() && !(p.cohesion_slip > 0);
}

// of the maximum closure: beyond it a hyperbola continues along its tangent
constexpr double end_of_hyperbola = 0.999;

// A hyperbola σ = k Vm/(1 - ρ) (u - rest)/(Vm - u) from its rest, m, to the closure u: ρ of loading is none.
NormalAnswer on_hyperbola(double stiffness, double maximum, double fraction, double rest, double u) {
  const double scale = stiffness * maximum / (1 - fraction), left = maximum - u, from = maximum - rest, way = u - rest;
  // from ln(from/left) - way = ∫ way/(from - way): by its series if the difference would cancel
  const double part = way / from;
  double sum = 0;
  if (part > 0.03) {
    sum = -std::log1p(-part) - part;
  } else {
    for (int n = 11; n >= 2; --n)
      sum = (sum + 1.0 / n) * part;
    sum *= part;
  }
  return {scale * way / left, scale * from / (left * left), scale * from * sum};
}

NormalAnswer hyperbolic_answer(const JointProperties& p, double u, double largest) {
  const double last = end_of_hyperbola * p.maximum_closure, within = std::min(u, last);
  const double fraction = p.irrecoverable_fraction;
  largest = std::min(std::max(largest, within), last);
  const double rest = fraction * largest;
  if (fraction > 0 && u <= rest) return {0, p.normal_stiffness, 0};
  NormalAnswer answer = on_hyperbola(p.normal_stiffness, p.maximum_closure, 0, 0, within);
  if (fraction > 0) {
    const NormalAnswer unloading = on_hyperbola(p.normal_stiffness, p.maximum_closure, fraction, rest, within);
    answer.energy = unloading.energy;
    if (within < largest) answer = unloading;
  }
  if (const double beyond = u - within; beyond > 0) {
    answer.energy += (answer.stress + 0.5 * answer.stiffness * beyond) * beyond;
    answer.stress += answer.stiffness * beyond;
  }
  return answer;
}

}  // namespace

NormalAnswer normal_answer(const JointProperties& p, double overlap, bool bonded, double largest_closure) {
  const double u = overlap - offset(p), k = p.normal_stiffness;
  if (u <= 0 && !bonded) return {0, p.laws.normal == StiffnessLaw::power ? 0 : k, 0};
  if (u <= 0) return {k * u, k, 0.5 * k * u * u};  // a bond in tension is linear
  if (p.laws.normal == StiffnessLaw::linear) {
    const double c = p.normal_growth, stress = k / c * std::expm1(c * u);
    return {stress, k + c * stress, k / (c * c) * integral_of_expm1(c * u)};
  }
  if (p.laws.normal == StiffnessLaw::power) {
    const double rest = 1 - p.normal_exponent, stress = std::pow(rest * k * u, 1 / rest);
    return {stress, k * std::pow(stress, p.normal_exponent), stress * u * rest / (1 + rest)};
  }
  if (p.laws.normal == StiffnessLaw::hyperbolic) return hyperbolic_answer(p, u, largest_closure);
  return {k * u, k, 0.5 * k * u * u};
}

double crushing_between(const JointProperties& p, double closure, double largest) {
  if (!(p.irrecoverable_fraction > 0)) return 0;
  const double last = end_of_hyperbola * p.maximum_closure;
  const auto lost = [&](double u) {
    if (!(u > 0)) return 0.0;
    const double fraction = p.irrecoverable_fraction;
    return on_hyperbola(p.normal_stiffness, p.maximum_closure, 0, 0, u).energy -
           on_hyperbola(p.normal_stiffness, p.maximum_closure, fraction, fraction * u, u).energy;
  };
  return lost(std::min(largest, last)) - lost(std::min(closure, last));
}

double stiffest_normal(const JointProperties& p, double overlap) {
  if (!(p.irrecoverable_fraction > 0)) return normal_answer(p, overlap, true).stiffness;
  const double u = std::clamp(overlap, 0.0, end_of_hyperbola * p.maximum_closure);
  return on_hyperbola(p.normal_stiffness, p.maximum_closure, p.irrecoverable_fraction, p.irrecoverable_fraction * u, u)
      .stiffness;
}

double overlap_at(const JointProperties& p, double stress) {
  const double k = p.normal_stiffness;
  if (p.laws.normal == StiffnessLaw::linear)
    return offset(p) + std::log1p(p.normal_growth * stress / k) / p.normal_growth;
  if (p.laws.normal == StiffnessLaw::hyperbolic) return stress * p.maximum_closure / (k * p.maximum_closure + stress);
  if (p.laws.normal == StiffnessLaw::power)
    return std::pow(stress, 1 - p.normal_exponent) / ((1 - p.normal_exponent) * k);
  return offset(p) + stress / k;
}

double shear_stiffness_at(const JointProperties& p, double stress) {
  const double pressure = std::max(stress, 0.0);
  if (p.laws.shear == StiffnessLaw::linear) return p.shear_stiffness + p.shear_growth * pressure;
  if (p.laws.shear == StiffnessLaw::power) return p.shear_stiffness * std::pow(pressure, p.shear_exponent);
  return p.shear_stiffness;
}

FrictionAnswer friction_answer(const JointProperties& p, double friction, double slip, double stress,
                               double strength_factor) {
  if (p.follows_barton_bandis()) {
    const MobilisedAngle now = mobilised_angle(p, slip, stress);
    const double tangent = std::tan(now.angle);
    return {tangent / strength_factor, (1 + tangent * tangent) * now.slope / strength_factor};
  }
  const double last = std::tan(friction);
  if (p.laws.friction == FrictionLaw::hardening) {
    const double scale = p.hardening_slip * std::pow(std::max(stress, 0.0), p.hardening_exponent);
    if (scale > 0) return {-last * std::expm1(-slip / scale), last / scale * std::exp(-slip / scale)};
    return {slip > 0 ? last : 0, 0};
  }
  if (p.laws.friction == FrictionLaw::softening) {
    const double drop = p.softening_drop / strength_factor;
    const double lost = -drop * std::expm1(-slip / p.softening_slip);
    if (lost >= last) return {0, 0};
    return {last - lost, -drop / p.softening_slip * std::exp(-slip / p.softening_slip)};
  }
  return {last, 0};
}

CohesionAnswer cohesion_answer(const JointProperties& p, Bond bond, double slip, double strength_factor) {
  if (bond == Bond::lost) return {};
  const double whole = p.cohesion / strength_factor;
  if (bond == Bond::whole || p.cohesion_law != CohesionLaw::softening) return {whole, 0};
  const double residual = p.residual_cohesion / strength_factor;
  if (!(p.cohesion_slip > 0)) return {residual, 0};
  const double above = (whole - residual) * std::exp(-slip / p.cohesion_slip);
  return {residual + above, -above / p.cohesion_slip};
}

// Eqs F.1-F.8 in one number: elastic trial, force and plastic slip have one direction.
SlipReturn return_to_cone(const JointProperties& p, double friction, double plastic_slip, double trial,
                          double stiffness, double normal_force, double stress, double strength_factor,
                          const Adhesion& adhesion) {
  const double area = adhesion.area;
  const auto cohesion_after = [&](double slip) {
    return cohesion_answer(p, adhesion.bond, adhesion.slip + slip, strength_factor);
  };
  SlipReturn result;
  const CohesionAnswer bond = cohesion_after(0);
  result.snap_back =
      stiffness <
      -normal_force * friction_answer(p, friction, plastic_slip, stress, strength_factor).slope - area * bond.slope;
  if (p.laws.friction == FrictionLaw::constant && bond.slope == 0) {
    result.slip = (trial - std::tan(friction) * normal_force - area * bond.stress) / stiffness;
    return result;
  }
  double low = 0, high = trial / stiffness;
  double slip = p.laws.friction == FrictionLaw::hardening ? low : high;
  // Newton's steps shorten quadratically; halving, which rounding may require, needs as many as a double has digits
  constexpr int limit = 2 * std::numeric_limits<double>::digits;
  for (int i = 0; i < limit; ++i) {
    const FrictionAnswer at = friction_answer(p, friction, plastic_slip + slip, stress, strength_factor);
    const CohesionAnswer left = cohesion_after(slip);
    const double excess = trial - stiffness * slip - at.coefficient * normal_force - area * left.stress;
    (excess > 0 ? low : high) = slip;
    double next = slip + excess / (stiffness + at.slope * normal_force + area * left.slope);
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    const bool done = std::abs(next - slip) <= std::numeric_limits<double>::epsilon() * next;
    slip = next;
    if (done) break;
  }
  result.slip = slip;
  return result;
}

namespace {

// What a joint that has slipped by `slip` in this step has risen by, m, and its normal stress.
struct Risen {
  double grown = 0;
  NormalAnswer normal;
};

// The place of a joint over a step: its rise and its normal stress as functions of the slip.
template <int Dim>
class Rising {
 public:
  Rising(const JointProperties& p, double overlap, double friction, double strength_factor, double plastic_slip,
         const PlaceOfJoint<Dim>& place)
      : p_(p), overlap_(overlap), strength_factor_(strength_factor), plastic_slip_(plastic_slip), place_(place) {
    if (!changes()) return;
    tangent_ = dilation_in_force(p, friction, strength_factor);
    path_.across = length_of<Dim>(place_.rise->offset);
  }

  bool changes() const { return place_.rise && p_.dilates(); }

  void turn_to(const Vector<Dim>& direction) {
    const Vector<Dim>& offset = place_.rise->offset;
    path_.along = offset.dot(direction);
    path_.across = Dim == 2 ? 0 : length_of<Dim>(offset - path_.along * direction);
    farthest_at_ = slip_to_farthest();
  }

  Risen after(double slip, bool bonded) const {
    if (!changes()) return {0, normal_at(overlap_, bonded)};
    if (p_.follows_barton_bandis()) return over_asperities(slip, bonded);
    const double grown = rise_at(p_, tangent_, path_.length(slip)) - place_.rise->rise;
    return {grown, normal_at(overlap_ + grown, bonded)};
  }

  // what it adds to the closing speed, m/s
  double closing_speed(const Risen& risen) const { return place_.seconds > 0 ? risen.grown / place_.seconds : 0; }

  const OffsetPath& path() const { return path_; }

  // the slip at which the offset is the largest so far
  double farthest_at() const { return farthest_at_; }

  // m: the slip that brings the offset back, and the largest fall of the rise with it
  double returns_until() const { return std::max(-path_.along, 0.0); }
  double steepest_fall() const {
    if (!p_.follows_barton_bandis()) return tangent_;
    return place_.rise->farthest > 0 ? place_.rise->rise_there / place_.rise->farthest : 0;
  }

  // the place after the step, and what it cost; the offset has been moved
  void settle(const Risen& risen, double area, LawForce<Dim>& result) const {
    JointRise<Dim>& rise = *place_.rise;
    const double closure = overlap_ + risen.grown, stress = risen.normal.stress;
    result.grown = risen.grown;
    result.dilation = -0.5 * (rise.stress + stress) * area * risen.grown;
    if (p_.irrecoverable_fraction > 0 && closure > rise.largest_closure) {
      result.crushing = area * crushing_between(p_, rise.largest_closure, closure);
      rise.largest_closure = closure;
    }
    rise.rise += risen.grown;
    rise.stress = stress;
    if (!p_.follows_barton_bandis()) return;
    if (const double offset = length_of<Dim>(rise.offset); offset > rise.farthest) {
      rise.farthest = offset;
      rise.rise_there = rise.rise;
    }
  }

 private:
  NormalAnswer normal_at(double closure, bool bonded) const {
    return normal_answer(p_, closure, bonded, place_.rise ? place_.rise->largest_closure : 0);
  }

  double slip_to_farthest() const {
    const double far = place_.rise->farthest;
    if (!(far > path_.across)) return std::max(-path_.along, 0.0);
    return std::max(std::sqrt((far - path_.across) * (far + path_.across)) - path_.along, 0.0);
  }

  // Barton and Bandis' rise depends on the stress, which it changes: its angle is that at the mean of the old and the
  // new stress, so that its error is of the second order in the step. A trial's stress minus the trial falls by at
  // least as much as the trial grows: the root is between any trial and the stress that it gives.
  Risen over_asperities(double slip, bool bonded) const {
    const JointRise<Dim>& now = *place_.rise;
    if (slip == 0) return {0, normal_at(overlap_, bonded)};
    const double offset = path_.length(slip), further = offset - now.farthest;
    if (!(further > 0)) {
      const double grown = rise_within(now, offset) - now.rise;
      return {grown, normal_at(overlap_ + grown, bonded)};
    }
    const MobilisedOver over = mobilised_over(p_, plastic_slip_ + std::min(farthest_at_, slip), plastic_slip_ + slip);
    const auto at = [&](double stress) -> Risen {
      const double tangent = barton_bandis_dilation(p_, over, 0.5 * (now.stress + stress), strength_factor_);
      const double grown = now.rise_there - now.rise + tangent * further;
      return {grown, normal_at(overlap_ + grown, bonded)};
    };
    double stress = now.stress;
    Risen risen = at(stress);
    if (over.fraction == 0) return risen;
    double excess = risen.normal.stress - stress;
    double low = std::min(stress, risen.normal.stress), high = std::max(stress, risen.normal.stress);
    double next = risen.normal.stress;
    constexpr int limit = 2 * std::numeric_limits<double>::digits;
    for (int i = 0; i < limit && std::abs(excess) > 2 * std::numeric_limits<double>::epsilon() * stress; ++i) {
      const double last = stress, last_excess = excess;
      stress = next;
      risen = at(stress);
      excess = risen.normal.stress - stress;
      (excess > 0 ? low : high) = stress;
      next = stress - excess * (stress - last) / (excess - last_excess);
      if (!(next > low && next < high)) next = 0.5 * (low + high);
      if (!(next > low && next < high)) break;
    }
    return risen;
  }

  const JointProperties& p_;
  double overlap_, strength_factor_, plastic_slip_, tangent_ = 0, farthest_at_ = 0;
  PlaceOfJoint<Dim> place_;
  OffsetPath path_;  // before it is turned to a direction: of an offset across it
};

// whether slip itself may lower the strength
bool weakens(const JointProperties& p) {
  return p.softens_cohesion() || p.laws.friction == FrictionLaw::softening ||
         (p.follows_barton_bandis() && p.mobilises());
}

// Whether slip back towards the place where the joint was mated lowers its spring's force by more than its strength,
// which falls with the normal stress: the strength's slope is largest at the lowest stress, the spring's at the
// highest. `dashpot`, Pa/m: what the dashpot adds to the normal spring over a step.
template <int Dim>
bool falls_on_the_way_back(const JointProperties& p, const Rising<Dim>& rising, const Risen& begin, double most,
                           double per_area, double coefficient, double dashpot) {
  const double back = std::min(rising.returns_until(), most);
  if (back == 0) return true;
  if (weakens(p)) return false;
  if (p.follows_barton_bandis()) coefficient = std::tan(peak_friction(p, rising.after(back, false).normal.stress));
  return per_area > coefficient * (begin.normal.stiffness + dashpot) * rising.steepest_fall();
}

// The plastic slip of a joint whose rise or whose friction has kinks: the first at which the rest of the trial's force
// is no more than the strength.
template <int Dim, class StrengthAfter>
SlipReturn return_by_first_slip(const JointProperties& p, const Rising<Dim>& rising, double plastic_slip, double trial,
                                double stiffness, double limit, bool falls, const StrengthAfter& strength_after) {
  std::array<double, mobilisation_kinks + 1> kinks{};
  std::size_t count = 0;
  if (p.follows_barton_bandis()) {
    for (const double slip : slips_of_kinks(p))
      kinks[count++] = slip - plastic_slip;
    kinks[count++] = rising.farthest_at();
  }
  const auto excess = [&](double slip) { return trial - stiffness * slip - strength_after(slip); };
  const double noise = std::numeric_limits<double>::epsilon() * trial;
  SlipReturn back;
  back.slip = first_slip(p, rising.path(), {trial / stiffness, trial - limit, noise, falls, std::cref(excess)},
                         std::span(kinks).first(count));
  back.snap_back = (weakens(p) || !falls) && limit - strength_after(0.5 * back.slip) > 0.5 * stiffness * back.slip;
  return back;
}

}  // namespace

template <int Dim>
LawForce<Dim> joint_law(const JointProperties& p, double friction, double dashpot,
                        const JointKinematics<Dim>& kinematics, JointState<Dim>& history, double strength_factor,
                        PlaceOfJoint<Dim> place) {
  Vector<Dim>& shear = history.shear_force;
  const double area = kinematics.area;
  LawForce<Dim> result;
  Rising<Dim> rising(p, kinematics.overlap, friction, strength_factor, history.plastic_slip, place);

  // the normal force; a bond breaks when it is pulled beyond its strength, of which a slipped one has none
  Risen risen = rising.after(0, history.bond == Bond::whole);
  const auto damping_of = [&](const Risen& at) {
    return dashpot * (kinematics.closing_speed + rising.closing_speed(at));
  };
  if (history.bond == Bond::whole && risen.normal.stress * area + damping_of(risen) < -p.tension * area) {
    history.bond = Bond::lost;
    risen = rising.after(0, false);
  }
  const auto normal_force = [&] {
    const double force = risen.normal.stress * area + damping_of(risen);
    return history.bond == Bond::whole ? force : std::max(force, 0.0);
  };
  const auto lose_if_open = [&] {
    if (history.bond == Bond::slipped && !(normal_force() > 0)) history.bond = Bond::lost;
  };
  lose_if_open();

  // at constant shear force the spring's energy changes with its stiffness
  const double per_area = shear_stiffness_at(p, risen.normal.stress), stiffness = per_area * area;
  if (history.shear_stiffness > 0 && per_area > 0 && per_area != history.shear_stiffness)
    result.stiffening = 0.5 * shear.squaredNorm() / area * (1 / history.shear_stiffness - 1 / per_area);
  history.shear_stiffness = per_area;

  // elastic trial; slip takes a bond's tensile strength and, of a brittle one, its cohesion
  const Vector<Dim> old_shear = shear;
  shear -= stiffness * kinematics.slip;
  const double trial = length_of<Dim>(shear);
  const double constant = p.laws.friction == FrictionLaw::constant ? std::tan(friction) : 0;
  const auto coefficient_after = [&](double slip, double stress) {
    if (p.laws.friction == FrictionLaw::constant) return constant;
    return friction_answer(p, friction, history.plastic_slip + slip, stress, strength_factor).coefficient;
  };
  const auto strength = [&] {
    const double cohesion = cohesion_answer(p, history.bond, history.bond_slip, strength_factor).stress;
    return std::max(cohesion * area + coefficient_after(0, risen.normal.stress) * normal_force(), 0.0);
  };
  if (trial > strength()) {
    if (history.bond == Bond::whole) {
      const bool keeps = p.cohesion_law != CohesionLaw::brittle && p.cohesion > 0;
      history.bond = keeps ? Bond::slipped : Bond::lost;
      history.bond_slip = 0;
      risen = rising.after(0, false);
      result.snap_back = keeps && falls_at_once(p);
      lose_if_open();
    }
    double limit = strength();  // after the bond's loss; hardening may leave no slip
    if (stiffness > 0 && trial > limit) {
      SlipReturn back;
      if (rising.changes() || p.follows_barton_bandis()) {
        if (rising.changes()) rising.turn_to(shear / trial);
        const auto strength_after = [&](double slip) {
          const Risen then = rising.after(slip, false);
          const double pressed = std::max(then.normal.stress * area + damping_of(then), 0.0);
          return area * cohesion_answer(p, history.bond, history.bond_slip + slip, strength_factor).stress +
                 coefficient_after(slip, then.normal.stress) * pressed;
        };
        const bool falls = falls_on_the_way_back(p, rising, risen, trial / stiffness, per_area, constant,
                                                 place.seconds > 0 ? dashpot / (place.seconds * area) : 0);
        back = return_by_first_slip(p, rising, history.plastic_slip, trial, stiffness, limit, falls, strength_after);
        risen = rising.after(back.slip, false);
        if (rising.changes()) place.rise->offset += back.slip * (shear / trial);
      } else {
        back = return_to_cone(p, friction, history.plastic_slip, trial, stiffness, normal_force(), risen.normal.stress,
                              strength_factor, {area, history.bond, history.bond_slip});
      }
      result.plastic_slip = back.slip;
      result.snap_back = result.snap_back || back.snap_back;
      history.plastic_slip += back.slip;
      if (history.bond == Bond::slipped) history.bond_slip += back.slip;
      limit = std::min(strength(), trial);
    }
    const Vector<Dim> excess = shear * (1 - limit / trial);
    shear *= limit / trial;
    if (stiffness > 0) result.friction = std::max(0.5 * (old_shear + shear).dot(excess) / stiffness, 0.0);
  }
  result.force = normal_force() * kinematics.normal + shear;
  result.dashpot = normal_force() - risen.normal.stress * area;
  result.elastic = risen.normal.energy * area + 0.5 * risen.normal.stiffness * area * kinematics.overlap_variance;
  if (stiffness > 0) result.elastic += 0.5 * shear.squaredNorm() / stiffness;
  if (place.rise) rising.settle(risen, area, result);
  // the mean of the shear forces does not see that a joint slips at its strength only: slip never gives energy
  if (rising.changes()) result.friction = std::max(result.friction, -result.dilation);
  return result;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                            \
  template LawForce<Dim> joint_law<Dim>(const JointProperties&, double, double, const JointKinematics<Dim>&, \
                                        JointState<Dim>&, double, PlaceOfJoint<Dim>);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
