#include "core/optimise/central_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/optimise/symmetric_system.hpp"

namespace voussoir {
namespace {

// Planes side by side: what is done to them is the same for each, whatever the instruction set makes of it.
constexpr int planes_per_quad = 4;
using Lanes = Eigen::Array<double, planes_per_quad, 1>;

double sum(const Lanes& x) {
  return (x[0] + x[1]) + (x[2] + x[3]);
}

template <int Dim>
struct Quad {
  Lanes row[Dim];         // a
  Lanes t;                // s + d - a·x
  Lanes scaled[Dim + 1];  // (a, 1) / t
};

// Four planes each; the last is filled up with planes that are infinitely far, which weigh nothing.
template <int Dim>
void load(const HalfSpaces<Dim>& planes, const Vector<Dim>& point, std::vector<Quad<Dim>>& quads) {
  quads.resize((planes.size() + planes_per_quad - 1) / planes_per_quad);
  for (Lanes& row : quads.back().row)
    row.setZero();
  quads.back().t.setConstant(std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < planes.size(); ++i) {
    Quad<Dim>& q = quads[i / planes_per_quad];
    for (int k = 0; k < Dim; ++k)
      q.row[k][i % planes_per_quad] = planes[i].normal[k];
    q.t[i % planes_per_quad] = -signed_distance(planes[i], point);
  }
}

// Σ log t over the first `count`: of products as long as they are far from overflow, for a logarithm costs twenty of
// their factors
template <int Dim>
double sum_of_logarithms(const std::vector<Quad<Dim>>& quads, std::size_t count) {
  constexpr double small = 1e-150, large = 1e150;
  double logarithms = 0, product = 1;
  for (std::size_t i = 0; i < count; ++i) {
    product *= quads[i / planes_per_quad].t[i % planes_per_quad];
    if (product > small && product < large) continue;
    logarithms += std::log(product);
    product = 1;
  }
  return logarithms + std::log(product);
}

}  // namespace

template <int Dim>
CentralPathResult<Dim> follow_central_path(const HalfSpaces<Dim>& planes, const CentralPathRequest<Dim>& request) {
  constexpr int size = Dim + 1;  // x and -s
  using Unknowns = Eigen::Matrix<double, size, 1>;
  static thread_local std::vector<Quad<Dim>> quads;
  load(planes, request.start, quads);
  double least = std::numeric_limits<double>::infinity();
  for (const Quad<Dim>& q : quads)
    least = std::min(least, q.t.minCoeff());

  CentralPathResult<Dim> result;
  result.point = request.start;
  result.bound = 2 * request.weight - least;
  for (Quad<Dim>& q : quads)
    q.t += result.bound;

  while (result.iterations < request.limit) {
    ++result.iterations;
    Lanes gradients[size], products[size][size];
    for (int j = 0; j < size; ++j) {
      gradients[j].setZero();
      for (int k = 0; k <= j; ++k)
        products[j][k].setZero();
    }
    for (Quad<Dim>& q : quads) {
      q.scaled[Dim] = 1 / q.t;
      for (int k = 0; k < Dim; ++k)
        q.scaled[k] = q.scaled[Dim] * q.row[k];
      for (int j = 0; j < size; ++j) {
        gradients[j] += q.scaled[j];
        for (int k = 0; k <= j; ++k)
          products[j][k] += q.scaled[j] * q.scaled[k];
      }
    }
    Unknowns gradient, step;
    Eigen::Matrix<double, size, size> hessian;
    for (int j = 0; j < size; ++j) {
      gradient[j] = sum(gradients[j]) - (j == Dim ? 1 / request.weight : 0);
      step[j] = -gradient[j];
      for (int k = 0; k <= j; ++k)
        hessian(j, k) = sum(products[j][k]);
    }
    if (!solve_symmetric<size>(hessian, step)) {
      result.status = CentralPathStatus::singular;
      return result;
    }
    double decrement = 0;
    for (int j = 0; j < size; ++j)
      decrement -= gradient[j] * step[j];

    // what the step takes of each t, as a share
    Lanes most = Lanes::Zero();
    for (Quad<Dim>& q : quads) {
      Lanes loss = step[0] * q.scaled[0];
      for (int j = 1; j < size; ++j)
        loss += step[j] * q.scaled[j];
      q.scaled[0] = loss;
      most = most.max(loss);
    }
    // a full step when it is safe, else the largest that provably stays within
    const double length = decrement < full_step_decrement ? 1 : 1 / (1 + most.maxCoeff());
    for (Quad<Dim>& q : quads)
      q.t *= 1 - length * q.scaled[0];
    result.point += length * step.template head<Dim>();
    result.bound -= length * step[Dim];
    if (!(decrement >= -1e-12) || !(length * most.maxCoeff() < 1)) {
      result.status = CentralPathStatus::singular;
      return result;
    }
    if (decrement <= request.tolerance * request.tolerance) {
      result.status = CentralPathStatus::converged;
      result.logarithms = sum_of_logarithms(quads, planes.size());
      return result;
    }
  }
  return result;
}

template CentralPathResult<2> follow_central_path<2>(const HalfSpaces<2>&, const CentralPathRequest<2>&);
template CentralPathResult<3> follow_central_path<3>(const HalfSpaces<3>&, const CentralPathRequest<3>&);

}  // namespace voussoir
