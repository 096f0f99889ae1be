#include "core/optimise/ipopt.hpp"

#include <IpIpoptApplication.hpp>
#include <IpSolveStatistics.hpp>
#include <IpTNLP.hpp>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <vector>

#include "core/floating_point_traps.hpp"

namespace voussoir {
namespace {

using Ipopt::Index;
using Ipopt::Number;

constexpr double ipopt_tolerance = 1e-10;  // of the scaled problem, whose slacks start at 1

// Boon (2013), Eqs 3.38 and 3.49: minimise -sum log t_i subject to t_i + g_i·y = 1, t_i > 0. Here t_i is plane i's
// slack over its slack at the start, y the step from the start in units of the room along each axis of a frame fitted
// to the region.
template <int Dim>
struct ScaledProgram {
  std::vector<Vector<Dim>> gradients;  // g_i
  Matrix<Dim> axes;                    // columns: a unit of y, m
};

template <int Dim>
bool scale_program(const HalfSpaces<Dim>& planes, const CentreRequest<Dim>& request, ScaledProgram<Dim>& program) {
  std::vector<double> slacks;
  Eigen::Matrix<double, Dim, Eigen::Dynamic> scaled(Dim, static_cast<Eigen::Index>(planes.size()));
  for (const HalfSpace<Dim>& plane : planes) {
    slacks.push_back(-signed_distance(plane, request.start));
    if (!std::isfinite(slacks.back()) || !plane.normal.allFinite() || slacks.back() <= 0) return false;
    scaled.col(static_cast<Eigen::Index>(slacks.size()) - 1) = plane.normal / slacks.back();
  }

  // the thin direction first: pivoting takes the nearest plane's normal, then the nearest of what remains
  program.axes = Eigen::ColPivHouseholderQR<decltype(scaled)>(scaled).householderQ() * Matrix<Dim>::Identity();

  // along each axis the room before the first plane is the unit of length: a flat overlap becomes a square one
  for (int k = 0; k < Dim; ++k) {
    double room = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < planes.size(); ++i) {
      const double slope = std::abs(planes[i].normal.dot(program.axes.col(k)));
      if (slope > 0) room = std::min(room, slacks[i] / slope);
    }
    if (std::isfinite(room)) program.axes.col(k) *= room;
  }
  for (std::size_t i = 0; i < planes.size(); ++i)
    program.gradients.push_back(program.axes.transpose() * planes[i].normal / slacks[i]);
  return true;
}

// variables: y, then t
template <int Dim>
class SlackForm : public Ipopt::TNLP {
 public:
  explicit SlackForm(ScaledProgram<Dim> program) : program_(std::move(program)) {}
  const Vector<Dim>& solution() const { return solution_; }

  bool get_nlp_info(Index& variables, Index& constraints, Index& jacobian, Index& hessian,
                    IndexStyleEnum& style) override {
    variables = Dim + planes();
    constraints = planes();
    jacobian = planes() * (Dim + 1);
    hessian = planes();
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index, Number* lower, Number* upper, Index, Number* right, Number* right_upper) override {
    const Number unbounded = 2e19;  // Ipopt's infinity
    std::fill_n(lower, Dim, -unbounded);
    std::fill_n(lower + Dim, planes(), 0.0);
    std::fill_n(upper, Dim + planes(), unbounded);
    std::fill_n(right, planes(), 1.0);
    std::fill_n(right_upper, planes(), 1.0);
    return true;
  }

  bool get_starting_point(Index, bool, Number* x, bool, Number*, Number*, Index, bool, Number*) override {
    std::fill_n(x, Dim, 0.0);
    std::fill_n(x + Dim, planes(), 1.0);
    return true;
  }

  // an answer of false makes Ipopt shorten its step
  bool eval_f(Index, const Number* x, bool, Number& value) override {
    value = 0;
    for (Index i = 0; i < planes(); ++i) {
      if (x[Dim + i] <= 0) return false;
      value -= std::log(x[Dim + i]);
    }
    return true;
  }

  bool eval_grad_f(Index, const Number* x, bool, Number* gradient) override {
    std::fill_n(gradient, Dim, 0.0);
    for (Index i = 0; i < planes(); ++i)
      gradient[Dim + i] = -1 / x[Dim + i];
    return true;
  }

