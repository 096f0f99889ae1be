// Slow and plain results in long double. They share no code with the kernels that they check.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "core/geometry/polytope.hpp"
#include "core/testing/dense.hpp"

namespace voussoir::oracle {

template <int Size>
using RealVector = Eigen::Matrix<Real, Size, 1>;
template <int Size>
using RealMatrix = Eigen::Matrix<Real, Size, Size>;

// calls with every ascending choice of `size` out of `count`
inline void for_each_choice(int count, int size, const std::function<void(const std::vector<int>&)>& call) {
  std::vector<int> choice(size);
  for (int k = 0; k < size; ++k)
    choice[k] = k;
  while (size <= count) {
    call(choice);
    int k = size - 1;
    while (k >= 0 && choice[k] == count - size + k)
      --k;
    if (k < 0) return;
    ++choice[k];
    for (int j = k + 1; j < size; ++j)
      choice[j] = choice[j - 1] + 1;
  }
}

// min s: a·x - d <= s by its dual: the best of all bases of Dim + 1 planes with multipliers >= 0
template <int Dim>
Real feasibility(const HalfSpaces<Dim>& planes) {
  Real best = -std::numeric_limits<Real>::infinity();
  for_each_choice(static_cast<int>(planes.size()), Dim + 1, [&](const std::vector<int>& choice) {
    RealMatrix<Dim + 1> columns;
    RealVector<Dim + 1> offsets;
    for (int k = 0; k <= Dim; ++k) {
      columns.col(k) << planes[choice[k]].normal.template cast<Real>(), 1;
      offsets[k] = planes[choice[k]].offset;
    }
    const Eigen::FullPivLU<RealMatrix<Dim + 1>> lu(columns);
    if (lu.rank() <= Dim) return;
    const RealVector<Dim + 1> lambda = lu.solve(RealVector<Dim + 1>::Unit(Dim));
    if (lambda.minCoeff() >= -1e-15L) best = std::max(best, Real(-lambda.dot(offsets)));
  });
  return best;
}

// Volume of {x : A x <= b} by Lasserre's recursion over its facets: no vertices. No two planes may coincide.
inline Real volume(const std::vector<std::vector<Real>>& a, const std::vector<Real>& b) {
  const std::size_t dim = a.front().size();
  if (dim == 1) {
    Real low = -std::numeric_limits<Real>::infinity(), high = -low;
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (a[i][0] > 0) high = std::min(high, b[i] / a[i][0]);
      if (a[i][0] < 0) low = std::max(low, b[i] / a[i][0]);
      if (a[i][0] == 0 && b[i] < 0) return 0;
    }
    return std::max(high - low, Real(0));
  }
  Real sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t pivot = 0;
    for (std::size_t k = 1; k < dim; ++k)
      if (std::abs(a[i][k]) > std::abs(a[i][pivot])) pivot = k;
    if (a[i][pivot] == 0) continue;
    // the pivot's coordinate is eliminated by the plane's equation
    std::vector<std::vector<Real>> face;
    std::vector<Real> rest;
    for (std::size_t j = 0; j < a.size(); ++j) {
      if (j == i) continue;
      const Real factor = a[j][pivot] / a[i][pivot];
      std::vector<Real> row;
      for (std::size_t k = 0; k < dim; ++k)
        if (k != pivot) row.push_back(a[j][k] - factor * a[i][k]);
      // parallel planes leave rounding in place of zeros
      for (Real& r : row)
        if (std::abs(r) < 1e-17L) r = 0;
      face.push_back(row);
      rest.push_back(b[j] - factor * b[i]);
    }
    sum += b[i] / std::abs(a[i][pivot]) * volume(face, rest);
  }
  return sum / dim;
}

template <int Dim>
Real volume(const HalfSpaces<Dim>& planes) {
  std::vector<std::vector<Real>> a;
  std::vector<Real> b;
  for (const HalfSpace<Dim>& p : planes) {
    a.push_back({});
    for (int k = 0; k < Dim; ++k)
      a.back().push_back(p.normal[k]);
    b.push_back(p.offset);
  }
  return volume(a, b);
}

// area of the section by the plane through the point normal to n
template <int Dim>
Real section(const HalfSpaces<Dim>& planes, const RealVector<Dim>& point, const RealVector<Dim>& n) {
  int axis = 0;
  n.cwiseAbs().minCoeff(&axis);
  Eigen::Matrix<Real, Dim, Dim - 1> plane_axes;
  RealVector<Dim> first = RealVector<Dim>::Unit(axis);
  first = (first - n.dot(first) * n).normalized();
  plane_axes.col(0) = first;
  if constexpr (Dim == 3) plane_axes.col(1) = n.cross(first);
  std::vector<std::vector<Real>> a;
  std::vector<Real> b;
  for (const HalfSpace<Dim>& p : planes) {
    const RealVector<Dim> normal = p.normal.template cast<Real>();
    const RealVector<Dim - 1> row = plane_axes.transpose() * normal;
    const Real slack = p.offset - normal.dot(point);
    if (row.cwiseAbs().maxCoeff() < 1e-17L) {
      if (slack < 0) return 0;
      continue;
    }
    a.emplace_back(row.data(), row.data() + Dim - 1);
    b.push_back(slack);
  }
  return volume(a, b);
}

