#include "core/implicit/point_law.hpp"

#include <algorithm>
#include <cmath>

namespace voussoir {
namespace {

// of the stiffness: the slope of a point that begins to press from a gap without any loss
constexpr double least_slope = 1e-9;

// of slip and elastic slip: a plastic slip below it is none
constexpr double hardly_slips = 1e-9;

double pressed(double overlap) {
  return std::max(overlap, 0.0);
}

}  // namespace

double unresolved_share(double stiffness, double mass, double h) {
  const double y2 = 0.25 * h * h * stiffness / mass;
  return y2 / (1 + y2);
}

double softer_of(double stiffness, double mass, double h) {
  return 1 / (h * h / mass + 1 / stiffness);
}

MeanNormal mean_normal(const PointStep& point, double u1) {
  const double k = point.normal, d = point.loss(), u0 = point.overlap;
  double force = d * (pressed(u1) - pressed(u0)), slope = u1 > 0 ? d : 0;
  if (u0 >= 0 && u1 >= 0) {
    force += 0.5 * k * (u0 + u1);
    slope += 0.5 * k;
  } else if (u0 < 0 && u1 > 0) {
    force += 0.5 * k * u1 * u1 / (u1 - u0);
    slope += 0.5 * k * u1 * (u1 - 2 * u0) / ((u1 - u0) * (u1 - u0));
  } else if (u0 > 0) {
    force += 0.5 * k * u0 * u0 / (u0 - u1);
    slope += 0.5 * k * u0 * u0 / ((u0 - u1) * (u0 - u1));
  }
  return force > 0 ? MeanNormal{force, slope} : MeanNormal{};
}

OverlapAfter overlap_after(const PointStep& point, double force) {
  const double half = 0.5 * point.normal, d = point.loss(), u0 = point.overlap;
  if (u0 < 0 && force == 0) return {0, d};
  if (u0 < 0) {
    // (k/2 + D) u1² - (D u0 + N) u1 + N u0 = 0: the positive root
    const double a = half + d, b = d * u0 + force, root = std::sqrt(b * b - 4 * a * force * u0);
    const double u1 = b > 0 ? (b + root) / (2 * a) : 2 * force * u0 / (b - root);
    return {u1, half * u1 * (u1 - 2 * u0) / ((u1 - u0) * (u1 - u0)) + d};
  }
  const double u1 = (force - (half - d) * u0) / (half + d);
  if (u1 >= 0) return {u1, half + d};
  const double way = half * u0 * u0 / (force + d * u0);  // u0 - u1
  return {u0 - way, half * u0 * u0 / (way * way)};
}

namespace {

// The normal equation about the present force: slope dN/du1 and the change that a further motion of none asks for.
// Where a contact opens, u1 runs away as the force falls, and the equation is taken without its denominator.
struct LinearNormal {
  bool presses = false;
  double slope = 0, change = 0;  // N/m, N
  double overlap_error = 0;      // m
};
LinearNormal linear_normal(const PointStep& point, double u1, double force) {
  const double half = 0.5 * point.normal, d = point.loss(), u0 = point.overlap, present = std::max(force, 0.0);
  LinearNormal line;
  const bool opens = u0 > 0 && present < (half - d) * u0;
  const double drop = present + d * u0;
  const bool runs_away = opens && !(drop > 0);
  const OverlapAfter now = runs_away ? OverlapAfter{} : overlap_after(point, present);
  line.presses = runs_away || force - point.rho_normal * (now.overlap - u1) > 0;
  if (!line.presses) return line;
  if (opens && u0 > u1) {
    line.slope = drop / (u0 - u1);
    line.change = half * u0 * u0 / (u0 - u1) - drop;
    line.overlap_error = line.slope > 0 ? std::abs(line.change) / line.slope : u0;
  } else if (opens) {
    line.slope = half + d;
    line.change = half * (u0 + u1) + d * (u1 - u0) - force;
    line.overlap_error = std::abs(line.change) / line.slope;
  } else {
    line.slope = std::max(now.slope, least_slope * point.normal);
    line.change = line.slope * (u1 - now.overlap) + present - force;
    line.overlap_error = std::abs(u1 - now.overlap);
  }
  return line;
}

}  // namespace

template <int Dim>
LinearPoint<Dim> linearise(const PointStep& point, const Vector<Dim>& n, const Vector<Dim>& from, double u1,
                           const Vector<Dim>& slip, const PointForce<Dim>& force) {
  LinearPoint<Dim> line;
  const LinearNormal normal = linear_normal(point, u1, force.normal);
  if (!normal.presses) {  // no force
    line.change = -force.normal * n - force.shear;
    return line;
  }
  line.presses = true;
  line.overlap_error = normal.overlap_error;
  line.slope = normal.slope * n * n.transpose();
  line.change = normal.change * n;

  // ---- shear
  const double k = point.sticking();
  if (!(k > 0)) {
    line.change -= force.shear;
    return line;
  }
  const Matrix<Dim> across = Matrix<Dim>::Identity() - n * n.transpose();
  const Vector<Dim> e = (from - force.shear) / k - slip;
  const Vector<Dim> trial = force.shear + point.rho_shear * e;
  const double most = point.friction * std::max(force.normal, 0.0), size = trial.norm();
  line.sticks = size <= most;
  if (line.sticks) {
    line.slip_error = e.norm();
    line.slope += k * across;
    line.change += k * e;
    return line;
  }
  const Vector<Dim> t = trial / size;
  const Matrix<Dim> side = across - t * t.transpose();
  const double alpha = most / size, beta = alpha * (1 - point.rho_shear / k);
  // (I - β P) dT = (μN t - T) + μ t dN - α ρ P δ, P across the slip
  const Vector<Dim> apart = most * t - force.shear;
  line.slip_error = apart.norm() / k;
  line.change += apart + beta / (1 - beta) * (side * apart) + point.friction * normal.change * t;
  line.slope += point.friction * normal.slope * t * n.transpose() + alpha * point.rho_shear / (1 - beta) * side;
  return line;
}

template <int Dim>
PointEnd<Dim> end_of_step(const PointStep& point, const Vector<Dim>& from, double u1, const Vector<Dim>& slip,
                          const PointForce<Dim>& force) {
  PointEnd<Dim> end;
  const double p0 = pressed(point.overlap), p1 = pressed(u1), grown = p1 - p0, closed = u1 - point.overlap;
  const double ks = point.shear;
  end.elastic_before = 0.5 * point.normal * p0 * p0 + (ks > 0 ? 0.5 * from.squaredNorm() / ks : 0);
  end.elastic = 0.5 * point.normal * p1 * p1;
  // what the normal force did beyond the change of the spring's energy, also where it was cut at zero
  const double lost = force.normal * closed - 0.5 * point.normal * (p1 * p1 - p0 * p0);
  const double by_dashpot = point.dashpot / point.h * grown * closed;
  end.dashpot = std::clamp(by_dashpot, 0.0, std::max(lost, 0.0));
  end.unresolved = lost - end.dashpot;
  if (!(ks > 0)) return end;

  const double k = point.sticking();
  const Vector<Dim> plastic = slip - (from - force.shear) / k;
  end.plastic_slip = plastic.norm();
  end.stuck = force.normal > 0 && end.plastic_slip <= hardly_slips * (slip.norm() + from.norm() / k);
  end.friction = -force.shear.dot(plastic);
  Vector<Dim> after = from + ks / k * (force.shear - from);
  const double most = point.friction * point.normal * p1, size = after.norm();
  if (size > most) after *= most / size;
  end.shear = after;
  const double stored = 0.5 * after.squaredNorm() / ks;
  end.elastic += stored;
  // work on the springs -T·Δ = stored - before + friction + unresolved
  const double by_shear_dashpot = point.shear_dashpot / point.h * (slip - plastic).squaredNorm();
  end.dashpot += by_shear_dashpot;
  end.unresolved += -force.shear.dot(slip) - (stored - 0.5 * from.squaredNorm() / ks) - end.friction - by_shear_dashpot;
  return end;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                            \
  template LinearPoint<Dim> linearise<Dim>(const PointStep&, const Vector<Dim>&, const Vector<Dim>&, double, \
                                           const Vector<Dim>&, const PointForce<Dim>&);                      \
  template PointEnd<Dim> end_of_step<Dim>(const PointStep&, const Vector<Dim>&, double, const Vector<Dim>&,  \
                                          const PointForce<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
