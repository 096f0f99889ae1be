#include "core/limit/shortfall.hpp"

#include <cmath>

namespace voussoir {
namespace {

constexpr double least_missing = 1e-10;  // of a body's weight

}  // namespace

template <int Dim>
Shortfall shortfall(const CornerAssembly<Dim>& assembly, CornerProgram<Dim> program) {
  add_missing_forces(assembly, program);
  Shortfall found{solve(program), least_missing};
  if (found.failed()) return found;
  double pressing = 0;
  for (Eigen::Index k = 0; k < found.answer.x.size(); k += Dim)
    pressing += std::abs(found.answer.x[k]);
  constexpr double largest_cost = 1;
  found.doubt +=
      found.answer.gap * (1 + std::abs(found.answer.value)) + found.answer.inadmissible * (1 + largest_cost) * pressing;
  return found;
}

template Shortfall shortfall(const CornerAssembly<2>&, CornerProgram<2>);
template Shortfall shortfall(const CornerAssembly<3>&, CornerProgram<3>);

}  // namespace voussoir
