#include "core/step/face_forces.hpp"

#include <algorithm>
#include <cmath>

#include "core/joint_laws/elastic_coulomb.hpp"

namespace voussoir {
template <int Dim>
double held(const JointState<Dim>& h, double shear_stiffness) {
  if (!(shear_stiffness > 0)) return 0;
  double energy = 0;
  if (h.area > 0) energy += 0.5 * h.shear_force.squaredNorm() / (shear_stiffness * h.area);
  if (h.polar > 0) energy += 0.5 * h.twist * h.twist / (shear_stiffness * h.polar);
  return energy;
}

template <int Dim>
void change_area(const Vector<Dim>& normal, const Vector<Dim>& apart, double area, double polar, JointState<Dim>& h) {
  if constexpr (Dim == 3) {
    // rotation moves the new centre, and moments refer to it
    const double turn = h.polar > 0 ? h.twist / h.polar : 0;
    const Vector<3> across = normal.cross(apart);
    if (area < h.area)
      h.shear_force = area / h.area * h.shear_force + turn * area * across;
    else
      h.twist -= h.shear_force.dot(across);
    if (!(polar > 0))
      h.twist = 0;
    else if (polar < h.polar)
      h.twist *= polar / h.polar;
  } else if (area < h.area) {
    h.shear_force *= area / h.area;
  }
  h.area = area;
  h.polar = polar;
}

namespace {

double about_normal(const Vector<3>& normal, const Spin<3>& spin) {
  return normal.dot(spin);
}
double about_normal(const Vector<2>&, const Spin<2>&) {
  return 0;
}

Spin<3> twist_moment(double twist, const Vector<3>& normal) {
  return twist * normal;
}
Spin<2> twist_moment(double, const Vector<2>&) {
  return Spin<2>::Zero();
}

// limits shear and twist by Coulomb friction, and returns the energy of slip
template <int Dim>
double slip(const IntegratedContact<Dim>& face, double shear_stiffness, double limit, const Vector<Dim>& shear_before,
            double twist_before, JointState<Dim>& h, Vector<3>* slip_normal) {
  Vector<Dim> way = Vector<Dim>::Zero();
  double turn = 0;
  if constexpr (Dim == 3) {
    if (face.polar > 0) {
      const double ks_area = shear_stiffness * h.area, ks_polar = shear_stiffness * h.polar;
      const Vector<2> shear = face.polygon.axes.transpose() * h.shear_force;
      const bool known = slip_normal && !slip_normal->isZero(0);
      const FaceSlip s = known ? return_near(face.polygon, limit, ks_area, ks_polar, shear, h.twist, *slip_normal)
                               : return_to_limit(face.polygon, limit, ks_area, ks_polar, shear, h.twist);
      if (slip_normal) *slip_normal = s.normal;
      way = face.polygon.axes * s.slip;
      turn = s.turn;
      if (way.isZero(0) && turn == 0) return 0;  // no slip
      h.shear_force = face.polygon.axes * s.force;
      h.twist = s.moment;
      h.plastic_slip += way.norm();
      return std::max(0.5 * (shear_before + h.shear_force).dot(way) + 0.5 * (twist_before + h.twist) * turn, 0.0);
    }
  }
  const double trial = length_of<Dim>(h.shear_force);
  if (!(trial > limit)) return 0;
  way = (1 - limit / trial) / (shear_stiffness * h.area) * h.shear_force;
  h.shear_force *= limit / trial;
  h.plastic_slip += way.norm();
  return std::max(0.5 * (shear_before + h.shear_force).dot(way), 0.0);
}

}  // namespace

template <int Dim>
FaceForce<Dim> face_force(const JointProperties& properties, double friction, double dashpot, double time_step,
                          const PairMotion<Dim>& motion, const ContactGeometry<Dim>& geometry,
                          const IntegratedContact<Dim>& face, JointState<Dim>& h, Vector<3>* slip_normal) {
  const double kn = properties.normal_stiffness, ks = properties.shear_stiffness, dt = time_step;
  const Vector<Dim>& n = face.normal;
  const Vector<Dim> velocity = motion.velocity_at(face.centre);
  const double closing = -velocity.dot(n);
  const Spin<Dim> spin = motion.spin_b - motion.spin_a;
  FaceForce<Dim> answer;

  // The slip of the last step, half of it at the old position of the contact and half at the new one, so that the old
  // and the new force each do half of the work; a new contact slips for the time that it has been closed.
  Vector<Dim> way = velocity + closing * n;
  double turn = about_normal(n, spin) * dt, closing_before = 0;
  if (!h.normal.isZero(0)) {
    const Vector<Dim> before = motion.velocity_before_at(h.point, dt);
    closing_before = -before.dot(h.normal);
    const double turned = 0.5 * about_normal(n, motion.spin_a + motion.spin_b) * dt;
    way = 0.5 * dt * (way + carried(Vector<Dim>(before + closing_before * h.normal), h.normal, n, turned));
    turn = 0.5 * (turn + about_normal(h.normal, spin) * dt);
    const double was = held(h, ks), twist = h.twist;
    const Vector<Dim> shear = carried(h.shear_force, h.normal, n, turned);
    h.shear_force = shear;
    // the old centre, displaced with both bodies
    const Vector<Dim> gone = dt * (cross(motion.spin_a, h.point) + 0.5 * before);
    change_area<Dim>(n, face.centre - h.point - gone, geometry.area, face.polar, h);
    answer.lost_area = was - held(h, ks) - 0.5 * ((shear - h.shear_force).dot(way) + (twist - h.twist) * turn);
  } else {
    const double closed = -motion.velocity_at(geometry.point).dot(geometry.normal) * dt;
    const double since = closed > geometry.overlap ? geometry.overlap / closed : 1;
    way *= since * dt;
    turn *= since;
    h.area = geometry.area;
    h.polar = face.polar;
  }

  const double spring = kn * face.force.norm(), pressed = std::max(spring + dashpot * closing, 0.0);
  const Vector<Dim> shear_before = h.shear_force;
  const double twist_before = h.twist;
  h.shear_force -= ks * h.area * way;
  if (h.polar > 0) h.twist -= ks * h.polar * turn;
  if (ks > 0) {
    answer.friction = slip(face, ks, friction * pressed, shear_before, twist_before, h, slip_normal);
  } else {
    h.shear_force.setZero();
    h.twist = 0;
  }

  const Vector<Dim> of_springs = kn * face.force, at_centre = h.shear_force + (pressed - spring) * n;
  answer.force = of_springs + at_centre;
  answer.about =
      moment(geometry.point, of_springs) + kn * face.couple + moment(face.centre, at_centre) + twist_moment(h.twist, n);
  answer.elastic = 0.5 * kn * face.square + held(h, ks);
  answer.dashpots = 0.5 * (h.dashpot * closing_before + (pressed - spring) * closing) * dt;
  h.normal = n;
  h.point = face.centre;
  h.dashpot = pressed - spring;
  return answer;
}

template double held<2>(const JointState<2>&, double);
template double held<3>(const JointState<3>&, double);
template void change_area<2>(const Vector<2>&, const Vector<2>&, double, double, JointState<2>&);
template void change_area<3>(const Vector<3>&, const Vector<3>&, double, double, JointState<3>&);
template FaceForce<2> face_force<2>(const JointProperties&, double, double, double, const PairMotion<2>&,
                                    const ContactGeometry<2>&, const IntegratedContact<2>&, JointState<2>&, Vector<3>*);
template FaceForce<3> face_force<3>(const JointProperties&, double, double, double, const PairMotion<3>&,
                                    const ContactGeometry<3>&, const IntegratedContact<3>&, JointState<3>&, Vector<3>*);

}  // namespace voussoir
