#include "core/modes/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/modes/lanczos.hpp"
#include "core/solvers/complete_factors.hpp"

namespace voussoir {
namespace {

// Over the stiffest K_ii / M_ii. Differences of forces leave 1e-10 of the stiffness.
constexpr double first_shift = 1e-9;
constexpr double lower_by = 8;  // the shift, until no pivot is negative
constexpr int most_shifts = 40;

// An eigenvalue 1/(λ - σ) is found to this part of itself; the count is made this part above the last one.
constexpr double precision = 1e-12, just_above = 1e-7;
constexpr int most_passes = 6;  // for copies of multiple eigenvalues

template <int Size>
class ShiftedPencil {
 public:
  explicit ShiftedPencil(const Pencil<Size>& pencil)
      : pencil_(pencil), plan_(neighbours_in(pencil.stiffness)), factors_(plan_, true) {}

  // false: there are no factors at this shift
  bool factorise(double shift) {
    BlockMatrix<Size> shifted = pencil_.stiffness;
    for (int i = 0; i < shifted.rows(); ++i)
      shifted.blocks[shifted.diagonal[i]] -= shift * (pencil_.mass_root[i] * pencil_.mass_root[i].transpose());
    ++factorisations;
    return factors_.factorise(shifted);
  }
  int below() const { return factors_.negative_pivots(); }
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const { return factors_.solve(b); }

  int factorisations = 0;

 private:
  const Pencil<Size>& pencil_;
  EliminationPlan plan_;
  CompleteFactors<Size> factors_;
};

// of Bᵀ (K - σ M)⁻¹ B, descending
struct Known {
  std::vector<double> values;
  std::vector<Eigen::VectorXd> vectors;
};

// the eigenvalues of the operator across those that are known
LargestEigenvalues seek(const SymmetricOperator& whole, const Known& known, int number, int pass) {
  const SymmetricOperator across{whole.size, [&](const Eigen::VectorXd& y) -> Eigen::VectorXd {
                                   Eigen::VectorXd z = whole.apply(y);
                                   for (std::size_t k = 0; k < known.values.size(); ++k)
                                     z -= known.values[k] * known.vectors[k].dot(y) * known.vectors[k];
                                   return z;
                                 }};
  return largest_eigenvalues(across, number, pass, precision);
}

void add(LargestEigenvalues&& more, Known& known) {
  for (std::size_t k = 0; k < more.values.size(); ++k) {
    if (!(more.values[k] > 0)) continue;  // of degrees of freedom without mass
    const auto at = std::upper_bound(known.values.begin(), known.values.end(), more.values[k], std::greater());
    known.vectors.insert(known.vectors.begin() + (at - known.values.begin()), std::move(more.vectors[k]));
    known.values.insert(at, more.values[k]);
  }
}

}  // namespace

template <int Size>
Eigen::VectorXd Pencil<Size>::times_root(const Eigen::VectorXd& y) const {
  Eigen::VectorXd x(y.size());
  for (std::size_t i = 0; i < mass_root.size(); ++i)
    x.segment<Size>(Size * i) = mass_root[i].lazyProduct(y.segment<Size>(Size * i));
  return x;
}

template <int Size>
Eigen::VectorXd Pencil<Size>::times_root_transposed(const Eigen::VectorXd& x) const {
  Eigen::VectorXd y(x.size());
  for (std::size_t i = 0; i < mass_root.size(); ++i)
    y.segment<Size>(Size * i) = mass_root[i].transpose().lazyProduct(x.segment<Size>(Size * i));
  return y;
}

template <int Size>
int Pencil<Size>::count() const {
  int with_mass = 0;
  for (const Block& root : mass_root)
    for (int f = 0; f < Size; ++f)
      with_mass += !root.row(f).isZero(0);
  return with_mass;
}

template <int Size>
double Pencil<Size>::stiffest() const {
  double most = 0;
  for (int i = 0; i < stiffness.rows(); ++i)
    for (int f = 0; f < Size; ++f)
      if (const double mass = mass_root[i].row(f).squaredNorm(); mass > 0)
        most = std::max(most, stiffness.blocks[stiffness.diagonal[i]](f, f) / mass);
  return most;
}

template <int Size>
Spectrum lowest_eigenvalues(const Pencil<Size>& pencil, int number) {
  Spectrum spectrum;
  spectrum.resolution = first_shift * pencil.stiffest();
  number = std::min(number, pencil.count());
  if (number < 1 || !(spectrum.resolution > 0)) return spectrum;
  ShiftedPencil<Size> shifted(pencil);
  spectrum.shift = -spectrum.resolution;
  for (int k = 0; !shifted.factorise(spectrum.shift) || shifted.below() > 0; spectrum.shift *= lower_by)
    if (++k == most_shifts) return spectrum.converged = false, spectrum;

  const SymmetricOperator inverse{Size * static_cast<Eigen::Index>(pencil.mass_root.size()),
                                  [&](const Eigen::VectorXd& y) -> Eigen::VectorXd {
                                    ++spectrum.solutions;
                                    return pencil.times_root_transposed(shifted.solve(pencil.times_root(y)));
                                  }};
  const auto value = [&](double of_inverse) { return spectrum.shift + 1 / of_inverse; };
  ShiftedPencil<Size> counter(pencil);
  Known known;
  int sought = number;
  for (int pass = 1; sought > 0 && pass <= most_passes; ++pass) {
    LargestEigenvalues more = seek(inverse, known, sought, pass);
    spectrum.converged = spectrum.converged && more.converged;
    add(std::move(more), known);
    if (known.values.empty()) break;
    const int last = std::min<int>(number, static_cast<int>(known.values.size())) - 1;
    const double above = value(known.values[last]);
    const bool counted = counter.factorise(above + just_above * (above - spectrum.shift));
    sought = counted ? counter.below() - static_cast<int>(known.values.size()) : 0;
  }
  spectrum.missing = std::max(sought, 0);
  for (std::size_t k = 0; k < known.values.size() && static_cast<int>(k) < number; ++k)
    spectrum.pairs.push_back(
        {value(known.values[k]), shifted.solve(pencil.times_root(known.vectors[k])) / known.values[k]});
  spectrum.solutions += static_cast<long long>(spectrum.pairs.size());
  spectrum.factorisations = shifted.factorisations + counter.factorisations;
  return spectrum;
}

#define VOUSSOIR_INSTANTIATE(Size) \
  template struct Pencil<Size>;    \
  template Spectrum lowest_eigenvalues<Size>(const Pencil<Size>&, int);
VOUSSOIR_INSTANTIATE(3)
VOUSSOIR_INSTANTIATE(6)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
