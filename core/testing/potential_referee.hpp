// The contact of two potential particles in 113 bits, with a proof of its own: it places the particles, evaluates them
// and bounds the result without the solvers' code. A proof does not depend on the origin of its numbers, so it may
// begin at the result that it checks.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/potential/contact.hpp"

namespace voussoir::referee {

using Quad = __float128;
template <int Dim>
using QuadPoint = std::array<Quad, Dim>;

template <int Dim>
struct QuadPotential {
  std::vector<QuadPoint<Dim>> normals;
  std::vector<Quad> offsets;
  Quad plane_weight, sphere_weight;
  QuadPoint<Dim> centre{};

  QuadPotential(const PotentialShape<Dim>& shape, const Matrix<Dim>& rotation, const Vector<Dim>& origin) {
    const Quad r = shape.corner_radius, k = shape.sphericity, big_r = shape.sphere_radius;
    plane_weight = (1 - k) / (r * r);
    sphere_weight = k / (big_r * big_r);
    const auto turned = [&](const Vector<Dim>& v) {
      QuadPoint<Dim> w{};
      for (int i = 0; i < Dim; ++i)
        for (int j = 0; j < Dim; ++j)
          w[i] += Quad(rotation(i, j)) * Quad(v[j]);
      return w;
    };
    centre = turned(shape.centre);
    for (int i = 0; i < Dim; ++i)
      centre[i] += Quad(origin[i]);
    for (const HalfSpace<Dim>& plane : shape.planes) {
      normals.push_back(turned(plane.normal));
      offsets.push_back(plane.offset);
      for (int i = 0; i < Dim; ++i)
        offsets.back() += normals.back()[i] * Quad(origin[i]);
    }
  }

  // planes up to `near` inside count in the Hessian
  Quad look(const QuadPoint<Dim>& x, QuadPoint<Dim>& gradient, std::array<QuadPoint<Dim>, Dim>& hessian,
            Quad near = 0) const {
    Quad f = -1;
    for (int i = 0; i < Dim; ++i) {
      const Quad arm = x[i] - centre[i];
      f += sphere_weight * arm * arm;
      gradient[i] = 2 * sphere_weight * arm;
      for (int j = 0; j < Dim; ++j)
        hessian[i][j] = i == j ? 2 * sphere_weight : 0;
    }
    for (std::size_t p = 0; p < normals.size(); ++p) {
      Quad slack = -offsets[p];
      for (int i = 0; i < Dim; ++i)
        slack += normals[p][i] * x[i];
      if (slack <= -near) continue;
      for (int i = 0; i < Dim; ++i)
        for (int j = 0; j < Dim; ++j)
          hessian[i][j] += 2 * plane_weight * normals[p][i] * normals[p][j];
      if (slack <= 0) continue;
      f += plane_weight * slack * slack;
      for (int i = 0; i < Dim; ++i)
        gradient[i] += 2 * plane_weight * slack * normals[p][i];
    }
    return f;
  }
};

template <int Dim>
struct Verdict {
  bool proven = false;        // the gap is below the required one
  Quad value = 0, bound = 0;  // v lies between bound and value
  QuadPoint<Dim> point{};
  double point_error = 0;  // m: the least point is no farther from `point`

