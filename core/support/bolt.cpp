#include "core/support/bolt.hpp"

#include <algorithm>
#include <cmath>

namespace voussoir {
namespace {

// the direction in which a spring pulls on its first block, unit
template <int Dim>
Vector<Dim> direction_of(const Vector<Dim>& apart, const BoltSpring<Dim>& spring) {
  const double distance = apart.norm();
  if (spring.length == 0 || !(distance > 0)) return spring.axis;
  return (spring.axis.dot(apart) < 0 ? -1 / distance : 1 / distance) * apart;
}

template <int Dim>
Vector<Dim> across(const Vector<Dim>& apart, const BoltSpring<Dim>& spring) {
  return apart - spring.axis.dot(apart) * spring.axis;
}

template <int Dim>
bool yields(const BoltProperties& p, const BoltSpring<Dim>& spring) {
  return (p.yield && std::abs(spring.force) >= *p.yield) || (p.tension_only && spring.force == 0);
}

}  // namespace

double transfer_length(const BoltProperties& p) {
  return std::sqrt(p.axial_stiffness / p.bond_stiffness);
}

double node_spacing(const BoltProperties& p, double length) {
  constexpr double of_transfer_length = 0.2, of_length = 1.0 / 200;
  return p.node_spacing.value_or(std::max(of_transfer_length * transfer_length(p), of_length * length));
}

template <int Dim>
BoltAnswer<Dim> bolt_answer(const BoltProperties& p, const Vector<Dim>& apart, BoltSpring<Dim>& spring) {
  BoltAnswer<Dim> answer;
  const Vector<Dim> direction = direction_of(apart, spring);
  spring.extension = direction.dot(apart) - spring.length;
  if (spring.broken) return answer;

  spring.force = spring.stiffness * (spring.extension - spring.plastic) + p.pretension;
  if (p.tension_only && spring.force < 0) spring.force = 0;
  if (p.yield && std::abs(spring.force) > *p.yield) {
    const double held = std::copysign(*p.yield, spring.force), more = (spring.force - held) / spring.stiffness;
    spring.plastic += more;
    spring.force = held;
    answer.lost += held * more;
  }
  spring.shear.setZero();
  if (p.dowel_stiffness > 0) {
    spring.shear = p.dowel_stiffness * (across(apart, spring) - spring.slip);
    const double size = spring.shear.norm();
    if (p.dowel_strength && size > *p.dowel_strength) {
      const Vector<Dim> held = (*p.dowel_strength / size) * spring.shear;
      const Vector<Dim> more = (spring.shear - held) / p.dowel_stiffness;
      spring.slip += more;
      spring.shear = held;
      answer.lost += held.dot(more);
    }
    answer.elastic = spring.shear.squaredNorm() / (2 * p.dowel_stiffness);
  }
  answer.elastic += spring.force * spring.force / (2 * spring.stiffness);
  if (p.rupture_extension && spring.plastic > *p.rupture_extension) {
    answer.lost += answer.elastic;
    answer.elastic = spring.force = 0;
    spring.shear.setZero();
    spring.broken = true;
  }
  answer.on_second = -(spring.force * direction + spring.shear);
  return answer;
}

template <int Dim>
Matrix<Dim> bolt_stiffness(const BoltProperties& p, const Vector<Dim>& apart, const BoltSpring<Dim>& spring) {
  if (spring.broken) return Matrix<Dim>::Zero();
  const Vector<Dim> u = direction_of(apart, spring);
  const Matrix<Dim> along = u * u.transpose(), one = Matrix<Dim>::Identity();
  Matrix<Dim> stiffness = Matrix<Dim>::Zero();
  if (!yields(p, spring)) stiffness = spring.stiffness * along;
  if (spring.length > 0) stiffness += spring.force / u.dot(apart) * (one - along);
  if (p.dowel_stiffness > 0 && !(p.dowel_strength && spring.shear.norm() >= *p.dowel_strength))
    stiffness += p.dowel_stiffness * (one - spring.axis * spring.axis.transpose());
  return stiffness;
}

template <int Dim>
double stiffest(const BoltProperties& p, const BoltSpring<Dim>& spring) {
  if (spring.broken) return 0;
  const double by_turning = spring.length > 0 ? std::abs(spring.force) / spring.length : 0;
  return spring.stiffness + p.dowel_stiffness + by_turning;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                              \
  template BoltAnswer<Dim> bolt_answer<Dim>(const BoltProperties&, const Vector<Dim>&, BoltSpring<Dim>&);      \
  template Matrix<Dim> bolt_stiffness<Dim>(const BoltProperties&, const Vector<Dim>&, const BoltSpring<Dim>&); \
  template double stiffest<Dim>(const BoltProperties&, const BoltSpring<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