// ∫ (u·x)^power dV from sections normal to u, exact between the given heights (Gauss-Legendre, 3 points)
template <int Dim>
Real moment(const HalfSpaces<Dim>& planes, const Vector<Dim>& u, std::vector<Real> heights, int power) {
  std::sort(heights.begin(), heights.end());
  const Real node = std::sqrt(Real(3) / 5);
  const RealVector<Dim> n = u.template cast<Real>().normalized();
  Real sum = 0;
  for (std::size_t k = 0; k + 1 < heights.size(); ++k) {
    const Real middle = (heights[k] + heights[k + 1]) / 2, half = (heights[k + 1] - heights[k]) / 2;
    for (const auto& [place, weight] :
         {std::pair<Real, Real>{-node, 5 / Real(9)}, {0, 8 / Real(9)}, {node, 5 / Real(9)}}) {
      const Real h = middle + half * place;
      sum += half * weight * std::pow(h, power) * section<Dim>(planes, h * n, n);
    }
  }
  return sum;
}

// Newton decrement of -Σ log(d - a·x) at a point that lies inside: 0 at the analytic centre
template <int Dim>
struct Barrier {
  RealVector<Dim> step = RealVector<Dim>::Zero();
  Real decrement = std::numeric_limits<Real>::infinity();
  bool interior = true;
};

template <int Dim>
Barrier<Dim> barrier(const HalfSpaces<Dim>& planes, const RealVector<Dim>& point) {
  Barrier<Dim> result;
  // the rows a/s as a least-squares problem: QR squares no condition number
  Eigen::Matrix<Real, Eigen::Dynamic, Dim> rows(planes.size(), Dim);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const RealVector<Dim> a = planes[i].normal.template cast<Real>();
    const Real slack = planes[i].offset - a.dot(point);
    if (!(slack > 0)) result.interior = false;
    rows.row(i) = a.transpose() / slack;
  }
  if (!result.interior) return result;
  const Eigen::Matrix<Real, Eigen::Dynamic, 1> ones = Eigen::Matrix<Real, Eigen::Dynamic, 1>::Ones(planes.size());
  result.step = -least_squares(rows, ones);
  result.decrement = (rows * result.step).norm();
  return result;
}

// the analytic centre from an interior start
template <int Dim>
RealVector<Dim> analytic_centre(const HalfSpaces<Dim>& planes, RealVector<Dim> point) {
  for (int i = 0; i < 500; ++i) {
    const Barrier<Dim> b = barrier<Dim>(planes, point);
    if (!b.interior || b.decrement < 1e-15L) break;
    point += b.step / (1 + b.decrement);
  }
  return point;
}

// Largest gap over all separating axes: face normals and, in space, cross products of edges. Negative when they
// overlap.
template <int Dim>
Real separation(const Polytope<Dim>& a, const Polytope<Dim>& b, const Matrix<Dim>& turn, const Vector<Dim>& offset) {
  using V = RealVector<Dim>;
  std::vector<V> corners_a, corners_b, axes, edges_a, edges_b;
  const RealMatrix<Dim> q = turn.template cast<Real>();
  for (const Vector<Dim>& v : a.vertices)
    corners_a.push_back(v.template cast<Real>());
  for (const Vector<Dim>& v : b.vertices)
    corners_b.push_back(q * v.template cast<Real>() + offset.template cast<Real>());
  for (const HalfSpace<Dim>& f : a.faces)
    axes.push_back(f.normal.template cast<Real>());
  for (const HalfSpace<Dim>& f : b.faces)
    axes.push_back(q * f.normal.template cast<Real>());
  if constexpr (Dim == 3) {
    for (const std::vector<int>& loop : a.loops)
      for (std::size_t k = 0; k < loop.size(); ++k)
        edges_a.push_back(corners_a[loop[(k + 1) % loop.size()]] - corners_a[loop[k]]);
    for (const std::vector<int>& loop : b.loops)
      for (std::size_t k = 0; k < loop.size(); ++k)
        edges_b.push_back(corners_b[loop[(k + 1) % loop.size()]] - corners_b[loop[k]]);
    for (const V& ea : edges_a)
      for (const V& eb : edges_b) {
        const V axis = ea.cross(eb);
        if (axis.norm() > 1e-6L * ea.norm() * eb.norm()) axes.push_back(axis.normalized());
      }
  }
  Real largest = -std::numeric_limits<Real>::infinity();
  for (const V& axis : axes) {
    Real low_a = std::numeric_limits<Real>::infinity(), high_a = -low_a, low_b = low_a, high_b = -low_a;
    for (const V& v : corners_a) {
      low_a = std::min(low_a, axis.dot(v));
      high_a = std::max(high_a, axis.dot(v));
    }
    for (const V& v : corners_b) {
      low_b = std::min(low_b, axis.dot(v));
      high_b = std::max(high_b, axis.dot(v));
    }
    largest = std::max({largest, low_b - high_a, low_a - high_b});
  }
  return largest;
}

}  // namespace voussoir::oracle
