#include "core/limit/shortfall.hpp"

namespace voussoir {
namespace {

constexpr double noise = 3;             // times the program's errors: below it nothing is missing
constexpr double least_missing = 3e-9;  // of a body's weight

}  // namespace

bool Shortfall::stands() const {
  return !failed() && !(answer.bound > least_missing + noise * answer.error());
}

template <int Dim>
Shortfall shortfall(const CornerAssembly<Dim>& assembly, CornerProgram<Dim> program) {
  add_missing_forces(assembly, program);
  return {solve(program)};
}

template Shortfall shortfall(const CornerAssembly<2>&, CornerProgram<2>);
template Shortfall shortfall(const CornerAssembly<3>&, CornerProgram<3>);

}  // namespace voussoir
