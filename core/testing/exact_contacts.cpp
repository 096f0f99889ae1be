#include "core/testing/exact_contacts.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace voussoir::exact {
namespace {

constexpr int most_steps = 500;

// far below any error checked, far above 113 bits
constexpr double converged = 1e-22;

// below this decrement Newton's full step converges quadratically
constexpr double full_step = 0.25;

// Seen from the start, which is subtracted before anything is rounded: slacks have all their digits, at any thickness
// of the region.
struct Barrier {
  std::vector<QuadVector> normals;
  std::vector<Quad> slacks;
  std::vector<double> weights;

  Barrier(const Planes& planes, const Point& start, std::vector<double> given) : weights(std::move(given)) {
    weights.resize(planes.size(), 1);
    for (const Plane& p : planes) {
      normals.push_back({to_quad(p.normal[0]), to_quad(p.normal[1]), to_quad(p.normal[2])});
      slacks.push_back(to_quad(p.offset - dot(p.normal, start)));
    }
  }
  Quad slack(std::size_t i, const QuadVector& x) const { return slacks[i] - dot(normals[i], x); }
};

// H y = g by Gaussian elimination with pivots on the diagonal: H is positive definite
QuadVector solve(std::array<QuadVector, 3> h, QuadVector g) {
  std::array<int, 3> order{0, 1, 2};
  for (int round = 0; round < 3; ++round) {
    for (int r = round + 1; r < 3; ++r)
      if (h[order[r]][order[r]] > h[order[round]][order[round]]) std::swap(order[r], order[round]);
    const int pivot = order[round];
    if (!(h[pivot][pivot] > 0)) throw std::logic_error("113 bits do not resolve the region");
    for (int r = round + 1; r < 3; ++r) {
      const int i = order[r];
      const Quad factor = h[i][pivot] / h[pivot][pivot];
      g[i] -= factor * g[pivot];
      for (int s = round + 1; s < 3; ++s)
        h[i][order[s]] -= factor * h[pivot][order[s]];
    }
  }
  QuadVector y{};
  for (int round = 2; round >= 0; --round) {
    const int i = order[round];
    y[i] = g[i];
    for (int r = round + 1; r < 3; ++r)
      y[i] -= h[i][order[r]] * y[order[r]];
    y[i] /= h[i][i];
  }
  return y;
}

struct Newton {
  QuadVector gradient{};
  std::array<QuadVector, 3> hessian{};

  Newton(const Barrier& barrier, const QuadVector& x) {
    for (std::size_t i = 0; i < barrier.normals.size(); ++i) {
      const Quad s = barrier.slack(i, x);
      for (int k = 0; k < 3; ++k) {
        const Quad weighted = barrier.weights[i] * barrier.normals[i][k];
        gradient[k] += weighted / s;
        for (int l = 0; l < 3; ++l)
          hessian[k][l] += weighted * barrier.normals[i][l] / (s * s);
      }
    }
  }
  Quad length(const QuadVector& y) const {
    QuadVector hy;
    for (int k = 0; k < 3; ++k)
      hy[k] = dot(hessian[k], y);
    return root(dot(y, hy));
  }
};

bool inside(const Barrier& barrier, const QuadVector& x) {
  for (std::size_t i = 0; i < barrier.normals.size(); ++i)
    if (!(barrier.slack(i, x) > 0)) return false;
  return true;
}

std::optional<QuadVector> centre_of(const Barrier& barrier) {
  QuadVector x{};
  if (!inside(barrier, x)) return {};
  for (int step = 0; step < most_steps; ++step) {
    const Newton newton(barrier, x);
    const QuadVector y = solve(newton.hessian, newton.gradient);
    const Quad decrement = newton.length(y);
    const Quad fraction = decrement < full_step ? Quad(1) : 1 / (1 + decrement);
    for (int k = 0; k < 3; ++k)
      x[k] -= fraction * y[k];
    if (!inside(barrier, x)) return {};
    if (decrement < converged) return x;
  }
  return {};
}

// one part's unit gradient of Σ w <r - slack>² at x; if no plane is nearer than r, the normal of the nearest
QuadVector potential_direction(const Barrier& barrier, int first, int last, const QuadVector& x, double radius) {
  QuadVector sum{};
  int nearest = first;
  for (int i = first; i < last; ++i) {
    if (barrier.slack(i, x) < barrier.slack(nearest, x)) nearest = i;
    const Quad depth = Quad(radius) - barrier.slack(i, x);
    if (!(depth > 0)) continue;
    for (int k = 0; k < 3; ++k)
      sum[k] += barrier.weights[i] * depth * barrier.normals[i][k];
  }
  if (dot(sum, sum) == 0) sum = barrier.normals[nearest];
  const Quad length = root(dot(sum, sum));
  for (Quad& s : sum)
    s /= length;
  return sum;
}

// three doubles have 159 bits
Rational rational(Quad q) {
  Rational sum = 0;
  for (int part = 0; part < 3; ++part) {
    const double leading = to_double(q);
    sum += Rational(leading);
    q -= leading;
  }
  return sum;
}

}  // namespace

std::vector<std::optional<Quad>> distances_along(const Planes& planes, int faces_a, int faces_b, const Point& point,
                                                 const Point& normal) {
  std::vector<std::optional<Quad>> distances;
  for (int i = 0; i < faces_a + faces_b; ++i) {
    const Rational along = dot(planes[i].normal, normal), slope = i < faces_a ? along : Rational(-along);
    distances.emplace_back();
    if (sgn(slope) > 0) distances.back() = to_quad(Rational((planes[i].offset - dot(planes[i].normal, point)) / slope));
  }
  return distances;
}

Quad nearest(const std::vector<std::optional<Quad>>& distances, int first, int count) {
  std::optional<Quad> least;
  for (int i = first; i < first + count; ++i)
    if (distances[i] && (!least || *distances[i] < *least)) least = distances[i];
  return least.value();
}

std::optional<ConvergedContact> converged_contact(const Planes& planes, int faces_a, int faces_b, const Point& start,
                                                  double radius, std::vector<double> weights) {
  const Barrier barrier(planes, start, std::move(weights));
  const std::optional<QuadVector> centre = centre_of(barrier);
  if (!centre) return {};
  ConvergedContact result;
  result.from_start = *centre;
  result.distance = Newton(barrier, *centre).length(*centre);

  const QuadVector of_a = potential_direction(barrier, 0, faces_a, *centre, radius),
                   of_b = potential_direction(barrier, faces_a, faces_a + faces_b, *centre, radius);
  for (int k = 0; k < 3; ++k)
    result.normal[k] = of_a[k] - of_b[k];
  const Quad length = root(dot(result.normal, result.normal));
  if (!(length > 0)) return result;
  Point point, normal;
  for (int k = 0; k < 3; ++k) {
    result.normal[k] /= length;
    point[k] = start[k] + rational((*centre)[k]);
    normal[k] = rational(result.normal[k]);
  }
  const std::vector<std::optional<Quad>> distances = distances_along(planes, faces_a, faces_b, point, normal);
  result.overlap = nearest(distances, 0, faces_a) + nearest(distances, faces_a, faces_b);
  result.section = section(planes, point, normal);
  return result;
}

}  // namespace voussoir::exact
