// A new contact, of which nothing is known: the dual simplex decides whether it touches (Eq. 3.27), and from its point
// a primal-dual method covers most of the distance to the analytic centre: from the corner at which the simplex ends,
// Newton alone would double its distance to the faces at every step.
#if defined(VOUSSOIR_COLD_START_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef VOUSSOIR_COLD_START_INL
#undef VOUSSOIR_COLD_START_INL
#else
#define VOUSSOIR_COLD_START_INL
#endif

#include <Eigen/Core>

#include "core/contact/kernel/warm_start_inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace voussoir {
namespace HWY_NAMESPACE {

// Tight planes of the dual simplex, one in each lane; in 2-D the last lane holds none. With C = columns (a_i, 1),
// C λ = (0, …, 0, 1) and (x, -s) C = d.
template <int Dim>
struct TightPlanes {
  static constexpr int size = Dim + 1;
  int planes[planes_per_quad];           // padded numbers
  OnePair::Wide inverse[size], offsets;  // columns of C's inverse

  HWY_INLINE void multipliers(double (&lambda)[planes_per_quad]) const {
    OnePair::store(larger(inverse[Dim], OnePair::wide(0)), lambda);
  }
};

template <int Dim>
HWY_INLINE Components<double, Dim> normal_of(const Batch<OnePair, Dim>& m, int plane) {
  Components<double, Dim> n;
  for (int k = 0; k < Dim; ++k)
    n[k] = m.number(m.normal_at + k, plane);
  return n;
}

// the plane most violated at x, and by how much
template <int Dim>
HWY_INLINE void most_violated(const Batch<OnePair, Dim>& m, const Components<double, Dim>& x, double& value,
                              int& plane) {
  using L = OnePair;
  const Components<L::Wide, Dim> at = m.wide(x);
  const auto violation = [&](int slot) HWY_ATTR { return dot(m.normals(slot), at) - m.get(m.slack_at, slot); };
  L::find_largest({0, m.quads}, -std::numeric_limits<double>::max(), violation, value, plane);
}

// x and -s where the tight planes intersect
template <int Dim>
HWY_INLINE void intersect(const TightPlanes<Dim>& t, Components<double, Dim>& x, double& s) {
  OnePair::Wide products[Dim + 1];
  for (int j = 0; j <= Dim; ++j)
    products[j] = t.offsets * t.inverse[j];
  double y[Dim + 1];
  OnePair::add_up<Dim + 1>(products, y);
  for (int j = 0; j < Dim; ++j)
    x[j] = y[j];
  s = -y[Dim];
}

// the tight plane that leaves, known at compile time: only the branch to here waits for its number
template <int leave, int Dim>
HWY_INLINE void replace(TightPlanes<Dim>& t, const OnePair::Wide& mu, int plane, double offset) {
  using L = OnePair;
  const auto leaving = L::only<leave>();
  const L::Wide inverse_pivot = L::spread<leave>(L::wide(1) / select(leaving, mu, L::wide(1)));
  for (L::Wide& column : t.inverse) {
    const L::Wide entered = inverse_pivot * L::spread<leave>(column);
    column = select(leaving, entered, column - mu * entered);
  }
  t.planes[leave] = plane;
  t.offsets = select(leaving, L::wide(offset), t.offsets);
}

// the entering plane takes the place of the first tight plane to lose its multiplier, of several that with the largest
// pivot
template <int Dim>
HWY_INLINE bool exchange(TightPlanes<Dim>& t, int plane, const Components<double, Dim>& normal, double offset) {
  using L = OnePair;
  using Wide = L::Wide;
  Wide mu = L::wide(0), size_of_mu = mu;
  for (int j = 0; j < Dim; ++j) {
    const Wide term = t.inverse[j] * L::wide(normal[j]);
    mu = mu + term;
    size_of_mu = size_of_mu + magnitude(term);
  }
  mu = mu + t.inverse[Dim];
  size_of_mu = size_of_mu + magnitude(t.inverse[Dim]);
  double pivots[planes_per_quad], sizes[planes_per_quad], lambda[planes_per_quad];
  L::store(mu, pivots);
  L::store(L::wide(exchange_rounding) * size_of_mu, sizes);
  t.multipliers(lambda);
  int leave = -1;
  double least = std::numeric_limits<double>::max();
  for (int k = 0; k <= Dim; ++k) {
    if (pivots[k] <= sizes[k]) continue;
    const double ratio = lambda[k] / pivots[k];
    if (ratio < least || (ratio == least && leave >= 0 && pivots[k] > pivots[leave])) {
      least = ratio;
      leave = k;
    }
  }
  if (leave == 0) replace<0>(t, mu, plane, offset);
  if (leave == 1) replace<1>(t, mu, plane, offset);
  if (leave == 2) replace<2>(t, mu, plane, offset);
  if (leave == 3) replace<3>(t, mu, plane, offset);
  return leave >= 0;
}

// Σ over A's planes of λ a: it separates the parts, or nearly does
template <int Dim>
HWY_INLINE Components<double, Dim> axis_of(const Batch<OnePair, Dim>& m, const TightPlanes<Dim>& t) {
  Components<double, Dim> axis{};
  double lambda[planes_per_quad];
  t.multipliers(lambda);
  for (int k = 0; k <= Dim; ++k)
    if (t.planes[k] < m.quads_a * planes_per_quad) axis = axis + scaled(lambda[k], normal_of(m, t.planes[k]));
  return axis;
}

// The bound that the multipliers certify by weak duality, however rounded: s >= -(Σ λ d + |Σ λ a| |x|) / Σ λ.
template <int Dim>
HWY_INLINE double certified_lower_bound(const Batch<OnePair, Dim>& m, const TightPlanes<Dim>& t, double reach) {
  Components<double, Dim> residual{};
  double sum = 0, offsets = 0, lambda[planes_per_quad], offset[planes_per_quad];
  t.multipliers(lambda);
  OnePair::store(t.offsets, offset);
  for (int k = 0; k <= Dim; ++k) {
    residual = residual + scaled(lambda[k], normal_of(m, t.planes[k]));
    offsets += lambda[k] * offset[k];
    sum += lambda[k];
  }
  return -(offsets + size_of(residual) * reach) / sum - m.rounding - slack_rounding * reach;
}

// of a slack seen from x, at most
template <int Dim>
HWY_INLINE double rounding_after(const Batch<OnePair, Dim>& m, const Components<double, Dim>& x) {
  return m.rounding + 4 * slack_rounding * size_of(x);
}

enum class Decision { unknown, separated, touching };

// Whether the line from A's origin to B's has a part within both blocks whose middle is certainly inside: it has if
// they meet face on face. `x` is the middle, `worst` its largest violation.
template <int Dim>
HWY_INLINE bool meets_on_line(const Batch<OnePair, Dim>& m, Components<double, Dim>& x, double& worst) {
  using L = OnePair;
  // planes that are nearly parallel to the line are left to the check of the point
  const L::Wide shallow = L::wide(nearly_parallel * size_of(m.offset)), far = L::wide(far_away), none = L::wide(0);
  const Components<L::Wide, Dim> direction = m.wide(m.offset), centre = m.wide(m.point);
  L::Wide leaves = far, enters = none - far;
  for (int slot = 0; slot < m.quads; ++slot) {
    const Components<L::Wide, Dim> n = m.normals(slot);
    const L::Wide rate = dot(n, direction), slack = m.get(m.slack_at, slot) + dot(n, centre);  // at A's origin
    const L::Wide at = slack / select(magnitude(rate) > shallow, rate, L::wide(1));
    leaves = smaller(leaves, select(rate > shallow, at, far));
    enters = larger(enters, select(none - rate > shallow, at, none - far));
  }
  const double first = L::most(enters), last = L::least(leaves);
  if (!(first < last)) return false;
  x = scaled(0.5 * (first + last), m.offset) - m.point;  // as all planes are, seen from the smaller part's centre
  int unused;
  most_violated(m, x, worst, unused);
  return -worst > rounding_after(m, x) + m.tolerance;
}

template <int Dim>
HWY_INLINE Decision decide(const Batch<OnePair, Dim>& m, TightPlanes<Dim>& t, double reach, double enough,
                           Components<double, Dim>& x, double& worst, double& bound, int& pivots) {
  for (pivots = 0; pivots < most_exchanges; ++pivots) {
    double s;
    int plane;
    intersect(t, x, s);
    if (s > 0) {
      bound = certified_lower_bound(m, t, reach);
      if (bound > 0) return Decision::separated;
    }
    most_violated(m, x, worst, plane);
    const double rounding = m.rounding + 2 * slack_rounding * size_of(x);
    // far enough inside, or as far inside as possible
    if (worst < -(rounding + m.tolerance) && (worst <= enough * s || worst - s <= rounding)) return Decision::touching;
    if (worst - s <= rounding) return Decision::unknown;
    if (std::find(t.planes, t.planes + Dim + 1, plane) != t.planes + Dim + 1) return Decision::unknown;
    if (!exchange(t, plane, normal_of(m, plane), m.number(m.slack_at, plane))) return Decision::unknown;
  }
  return Decision::unknown;
}

// the plane that is thinnest seen across the axis: largest tangential part of its normal over its slack at x
template <int Dim>
HWY_INLINE Components<double, Dim> thinnest_across(const Batch<OnePair, Dim>& m, const Components<double, Dim>& axis,
                                                   const Components<double, Dim>& x) {
  using L = OnePair;
  const Components<L::Wide, Dim> direction = m.wide(axis), at = m.wide(x);
  double value;
  int number;
  const auto thinness = [&](int slot) HWY_ATTR {
    const Components<L::Wide, Dim> n = m.normals(slot);
    const L::Wide along = dot(n, direction), slack = m.get(m.slack_at, slot) - dot(n, at);
    return (L::wide(1) - along * along) / (slack * slack);
  };
  L::find_largest({0, m.quads}, -1, thinness, value, number);
  const Components<double, Dim> n = normal_of(m, number);
  const Components<double, Dim> across = n - scaled(dot(n, axis), axis);
  const double length = root(dot(across, across));
  return length > 0 ? scaled(1 / length, across) : across;
}

// the plane with the smallest slack at x, its normal seen from A to B
template <int Dim>
HWY_INLINE Components<double, Dim> nearest_face(const Batch<OnePair, Dim>& m, const Components<double, Dim>& x) {
  double value;
  int plane;
  most_violated(m, x, value, plane);
  const Components<double, Dim> n = normal_of(m, plane);
  return plane < m.quads_a * planes_per_quad ? n : scaled(-1.0, n);
}

// The planes in the frame's axes, seen from x: less exact than assembled ones by the growth of `rounding`.
template <int Dim>
HWY_INLINE void turn_planes(Batch<OnePair, Dim>& m, const Components<double, Dim>& x) {
  using L = OnePair;
  const Components<L::Wide, Dim> to = m.wide(x);
  Components<L::Wide, Dim> turn[Dim];
  for (int i = 0; i < Dim; ++i)
    turn[i] = m.wide(m.frame[i]);
  L::Wide least = L::wide(std::numeric_limits<double>::max());
  for (int slot = 0; slot < m.quads; ++slot) {
    const Components<L::Wide, Dim> n = m.normals(slot);
    const L::Wide slack = m.get(m.slack_at, slot) - dot(n, to);
    least = smaller(least, slack);
    m.set(slack, m.slack_at, slot);
    for (int i = 0; i < Dim; ++i)
      m.set(dot(turn[i], n), m.normal_at + i, slot);
  }
  m.least = L::least(least);
  m.rounding = rounding_after(m, x);
}

// Primal-dual steps (weights z/s in place of 1/s²) until Newton would converge.
template <int Dim>
HWY_INLINE int approach_centre(Batch<OnePair, Dim>& m) {
  using L = OnePair;
  constexpr int sums_count = Dim + Dim * (Dim + 1) / 2;
  for (int slot = 0; slot < m.quads; ++slot)
    m.set(L::wide(1) / m.get(m.slack_at, slot), m.multiplier_at, slot);
  for (int k = 0; k < Dim; ++k)
    m.moved[k] = 0;
  int iterations = 0;
  for (; iterations < most_approaches; ++iterations) {
    double sums[sums_count];
    L::sum<sums_count>(m.part, sums, [&](int slot, L::Wide(&acc)[sums_count]) HWY_ATTR {
      const L::Wide inverse = L::wide(1) / m.get(m.slack_at, slot);
      m.set(inverse, m.inverse_at, slot);
      const Components<L::Wide, Dim> n = m.normals(slot), p = scaled(inverse, n);
      m.set_vector(p, m.scaled_at, slot);
      accumulate(p, scaled(m.get(m.multiplier_at, slot), n), acc);
    });
    Components<double, Dim> step;
    double decrement2;
    bool solved;
    newton_direction<OnePair, Dim>(sums, step, decrement2, solved);
    if (!solved) return -1;
    if (decrement2 < full_step_decrement2) break;

    const Components<L::Wide, Dim> direction = m.wide(step);
    L::Wide primal = L::wide(0), dual = primal;
    for (int slot = 0; slot < m.quads; ++slot) {
      const L::Wide z = m.get(m.multiplier_at, slot), inverse = m.get(m.inverse_at, slot);
      const L::Wide along = dot(m.get_vector(m.scaled_at, slot), direction);  // relative loss of slack
      primal = larger(primal, along);
      // relative loss of the multiplier: Δz = 1/s - z + z (a·Δx)/s
      dual = larger(dual, (L::wide(1) - inverse / z) - along);
    }
    const double most_primal = L::most(primal), most_dual = L::most(dual);
    const double slack_step = most_primal > near_boundary ? near_boundary / most_primal : 1;
    const double multiplier_step = most_dual > near_boundary ? near_boundary / most_dual : 1;
    const L::Wide ds = L::wide(slack_step), dz = L::wide(multiplier_step);
    for (int slot = 0; slot < m.quads; ++slot) {
      const L::Wide s = m.get(m.slack_at, slot), z = m.get(m.multiplier_at, slot);
      const L::Wide along = dot(m.get_vector(m.scaled_at, slot), direction);
      m.set(z + dz * (m.get(m.inverse_at, slot) - z + z * along), m.multiplier_at, slot);
      m.set(s - ds * dot(m.normals(slot), direction), m.slack_at, slot);
    }
    for (int k = 0; k < Dim; ++k)
      m.moved[k] = m.moved[k] + slack_step * step[k];
  }
  return iterations;
}

}  // namespace HWY_NAMESPACE
}  // namespace voussoir
HWY_AFTER_NAMESPACE();
#endif
