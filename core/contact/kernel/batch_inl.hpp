// A batch of pairs, as many as one register holds, and their data until they are resolved (warm_start_inl.hpp,
// central_inl.hpp).
#if defined(VOUSSOIR_BATCH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef VOUSSOIR_BATCH_INL
#undef VOUSSOIR_BATCH_INL
#else
#define VOUSSOIR_BATCH_INL
#endif

#include "core/contact/kernel/lanes_inl.hpp"
#include "core/contact/kernel/records_inl.hpp"
#include "core/contact/kernel/workspace.hpp"

HWY_BEFORE_NAMESPACE();
namespace voussoir {
namespace HWY_NAMESPACE {

template <class L, int Dim>
struct Batch : Fields<Dim> {
  using Real = typename L::Real;
  using Wide = typename L::Wide;
  using Bool = typename L::Bool;

  Sources<L::width> a, b;  // planes as the parts store them
  Slots part[2];
  int quads_a = 0, quads = 0;
  double* numbers = nullptr;  // Fields of each slot, and two numbers of each plane as scratch behind

  Components<Real, Dim> rotation[Dim], offset;  // rows; B's frame -> A's
  Components<Real, Dim> point, axis, tangent;   // A's frame
  // rows: normal, unit; tangent, binormal, as long as `across`. A vector has components along them, which add up to
  // it, and products with them, which the planes' normals are kept as; times `inverse_across` across the normal, either
  // are components along unit axes.
  Components<Real, Dim> frame[Dim];
  Real across, inverse_across;  // 3-D
  Real reach;                   // m, the larger of the parts' radii
  Real tolerance, potential_radius;
  Real smoothing, diameter[2];  // m, only on the central path
  Bool good;
  Bool fallback;  // a face's normal replaced a gradient

  Real rounding;                 // m, of a slack
  Components<Real, Dim> moved;   // contact frame
  Real least;                    // smallest slack
  Components<Real, Dim> normal;  // along the frame's rows
  Real bound, stiffness_factor;  // only on the central path
  Real overlap, area, iterations;
  typename L::Number face_a, face_b;

  HWY_INLINE Components<Wide, Dim> wide(const Components<Real, Dim>& x) const {
    Components<Wide, Dim> r;
    for (int k = 0; k < Dim; ++k)
      r[k] = L::wide(x[k]);
    return r;
  }
  HWY_INLINE Wide get(int field, int slot) const {
    return L::load(numbers + (slot * Fields<Dim>::fields + field) * L::step);
  }
  HWY_INLINE void set(const Wide& x, int field, int slot) {
    L::store(x, numbers + (slot * Fields<Dim>::fields + field) * L::step);
  }
  HWY_INLINE Components<Wide, Dim> get_vector(int field, int slot) const {
    Components<Wide, Dim> r;
    for (int k = 0; k < Dim; ++k)
      r[k] = get(field + k, slot);
    return r;
  }
  HWY_INLINE void set_vector(const Components<Wide, Dim>& x, int field, int slot) {
    for (int k = 0; k < Dim; ++k)
      set(x[k], field + k, slot);
  }
  HWY_INLINE Components<Wide, Dim> normals(int slot) const { return get_vector(Fields<Dim>::normal_at, slot); }
  static HWY_INLINE int room(int quads) { return quads * planes_per_quad * (Fields<Dim>::fields * L::width + 2); }
  HWY_INLINE double* scratch() const { return numbers + quads * planes_per_quad * Fields<Dim>::fields * L::width; }
  // one number of one plane
  HWY_INLINE double number(int field, int plane, int lane = 0) const {
    return numbers[(L::slot_of(plane) * Fields<Dim>::fields + field) * L::step + L::place_of(plane, lane)];
  }
};

template <class Real>
HWY_INLINE Real size_of(const Components<Real, 2>& x) {
  return magnitude(x[0]) + magnitude(x[1]);
}
template <class Real>
HWY_INLINE Real size_of(const Components<Real, 3>& x) {
  return magnitude(x[0]) + magnitude(x[1]) + magnitude(x[2]);
}

template <class Real, int Dim>
HWY_INLINE Components<Real, Dim> column(const Components<Real, Dim> (&rows)[Dim], int k) {
  Components<Real, Dim> r;
  for (int j = 0; j < Dim; ++j)
    r[j] = rows[j][k];
  return r;
}

// Σ x_k row_k
template <class Real, int Dim>
HWY_INLINE Components<Real, Dim> from_frame(const Components<Real, Dim> (&rows)[Dim], const Components<Real, Dim>& x) {
  Components<Real, Dim> r = scaled(x[0], rows[0]);
  for (int k = 1; k < Dim; ++k)
    r = r + scaled(x[k], rows[k]);
  return r;
}

// A vector that is unit but for rounding, made so by one step of Newton for 1/√: otherwise the errors of axes and
// rotations would accumulate in the axis that is kept from step to step.
template <class L, int Dim>
HWY_INLINE Components<typename L::Real, Dim> unit_again(const Components<typename L::Real, Dim>& x) {
  return scaled(L::real(1.5) - L::real(0.5) * dot(x, x), x);
}

}  // namespace HWY_NAMESPACE
}  // namespace voussoir
HWY_AFTER_NAMESPACE();
#endif
