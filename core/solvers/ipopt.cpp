#include "core/solvers/ipopt.hpp"

#include <IpIpoptApplication.hpp>
#include <IpSolveStatistics.hpp>
#include <IpTNLP.hpp>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <vector>

#include "core/base/floating_point_traps.hpp"

namespace voussoir {
namespace {

using Ipopt::Index;
using Ipopt::Number;

constexpr double ipopt_tolerance = 1e-10;  // of the scaled problem, whose slacks start at 1

// Newton's step from the result may change no slack by more than this fraction, beyond the rounding of the slacks
constexpr double accepted_step = 1e-9;
constexpr double roundings = 16;  // operations behind a slack and a step, in units of rounding

// far from the centre the start's slacks are poor units; from the first result they are good ones
constexpr int passes = 3;

// squared sine of the angle between normals that are opposite but for rounding
constexpr double opposite = 1e-34;

// Boon (2013), Eqs 3.38 and 3.49: minimise -sum log t_i subject to t_i + g_i·y = t_i0, t_i > 0. Here t_i is plane i's
// slack over its unit u_i, t_i0 its value at the start, y the step from the start in units along axes of any direction.
template <int Dim>
struct SlackProgram {
  std::vector<Vector<Dim>> gradients;  // g_i = axesᵀ a_i / u_i
  std::vector<double> start;           // t_i0
  Matrix<Dim> axes;                    // columns: a unit of y, m
};

template <int Dim>
bool slacks_of(const HalfSpaces<Dim>& planes, const Vector<Dim>& point, std::vector<double>& slacks) {
  for (const HalfSpace<Dim>& plane : planes) {
    slacks.push_back(-signed_distance(plane, point));
    if (!std::isfinite(slacks.back()) || !plane.normal.allFinite() || slacks.back() <= 0) return false;
  }
  return true;
}

template <int Dim>
SlackProgram<Dim> make_program(const HalfSpaces<Dim>& planes, const std::vector<double>& slacks,
                               const std::vector<double>& units, const Matrix<Dim>& axes) {
  SlackProgram<Dim> program{{}, {}, axes};
  for (std::size_t i = 0; i < planes.size(); ++i) {
    program.gradients.push_back(axes.transpose() * planes[i].normal / units[i]);
    program.start.push_back(slacks[i] / units[i]);
  }
  return program;
}

// how far the region reaches from the start along a direction and against it: to the first plane on either side
struct Room {
  double ahead = std::numeric_limits<double>::infinity(), behind = ahead;
  double width() const { return ahead + behind; }
};

template <int Dim>
Room room_along(const HalfSpaces<Dim>& planes, const std::vector<double>& slacks, const Vector<Dim>& direction) {
  Room room;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const double slope = planes[i].normal.dot(direction);
    if (slope > 0) room.ahead = std::min(room.ahead, slacks[i] / slope);
    if (slope < 0) room.behind = std::min(room.behind, -slacks[i] / slope);
  }
  return room;
}

template <int Dim>
Matrix<Dim> fitted_axes(const HalfSpaces<Dim>& planes, const std::vector<double>& slacks) {
  Eigen::Matrix<double, Dim, Eigen::Dynamic> scaled(Dim, static_cast<Eigen::Index>(planes.size()));
  for (std::size_t i = 0; i < planes.size(); ++i)
    scaled.col(static_cast<Eigen::Index>(i)) = planes[i].normal / slacks[i];

  // the thin direction first: pivoting takes the nearest plane's normal, then the nearest of the rest
  Matrix<Dim> axes = Eigen::ColPivHouseholderQR<decltype(scaled)>(scaled).householderQ() * Matrix<Dim>::Identity();

  // along each axis the room before the first plane is the unit of length: a flat overlap becomes a square one
  for (int k = 0; k < Dim; ++k) {
    const Room room = room_along<Dim>(planes, slacks, axes.col(k));
    const double unit = std::min(room.ahead, room.behind);
    if (std::isfinite(unit)) axes.col(k) *= unit;
  }
  return axes;
}

// the normal among all planes along which the region is thinnest at the start
template <int Dim>
Vector<Dim> thinnest(const HalfSpaces<Dim>& planes, const std::vector<double>& slacks) {
  Vector<Dim> normal = planes.front().normal;
  double least = std::numeric_limits<double>::infinity();
  for (const HalfSpace<Dim>& plane : planes)
    if (const double width = room_along<Dim>(planes, slacks, plane.normal).width(); width < least) {
      least = width;
      normal = plane.normal;
    }
  return normal;
}

// Q D of Eqs 3.45-3.52; the overlap of the step before, h, is taken at the start
template <int Dim>
Matrix<Dim> contact_axes(const HalfSpaces<Dim>& planes, const std::vector<double>& slacks, const Vector<Dim>& known) {
  const Vector<Dim> normal = known.isZero(0) ? thinnest<Dim>(planes, slacks) : known;
  Matrix<Dim> axes = aligning_rotation(normal);
  const double overlap = room_along<Dim>(planes, slacks, normal).width();
  if (std::isfinite(overlap)) axes.col(Dim - 1) *= overlap;
  return axes;
}

// variables: y, then t; gradient, Hessian and Jacobian are those of Eqs 3.53-3.55
template <int Dim>
class SlackForm : public Ipopt::TNLP {
 public:
  explicit SlackForm(SlackProgram<Dim> program) : program_(std::move(program)) {}
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
    std::copy(program_.start.begin(), program_.start.end(), right);
    std::copy(program_.start.begin(), program_.start.end(), right_upper);
    return true;
  }