  bool eval_g(Index, const Number* x, bool, Index, Number* constraints) override {
    for (Index i = 0; i < planes(); ++i) {
      constraints[i] = x[Dim + i];
      for (int k = 0; k < Dim; ++k)
        constraints[i] += program_.gradients[i][k] * x[k];
    }
    return true;
  }

  bool eval_jac_g(Index, const Number*, bool, Index, Index, Index* row, Index* column, Number* value) override {
    Index entry = 0;
    for (Index i = 0; i < planes(); ++i)
      for (int k = 0; k <= Dim; ++k, ++entry) {
        if (!value) {
          row[entry] = i;
          column[entry] = k < Dim ? k : Dim + i;
        } else {
          value[entry] = k < Dim ? program_.gradients[i][k] : 1;
        }
      }
    return true;
  }

  bool eval_h(Index, const Number* x, bool, Number factor, Index, const Number*, bool, Index, Index* row, Index* column,
              Number* value) override {
    for (Index i = 0; i < planes(); ++i) {
      if (!value)
        row[i] = column[i] = Dim + i;
      else
        value[i] = factor / (x[Dim + i] * x[Dim + i]);
    }
    return true;
  }

  void finalize_solution(Ipopt::SolverReturn, Index, const Number* x, const Number*, const Number*, Index,
                         const Number*, const Number*, Number, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    for (int k = 0; k < Dim; ++k)
      solution_[k] = x[k];
  }

 private:
  Index planes() const { return static_cast<Index>(program_.gradients.size()); }

  ScaledProgram<Dim> program_;
  Vector<Dim> solution_ = Vector<Dim>::Zero();
};

Ipopt::SmartPtr<Ipopt::IpoptApplication> make_application() {
  Ipopt::SmartPtr<Ipopt::IpoptApplication> application = new Ipopt::IpoptApplication(false);
  const auto& options = application->Options();
  options->SetIntegerValue("print_level", 0);
  options->SetStringValue("sb", "yes");
  options->SetNumericValue("tol", ipopt_tolerance);
  options->SetNumericValue("bound_relax_factor", 0);  // a slack may not pass its plane, not even by 1e-8
  options->SetStringValue("jac_c_constant", "yes");
  options->SetStringValue("mu_strategy", "adaptive");
  if (application->Initialize("") != Ipopt::Solve_Succeeded) return nullptr;
  return application;
}

CentreStatus status_of(Ipopt::ApplicationReturnStatus status) {
  switch (status) {
    case Ipopt::Solve_Succeeded:
    case Ipopt::Solved_To_Acceptable_Level:
    case Ipopt::Search_Direction_Becomes_Too_Small:
      return CentreStatus::converged;
    case Ipopt::Maximum_Iterations_Exceeded:
      return CentreStatus::iteration_limit;
    default:
      return CentreStatus::singular;
  }
}

}  // namespace

template <int Dim>
CentreResult<Dim> solve_analytic_centre_ipopt(const HalfSpaces<Dim>& planes, const CentreRequest<Dim>& request) {
  CentreResult<Dim> result;
  result.point = request.start;
  ScaledProgram<Dim> program;
  if (!scale_program(planes, request, program)) {
    result.status = CentreStatus::start_not_interior;
    return result;
  }

  // one call at a time in the whole program; the application is made once, its options cost more than a solve
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  const WithoutTraps without_traps;  // Ipopt divides by zero on purpose
  static const Ipopt::SmartPtr<Ipopt::IpoptApplication> application = make_application();
  if (!IsValid(application)) {
    result.status = CentreStatus::singular;
    return result;
  }

  application->Options()->SetIntegerValue("max_iter", request.limit);
  const Ipopt::SmartPtr<SlackForm<Dim>> slack_form = new SlackForm<Dim>(program);
  result.status = status_of(application->OptimizeTNLP(GetRawPtr(slack_form)));
  if (IsValid(application->Statistics())) result.iterations = application->Statistics()->IterationCount();
  if (result.status == CentreStatus::converged) result.point = request.start + program.axes * slack_form->solution();
  return result;
}

template CentreResult<2> solve_analytic_centre_ipopt(const HalfSpaces<2>&, const CentreRequest<2>&);
template CentreResult<3> solve_analytic_centre_ipopt(const HalfSpaces<3>&, const CentreRequest<3>&);

}  // namespace voussoir
