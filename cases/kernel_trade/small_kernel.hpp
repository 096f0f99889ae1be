// A second, plain contact kernel for any type of number: float, double and, as the study's reference,
// long double. It shares no code with the core and has none of its safeguards: world axes, no proofs.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/geometry/half_space.hpp"

namespace voussoir::trade {

template <class Real>
using Vec = Eigen::Matrix<Real, 3, 1>;

// planes in the first part's frame, A's first, rounded to Real
template <class Real>
struct Planes {
  std::vector<Vec<Real>> normals;
  std::vector<Real> offsets;
  int faces_a = 0;

  Planes(const HalfSpaces<3>& planes, int count_a) : faces_a(count_a) {
    for (const HalfSpace<3>& p : planes) {
      normals.push_back(p.normal.template cast<Real>());
      offsets.push_back(static_cast<Real>(p.offset));
    }
  }
  int size() const { return static_cast<int>(offsets.size()); }
  Real slack(int i, const Vec<Real>& x) const { return offsets[i] - normals[i].dot(x); }
};

template <class Real>
struct Answer {
  bool found = false;
  Vec<Real> point = Vec<Real>::Zero(), normal = Vec<Real>::Zero();
  Real overlap = 0, area = 0;
  int iterations = 0;
};

// Newton's step of -Σ log s: the least squares of P x = -1, P's rows being a/s, by modified Gram-Schmidt, which squares
// no condition number. Returns the decrement |P x|.
template <class Real>
Real newton_step(const Planes<Real>& planes, const Vec<Real>& x, Vec<Real>& step) {
  const int count = planes.size();
  Eigen::Matrix<Real, Eigen::Dynamic, 3> p(count, 3);
  Eigen::Matrix<Real, Eigen::Dynamic, 1> rest = -Eigen::Matrix<Real, Eigen::Dynamic, 1>::Ones(count);
  for (int i = 0; i < count; ++i)
    p.row(i) = planes.normals[i].transpose() / planes.slack(i, x);
  Eigen::Matrix<Real, 3, 3> r = Eigen::Matrix<Real, 3, 3>::Zero();
  Vec<Real> along;
  for (int k = 0; k < 3; ++k) {
    r(k, k) = p.col(k).norm();
    if (!(r(k, k) > 0)) return std::numeric_limits<Real>::infinity();  // the planes contain no ball: rounding
    p.col(k) /= r(k, k);
    for (int j = k + 1; j < 3; ++j) {
      r(k, j) = p.col(k).dot(p.col(j));
      p.col(j) -= r(k, j) * p.col(k);
    }
    along[k] = p.col(k).dot(rest);
    rest -= along[k] * p.col(k);
  }
  for (int k = 2; k >= 0; --k) {
    Real sum = along[k];
    for (int j = k + 1; j < 3; ++j)
      sum -= r(k, j) * step[j];
    step[k] = sum / r(k, k);
  }
  return along.norm();
}

// below this decrement the full step cannot leave the region
inline constexpr double full_step = 0.25;

template <class Real>
bool find_centre(const Planes<Real>& planes, Real tolerance, int limit, Answer<Real>& answer) {
  const auto inside = [&](const Vec<Real>& x) {
    for (int i = 0; i < planes.size(); ++i)
      if (!(planes.slack(i, x) > 0)) return false;
    return true;
  };
  for (; answer.iterations < limit && inside(answer.point); ++answer.iterations) {
    Vec<Real> step;
    const Real decrement = newton_step(planes, answer.point, step);
    if (!std::isfinite(decrement)) return false;
    Real length = 1;
    if (decrement >= static_cast<Real>(full_step)) {
      Real steepest = 0;
      for (int i = 0; i < planes.size(); ++i)
        steepest = std::max(steepest, planes.normals[i].dot(step) / planes.slack(i, answer.point));
      length = 1 / (1 + steepest);
    }
    answer.point += length * step;
    if (decrement < tolerance) {
      ++answer.iterations;
      return inside(answer.point);
    }
  }
  return false;
}

template <class Real>
Vec<Real> gradient(const Planes<Real>& planes, int from, int to, const Vec<Real>& x, Real radius) {
  Vec<Real> sum = Vec<Real>::Zero();
  for (int i = from; i < to; ++i)
    sum += std::max(radius - planes.slack(i, x), Real(0)) * planes.normals[i];
  const Real length = sum.norm();
  return length > 0 ? Vec<Real>(sum / length) : Vec<Real>(Vec<Real>::Zero());
}

template <class Real>
Real overlap(const Planes<Real>& planes, const Vec<Real>& x, const Vec<Real>& normal) {
  Real ahead = std::numeric_limits<Real>::infinity(), behind = ahead;
  for (int i = 0; i < planes.size(); ++i) {
    const Real slope = planes.normals[i].dot(normal);
    if (i < planes.faces_a && slope > 0) ahead = std::min(ahead, planes.slack(i, x) / slope);
    if (i >= planes.faces_a && slope < 0) behind = std::min(behind, -planes.slack(i, x) / slope);
  }
  return ahead + behind;
}

// the section's polygon, cut by one plane after the other
template <class Real>
Real area(const Planes<Real>& planes, const Vec<Real>& x, const Vec<Real>& normal, Real reach) {
  using Point = Eigen::Matrix<Real, 2, 1>;
  const Vec<Real> first = normal.unitOrthogonal(), second = normal.cross(first);
  std::vector<Point> polygon{{-reach, -reach}, {reach, -reach}, {reach, reach}, {-reach, reach}}, left;
  for (int i = 0; i < planes.size(); ++i) {
    const Point q(planes.normals[i].dot(first), planes.normals[i].dot(second));
    const Real slack = planes.slack(i, x);
    left.clear();
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Point &here = polygon[k], &next = polygon[(k + 1) % polygon.size()];
      const Real here_in = slack - q.dot(here), next_in = slack - q.dot(next);
      if (here_in >= 0) left.push_back(here);
      if ((here_in > 0 && next_in < 0) || (here_in < 0 && next_in > 0))
        left.push_back(here + here_in / (here_in - next_in) * (next - here));
    }
    polygon.swap(left);
  }
  Real twice = 0;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const Point u = polygon[k] - polygon[0], v = polygon[k + 1] - polygon[0];
    twice += u[0] * v[1] - u[1] * v[0];
  }
  return std::abs(twice) / 2;
}

// all quantities from an interior starting point
template <class Real>
Answer<Real> solve(const Planes<Real>& planes, const Vec<Real>& start, Real tolerance, Real radius, Real reach) {
  const int limit = 200;
  Answer<Real> answer;
  answer.point = start;
  if (!find_centre(planes, tolerance, limit, answer)) return answer;
  const Vec<Real> difference = gradient(planes, 0, planes.faces_a, answer.point, radius) -
                               gradient(planes, planes.faces_a, planes.size(), answer.point, radius);
  if (!(difference.norm() > 0)) return answer;
  answer.normal = difference.normalized();
  answer.overlap = overlap(planes, answer.point, answer.normal);
  answer.area = area(planes, answer.point, answer.normal, reach);
  answer.found = true;
  return answer;
}

}  // namespace voussoir::trade
