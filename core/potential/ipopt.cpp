#include "core/potential/ipopt.hpp"

#include <IpIpoptApplication.hpp>
#include <IpIpoptCalculatedQuantities.hpp>
#include <IpSolveStatistics.hpp>
#include <IpTNLP.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>

#include "core/base/floating_point_traps.hpp"

namespace voussoir {
namespace {

using Ipopt::Index;
using Ipopt::Number;

// Its error by its own measure; values are about 1. A solution that rounding keeps above the first ends at the second.
constexpr double ipopt_tolerance = 1e-15, acceptable_tolerance = 1e-12;
constexpr int ipopt_limit = 500;
constexpr Number unbounded = 2e19;  // Ipopt's infinity

template <int Dim>
struct Side {
  PlacedPotential<Dim> potential;
  double unit;  // of p: r / sqrt(1 - k), m
  Index planes() const { return static_cast<Index>(potential.planes.size()); }
};

// Variables: x, the p of A, the p of B (Eq. A.6, in the units of Eq. A.7), then t, or s_A and s_B, or t_A and t_B.
// Constraints: one for each plane, with the lengths of Eq. A.9, then the two cones, Eq. A.8 against the last variables.
template <int Dim>
class ConeProgram : public Ipopt::TNLP {
 public:
  ConeProgram(std::array<Side<Dim>, 2> sides, ConeReading reading, const Vector<Dim>& start)
      : sides_(std::move(sides)),
        linked_(reading == ConeReading::linked),
        roots_(reading == ConeReading::unlinked),
        start_(start) {}
  const Vector<Dim>& solution() const { return solution_; }
  double error() const { return error_; }

  bool get_nlp_info(Index& variables, Index& constraints, Index& jacobian, Index& hessian,
                    IndexStyleEnum& style) override {
    variables = last() + (linked_ ? 1 : 2);
    constraints = planes() + 2;
    jacobian = planes() * (Dim + 1) + planes() + 2 * (Dim + 1);
    hessian = Dim + planes() + (roots_ ? 2 : 0);
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index variables, Number* lower, Number* upper, Index, Number* below, Number* above) override {
    std::fill_n(lower, variables, -unbounded);
    std::fill_n(upper, variables, unbounded);
    std::fill(lower + Dim, lower + variables, 0.0);
    Index row = 0;
    for (const Side<Dim>& side : sides_)
      for (const HalfSpace<Dim>& plane : side.potential.planes)
        above[row++] = plane.offset;
    above[row] = above[row + 1] = 0;
    std::fill_n(below, row + 2, -unbounded);
    return true;
  }

  bool get_starting_point(Index variables, bool, Number* x, bool, Number*, Number*, Index, bool, Number*) override {
    std::copy(start_.data(), start_.data() + Dim, x);
    std::fill(x + last(), x + variables, 0.0);
    Index p = Dim;
    for (Index cone = 0; cone < 2; ++cone) {
      for (const HalfSpace<Dim>& plane : sides_[cone].potential.planes)
        x[p++] = std::max(signed_distance<Dim>(plane, start_), 0.0) / sides_[cone].unit;
      const double q = 1 + value<Dim>(sides_[cone].potential, start_);
      Number& height = x[linked_ ? last() : last() + cone];
      height = std::max(height, roots_ ? std::sqrt(q) : q);
    }
    return true;
  }

  bool eval_f(Index variables, const Number* x, bool, Number& value) override {
    value = 0;
    for (Index i = last(); i < variables; ++i)
      value += x[i];
    return true;
  }

  bool eval_grad_f(Index variables, const Number*, bool, Number* gradient) override {
    std::fill_n(gradient, last(), 0.0);
    std::fill(gradient + last(), gradient + variables, 1.0);
    return true;
  }

  bool eval_g(Index, const Number* x, bool, Index, Number* g) override {
    Index row = 0, cone = 0;
    const Eigen::Map<const Vector<Dim>> point(x);
    for (const Side<Dim>& side : sides_) {
      double q = side.potential.sphere_weight * (point - side.potential.centre).squaredNorm();
      for (const HalfSpace<Dim>& plane : side.potential.planes) {
        const double p = x[Dim + row];
        g[row++] = plane.normal.dot(point) - side.unit * p;
        q += p * p;
      }
      const double height = x[linked_ ? last() : last() + cone];
      g[planes() + cone] = q - (roots_ ? height * height : height);
      ++cone;
    }
    return true;
  }

