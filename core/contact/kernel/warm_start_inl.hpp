// A warm start: a contact from a point known to lie inside both parts, by Newton to the analytic centre, normal,
// overlap, area. Written once for both methods to fill a register (lanes_inl.hpp).
//
// All computations are in the contact frame: origin at the start, axes along the old normal and the next-thinnest
// direction. There the Hessian is graded and factorising it top down loses nothing, at any thickness of the region (the
// thesis' 3.3.6 without its scaling factors).
#if defined(VOUSSOIR_WARM_START_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef VOUSSOIR_WARM_START_INL
#undef VOUSSOIR_WARM_START_INL
#else
#define VOUSSOIR_WARM_START_INL
#endif

#include <limits>

#include "core/contact/kernel/batch_inl.hpp"
#include "core/contact/kernel/section_inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace voussoir {
namespace HWY_NAMESPACE {

// The tangent is that of the contact's begin, the normal has turned since: they span the frame as they are, since
// Newton's method needs no unit axes, and no result waits for a root and a quotient.
template <class L, int Dim>
HWY_INLINE void build_frame(Batch<L, Dim>& m) {
  using Real = typename L::Real;
  for (int k = 0; k < Dim; ++k)  // number by number: a copy of all would wait for the stores before it
    m.frame[0][k] = m.axis[k];
  if constexpr (Dim == 2) {
    m.frame[1] = {-m.axis[1], m.axis[0]};
  } else {
    m.frame[2] = cross_product(m.axis, m.tangent);
    m.frame[1] = cross_product(m.frame[2], m.frame[0]);
    const Real length2 = dot(m.frame[2], m.frame[2]);
    m.good = both(m.good, length2 > L::real(smallest_binormal2));
    m.across = root(select(m.good, length2, L::real(1)));
    m.inverse_across = L::real(1) / m.across;
  }
}

// products with the rows as components along unit axes, these as components along the rows
template <class L>
HWY_INLINE Components<typename L::Real, 2> rescaled(const Batch<L, 2>&, const Components<typename L::Real, 2>& x) {
  return x;
}
template <class L>
HWY_INLINE Components<typename L::Real, 3> rescaled(const Batch<L, 3>& m, const Components<typename L::Real, 3>& x) {
  return {x[0], m.inverse_across * x[1], m.inverse_across * x[2]};
}

// The slacks at the start, in each part's own frame, to full accuracy; `keep` takes each slot's normals there.
template <class L, int Dim, class Keep>
HWY_INLINE void assemble_slacks(Batch<L, Dim>& m, const Keep& keep) {
  using Real = typename L::Real;
  using Wide = typename L::Wide;
  const Components<Real, Dim> from_b = m.point - m.offset;
  Components<Real, Dim> point_b;
  for (int k = 0; k < Dim; ++k)
    point_b[k] = dot(column(m.rotation, k), from_b);

  Wide least = L::wide(std::numeric_limits<double>::max());
  for (int part = 0; part < 2; ++part) {
    const Components<Wide, Dim> x = m.wide(part == 0 ? m.point : point_b);
    for_slots(m.part[part], [&](int slot) HWY_ATTR {
      Components<Wide, Dim> n;
      Wide d;
      load_planes<L, Dim>(part == 0 ? m.a : m.b, slot - m.part[part].first, n, d);
      const Wide slack = d - dot(n, x);
      least = smaller(least, slack);
      m.set(slack, m.slack_at, slot);
      keep(part, slot, n);
    });
  }
  m.least = L::least(least);
  m.rounding = L::real(slack_rounding) * (m.reach + L::real(2) * (size_of(m.point) + size_of(from_b)));
}

// planes in the contact frame and their slacks
template <class L, int Dim>
HWY_INLINE void assemble_planes(Batch<L, Dim>& m) {
  using Wide = typename L::Wide;
  Components<Wide, Dim> turn[2][Dim];
  for (int i = 0; i < Dim; ++i) {
    turn[0][i] = m.wide(m.frame[i]);
    for (int k = 0; k < Dim; ++k)
      turn[1][i][k] = L::wide(dot(m.frame[i], column(m.rotation, k)));
  }
  assemble_slacks(m, [&](int part, int slot, const Components<Wide, Dim>& n) HWY_ATTR {
    for (int i = 0; i < Dim; ++i)
      m.set(dot(turn[part][i], n), m.normal_at + i, slot);
  });
}

// planes in the first part's axes, and their slacks
template <class L, int Dim>
HWY_INLINE void assemble_in_first(Batch<L, Dim>& m) {
  using Wide = typename L::Wide;
  Components<Wide, Dim> turn[Dim];
  for (int i = 0; i < Dim; ++i)
    turn[i] = m.wide(m.rotation[i]);
  assemble_slacks(m, [&](int part, int slot, const Components<Wide, Dim>& n) HWY_ATTR {
    for (int i = 0; i < Dim; ++i)
      m.set(part == 0 ? n[i] : dot(turn[i], n), m.normal_at + i, slot);
  });
}

// Newton's direction of -Σ log s in a graded frame, and its decrement²; `solved` if the system has full rank. The
// first unknown is eliminated without a quotient, the other two follow by Cramer's rule, so that no quotient waits for
// another. The decrement is a sum of squares. (By the adjugate of all three and the product of step and gradient, the
// decrement cancels if one plane is a millionth as near as the others, and Newton stops beside the centre: two of
// 625,000 pairs.)
template <class L, int Dim>
HWY_INLINE void newton_direction(const typename L::Real (&sums)[Dim + Dim * (Dim + 1) / 2],
                                 Components<typename L::Real, Dim>& step, typename L::Real& decrement2,
                                 typename L::Bool& solved) {
  using Real = typename L::Real;
  const Real one = L::real(1), zero = L::real(0), tiny = L::real(smallest_pivot);
  if constexpr (Dim == 2) {
    const Real g0 = sums[0], g1 = sums[1], h00 = sums[2], h01 = sums[3], h11 = sums[4];
    const Real square = h00 * h11, d1 = square - h01 * h01;
    solved = both(h00 > zero, d1 > tiny * square);
    const Real i0 = one / select(solved, h00, one), i1 = select(solved, one / select(solved, d1, one), zero);
    const Real y1 = h01 * g0 - h00 * g1;
    step[1] = y1 * i1;
    step[0] = -(g0 + h01 * step[1]) * i0;
    decrement2 = (g0 * g0 + y1 * step[1]) * i0;
  } else {
    const Real g0 = sums[0], g1 = sums[1], g2 = sums[2], h00 = sums[3], h01 = sums[4], h02 = sums[5], h11 = sums[6],
               h12 = sums[7], h22 = sums[8];
    const Real square = h00 * h11, d1 = square - h01 * h01, c = h00 * h12 - h01 * h02, e = h00 * h22 - h02 * h02;
    const Real product = d1 * e, d2 = product - c * c;
    solved = both(both(h00 > zero, d1 > tiny * square), d2 > tiny * (d1 * (h00 * h22)));
    const Real i0 = one / select(solved, h00, one), i1 = one / select(solved, d1, one),
               i2 = select(solved, one / select(solved, d2, one), zero);
    const Real y1 = h01 * g0 - h00 * g1, z = h02 * g0 - h00 * g2, y2 = d1 * z - c * y1;
    step[2] = y2 * i2;
    step[1] = (y1 * e - c * z) * i2;
    step[0] = -(g0 + h01 * step[1] + h02 * step[2]) * i0;
    decrement2 = (g0 * g0 + (y1 * y1 + y2 * step[2]) * i1) * i0;
  }
}

// one slot's fraction of the gradient, Σ p, and of the Hessian, Σ wp pᵀ
template <class Wide, int K>
HWY_INLINE void accumulate(const Components<Wide, 2>& p, const Components<Wide, 2>& wp, Wide (&acc)[K]) {
  acc[0] = acc[0] + p[0];
  acc[1] = acc[1] + p[1];
  acc[2] = acc[2] + wp[0] * p[0];
  acc[3] = acc[3] + wp[0] * p[1];
  acc[4] = acc[4] + wp[1] * p[1];
}
template <class Wide, int K>
HWY_INLINE void accumulate(const Components<Wide, 3>& p, const Components<Wide, 3>& wp, Wide (&acc)[K]) {
  acc[0] = acc[0] + p[0];
  acc[1] = acc[1] + p[1];
  acc[2] = acc[2] + p[2];
  acc[3] = acc[3] + wp[0] * p[0];
  acc[4] = acc[4] + wp[0] * p[1];
  acc[5] = acc[5] + wp[0] * p[2];
  acc[6] = acc[6] + wp[1] * p[1];
  acc[7] = acc[7] + wp[1] * p[2];
  acc[8] = acc[8] + wp[2] * p[2];
}

// Keeps the inverse of `slack` for each plane. Two planes of a part share a quotient; one whose other is
// padding gets the very bits of its own, so a pair's result is bitwise independent of the batch.
template <class L, int Dim, class F>
HWY_INLINE void invert_slacks(Batch<L, Dim>& m, const F& slack) {
  using Wide = typename L::Wide;
  const Wide floor = L::wide(least_inverted);
  for (const Slots& run : L::runs(m.part).all)
    L::invert(
        run, [&](int slot) HWY_ATTR { return L::where(m.good, larger(slack(slot), floor), 1); },
        [&](const Wide& inverse, int slot) HWY_ATTR { m.set(inverse, m.inverse_at, slot); });
}
template <class L, int Dim>
HWY_INLINE void invert_slacks(Batch<L, Dim>& m) {
  invert_slacks(m, [&](int slot) HWY_ATTR { return m.get(m.slack_at, slot); });
}

// Subtracts a step's change from each slack, and inverts the rest. Pairs that are no longer inside are lost.
template <class L, int Dim, class Taken>
HWY_INLINE typename L::Bool take_from_slacks(Batch<L, Dim>& m, const typename L::Bool& moving, const Taken& taken) {
  using Wide = typename L::Wide;
  Wide least = L::wide(std::numeric_limits<double>::max());
  invert_slacks(m, [&](int slot) HWY_ATTR {
    const Wide slack = m.get(m.slack_at, slot) - taken(slot);
    m.set(slack, m.slack_at, slot);
    least = smaller(least, slack);
    return slack;
  });
  m.least = select(moving, L::least(least), m.least);
  const typename L::Bool inside = m.least > L::real(0);
  if (const typename L::Bool lost = but_not(m.good, inside); !none(lost)) {
    m.good = both(m.good, inside);
    invert_slacks(m);  // theirs are no inverses
  }
  return inside;
}

// Damped Newton until the decrement before the last step was below the tolerance. Pairs that are done do not move.
template <class L, int Dim>
HWY_INLINE void find_centre(Batch<L, Dim>& m, double tolerance, int limit) {
  using Real = typename L::Real;
  using Wide = typename L::Wide;
  using Bool = typename L::Bool;
  constexpr int sums_count = Dim + Dim * (Dim + 1) / 2;
  const Real zero = L::real(0), one = L::real(1), enough = L::real(tolerance * tolerance);
  for (int k = 0; k < Dim; ++k)
    m.moved[k] = zero;
  m.iterations = zero;
  Bool moving = m.good;
  invert_slacks(m);
  for (int i = 0; i < limit && !none(moving); ++i) {
    Real sums[sums_count];
    L::template sum<sums_count>(m.part, sums, [&](int slot, Wide(&acc)[sums_count]) HWY_ATTR {
      const Components<Wide, Dim> p = scaled(m.get(m.inverse_at, slot), m.normals(slot));
      accumulate(p, p, acc);
    });
    Components<Real, Dim> step;
    Real decrement2;
    Bool solved;
    newton_direction<L, Dim>(sums, step, decrement2, solved);
    m.good = but_not(m.good, but_not(moving, solved));
    moving = both(moving, solved);

    // a full step when it is safe, else the largest whose slacks provably stay positive
    const Bool full = decrement2 < L::real(full_step_decrement2);
    Real length = one;
    if (!none(but_not(moving, full))) {
      const Components<Wide, Dim> direction = m.wide(step);
      Wide most = L::wide(0.0);
      for_slots<L>(m.part, [&](int slot) HWY_ATTR {
        most = larger(most, m.get(m.inverse_at, slot) * dot(m.normals(slot), direction));
      });
      length = select(full, one, one / (one + L::most(most)));
    }
    m.iterations = m.iterations + select(moving, one, zero);
    for (int k = 0; k < Dim; ++k) {
      step[k] = select(moving, length * step[k], zero);
      m.moved[k] = m.moved[k] + step[k];
    }
    const Components<Wide, Dim> shift = m.wide(step);
    const Bool inside = take_from_slacks(m, moving, [&](int slot) HWY_ATTR { return dot(m.normals(slot), shift); });
    const Bool done = both(moving, decrement2 < enough);
    moving = both(but_not(moving, done), inside);
  }
  m.good = but_not(m.good, moving);
}

// the normal of the part's face with the smallest slack, along unit axes
template <class L, int Dim>
HWY_INLINE Components<typename L::Real, Dim> nearest_normal(const Batch<L, Dim>& m, int part) {
  typename L::Real value;
  typename L::Number number;
  const auto closeness = [&](int slot) HWY_ATTR { return -m.get(m.slack_at, slot); };
  L::find_largest(m.part[part], -std::numeric_limits<double>::max(), closeness, value, number);
  double faces[L::width];
  L::put(number, faces);
  const int first = part ? m.quads_a * planes_per_quad : 0;
  Components<typename L::Real, Dim> n;
  for (int k = 0; k < Dim; ++k)
    n[k] = L::collect([&](int lane) { return m.number(m.normal_at + k, first + static_cast<int>(faces[lane]), lane); });
  return rescaled(m, n);
}

// Unit gradients of the two inner potentials Σ <r - s>² at the point, their difference (Eqs 3.31-3.35); the overlap
// along it and the faces that end it (Eq. 3.36). If a gradient vanishes, deeper than r in the part, the normal of its
// nearest face replaces it.
template <class L, int Dim>
HWY_INLINE void measure_overlap(Batch<L, Dim>& m) {
  using Real = typename L::Real;
  using Wide = typename L::Wide;
  using Bool = typename L::Bool;
  const Real zero = L::real(0), one = L::real(1);
  const Wide radius = L::wide(m.potential_radius);
  Components<Real, Dim> uphill[2];
  Real length[2];
  for (int part = 0; part < 2; ++part) {
    Real gradient[Dim];
    L::template sum<Dim>({m.part[part]}, gradient, [&](int slot, Wide(&acc)[Dim]) HWY_ATTR {
      const Wide depth = larger(radius - m.get(m.slack_at, slot), L::wide(0.0));
      const Components<Wide, Dim> n = m.normals(slot);
      for (int k = 0; k < Dim; ++k)
        acc[k] = acc[k] + depth * n[k];
    });
    Components<Real, Dim>& g = uphill[part];
    for (int k = 0; k < Dim; ++k)
      g[k] = gradient[k];
    g = rescaled(m, g);
    length[part] = root(dot(g, g));
    const Bool steep = length[part] > L::real(parallel_gradients) * m.potential_radius;
    if (const Bool flat = but_not(m.good, steep); !none(flat)) {
      m.fallback = either(m.fallback, flat);
      const Components<Real, Dim> nearest = nearest_normal(m, part);
      for (int k = 0; k < Dim; ++k)
        g[k] = select(flat, nearest[k], g[k]);
      length[part] = select(flat, one, length[part]);
    }
  }
  // of the unit gradients, times both lengths; the searches run along it while its own is found
  const Components<Real, Dim> difference = scaled(length[1], uphill[0]) - scaled(length[0], uphill[1]);
  const Real whole = root(dot(difference, difference));
  m.good = both(m.good, whole > L::real(parallel_gradients) * (length[0] * length[1]));
  const Components<Real, Dim> along = rescaled(m, difference);
  m.normal = scaled(one / select(m.good, whole, one), along);

  const Components<Wide, Dim> direction = m.wide(along);
  Real steepest[2];
  typename L::Number face[2];
  for (int part = 0; part < 2; ++part) {
    const auto slope = [&](int slot) HWY_ATTR {
      const Wide closing = m.get(m.inverse_at, slot) * dot(m.normals(slot), direction);
      return part ? -closing : closing;
    };
    L::find_largest(m.part[part], 0, slope, steepest[part], face[part]);
    m.good = both(m.good, steepest[part] > zero);
  }
  m.overlap = whole / select(m.good, steepest[0], one) + whole / select(m.good, steepest[1], one);
  m.face_a = face[0];
  m.face_b = face[1];
}

// Scaled normals in the contact plane: the section is {y : q·y <= 1}.
template <class L>
HWY_INLINE void project(Batch<L, 3>& m) {
  using Real = typename L::Real;
  using Wide = typename L::Wide;
  // unit axes of the plane by Duff et al. (2017), close to the frame's own when the normal is
  const Real sign = with_sign_of(L::real(1), m.normal[0]);
  const Real x = m.across * m.normal[1], y = m.across * m.normal[2];
  const Real a = L::real(-1) / (sign + m.normal[0]), b = x * y * a;
  const Components<Wide, 3> first = m.wide(rescaled<L>(m, {-(sign * x), L::real(1) + sign * x * x * a, sign * b}));
  const Components<Wide, 3> second = m.wide(rescaled<L>(m, {-y, b, sign + y * y * a}));
  for_slots<L>(m.part, [&](int slot) HWY_ATTR {
    const Components<Wide, 3> p = scaled(m.get(m.inverse_at, slot), m.normals(slot));
    m.set(dot(p, first), m.scaled_at, slot);
    m.set(dot(p, second), m.scaled_at + 1, slot);
  });
}

template <class L>
HWY_INLINE void measure_area(Batch<L, 2>& m, SectionList*) {
  using Wide = typename L::Wide;
  const Wide along0 = L::wide(-m.normal[1]), along1 = L::wide(m.normal[0]);
  Wide forward = L::wide(0.0), backward = forward;
  for_slots<L>(m.part, [&](int slot) HWY_ATTR {
    const Components<Wide, 2> p = scaled(m.get(m.inverse_at, slot), m.normals(slot));
    const Wide slope = p[0] * along0 + p[1] * along1;
    forward = larger(forward, slope);
    backward = larger(backward, -slope);
  });
  using Real = typename L::Real;
  const Real zero = L::real(0), one = L::real(1), f = L::most(forward), b = L::most(backward);
  m.good = both(m.good, both(f > zero, b > zero));
  m.area = one / select(m.good, f, one) + one / select(m.good, b, one);
}

template <class L>
HWY_INLINE void measure_area(Batch<L, 3>& m, SectionList* lists) {
  project(m);
  typename L::Bool known;
  const SectionPlanes<L> planes{m.numbers + m.scaled_at * L::step, m.fields * L::step};
  section_area_of<L>(planes, m.part, lists, m.good, m.area, known);
  rebuild_sections<L>(planes, m.part, m.quads, m.scratch(), lists, but_not(m.good, known), m.area, m.good);
}

// before any result
template <class L, int Dim>
HWY_INLINE void clear(Batch<L, Dim>& m) {
  for (int k = 0; k < Dim; ++k)
    m.moved[k] = m.normal[k] = L::real(0);
  m.iterations = m.overlap = m.area = L::real(0);
  m.face_a = m.face_b = L::number(0);
  m.fallback = but_not(m.good, m.good);
}

// everything from the start on; the results of pairs that are not good are meaningless
template <class L, int Dim>
HWY_INLINE void resolve_from_point(Batch<L, Dim>& m, QueryLevel level, double tolerance, int limit,
                                   SectionList* lists) {
  using Real = typename L::Real;
  clear(m);
  if (level == QueryLevel::decision) {
    assemble_slacks(m, [](int, int, const auto&) {});
    m.good = both(m.good, m.least > m.rounding + m.tolerance);
    return;
  }
  build_frame(m);
  assemble_planes(m);
  m.good = both(m.good, m.least > m.rounding + m.tolerance);
  if (none(m.good)) return;
  find_centre(m, tolerance, limit);
  m.rounding = m.rounding + L::real(4 * slack_rounding) * size_of(m.moved);
  m.good = both(m.good, m.least > m.rounding);
  const Components<Real, Dim> shift = from_frame(m.frame, m.moved);
  for (int k = 0; k < Dim; ++k)  // as in build_frame
    m.point[k] = m.point[k] + shift[k];
  if (level == QueryLevel::point || none(m.good)) return;
  measure_overlap(m);
  if (level == QueryLevel::overlap || none(m.good)) return;
  measure_area(m, lists);
}

}  // namespace HWY_NAMESPACE
}  // namespace voussoir
HWY_AFTER_NAMESPACE();
#endif
