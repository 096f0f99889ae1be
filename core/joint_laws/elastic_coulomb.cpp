#include "core/joint_laws/elastic_coulomb.hpp"

#include <algorithm>
#include <cmath>

namespace voussoir {

namespace {

// squares of lengths between these are numbers, and sums of them too
constexpr double least_squared = 1e-140, most_squared = 1e140;

bool squares(double length) {
  return length > least_squared && length < most_squared;
}

}  // namespace

template <int Dim>
double length_of(const Vector<Dim>& v) {
  const double largest = v.cwiseAbs().maxCoeff();
  if (squares(largest)) return v.norm();
  return largest > 0 ? largest * (v / largest).norm() : 0;
}
template double length_of<2>(const Vector<2>&);
template double length_of<3>(const Vector<3>&);

namespace {

// The difference of the lengths' squares is taken as (a - b)·(a + b), where nothing cancels, and added as a correction:
// the quotient of the two lengths is rounded so unevenly that a force transported round once in 1e6 steps would return
// longer by 1e-11.
template <int Dim>
Vector<Dim> corrected(const Vector<Dim>& shear, const Vector<Dim>& turned) {
  const double excess = (shear - turned).dot(shear + turned) / turned.squaredNorm();  // |a|²/|b|² - 1
  return turned + excess / (1 + std::sqrt(1 + excess)) * turned;
}

// gives `turned` the length of `shear`, from which it differs by rounding
template <int Dim>
Vector<Dim> with_length_of(const Vector<Dim>& shear, const Vector<Dim>& turned) {
  const double scale = turned.cwiseAbs().maxCoeff();
  if (squares(scale)) return corrected(shear, turned);
  if (scale == 0) return Vector<Dim>::Zero();
  return scale * corrected<Dim>(shear / scale, turned / scale);
}

// below it the series is exact to rounding
constexpr double small_turn = 1e-3;

// v turned about an axis across it
Vector<3> turned_about(const Vector<3>& axis, double angle, const Vector<3>& v) {
  if (angle == 0) return v;
  const double square = angle * angle;
  const bool small = std::abs(angle) < small_turn;
  const double cosine = small ? 1 - square * (0.5 - square * (1.0 / 24)) : std::cos(angle);
  const double sine = small ? angle * (1 - square * (1.0 / 6 - square * (1.0 / 120))) : std::sin(angle);
  return cosine * v + sine * axis.cross(v);
}

}  // namespace

Vector<2> carried(const Vector<2>& shear, const Vector<2>& old_normal, const Vector<2>& normal, double) {
  // in the plane a shear force is a number along the tangent; a normal is a unit vector up to rounding only
  const Vector<2> turned = perpendicular(old_normal).dot(shear) * perpendicular(normal);
  return with_length_of<2>(shear, turned);
}

Vector<3> carried(const Vector<3>& shear, const Vector<3>& old_normal, const Vector<3>& normal, double turn) {
  if (shear.isZero(0)) return Vector<3>::Zero();
  // rotation that takes the old normal to the new; normals that point apart by more than a right angle belong to
  // different contacts, and the force is only projected
  Vector<3> turned = shear;
  const double cosine = old_normal.dot(normal);
  if (cosine > 0) {
    const Vector<3> axis = old_normal.cross(normal);
    const Vector<3> across = axis.cross(shear);
    turned += across + 1 / (1 + cosine) * axis.cross(across);
  }
  turned = turned_about(normal, turn, turned);
  turned -= normal.dot(turned) * normal;
  return with_length_of<3>(shear, turned);
}

template <int Dim>
JointForce<Dim> elastic_coulomb(const JointProperties& properties, double coefficient, double dashpot,
                                const JointKinematics<Dim>& kinematics, Vector<Dim>& shear) {
  const double normal_stiffness = properties.normal_stiffness * kinematics.area * kinematics.stiffness_factor;
  const double shear_stiffness = properties.shear_stiffness * kinematics.area;
  const double spring = normal_stiffness * kinematics.overlap;
  const double normal_force = std::max(spring + dashpot * kinematics.closing_speed, 0.0);  // a NaN stays one

  // elastic trial, then return to the cone along the trial's direction
  JointForce<Dim> result;
  const Vector<Dim> old_shear = shear;
  shear -= shear_stiffness * kinematics.slip;
  const double limit = coefficient * normal_force, trial = length_of<Dim>(shear);
  if (trial > limit) {
    const Vector<Dim> excess = shear * (1 - limit / trial);
    shear *= limit / trial;
    if (shear_stiffness > 0) {
      result.plastic_slip = (trial - limit) / shear_stiffness;
      result.friction = std::max(0.5 * (old_shear + shear).dot(excess) / shear_stiffness, 0.0);
    }
  }
  result.force = normal_force * kinematics.normal + shear;
  result.dashpot = normal_force - spring;
  result.elastic = 0.5 * (spring * kinematics.overlap + normal_stiffness * kinematics.overlap_variance);
  if (shear_stiffness > 0) result.elastic += 0.5 * shear.squaredNorm() / shear_stiffness;
  return result;
}

template JointForce<2> elastic_coulomb<2>(const JointProperties&, double, double, const JointKinematics<2>&,
                                          Vector<2>&);
template JointForce<3> elastic_coulomb<3>(const JointProperties&, double, double, const JointKinematics<3>&,
                                          Vector<3>&);

}  // namespace voussoir
