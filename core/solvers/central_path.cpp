#include "core/solvers/central_path.hpp"

#include <algorithm>
#include <vector>

#include "core/geometry/half_space_inl.hpp"
#include "core/solvers/symmetric_system.hpp"

namespace voussoir {
namespace {

template <int Size>
using Row = FixedMatrix<Size, 1>;

// Axes fitted to the rows: each along the largest remainder that the axes before it leave. In these axes the Hessian
// Σ p pᵀ is graded, so that factorising it top down loses nothing, at any ratio of near and far distances. False
// when the rows do not span space. Destroys the rows.
template <int Size>
bool graded_frame(std::vector<Row<Size>>& rows, FixedMatrix<Size, Size>& frame) {
  for (int k = 0; k < Size; ++k) {
    const Row<Size>& largest = *std::max_element(rows.begin(), rows.end(), [](const Row<Size>& a, const Row<Size>& b) {
      return a.squaredNorm() < b.squaredNorm();
    });
    Row<Size> axis = largest.normalized();
    for (int j = 0; j < k; ++j)
      axis -= frame.row(j).dot(axis) * frame.row(j).transpose();
    if (!(axis.squaredNorm() > 0)) return false;
    axis.normalize();
    frame.row(k) = axis.transpose();
    for (Row<Size>& r : rows)
      r -= axis.dot(r) * axis;
  }
  return true;
}

}  // namespace

// Eq. 3.30 with t = 1/µ, of the feasibility program as one of the form Eq. 3.29
template <int Dim>
CentralPathResult<Dim> follow_central_path(const HalfSpaces<Dim>& planes, const CentralPathRequest<Dim>& request) {
  constexpr int size = Dim + 1;                                     // x and -s
  static thread_local std::vector<Row<size>> rows, turned, scaled;  // (a, 1); in the frame; over t
  static thread_local std::vector<double> t;                        // s + d - a·x
  const std::size_t count = planes.size();
  rows.resize(count);
  turned.resize(count);
  scaled.resize(count);
  t.resize(count);

  CentralPathResult<Dim> result;
  result.point = request.start;
  for (std::size_t i = 0; i < count; ++i) {
    rows[i] << planes[i].normal, 1;
    t[i] = -signed_distance(planes[i], request.start);
  }
  result.bound = 2 * request.weight - *std::min_element(t.begin(), t.end());
  for (double& v : t)
    v += result.bound;

  // as in weighted_centre.cpp
  const double least_weight =
      request.weights.empty() ? 1 : *std::min_element(request.weights.begin(), request.weights.end());
  FixedMatrix<size, size> frame;
  bool settled = false;  // near the end the frame is kept
  while (result.iterations < request.limit) {
    ++result.iterations;
    if (!settled) {
      for (std::size_t i = 0; i < count; ++i)
        scaled[i] = rows[i] / t[i];
      if (!graded_frame<size>(scaled, frame)) {
        result.status = CentralPathStatus::singular;
        return result;
      }
      for (std::size_t i = 0; i < count; ++i)
        turned[i] = frame * rows[i];
    }
    Row<size> gradient = -frame.col(Dim) / request.weight;
    FixedMatrix<size, size> hessian = FixedMatrix<size, size>::Zero();
    for (std::size_t i = 0; i < count; ++i) {
      scaled[i] = turned[i] / t[i];
      if (request.weights.empty()) {
        gradient += scaled[i];
        hessian += scaled[i] * scaled[i].transpose();
      } else {
        const Row<size> weighted = request.weights[i] * scaled[i];
        gradient += weighted;
        hessian += weighted * scaled[i].transpose();
      }
    }
    Row<size> step = -gradient;
    if (!solve_symmetric<size>(hessian, step)) {
      result.status = CentralPathStatus::singular;
      return result;
    }

    // a full step when it is safe, else the largest that provably stays within
    const double decrement = -gradient.dot(step);
    settled = decrement < full_step_decrement * least_weight;
    double length = 1;
    if (!settled) {
      double steepest = 0;
      for (const Row<size>& p : scaled)
        steepest = std::max(steepest, p.dot(step));
      length = 1 / (1 + steepest);
    }
    double least = 1;  // smallest ratio of a t to its old value
    for (std::size_t i = 0; i < count; ++i) {
      const double ratio = 1 - length * scaled[i].dot(step);
      t[i] *= ratio;
      least = std::min(least, ratio);
    }
    const Row<size> moved = length * (frame.transpose() * step);
    result.point += moved.template head<Dim>();
    result.bound -= moved[Dim];
    if (!(decrement >= -1e-12) || !(least > 0)) {
      result.status = CentralPathStatus::singular;
      return result;
    }
    if (decrement <= request.tolerance * request.tolerance * least_weight) {
      result.status = CentralPathStatus::converged;
      return result;
    }
  }
  return result;
}

template CentralPathResult<2> follow_central_path<2>(const HalfSpaces<2>&, const CentralPathRequest<2>&);
template CentralPathResult<3> follow_central_path<3>(const HalfSpaces<3>&, const CentralPathRequest<3>&);

}  // namespace voussoir