  bool eval_jac_g(Index, const Number* x, bool, Index, Index, Index* row, Index* column, Number* values) override {
    Index entry = 0, plane_row = 0;
    const auto put = [&](Index r, Index c, Number v) {
      if (values) {
        values[entry] = v;
      } else {
        row[entry] = r;
        column[entry] = c;
      }
      ++entry;
    };
    for (Index cone = 0; cone < 2; ++cone) {
      const Side<Dim>& side = sides_[cone];
      const Index cone_row = planes() + cone, s = linked_ ? last() : last() + cone;
      for (int k = 0; k < Dim; ++k)
        put(cone_row, k, values ? 2 * side.potential.sphere_weight * (x[k] - side.potential.centre[k]) : 0);
      put(cone_row, s, !values ? 0 : roots_ ? -2 * x[s] : -1);
      for (const HalfSpace<Dim>& plane : side.potential.planes) {
        for (int k = 0; k < Dim; ++k)
          put(plane_row, k, plane.normal[k]);
        put(plane_row, Dim + plane_row, -side.unit);
        put(cone_row, Dim + plane_row, values ? 2 * x[Dim + plane_row] : 0);
        ++plane_row;
      }
    }
    return true;
  }

  // a diagonal: the cones alone are curved
  bool eval_h(Index, const Number*, bool, Number, Index, const Number* multipliers, bool, Index entries, Index* row,
              Index* column, Number* values) override {
    if (!values) {
      for (Index i = 0; i < entries; ++i)
        row[i] = column[i] = i;
      return true;
    }
    std::fill_n(values, entries, 0.0);
    Index p = Dim;
    for (Index cone = 0; cone < 2; ++cone) {
      const Number multiplier = 2 * multipliers[planes() + cone];
      for (int k = 0; k < Dim; ++k)
        values[k] += multiplier * sides_[cone].potential.sphere_weight;
      for (Index i = 0; i < sides_[cone].planes(); ++i)
        values[p++] = multiplier;
      if (roots_) values[last() + cone] = -multiplier;
    }
    return true;
  }

  void finalize_solution(Ipopt::SolverReturn, Index, const Number* x, const Number*, const Number*, Index,
                         const Number*, const Number*, Number, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities* quantities) override {
    std::copy(x, x + Dim, solution_.data());
    error_ = quantities->curr_nlp_error();
  }

 private:
  Index planes() const { return sides_[0].planes() + sides_[1].planes(); }
  Index last() const { return Dim + planes(); }

  std::array<Side<Dim>, 2> sides_;
  bool linked_, roots_;
  Vector<Dim> start_, solution_ = Vector<Dim>::Zero();
  double error_ = std::numeric_limits<double>::infinity();
};

Ipopt::SmartPtr<Ipopt::IpoptApplication> make_application() {
  Ipopt::SmartPtr<Ipopt::IpoptApplication> application = new Ipopt::IpoptApplication(false);
  const auto& options = application->Options();
  options->SetIntegerValue("print_level", 0);
  options->SetStringValue("sb", "yes");
  options->SetIntegerValue("max_iter", ipopt_limit);
  options->SetNumericValue("tol", ipopt_tolerance);
  options->SetNumericValue("acceptable_tol", acceptable_tolerance);
  options->SetNumericValue("bound_relax_factor", 0);
  options->SetStringValue("mu_strategy", "adaptive");
  if (application->Initialize("") != Ipopt::Solve_Succeeded) return nullptr;
  return application;
}

}  // namespace

template <int Dim>
ConeAnswer<Dim> solve_cone_program(const PotentialPair<Dim>& pair, ConeReading reading) {
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  const WithoutTraps without_traps;  // Ipopt divides by zero on purpose
  static const Ipopt::SmartPtr<Ipopt::IpoptApplication> application = make_application();
  ConeAnswer<Dim> answer;
  if (!IsValid(application)) return answer;

  std::array<Side<Dim>, 2> sides;
  place<Dim>(*pair.a, Matrix<Dim>::Identity(), Vector<Dim>::Zero(), sides[0].potential);
  place<Dim>(*pair.b, pair.rotation, pair.offset, sides[1].potential);
  for (Side<Dim>& side : sides)
    side.unit = side.planes() > 0 ? 1 / std::sqrt(side.potential.plane_weight) : 1;
  const double fraction = sides[0].potential.reach / (sides[0].potential.reach + sides[1].potential.reach);
  const Vector<Dim> from = sides[0].potential.centre, start = from + fraction * (sides[1].potential.centre - from);

  const Ipopt::SmartPtr<ConeProgram<Dim>> program = new ConeProgram<Dim>(sides, reading, start);
  const Ipopt::ApplicationReturnStatus status = application->OptimizeTNLP(GetRawPtr(program));
  answer.solved = status == Ipopt::Solve_Succeeded || status == Ipopt::Solved_To_Acceptable_Level ||
                  status == Ipopt::Search_Direction_Becomes_Too_Small;
  if (IsValid(application->Statistics())) answer.iterations = application->Statistics()->IterationCount();
  answer.point = program->solution();
  answer.error = program->error();
  answer.value_a = value<Dim>(sides[0].potential, answer.point);
  answer.value_b = value<Dim>(sides[1].potential, answer.point);
  return answer;
}

template ConeAnswer<2> solve_cone_program<2>(const PotentialPair<2>&, ConeReading);
template ConeAnswer<3> solve_cone_program<3>(const PotentialPair<3>&, ConeReading);

}  // namespace voussoir
