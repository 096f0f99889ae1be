#include "core/solvers/weighted_centre.hpp"

#include <algorithm>
#include <vector>

#include "core/geometry/half_space_inl.hpp"
#include "core/solvers/symmetric_system.hpp"

namespace voussoir {
namespace {

template <int Dim>
const Vector<Dim>& largest(const std::vector<Vector<Dim>>& vectors) {
  return *std::max_element(vectors.begin(), vectors.end(), [](const Vector<Dim>& a, const Vector<Dim>& b) {
    return a.squaredNorm() < b.squaredNorm();
  });
}

// Axes fitted to the scaled normals p = a/s: the first along the largest, the second along the largest remainder. In
// these axes the Hessian Σ p pᵀ is graded, so that factorising it top down loses nothing, even if the region is thin in
// one direction (face on face) or in two (edge along edge).
Matrix<2> graded_frame(const std::vector<Vector<2>>& scaled) {
  const Vector<2> first = largest(scaled).normalized();
  Matrix<2> frame;
  frame << first.transpose(), perpendicular(first).transpose();
  return frame;
}

Matrix<3> graded_frame(const std::vector<Vector<3>>& scaled) {
  const Vector<3> first = largest(scaled).normalized();
  Vector<3> remainder = Vector<3>::Zero();
  for (const Vector<3>& p : scaled) {
    const Vector<3> r = p - first.dot(p) * first;
    if (r.squaredNorm() > remainder.squaredNorm()) remainder = r;
  }
  remainder -= first.dot(remainder) * first;
  const Vector<3> second = remainder.squaredNorm() > 0 ? Vector<3>(remainder.normalized()) : perpendicular(first);
  Matrix<3> frame;
  frame << first.transpose(), second.transpose(), first.cross(second).transpose();
  return frame;
}

// work arrays kept between calls: the step allocates nothing
template <int Dim>
struct Workspace {
  std::vector<Vector<Dim>> scaled;  // a/s
  std::vector<Vector<Dim>> turned;  // a in the graded frame
  std::vector<double> slacks;
};

}  // namespace

template <int Dim>
CentreResult<Dim> solve_weighted_centre(const HalfSpaces<Dim>& planes, std::span<const double> weights,
                                        const CentreRequest<Dim>& request) {
  static thread_local Workspace<Dim> work;
  const std::size_t count = planes.size();
  work.scaled.resize(count);
  work.turned.resize(count);
  work.slacks.resize(count);

  CentreResult<Dim> result;
  for (std::size_t i = 0; i < count; ++i) {
    work.slacks[i] = -signed_distance(planes[i], request.start);
    if (!(work.slacks[i] > 0)) {
      result.status = CentreStatus::start_not_interior;
      return result;
    }
  }

  // A slack changes by at most the decrement over the root of its weight, relative to itself: the bound on the
  // decrement's square is applied to the smallest of them.
  const double least_weight = weights.empty() ? 1 : *std::min_element(weights.begin(), weights.end());
  Vector<Dim> moved = Vector<Dim>::Zero();
  Matrix<Dim> frame;
  bool settled = false;  // near the centre the frame is kept: a new one rounds again, which thin regions magnify
  for (; result.iterations < request.limit; ++result.iterations) {
    if (!settled) {
      for (std::size_t i = 0; i < count; ++i)
        work.scaled[i] = planes[i].normal / work.slacks[i];
      frame = graded_frame(work.scaled);
      for (std::size_t i = 0; i < count; ++i)
        work.turned[i] = frame * planes[i].normal;
    }

    // gradient and Hessian of -Σ w log s, and Newton's step
    Vector<Dim> gradient = Vector<Dim>::Zero();
    Matrix<Dim> hessian = Matrix<Dim>::Zero();
    for (std::size_t i = 0; i < count; ++i) {
      const Vector<Dim> p = work.scaled[i] = work.turned[i] / work.slacks[i];
      if (weights.empty()) {
        gradient += p;
        hessian += p * p.transpose();
      } else {
        const Vector<Dim> weighted = weights[i] * p;
        gradient += weighted;
        hessian += weighted * p.transpose();
      }
    }
    Vector<Dim> step = -gradient;
    if (!solve_symmetric<Dim>(hessian, step)) {
      result.status = CentreStatus::singular;
      return result;
    }

    // a full step when it is safe, else the largest whose slacks provably stay positive
    const double decrement = -gradient.dot(step);
    double length = 1;
    settled = decrement < full_step_decrement * least_weight;
    if (!settled) {
      double steepest = 0;
      for (std::size_t i = 0; i < count; ++i)
        steepest = std::max(steepest, work.scaled[i].dot(step));
      length = 1 / (1 + steepest);
    }
    double least = 1;  // smallest ratio of a new slack to its old value
    for (std::size_t i = 0; i < count; ++i) {
      const double ratio = 1 - length * work.scaled[i].dot(step);
      work.slacks[i] *= ratio;
      least = std::min(least, ratio);
    }
    moved += length * (frame.transpose() * step);

    // a decrement that is negative or a slack that vanished looks like convergence and is not
    if (!(decrement >= -1e-12) || !(least > 0)) {
      result.status = CentreStatus::singular;
      return result;
    }
    if (decrement <= request.tolerance * request.tolerance * least_weight) {
      ++result.iterations;
      result.point = request.start + moved;
      // in a region as thin as the coordinates' rounding the point itself may round to the outside
      const bool inside = std::all_of(planes.begin(), planes.end(),
                                      [&](const HalfSpace<Dim>& p) { return signed_distance(p, result.point) < 0; });
      result.status = inside ? CentreStatus::converged : CentreStatus::singular;
      return result;
    }
  }
  return result;
}

template <int Dim>
CentreResult<Dim> solve_analytic_centre(const HalfSpaces<Dim>& planes, const CentreRequest<Dim>& request) {
  return solve_weighted_centre<Dim>(planes, {}, request);
}

template CentreResult<2> solve_weighted_centre<2>(const HalfSpaces<2>&, std::span<const double>,
                                                  const CentreRequest<2>&);
template CentreResult<3> solve_weighted_centre<3>(const HalfSpaces<3>&, std::span<const double>,
                                                  const CentreRequest<3>&);
template CentreResult<2> solve_analytic_centre<2>(const HalfSpaces<2>&, const CentreRequest<2>&);
template CentreResult<3> solve_analytic_centre<3>(const HalfSpaces<3>&, const CentreRequest<3>&);

}  // namespace voussoir