  double distance_to(const Vector<Dim>& p) const {
    double sum = 0;
    for (int i = 0; i < Dim; ++i)
      sum += std::pow(static_cast<double>(point[i] - Quad(p[i])), 2);
    return std::sqrt(sum);
  }
};

// max(f_A, f_B)
template <int Dim>
Quad larger_value(const PotentialPair<Dim>& pair, const Vector<Dim>& point) {
  QuadPoint<Dim> x, gradient;
  std::array<QuadPoint<Dim>, Dim> hessian;
  for (int i = 0; i < Dim; ++i)
    x[i] = point[i];
  const QuadPotential<Dim> a(*pair.a, Matrix<Dim>::Identity(), Vector<Dim>::Zero());
  const QuadPotential<Dim> b(*pair.b, pair.rotation, pair.offset);
  return std::max(a.look(x, gradient, hessian), b.look(x, gradient, hessian));
}

// (H, difference; differenceᵀ, 0) (dx, dλ) = right, by elimination with pivoting
template <int Size>
bool solve(std::array<std::array<Quad, Size>, Size> m, std::array<Quad, Size>& right) {
  const auto magnitude = [](Quad x) { return x < 0 ? -x : x; };
  for (int k = 0; k < Size; ++k) {
    int best = k;
    for (int i = k + 1; i < Size; ++i)
      if (magnitude(m[i][k]) > magnitude(m[best][k])) best = i;
    if (m[best][k] == 0) return false;
    std::swap(m[k], m[best]);
    std::swap(right[k], right[best]);
    for (int i = k + 1; i < Size; ++i) {
      const Quad factor = m[i][k] / m[k][k];
      for (int j = k; j < Size; ++j)
        m[i][j] -= factor * m[k][j];
      right[i] -= factor * right[k];
    }
  }
  for (int k = Size - 1; k >= 0; --k) {
    for (int j = k + 1; j < Size; ++j)
      right[k] -= m[k][j] * right[j];
    right[k] /= m[k][k];
  }
  return true;
}

// Needs k > 0 of one of the two. Newton's method on both conditions from the given point and ratio; the proof is the
// gap between max(f_A, f_B) at the point and the weighted sum's least value, which strong convexity bounds.
template <int Dim>
Verdict<Dim> judge(const PotentialPair<Dim>& pair, const Vector<Dim>& start, double ratio, double asked_gap,
                   double near) {
  const QuadPotential<Dim> a(*pair.a, Matrix<Dim>::Identity(), Vector<Dim>::Zero()),
      b(*pair.b, pair.rotation, pair.offset);
  Verdict<Dim> verdict;
  QuadPoint<Dim> x;
  for (int i = 0; i < Dim; ++i)
    x[i] = start[i];
  Quad lambda = Quad(ratio) / (1 + Quad(ratio)), best_gap = 0;
  for (int step = 0; step < 40; ++step) {
    QuadPoint<Dim> ga, gb;
    std::array<QuadPoint<Dim>, Dim> ha, hb;
    const Quad fa = a.look(x, ga, ha, near), fb = b.look(x, gb, hb, near);
    std::array<std::array<Quad, Dim + 1>, Dim + 1> m{};
    std::array<Quad, Dim + 1> right{};
    Quad slope = 0;
    for (int i = 0; i < Dim; ++i) {
      const Quad g = lambda * ga[i] + (1 - lambda) * gb[i];
      slope += g * g;
      right[i] = -g;
      m[i][Dim] = m[Dim][i] = ga[i] - gb[i];
      for (int j = 0; j < Dim; ++j)
        m[i][j] = lambda * ha[i][j] + (1 - lambda) * hb[i][j];
    }
    right[Dim] = fb - fa;
    const Quad curvature = 2 * (lambda * a.sphere_weight + (1 - lambda) * b.sphere_weight);
    const Quad value = fa > fb ? fa : fb;
    Quad bound = lambda * fa + (1 - lambda) * fb - slope / (2 * curvature);
    if (bound < -1) bound = -1;  // f + 1 is a sum of squares
    if (step == 0 || value - bound < best_gap) {
      best_gap = value - bound;
      verdict.value = value;
      verdict.bound = bound;
      verdict.point = x;
      verdict.point_error =
          std::sqrt(std::max(static_cast<double>(2 * (value - bound) / curvature), 0.0)) +  // strong convexity
          std::sqrt(static_cast<double>(slope)) / static_cast<double>(curvature);
    }
    if (best_gap <= Quad(asked_gap) || !solve<Dim + 1>(m, right)) break;
    for (int i = 0; i < Dim; ++i)
      x[i] += right[i];
    lambda += right[Dim];
    if (lambda <= 0 || lambda >= 1) break;
  }
  verdict.proven = best_gap <= Quad(asked_gap);
  return verdict;
}

// If Newton's method passes a plane on which double precision has put the point, the plane is held.
template <int Dim>
Verdict<Dim> judge(const PotentialPair<Dim>& pair, const Vector<Dim>& start, double ratio, double asked_gap) {
  constexpr double held = 1e-15;  // m; sizes are about 1
  const Verdict<Dim> verdict = judge<Dim>(pair, start, ratio, asked_gap, 0);
  return verdict.proven ? verdict : judge<Dim>(pair, start, ratio, asked_gap, held);
}

}  // namespace voussoir::referee