  bool get_starting_point(Index, bool, Number* x, bool, Number*, Number*, Index, bool, Number*) override {
    std::fill_n(x, Dim, 0.0);
    std::copy(program_.start.begin(), program_.start.end(), x + Dim);
    return true;
  }

  // a return value of false makes Ipopt shorten its step
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

  SlackProgram<Dim> program_;
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

// one solve from `result.point`
template <int Dim>
void solve(const SlackProgram<Dim>& program, int limit, CentreResult<Dim>& result) {
  // one call at a time in the program; the application is made once, its options cost more than a solve
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  const WithoutTraps without_traps;  // Ipopt divides by zero on purpose
  static const Ipopt::SmartPtr<Ipopt::IpoptApplication> application = make_application();
  result.status = CentreStatus::singular;
  if (!IsValid(application)) return;

  application->Options()->SetIntegerValue("max_iter", limit);
  const Ipopt::SmartPtr<SlackForm<Dim>> slack_form = new SlackForm<Dim>(program);
  result.status = status_of(application->OptimizeTNLP(GetRawPtr(slack_form)));
  if (IsValid(application->Statistics())) result.iterations += application->Statistics()->IterationCount();
  if (result.status == CentreStatus::converged) result.point += program.axes * slack_form->solution();
}

// Ipopt's error measure does not see errors that its scaling hides: a result counts when Newton's step would not move
// it
template <int Dim>
bool is_centre(const HalfSpaces<Dim>& planes, const std::vector<double>& slacks, const Vector<Dim>& point) {
  Eigen::Matrix<double, Eigen::Dynamic, Dim> rows(planes.size(), Dim);
  double rounding = 0;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    rows.row(static_cast<Eigen::Index>(i)) = planes[i].normal.transpose() / slacks[i];
    rounding = std::max(rounding, (std::abs(planes[i].offset) + point.norm()) / slacks[i]);
  }
  const Vector<Dim> step = rows.colPivHouseholderQr().solve(-Eigen::VectorXd::Ones(rows.rows()));
  return (rows * step).norm() <= accepted_step + roundings * std::numeric_limits<double>::epsilon() * rounding;
}

enum class Scaling { fitted, contact, none };

template <int Dim>
CentreResult<Dim> solve_scaled(const HalfSpaces<Dim>& planes, const CentreRequest<Dim>& request, Scaling scaling) {
  CentreResult<Dim> result;
  result.point = request.start;
  for (int pass = 0; pass <= passes; ++pass) {
    std::vector<double> slacks;
    if (!slacks_of<Dim>(planes, result.point, slacks)) {
      result.status = pass == 0 ? CentreStatus::start_not_interior : CentreStatus::singular;
      return result;
    }
    if (pass > 0 && is_centre<Dim>(planes, slacks, result.point)) return result;
    if (pass == passes) break;
    Matrix<Dim> axes = Matrix<Dim>::Identity();
    if (scaling == Scaling::fitted) axes = fitted_axes<Dim>(planes, slacks);
    if (scaling == Scaling::contact) axes = contact_axes<Dim>(planes, slacks, request.normal);
    const std::vector<double> metres(planes.size(), 1.0);
    solve<Dim>(make_program<Dim>(planes, slacks, scaling == Scaling::none ? metres : slacks, axes),
               request.limit - result.iterations, result);
    if (result.status != CentreStatus::converged) return result;
  }
  result.status = CentreStatus::singular;
  return result;
}

}  // namespace

Matrix<2> aligning_rotation(const Vector<2>& n) {
  Matrix<2> rotation;
  rotation << n[1], n[0], -n[0], n[1];
  return rotation;
}

Matrix<3> aligning_rotation(const Vector<3>& n) {
  // the quaternion of Eqs 3.39-3.43 before it is made unit: w = 1 + n·z, (x, y, z) = z × n. Near -z the sum cancels;
  // there (x² + y²)/(1 - n·z) replaces it
  const double across = n[0] * n[0] + n[1] * n[1];
  Quaternion turn(n[2] > 0 ? 1 + n[2] : across / (1 - n[2]), -n[1], n[0], 0);
  if (n[2] < 0 && across < opposite) turn = Quaternion(0, 1, 0, 0);
  return turn.normalized().toRotationMatrix();
}

template <int Dim>
CentreResult<Dim> solve_analytic_centre_ipopt(const HalfSpaces<Dim>& planes, const CentreRequest<Dim>& request) {
  return solve_scaled<Dim>(planes, request, Scaling::fitted);
}

template <int Dim>
CentreResult<Dim> solve_analytic_centre_ipopt_scaled(const HalfSpaces<Dim>& planes, const CentreRequest<Dim>& request) {
  return solve_scaled<Dim>(planes, request, Scaling::contact);
}

template <int Dim>
CentreResult<Dim> solve_analytic_centre_ipopt_unscaled(const HalfSpaces<Dim>& planes,
                                                       const CentreRequest<Dim>& request) {
  return solve_scaled<Dim>(planes, request, Scaling::none);
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                                   \
  template CentreResult<Dim> solve_analytic_centre_ipopt(const HalfSpaces<Dim>&, const CentreRequest<Dim>&);        \
  template CentreResult<Dim> solve_analytic_centre_ipopt_scaled(const HalfSpaces<Dim>&, const CentreRequest<Dim>&); \
  template CentreResult<Dim> solve_analytic_centre_ipopt_unscaled(const HalfSpaces<Dim>&, const CentreRequest<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
