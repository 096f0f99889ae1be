#include "core/law/elastic_coulomb.hpp"

#include <algorithm>
#include <cmath>

namespace voussoir {

Vector<2> carried(const Vector<2>& shear, const Vector<2>& old_normal, const Vector<2>& normal, double) {
  // in the plane a shear force is a number along the tangent
  return perpendicular(old_normal).dot(shear) * perpendicular(normal);
}

Vector<3> carried(const Vector<3>& shear, const Vector<3>& old_normal, const Vector<3>& normal, double turn) {
  const double length = shear.norm();
  if (length == 0) return Vector<3>::Zero();
  // rotation that takes the old normal to the new; normals that point apart by more than a right angle belong to
  // different contacts, and the force is only projected
  Vector<3> turned = shear;
  const double cosine = old_normal.dot(normal);
  if (cosine > 0) {
    const Vector<3> axis = old_normal.cross(normal);
    turned += axis.cross(shear) + axis.cross(axis.cross(shear)) / (1 + cosine);
  }
  if (turn != 0) turned = std::cos(turn) * turned + std::sin(turn) * normal.cross(turned);
  turned -= normal.dot(turned) * normal;
  const double new_length = turned.norm();
  return new_length > 0 ? Vector<3>(turned * (length / new_length)) : Vector<3>(Vector<3>::Zero());
}

template <int Dim>
JointForce<Dim> elastic_coulomb(const JointProperties& properties, double friction, double dashpot,
                                const JointKinematics<Dim>& kinematics, Vector<Dim>& shear) {
  const double normal_stiffness = properties.normal_stiffness * kinematics.area;
  const double shear_stiffness = properties.shear_stiffness * kinematics.area;
  const double spring = normal_stiffness * kinematics.overlap;
  const double normal_force = std::max(0.0, spring + dashpot * kinematics.closing_speed);

  // elastic trial, then return to the cone along the trial's direction
  JointForce<Dim> result;
  const Vector<Dim> old_shear = shear;
  shear -= shear_stiffness * kinematics.slip;
  const double limit = std::tan(friction) * normal_force, trial = shear.norm();
  if (trial > limit) {
    const Vector<Dim> excess = shear * (1 - limit / trial);
    shear *= limit / trial;
    if (shear_stiffness > 0) {
      result.plastic_slip = (trial - limit) / shear_stiffness;
      result.friction = 0.5 * (old_shear + shear).dot(excess) / shear_stiffness;
    }
  }
  result.force = normal_force * kinematics.normal + shear;
  result.dashpot = normal_force - spring;
  result.elastic = 0.5 * spring * kinematics.overlap;
  if (shear_stiffness > 0) result.elastic += 0.5 * shear.squaredNorm() / shear_stiffness;
  return result;
}

template JointForce<2> elastic_coulomb<2>(const JointProperties&, double, double, const JointKinematics<2>&,
                                          Vector<2>&);
template JointForce<3> elastic_coulomb<3>(const JointProperties&, double, double, const JointKinematics<3>&,
                                          Vector<3>&);

}  // namespace voussoir
