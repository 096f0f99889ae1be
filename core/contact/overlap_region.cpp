#include "core/contact/overlap_region.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>

#include "core/geometry/half_space_inl.hpp"
#include "core/geometry/polytope.hpp"
#include "core/geometry/surface.hpp"
#include "core/solvers/analytic_centre.hpp"

namespace voussoir {
namespace {

// the analytic centre only shows the region's shape: a tenth of the region is near enough
constexpr double near_the_centre = 0.1;
constexpr int newton_limit = 200;

// at the centre itself the ball's radius is less than the number of planes; so near to it, less than twice that
constexpr double clearance = 2;

// Axes in which the region is about a ball: columns are the units, m. The barrier's Hessian Σ p pᵀ, p = a/s, at the
// centre is an ellipsoid inside the region that, times the number of planes, contains it (Boyd & Vandenberghe
// 2004, 8.5.3); by QR of the rows p it is PRᵀRPᵀ, so that x = P R⁻¹ y makes it the unit ball. False when the region is
// open.
template <int Dim>
bool ball_axes(const HalfSpaces<Dim>& planes, const Vector<Dim>& centre, Matrix<Dim>& axes) {
  Eigen::Matrix<double, Eigen::Dynamic, Dim> rows(planes.size(), Dim);
  for (std::size_t i = 0; i < planes.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i)) = planes[i].normal.transpose() / -signed_distance(planes[i], centre);
  const Eigen::ColPivHouseholderQR<decltype(rows)> qr(rows);
  const Matrix<Dim> factor = qr.matrixR().topRows(Dim);
  if (!(std::abs(factor(Dim - 1, Dim - 1)) > 0)) return false;
  const Matrix<Dim> inverse =
      factor.template triangularView<Eigen::Upper>().solve(Matrix<Dim>(Matrix<Dim>::Identity()));
  axes = qr.colsPermutation() * inverse;
  return true;
}

}  // namespace

template <int Dim>
bool overlap_region(const HalfSpaces<Dim>& planes, const Vector<Dim>& inside, OverlapRegion<Dim>& region) {
  HalfSpaces<Dim> near;
  for (const HalfSpace<Dim>& p : planes)
    near.push_back(moved_origin(p, inside));
  const CentreResult<Dim> centre =
      solve_analytic_centre<Dim>(near, {Vector<Dim>::Zero(), near_the_centre, newton_limit});
  Matrix<Dim> axes;
  if (centre.status != CentreStatus::converged || !ball_axes<Dim>(near, centre.point, axes)) return false;

  // Normals are turned before they are divided: opposite faces stay opposite, and a flat region keeps its thickness.
  // Planes beyond the ball around the region do not bound it.
  const double outside = clearance * static_cast<double>(planes.size());
  HalfSpaces<Dim> round;
  for (const HalfSpace<Dim>& p : near) {
    const Vector<Dim> turned = axes.transpose() * p.normal;
    const double length = turned.norm();
    const double distance = -signed_distance(p, centre.point) / length;
    if (distance < outside) round.push_back({turned / length, distance});
  }
  const Surface<Dim> surface = find_surface<Dim>(round, 0);
  if (surface.status != SurfaceStatus::ok) return false;
  const MassProperties<Dim> mass = integrate<Dim>(surface.vertices, surface.loops);
  region.centroid = inside + (centre.point + axes * mass.centroid);
  region.volume = mass.volume * std::abs(axes.determinant());
  return true;
}

template bool overlap_region<2>(const HalfSpaces<2>&, const Vector<2>&, OverlapRegion<2>&);
template bool overlap_region<3>(const HalfSpaces<3>&, const Vector<3>&, OverlapRegion<3>&);

}  // namespace voussoir
