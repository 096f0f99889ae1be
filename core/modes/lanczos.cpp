#include "core/modes/lanczos.hpp"

#include <Spectra/SymEigsSolver.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace {

// A number of its own type: templates of Eigen and Spectra over it are local to this source. Over double the linker
// would keep one copy of each for the whole program, perhaps one that other flags have vectorised, with other rounding.
struct Real {
  double value = 0;
  constexpr Real() = default;
  constexpr Real(double v) : value(v) {}                              // NOLINT: as the libraries convert
  constexpr Real(long v) : value(static_cast<double>(v)) {}           // NOLINT
  constexpr Real(unsigned long v) : value(static_cast<double>(v)) {}  // NOLINT
  constexpr Real(int v) : value(v) {}                                 // NOLINT
  constexpr Real& operator+=(Real b) { return value += b.value, *this; }
  constexpr Real& operator-=(Real b) { return value -= b.value, *this; }
  constexpr Real& operator*=(Real b) { return value *= b.value, *this; }
  constexpr Real& operator/=(Real b) { return value /= b.value, *this; }
  friend constexpr Real operator+(Real a, Real b) { return a.value + b.value; }
  friend constexpr Real operator-(Real a, Real b) { return a.value - b.value; }
  friend constexpr Real operator*(Real a, Real b) { return a.value * b.value; }
  friend constexpr Real operator/(Real a, Real b) { return a.value / b.value; }
  friend constexpr Real operator-(Real a) { return -a.value; }
  friend constexpr auto operator<=>(Real a, Real b) { return a.value <=> b.value; }
  friend constexpr bool operator==(Real a, Real b) { return a.value == b.value; }
  friend Real sqrt(Real a) { return std::sqrt(a.value); }
  friend Real abs(Real a) { return std::abs(a.value); }
  friend Real pow(Real a, Real b) { return std::pow(a.value, b.value); }
  friend bool isinf(Real a) { return std::isinf(a.value); }
  friend bool isnan(Real a) { return std::isnan(a.value); }
};

}  // namespace

template <>
struct std::numeric_limits<Real> : std::numeric_limits<double> {
  static constexpr Real epsilon() { return std::numeric_limits<double>::epsilon(); }
  static constexpr Real(min)() { return (std::numeric_limits<double>::min)(); }
  static constexpr Real(max)() { return (std::numeric_limits<double>::max)(); }
  static constexpr Real lowest() { return std::numeric_limits<double>::lowest(); }
};

template <>
struct Eigen::NumTraits<Real> : Eigen::GenericNumTraits<Real> {
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
  static constexpr Real dummy_precision() { return 1e-12; }
  static constexpr int digits10() { return std::numeric_limits<double>::digits10; }
};

namespace voussoir {
namespace {

constexpr int most_restarts = 1000;
constexpr int norm_steps = 4;  // products that find the operator's size before the iteration

// Numbers between -0.5 and 0.5 that no symmetry of a model shares (Park and Miller 1988).
Eigen::VectorXd start_vector(Eigen::Index size, int start) {
  constexpr std::uint64_t multiplier = 48271, modulus = 2147483647;
  std::uint64_t seed = 20260000 + static_cast<std::uint64_t>(start);
  Eigen::VectorXd x(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    seed = seed * multiplier % modulus;
    x[i] = static_cast<double>(seed) / static_cast<double>(modulus) - 0.5;
  }
  return x;
}

// The operator over its size, as Spectra's thresholds are absolute, with one further row and column of zeros, as
// Spectra finds fewer eigenvalues than there are rows.
struct PaddedOperator {
  using Scalar = Real;
  const SymmetricOperator* a;
  double scale;

  Eigen::Index rows() const { return a->size + 1; }
  Eigen::Index cols() const { return rows(); }
  void perform_op(const Real* x, Real* y) const {
    Eigen::VectorXd plain(a->size);
    for (Eigen::Index i = 0; i < a->size; ++i)
      plain[i] = x[i].value;
    const Eigen::VectorXd product = a->apply(plain);
    for (Eigen::Index i = 0; i < a->size; ++i)
      y[i] = product[i] / scale;
    y[a->size] = 0;
  }
};

}  // namespace

LargestEigenvalues largest_eigenvalues(const SymmetricOperator& a, int count, int start, double tolerance) {
  LargestEigenvalues found;
  Eigen::VectorXd x = start_vector(a.size, start);
  double size = 0;
  for (int k = 0; k < norm_steps; ++k) {
    x /= x.norm();
    x = a.apply(x);
    size = x.norm();
    if (!(size > 0)) return found;
  }
  PaddedOperator padded{&a, size};
  const Eigen::Index subspace = std::min<Eigen::Index>(padded.rows(), std::max(2 * count + 1, 20));
  Spectra::SymEigsSolver<PaddedOperator> solver(padded, count, subspace);
  const Eigen::VectorXd begin = start_vector(padded.rows(), start);
  std::vector<Real> residual(begin.data(), begin.data() + begin.size());
  solver.init(residual.data());
  solver.compute(Spectra::SortRule::LargestAlge, most_restarts, Real(tolerance), Spectra::SortRule::LargestAlge);
  found.converged = solver.info() == Spectra::CompInfo::Successful;
  const auto values = solver.eigenvalues();
  const auto vectors = solver.eigenvectors();
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    found.values.push_back(values[k].value * size);
    Eigen::VectorXd vector(a.size);
    for (Eigen::Index i = 0; i < a.size; ++i)
      vector[i] = vectors(i, k).value;
    found.vectors.push_back(vector);
  }
  found.products = norm_steps + solver.num_operations();
  return found;
}

}  // namespace voussoir
