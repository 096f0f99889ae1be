#include "core/testing/limit_referee.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "core/testing/linear_program.hpp"

namespace voussoir {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// the edges of a cone x0 >= |(x1, …)|, or of a pyramid of it
std::vector<Vector<2>> edges_of(const Vector<2>&, int, bool) {
  return {{1, 1}, {1, -1}};
}

std::vector<Vector<3>> edges_of(const Vector<3>&, int count, bool around) {
  const double length = around ? 1 / std::cos(std::numbers::pi / count) : 1;
  std::vector<Vector<3>> edges;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * std::numbers::pi * k / count;
    edges.emplace_back(1, length * std::cos(angle), length * std::sin(angle));
  }
  return edges;
}

}  // namespace

template <int Dim>
RefereedFactor refereed_factor(const CornerAssembly<Dim>& assembly, const Loads<Dim>& dead, const Loads<Dim>& live,
                               int edges, bool around) {
  constexpr int rows = freedoms<Dim>;
  const CornerProgram<Dim> cones = corner_program(assembly, dead, live);
  LinearProgram program{{cones.right_side.begin(), cones.right_side.end()}, {}};
  for (const auto& cone : cones.cones)
    for (const Vector<Dim>& edge : edges_of(Vector<Dim>(), edges, around)) {
      ProgramColumn column{0, 0, infinity, {}};
      const auto add = [&](int body, const FixedMatrix<rows, Dim>& on) {
        const Vector<rows> forces = on * edge;
        for (int k = 0; body >= 0 && k < rows; ++k)
          if (forces[k] != 0) column.entries.emplace_back(rows * body + k, forces[k]);
      };
      add(cone.body_a, cone.on_a);
      add(cone.body_b, cone.on_b);
      program.columns.push_back(column);
    }
  ProgramColumn factor{-1, 0, infinity, {}};
  for (Eigen::Index row = 0; row < cones.live.size(); ++row)
    if (cones.live[row] != 0) factor.entries.emplace_back(static_cast<int>(row), cones.live[row]);
  program.columns.push_back(factor);
  const ProgramSolution solution = solve(program);
  if (solution.status != ProgramStatus::optimal) return {};
  const Certificate certificate = judge(program, solution);
  return {true, solution.x.back(), std::abs(certificate.primal - certificate.dual),
          std::max(certificate.primal_violation, certificate.dual_violation)};
}

template RefereedFactor refereed_factor(const CornerAssembly<2>&, const Loads<2>&, const Loads<2>&, int, bool);
template RefereedFactor refereed_factor(const CornerAssembly<3>&, const Loads<3>&, const Loads<3>&, int, bool);

}  // namespace voussoir
