#include "core/contact/contact_between.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <span>
#include <stdexcept>
#include <string>

#include "core/contact/narrow_phase.hpp"

namespace voussoir {
namespace {

// the deviation from orthonormal of a product of several rotations; beyond it the parts would be stretched visibly
constexpr double axes_rounding = 1e-12;

// a total order, so that even 0 and -0 differ: numbers that compare equal have the same bits
template <int Size>
std::strong_ordering compare(const FixedMatrix<Size, 1>& a, const FixedMatrix<Size, 1>& b) {
  return std::lexicographical_compare_three_way(a.data(), a.data() + Size, b.data(), b.data() + Size,
                                                [](double x, double y) { return std::strong_order(x, y); });
}

template <int Dim>
std::strong_ordering compare(const HalfSpace<Dim>& a, const HalfSpace<Dim>& b) {
  const std::strong_ordering normals = compare<Dim>(a.normal, b.normal);
  return normals != 0 ? normals : std::strong_order(a.offset, b.offset);
}

template <int Dim>
std::strong_ordering compare(const HalfSpaces<Dim>& a, const HalfSpaces<Dim>& b) {
  return std::lexicographical_compare_three_way(
      a.begin(), a.end(), b.begin(), b.end(),
      [](const HalfSpace<Dim>& f, const HalfSpace<Dim>& g) { return compare<Dim>(f, g); });
}

template <int Dim>
std::strong_ordering compare(const Pose<Dim>& a, const Pose<Dim>& b) {
  const std::strong_ordering positions = compare<Dim>(a.position, b.position);
  return positions != 0 ? positions : compare<Dim * Dim>(a.axes.reshaped(), b.axes.reshaped());
}

// Eigen's allFinite subtracts, which traps
template <class Derived>
bool finite(const Eigen::MatrixBase<Derived>& m) {
  return m.unaryExpr([](double x) { return std::isfinite(x); }).all();
}

template <int Dim>
void check(const Polytope<Dim>& part, const Pose<Dim>& at, const char* which) {
  const auto refuse = [&](const char* what) {
    throw std::invalid_argument(std::string("contact_between: the ") + which + " part's " + what);
  };
  if (part.faces.empty()) refuse("faces are missing");
  if (!finite(at.position)) refuse("position is not finite");
  if (!finite(at.axes)) refuse("axes are not finite");
  const double off = (at.axes.transpose() * at.axes - Matrix<Dim>::Identity()).cwiseAbs().maxCoeff();
  if (off > axes_rounding) refuse("axes are not orthonormal");
}

template <int Dim>
ContactBetween<Dim> resolve(const Polytope<Dim>& a, const Pose<Dim>& at_a, const Polytope<Dim>& b,
                            const Pose<Dim>& at_b, QueryLevel level, const ContactSettings& settings,
                            const Solvers<Dim>& solvers) {
  const Pair<Dim> pair{
      &a,   &b, at_a.axes, at_a.axes.transpose() * at_b.axes, at_a.axes.transpose() * (at_b.position - at_a.position),
      level};
  Contact<Dim> contact;
  Contact<Dim>* const slot = &contact;
  KernelCounters counters;
  narrow_phase<Dim>(std::span(&pair, 1), settings, solvers, std::span(&slot, 1), counters);
  return {contact.status, at_a.position, contact.geometry};
}

}  // namespace

template <int Dim>
ContactBetween<Dim> contact_between(const Polytope<Dim>& a, const Pose<Dim>& at_a, const Polytope<Dim>& b,
                                    const Pose<Dim>& at_b, QueryLevel level, const ContactSettings& settings,
                                    const Solvers<Dim>& solvers) {
  check<Dim>(a, at_a, "first");
  check<Dim>(b, at_b, "second");
  const std::strong_ordering faces = compare<Dim>(a.faces, b.faces);
  const bool in_their_order = faces != 0 ? faces < 0 : compare<Dim>(at_a, at_b) <= 0;
  if (in_their_order) return resolve<Dim>(a, at_a, b, at_b, level, settings, solvers);

  ContactBetween<Dim> turned = resolve<Dim>(b, at_b, a, at_a, level, settings, solvers);
  turned.geometry.normal = -turned.geometry.normal;
  std::swap(turned.geometry.face_a, turned.geometry.face_b);
  return turned;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                                 \
  template ContactBetween<Dim> contact_between<Dim>(const Polytope<Dim>&, const Pose<Dim>&, const Polytope<Dim>&, \
                                                    const Pose<Dim>&, QueryLevel, const ContactSettings&,         \
                                                    const Solvers<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
