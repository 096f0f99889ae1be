// The exact referee's numbers of 113 bits, and a contact's point and normal in them.
#include <cmath>
#include <stdexcept>

#include "core/testing/exact_referee.hpp"

namespace voussoir::exact {

double to_double(const Quad& q) {
  return static_cast<double>(q);
}

Quad to_quad(const Rational& q) {
  // three doubles have 159 bits
  mpf_class rest(q, 256);
  Quad sum = 0;
  for (int part = 0; part < 3; ++part) {
    const double leading = rest.get_d();
    sum += leading;
    rest -= leading;
  }
  return sum;
}

Quad root(Quad square) {
  if (!(square > 0)) return 0;
  // the double's root has 53 bits; each of Heron's steps doubles them
  Quad r = std::sqrt(static_cast<double>(square));
  if (r == 0) return 0;  // below the range of doubles: far below any number checked here
  for (int step = 0; step < 2; ++step)
    r = (r + square / r) / 2;
  return r;
}

QuadVector quads(const Vector<3>& v) {
  return {v[0], v[1], v[2]};
}

Quad dot(const QuadVector& a, const QuadVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Centre centre(const HalfSpaces<3>& planes, const Vector<3>& point) {
  Centre result;
  const QuadVector x = quads(point);
  QuadVector gradient{};
  std::array<QuadVector, 3> hessian{};
  for (const HalfSpace<3>& p : planes) {
    const QuadVector a = quads(p.normal);
    const Quad slack = Quad(p.offset) - dot(a, x);
    if (!(slack > 0)) return result;
    for (int i = 0; i < 3; ++i) {
      gradient[i] += a[i] / slack;
      for (int j = 0; j < 3; ++j)
        hessian[i][j] += a[i] * a[j] / (slack * slack);
    }
  }
  result.interior = true;
  // gᵀ H⁻¹ g by Gaussian elimination with pivots on the diagonal: H is positive definite
  std::array<bool, 3> done{};
  for (int round = 0; round < 3; ++round) {
    int pivot = -1;
    for (int i = 0; i < 3; ++i)
      if (!done[i] && (pivot < 0 || hessian[i][i] > hessian[pivot][pivot])) pivot = i;
    done[pivot] = true;
    if (!(hessian[pivot][pivot] > 0)) throw std::logic_error("113 bits do not resolve the region");
    result.decrement += gradient[pivot] * gradient[pivot] / hessian[pivot][pivot];
    for (int i = 0; i < 3; ++i) {
      if (done[i]) continue;
      const Quad factor = hessian[i][pivot] / hessian[pivot][pivot];
      gradient[i] -= factor * gradient[pivot];
      for (int j = 0; j < 3; ++j)
        if (!done[j]) hessian[i][j] -= factor * hessian[pivot][j];
    }
  }
  result.decrement = root(result.decrement);
  return result;
}

Normal contact_normal(const HalfSpaces<3>& planes, int faces_a, const Vector<3>& point, double radius) {
  const QuadVector x = quads(point);
  std::array<QuadVector, 2> gradient{};
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const QuadVector a = quads(planes[i].normal);
    const Quad depth = dot(a, x) - Quad(planes[i].offset) + Quad(radius);
    if (!(depth > 0)) continue;
    for (int k = 0; k < 3; ++k)
      gradient[static_cast<int>(i) < faces_a ? 0 : 1][k] += depth * a[k];
  }
  Normal result;
  result.gradient_a = root(dot(gradient[0], gradient[0]));
  result.gradient_b = root(dot(gradient[1], gradient[1]));
  if (result.gradient_a == 0 || result.gradient_b == 0) return result;
  for (int k = 0; k < 3; ++k)
    result.normal[k] = gradient[0][k] / result.gradient_a - gradient[1][k] / result.gradient_b;
  result.difference = root(dot(result.normal, result.normal));
  if (result.difference == 0) return result;
  for (Quad& n : result.normal)
    n /= result.difference;
  return result;
}

}  // namespace voussoir::exact
