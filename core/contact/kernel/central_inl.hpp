// A contact by multipliers on the central path (solvers/central_path.hpp), from a point known to lie inside both
// parts: Newton in x and s, then the gradient and the value of the barrier, which are normal and overlap. In the first
// part's axes: distances to the planes, s included, are never less than the smoothing, and no frame must fit them.
#if defined(VOUSSOIR_CENTRAL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef VOUSSOIR_CENTRAL_INL
#undef VOUSSOIR_CENTRAL_INL
#else
#define VOUSSOIR_CENTRAL_INL
#endif

#include <cmath>

#include "core/contact/kernel/warm_start_inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace voussoir {
namespace HWY_NAMESPACE {

// H y = -g for x and -s by LDLᵀ; `sums` holds g, then the lower half of H by rows
template <class L, int Size>
HWY_INLINE void bordered_direction(const typename L::Real (&sums)[Size + Size * (Size + 1) / 2],
                                   typename L::Real (&step)[Size], typename L::Real& decrement2,
                                   typename L::Bool& solved) {
  using Real = typename L::Real;
  const Real zero = L::real(0), one = L::real(1);
  Real h[Size][Size], inverse[Size];
  for (int i = 0, next = Size; i < Size; ++i) {
    step[i] = -sums[i];
    for (int j = 0; j <= i; ++j)
      h[i][j] = sums[next++];
  }
  for (int k = 0; k < Size; ++k) {
    solved = k == 0 ? h[k][k] > zero : both(solved, h[k][k] > zero);
    inverse[k] = one / select(solved, h[k][k], one);
    for (int i = k + 1; i < Size; ++i) {
      const Real factor = h[i][k] * inverse[k];
      for (int j = k + 1; j <= i; ++j)
        h[i][j] = h[i][j] - factor * h[j][k];
      step[i] = step[i] - factor * step[k];
    }
  }
  for (int k = Size - 1; k >= 0; --k) {
    for (int i = k + 1; i < Size; ++i)
      step[k] = step[k] - h[i][k] * step[i];
    step[k] = step[k] * inverse[k];
  }
  decrement2 = zero;
  for (int k = 0; k < Size; ++k)
    decrement2 = decrement2 - sums[k] * step[k];
}

// Damped Newton; the slots' slacks become t = s + d - a·x, their inverses with them. Pairs that are done do not move.
template <class L, int Dim>
HWY_INLINE void follow_path(Batch<L, Dim>& m, double tolerance, int limit) {
  using Real = typename L::Real;
  using Wide = typename L::Wide;
  using Bool = typename L::Bool;
  constexpr int size = Dim + 1, sums_count = size + size * (size + 1) / 2;
  const Real zero = L::real(0), one = L::real(1), enough = L::real(tolerance * tolerance);
  const Real pull = one / m.smoothing;
  m.bound = L::real(2) * m.smoothing - m.least;
  const Wide up = L::wide(m.bound);
  for_slots<L>(m.part, [&](int slot) HWY_ATTR { m.set(m.get(m.slack_at, slot) + up, m.slack_at, slot); });
  m.least = m.least + m.bound;
  invert_slacks(m);
  Bool moving = m.good;
  for (int i = 0; i < limit && !none(moving); ++i) {
    Real sums[sums_count];
    L::template sum<sums_count>(m.part, sums, [&](int slot, Wide(&acc)[sums_count]) HWY_ATTR {
      Wide p[size];
      p[Dim] = m.get(m.inverse_at, slot);
      const Components<Wide, Dim> n = m.normals(slot);
      for (int j = 0; j < Dim; ++j)
        p[j] = p[Dim] * n[j];
      for (int j = 0, next = size; j < size; ++j) {
        acc[j] = acc[j] + p[j];
        for (int k = 0; k <= j; ++k, ++next)
          acc[next] = acc[next] + p[j] * p[k];
      }
    });
    sums[Dim] = sums[Dim] - pull;
    Real step[size], decrement2;
    Bool solved;
    bordered_direction<L, size>(sums, step, decrement2, solved);
    m.good = but_not(m.good, but_not(moving, solved));
    moving = both(moving, solved);

    // a full step when it is safe, else the largest that provably stays within
    const auto taken = [&](const Wide(&by)[size], int slot) HWY_ATTR {
      const Components<Wide, Dim> n = m.normals(slot);
      Wide t = by[Dim];
      for (int k = 0; k < Dim; ++k)
        t = t + n[k] * by[k];
      return t;
    };
    const Bool full = decrement2 < L::real(full_step_decrement2);
    Real length = one;
    if (!none(but_not(moving, full))) {
      Wide direction[size], most = L::wide(0.0);
      for (int k = 0; k < size; ++k)
        direction[k] = L::wide(step[k]);
      for_slots<L>(m.part,
                   [&](int slot) HWY_ATTR { most = larger(most, m.get(m.inverse_at, slot) * taken(direction, slot)); });
      length = select(full, one, one / (one + L::most(most)));
    }
    m.iterations = m.iterations + select(moving, one, zero);
    Wide shift[size];
    for (int k = 0; k < size; ++k) {
      step[k] = select(moving, length * step[k], zero);
      shift[k] = L::wide(step[k]);
    }
    for (int k = 0; k < Dim; ++k)
      m.moved[k] = m.moved[k] + step[k];
    m.bound = m.bound - step[Dim];
    const Bool inside = take_from_slacks(m, moving, [&](int slot) HWY_ATTR { return taken(shift, slot); });
    const Bool done = both(moving, decrement2 < enough);
    moving = both(but_not(moving, done), inside);
  }
  m.good = but_not(m.good, moving);
}

// below it a product of distances over diameters has lost its digits, or has none: too many planes for this kernel
inline constexpr double least_product = 0x1p-900;

// The value of the barrier as in the reference kernel (reference_kernel.cpp): distances over the diameters of their
// parts, without the two logarithms that any contact has.
template <class L, int Dim>
HWY_INLINE typename L::Real barrier_value(Batch<L, Dim>& m) {
  using Real = typename L::Real;
  using Wide = typename L::Wide;
  const Real one = L::real(1);
  const Wide inverse[2] = {L::wide(one / m.diameter[0]), L::wide(one / m.diameter[1])};
  const Wide padding = L::wide(0.5 * far_away), nothing = L::wide(1.0);
  Real product;
  L::multiply(m.part, product, [&](int part, int slot) HWY_ATTR {
    const Wide t = m.get(m.slack_at, slot);
    return select(t < padding, t * inverse[part], nothing);
  });
  const Real twice = L::real(2) * m.smoothing;
  product = product * ((m.diameter[0] / twice) * (m.diameter[1] / twice));
  m.good = both(m.good, product > L::real(least_product));
  double logarithms[L::width];
  L::put(select(m.good, product, one), logarithms);
  for (double& x : logarithms)
    x = std::log(x);
  return m.bound - m.smoothing * (L::pick(logarithms) + L::real(2));
}

// Normal and overlap from the barrier's gradient g over the first part's planes, and the fraction of a stiffness, 4 g².
template <class L, int Dim>
HWY_INLINE void measure_by_barrier(Batch<L, Dim>& m) {
  using Real = typename L::Real;
  using Wide = typename L::Wide;
  const Real zero = L::real(0), one = L::real(1);
  const Real value = barrier_value(m);
  Real gradient[Dim];
  L::template sum<Dim>({m.part[0]}, gradient, [&](int slot, Wide(&acc)[Dim]) HWY_ATTR {
    const Components<Wide, Dim> p = scaled(m.get(m.inverse_at, slot), m.normals(slot));
    for (int k = 0; k < Dim; ++k)
      acc[k] = acc[k] + p[k];
  });
  Components<Real, Dim> g;
  for (int k = 0; k < Dim; ++k)
    g[k] = m.smoothing * gradient[k];
  const Real length = root(dot(g, g));
  m.good = both(m.good, length > L::real(parallel_gradients));
  const Real safe = select(m.good, length, one);
  m.normal = scaled(one / safe, g);
  m.overlap = larger(-value, zero) / safe;
  m.stiffness_factor = L::real(4) * length * length;
  Real most;
  const auto closeness = [&](int slot) HWY_ATTR { return m.get(m.inverse_at, slot); };
  L::find_largest(m.part[0], 0, closeness, most, m.face_a);
  L::find_largest(m.part[1], 0, closeness, most, m.face_b);
}

// everything from the start on; the results of pairs that are not good are meaningless
template <class L, int Dim>
HWY_INLINE void resolve_on_central_path(Batch<L, Dim>& m, QueryLevel level, double tolerance, int limit,
                                        SectionList* lists) {
  using Real = typename L::Real;
  using Wide = typename L::Wide;
  clear(m);
  for (int i = 0; i < Dim; ++i)
    for (int k = 0; k < Dim; ++k)
      m.frame[i][k] = L::real(i == k);
  m.across = m.inverse_across = L::real(1);
  assemble_in_first(m);
  m.good = both(m.good, m.least > m.rounding + m.tolerance);
  if (level == QueryLevel::decision || none(m.good)) return;
  const Real start_least = m.least;
  follow_path(m, tolerance, limit);

  // The point of a region thinner than the smoothing may lie outside; the start does not, and there is no force yet.
  const Real rounding = m.rounding + L::real(4 * slack_rounding) * (size_of(m.moved) + magnitude(m.bound));
  m.least = m.least - m.bound;
  const typename L::Bool inside = m.least > rounding;
  m.least = select(inside, m.least, start_least);
  m.rounding = select(inside, rounding, m.rounding);
  for (int k = 0; k < Dim; ++k)
    m.point[k] = m.point[k] + select(inside, m.moved[k], L::real(0));
  if (level == QueryLevel::point || none(m.good)) return;
  measure_by_barrier(m);
  if (level == QueryLevel::overlap || none(m.good)) return;
  m.good = both(m.good, inside);
  const Wide down = L::wide(m.bound);
  invert_slacks(m, [&](int slot) HWY_ATTR { return m.get(m.slack_at, slot) - down; });
  measure_area(m, lists);
}

}  // namespace HWY_NAMESPACE
}  // namespace voussoir
HWY_AFTER_NAMESPACE();
#endif
