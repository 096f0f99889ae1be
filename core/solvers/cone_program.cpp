#include "core/solvers/cone_program.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/solvers/complete_factors.hpp"
#include "core/solvers/cone_scaling.hpp"

namespace voussoir {
namespace {

constexpr int most_steps = 80;
constexpr double wanted_error = 1e-11;     // residuals and gap; relative
constexpr double enough_digits = 1e-7;     // if more digits are lost than gained
constexpr int steps_without_gain = 6;      // iterations without a point that is better by `gain`
constexpr double gain = 1;                 // of the error
constexpr double no_optimum = 1e-8;        // τ over κ: the program has no optimum
constexpr double to_the_boundary = 0.985;  // part of the step to it
constexpr double least_step = 1e-9;
constexpr double own_ridge = 1e-15;      // of each row's own diagonal: light bodies keep their digits
constexpr double refined_error = 1e-15;  // of a direction
constexpr int most_refinements = 4;
constexpr double spoilt_digits = 1e-10;  // of a right side
constexpr int most_conjugate_steps = 8;

double largest(const Eigen::VectorXd& numbers) {
  return numbers.size() ? numbers.cwiseAbs().maxCoeff() : 0;
}

// numbers by cone, by its given head, by body, and of the load
struct Multipliers {
  Eigen::VectorXd y, heads;
  double load = 0;
};

template <int Freedoms, int Width>
class Embedding {
 public:
  // thorough: every system to rounding, by conjugate gradients too
  Embedding(const ConeProgram<Freedoms, Width>& of_program, bool is_thorough);
  ConeProgramAnswer solve();

 private:
  using Numbers = Vector<Width>;
  using Algebra = ConeAlgebra<Width>;
  struct Point {
    Eigen::VectorXd x, s;
    Multipliers dual;  // its load: λ's own value
    double tau = 1, kappa = 1;
  };
  struct Residuals {
    Eigen::VectorXd balance, dual, heads;
    double load, gap;
  };

  auto part(Eigen::VectorXd& x, int i) const { return x.template segment<Width>(Width * i); }
  auto part(const Eigen::VectorXd& x, int i) const { return x.template segment<Width>(Width * i); }
  bool given(int i) const { return heads[i] > 0; }
  double head(const Eigen::VectorXd& x, int i) const { return Algebra::head().dot(part(x, i)); }

  Eigen::VectorXd forces(const Eigen::VectorXd& x) const;      // A x
  Eigen::VectorXd velocities(const Eigen::VectorXd& y) const;  // A' y
  Eigen::VectorXd velocities(const Multipliers& dual) const;   // A' y, and the heads'
  Eigen::VectorXd scaled(const Eigen::VectorXd& x) const;      // W² x
  double right_of(const Multipliers& dual) const;              // b' y
  Residuals residuals(const Point& at) const;
  bool factorise(const Point& at);
  Multipliers solve_normal(const Eigen::VectorXd& balance, const Eigen::VectorXd& heads) const;
  Multipliers eliminate_heads(const Eigen::VectorXd& balance, const Eigen::VectorXd& heads) const;
  Multipliers solve_system(const Eigen::VectorXd& balance, const Eigen::VectorXd& heads, double load) const;
  Point direction(const Point& at, const Residuals& of, const Eigen::VectorXd& q, double of_tau, double weight) const;
  double step(const Point& at, const Point& direction) const;
  bool inside(const Point& at) const;
  void judge(const Point& at, const Residuals& of, ConeProgramAnswer& answer) const;

  const bool thorough;
  const ConeProgram<Freedoms, Width> program;  // in the algebra's own numbers
  int count, bodies;
  bool has_load;
  BlockMatrix<Freedoms> normal;
  std::vector<std::array<int, 3>> places;  // by cone: blocks of body a, of b, between both
  EliminationPlan plan;
  CompleteFactors<Freedoms> factors;
  Eigen::VectorXd cost, heads;  // by cone: its whole cost, its given head
  double size_of_right = 1, size_of_cost = 1;

  // of an iteration
  std::vector<ConeScaling<Width>> scaling;
  std::vector<Numbers> of_head;  // of given heads: W² h / h·W² h
  Multipliers of_live, of_tau;   // M⁻¹ of the load, and the system's answer to τ
  double live_power = 0, tau_pivot = 0;
};

template <int Freedoms, int Width>
BlockMatrix<Freedoms> normal_pattern(const ConeProgram<Freedoms, Width>& program) {
  std::vector<std::vector<int>> columns(program.right_side.size() / Freedoms);
  for (const ForceCone<Freedoms, Width>& cone : program.cones)
    if (cone.body_a >= 0 && cone.body_b >= 0)
      columns[std::max(cone.body_a, cone.body_b)].push_back(std::min(cone.body_a, cone.body_b));
  BlockMatrix<Freedoms> matrix;
  matrix.lay_out(columns);
  return matrix;
}

template <int Freedoms, int Width>
ConeProgram<Freedoms, Width> in_own_numbers(ConeProgram<Freedoms, Width> program) {
  for (ForceCone<Freedoms, Width>& cone : program.cones)
    for (auto* on : {&cone.on_a, &cone.on_b})
      for (int row = 0; row < Freedoms; ++row)
        on->row(row) = ConeAlgebra<Width>::own(on->row(row).transpose()).transpose().eval();
  return program;
}

template <int Freedoms, int Width>
Embedding<Freedoms, Width>::Embedding(const ConeProgram<Freedoms, Width>& of_program, bool is_thorough)
    : thorough(is_thorough),
      program(in_own_numbers(of_program)),
      count(static_cast<int>(program.cones.size())),
      bodies(static_cast<int>(program.right_side.size()) / Freedoms),
      has_load((program.live.array() != 0).any()),
      normal(normal_pattern(program)),
      plan(neighbours_in(normal)),
      factors(plan, true),
      cost(Eigen::VectorXd::Zero(Width * count)),
      heads(Eigen::VectorXd::Zero(count)),
      scaling(count),
      of_head(count) {
  for (int i = 0; i < count; ++i) {
    const ForceCone<Freedoms, Width>& cone = program.cones[i];
    const int a = cone.body_a, b = cone.body_b;
    const auto place = [&](int row, int column) {
      return static_cast<int>(&normal.at(row, column) - normal.blocks.data());
    };
    places.push_back({a < 0 ? -1 : place(a, a), b < 0 ? -1 : place(b, b),
                      a < 0 || b < 0 ? -1 : place(std::max(a, b), std::min(a, b))});
    part(cost, i) = cone.cost * Algebra::head();
    heads[i] = cone.head;
  }
  size_of_right += std::max(largest(program.right_side), largest(heads));
  for (const ForceCone<Freedoms, Width>& cone : program.cones)
    size_of_cost = std::max(size_of_cost, 1 + std::abs(cone.cost));
}

template <int Freedoms, int Width>
Eigen::VectorXd Embedding<Freedoms, Width>::forces(const Eigen::VectorXd& x) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(program.right_side.size());
  for (int i = 0; i < count; ++i) {
    const ForceCone<Freedoms, Width>& cone = program.cones[i];
    if (cone.body_a >= 0) sum.template segment<Freedoms>(Freedoms * cone.body_a).noalias() += cone.on_a * part(x, i);
    if (cone.body_b >= 0) sum.template segment<Freedoms>(Freedoms * cone.body_b).noalias() += cone.on_b * part(x, i);
  }
  return sum;
}

template <int Freedoms, int Width>
Eigen::VectorXd Embedding<Freedoms, Width>::velocities(const Eigen::VectorXd& y) const {
  Eigen::VectorXd all(Width * count);
  for (int i = 0; i < count; ++i) {
    const ForceCone<Freedoms, Width>& cone = program.cones[i];
    Numbers sum = Numbers::Zero();
    if (cone.body_a >= 0) sum.noalias() += cone.on_a.transpose() * y.template segment<Freedoms>(Freedoms * cone.body_a);
    if (cone.body_b >= 0) sum.noalias() += cone.on_b.transpose() * y.template segment<Freedoms>(Freedoms * cone.body_b);
    part(all, i) = sum;
  }
  return all;
}

template <int Freedoms, int Width>
Eigen::VectorXd Embedding<Freedoms, Width>::velocities(const Multipliers& dual) const {
  Eigen::VectorXd all = velocities(dual.y);
  for (int i = 0; i < count; ++i)
    if (given(i)) part(all, i) += dual.heads[i] * Algebra::head();
  return all;
}

template <int Freedoms, int Width>
Eigen::VectorXd Embedding<Freedoms, Width>::scaled(const Eigen::VectorXd& x) const {
  Eigen::VectorXd all(x.size());
  for (int i = 0; i < count; ++i)
    part(all, i).noalias() = scaling[i].square * part(x, i);
  return all;
}

template <int Freedoms, int Width>
double Embedding<Freedoms, Width>::right_of(const Multipliers& dual) const {
  return program.right_side.dot(dual.y) + heads.dot(dual.heads);
}

template <int Freedoms, int Width>
typename Embedding<Freedoms, Width>::Residuals Embedding<Freedoms, Width>::residuals(const Point& at) const {
  Residuals of;
  of.balance = program.right_side * at.tau - forces(at.x) - program.live * at.dual.load;
  of.dual = cost * at.tau - velocities(at.dual) - at.s;
  of.heads = Eigen::VectorXd::Zero(count);
  for (int i = 0; i < count; ++i)
    if (given(i)) of.heads[i] = heads[i] * at.tau - head(at.x, i);
  of.load = has_load ? -at.tau - program.live.dot(at.dual.y) : 0;
  of.gap = at.kappa + cost.dot(at.x) - (has_load ? at.dual.load : 0) - right_of(at.dual);
  return of;
}

// the scaling of every cone, and M = A W² A' without what is given away by the heads
template <int Freedoms, int Width>
bool Embedding<Freedoms, Width>::factorise(const Point& at) {
  using Block = typename BlockMatrix<Freedoms>::Block;
  for (Block& block : normal.blocks)
    block.setZero();
  for (int i = 0; i < count; ++i) {
    scaling[i] = Algebra::scaling(part(at.x, i), part(at.s, i));
    Matrix<Width> square = scaling[i].square;
    if (given(i)) {
      const Numbers weighted = square * Algebra::head();
      of_head[i] = weighted / Algebra::head().dot(weighted);
      square -= (of_head[i] * weighted.transpose()).eval();
    }
    const ForceCone<Freedoms, Width>& cone = program.cones[i];
    const FixedMatrix<Freedoms, Width> of_a = cone.on_a * square, of_b = cone.on_b * square;
    if (cone.body_a >= 0) normal.blocks[places[i][0]].noalias() += of_a * cone.on_a.transpose();
    if (cone.body_b >= 0) normal.blocks[places[i][1]].noalias() += of_b * cone.on_b.transpose();
    if (places[i][2] < 0) continue;
    if (cone.body_a > cone.body_b)
      normal.blocks[places[i][2]].noalias() += of_a * cone.on_b.transpose();
    else
      normal.blocks[places[i][2]].noalias() += of_b * cone.on_a.transpose();
  }
  for (const int place : normal.diagonal)
    for (int k = 0; k < Freedoms; ++k) {
      double& own = normal.blocks[place](k, k);
      own = own > 0 ? own * (1 + own_ridge) : 1;
    }
  if (!factors.factorise(normal)) return false;

  const Eigen::VectorXd none = Eigen::VectorXd::Zero(count), scaled_cost = scaled(cost);
  if (has_load) {
    of_live = solve_normal(program.live, none);
    live_power = program.live.dot(of_live.y);
  }
  Eigen::VectorXd more_heads = none, fewer_heads = none;
  for (int i = 0; i < count; ++i)
    if (given(i)) {
      more_heads[i] = heads[i] + head(scaled_cost, i);
      fewer_heads[i] = heads[i] - head(scaled_cost, i);
    }
  const Eigen::VectorXd of_cost = forces(scaled_cost);
  of_tau = solve_system(program.right_side + of_cost, more_heads, has_load ? -1 : 0);
  tau_pivot = (program.right_side - of_cost).dot(of_tau.y) + fewer_heads.dot(of_tau.heads) +
              (has_load ? of_tau.load : 0) + cost.dot(scaled_cost) + at.kappa / at.tau;
  return true;
}

// M⁻¹, with the heads eliminated, refined once; if thorough, by conjugate gradients where rounding has spoilt pivots: a
// step for each of them. Where M has no full rank, they would add motions that nothing resists.
template <int Freedoms, int Width>
Multipliers Embedding<Freedoms, Width>::solve_normal(const Eigen::VectorXd& balance,
                                                     const Eigen::VectorXd& of_heads) const {
  Multipliers sum = eliminate_heads(balance, of_heads);
  Eigen::VectorXd left, left_heads;
  const auto find_left = [&] {
    const Eigen::VectorXd carried = scaled(velocities(sum));
    left = balance - forces(carried);
    left_heads = of_heads;
    for (int i = 0; i < count; ++i)
      if (given(i)) left_heads[i] -= head(carried, i);
  };
  const auto add = [&](const Multipliers& more, double times) {
    sum.y += times * more.y;
    sum.heads += times * more.heads;
  };
  const auto slope_of = [&](const Multipliers& aim) { return left.dot(aim.y) + left_heads.dot(aim.heads); };
  find_left();
  add(eliminate_heads(left, left_heads), 1);
  if (!thorough) return sum;
  find_left();
  const double size = std::max(largest(balance), largest(of_heads));
  double least = std::max(largest(left), largest(left_heads));
  if (least <= spoilt_digits * size) return sum;
  Multipliers best = sum;

  Multipliers aim = eliminate_heads(left, left_heads), towards = aim;
  double slope = slope_of(aim);
  for (int step = 0; step < most_conjugate_steps && slope > 0; ++step) {
    const Eigen::VectorXd speeds = velocities(towards);
    const double curvature = speeds.dot(scaled(speeds));
    if (!(curvature > 0)) break;
    add(towards, slope / curvature);
    find_left();
    if (const double now = std::max(largest(left), largest(left_heads)); now < least) {
      least = now;
      best = sum;
    }
    if (least <= refined_error * size) break;
    aim = eliminate_heads(left, left_heads);
    const double before = slope;
    slope = slope_of(aim);
    towards.y = aim.y + slope / before * towards.y;
    towards.heads = aim.heads + slope / before * towards.heads;
  }
  return best;
}

// by the factors of M
template <int Freedoms, int Width>
Multipliers Embedding<Freedoms, Width>::eliminate_heads(const Eigen::VectorXd& balance,
                                                        const Eigen::VectorXd& of_heads) const {
  Eigen::VectorXd right = balance;
  if (heads.any()) {
    Eigen::VectorXd given_away = Eigen::VectorXd::Zero(Width * count);
    for (int i = 0; i < count; ++i)
      if (given(i)) part(given_away, i) = of_head[i] * of_heads[i];
    right -= forces(given_away);
  }
  Multipliers answer{factors.solve(right), Eigen::VectorXd::Zero(count), 0};
  if (!heads.any()) return answer;
  const Eigen::VectorXd speeds = velocities(answer.y);
  for (int i = 0; i < count; ++i)
    if (given(i))
      answer.heads[i] =
          of_heads[i] / Algebra::head().dot(scaling[i].square * Algebra::head()) - of_head[i].dot(part(speeds, i));
  return answer;
}

// of [M live; live' 0]
template <int Freedoms, int Width>
Multipliers Embedding<Freedoms, Width>::solve_system(const Eigen::VectorXd& balance, const Eigen::VectorXd& of_heads,
                                                     double load) const {
  Multipliers answer = solve_normal(balance, of_heads);
  if (!has_load || !(live_power > 0)) return answer;
  answer.load = (program.live.dot(answer.y) - load) / live_power;
  answer.y -= answer.load * of_live.y;
  answer.heads -= answer.load * of_live.heads;
  return answer;
}

// q: the wanted_error complementarity of each cone in scaled numbers, of_tau_kappa: of τ and κ; weight: the part of the
// residuals that the full step takes away
template <int Freedoms, int Width>
typename Embedding<Freedoms, Width>::Point Embedding<Freedoms, Width>::direction(const Point& at, const Residuals& of,
                                                                                 const Eigen::VectorXd& q,
                                                                                 double of_tau_kappa,
                                                                                 double weight) const {
  Eigen::VectorXd wanted_x(Width * count);
  for (int i = 0; i < count; ++i)
    part(wanted_x, i).noalias() = scaling[i].scale * part(q, i);
  const Eigen::VectorXd aim = wanted_x - weight * scaled(of.dual), scaled_cost = scaled(cost);
  Eigen::VectorXd of_heads = Eigen::VectorXd::Zero(count), fewer_heads = of_heads;
  for (int i = 0; i < count; ++i)
    if (given(i)) {
      of_heads[i] = weight * of.heads[i] - head(aim, i);
      fewer_heads[i] = heads[i] - head(scaled_cost, i);
    }
  const Multipliers first = solve_system(weight * of.balance - forces(aim), of_heads, weight * of.load);
  Point step;
  step.tau = (weight * of.gap + cost.dot(aim) + of_tau_kappa / at.tau -
              (program.right_side - forces(scaled_cost)).dot(first.y) - fewer_heads.dot(first.heads) -
              (has_load ? first.load : 0)) /
             tau_pivot;
  step.dual = {first.y + step.tau * of_tau.y, first.heads + step.tau * of_tau.heads,
               first.load + step.tau * of_tau.load};
  step.s = weight * of.dual + step.tau * cost - velocities(step.dual);
  step.x = wanted_x - scaled(step.s);
  for (int round = 0; round < most_refinements; ++round) {
    const Eigen::VectorXd balance =
        weight * of.balance - forces(step.x) - program.live * step.dual.load + program.right_side * step.tau;
    Eigen::VectorXd left_heads = Eigen::VectorXd::Zero(count);
    for (int i = 0; i < count; ++i)
      if (given(i)) left_heads[i] = weight * of.heads[i] - head(step.x, i) + heads[i] * step.tau;
    const double load = has_load ? weight * of.load - program.live.dot(step.dual.y) - step.tau : 0;
    if (std::max({largest(balance), largest(left_heads), std::abs(load)}) <= refined_error * (1 + at.tau)) break;
    const Multipliers more = solve_system(balance, left_heads, load);
    const Eigen::VectorXd slower = velocities(more);
    step.dual.y += more.y;
    step.dual.heads += more.heads;
    step.dual.load += more.load;
    step.s -= slower;
    step.x += scaled(slower);
  }
  step.kappa = (of_tau_kappa - at.kappa * step.tau) / at.tau;
  return step;
}

template <int Freedoms, int Width>
double Embedding<Freedoms, Width>::step(const Point& at, const Point& direction) const {
  double most = std::numeric_limits<double>::max();
  for (int i = 0; i < count; ++i)
    most = std::min({most, Algebra::steps_to_boundary(part(at.x, i), part(direction.x, i)),
                     Algebra::steps_to_boundary(part(at.s, i), part(direction.s, i))});
  if (direction.tau < 0) most = std::min(most, at.tau / -direction.tau);
  if (direction.kappa < 0) most = std::min(most, at.kappa / -direction.kappa);
  return most;
}

// whether rounding has left all forces and velocities within their cones
template <int Freedoms, int Width>
bool Embedding<Freedoms, Width>::inside(const Point& at) const {
  for (int i = 0; i < count; ++i)
    if (!Algebra::inside(part(at.x, i)) || !Algebra::inside(part(at.s, i))) return false;
  return true;
}

// keeps the point if it is better than the best so far
template <int Freedoms, int Width>
void Embedding<Freedoms, Width>::judge(const Point& at, const Residuals& of, ConeProgramAnswer& answer) const {
  const double value = (cost.dot(at.x) - (has_load ? at.dual.load : 0)) / at.tau, bound = right_of(at.dual) / at.tau,
               gap = std::abs(value - bound) / (1 + std::abs(value)),
               balance = std::max(largest(of.balance), largest(of.heads)) / at.tau / size_of_right,
               inadmissible = std::max(largest(of.dual) / size_of_cost, std::abs(of.load)) / at.tau;
  if (answer.iterations > 0 && std::max({gap, balance, inadmissible}) >= answer.error()) return;
  answer.value = value;
  answer.bound = bound;
  answer.factor = has_load ? at.dual.load / at.tau : 0;
  answer.x = at.x / at.tau;
  answer.y = at.dual.y / at.tau;
  answer.heads = at.dual.heads / at.tau;
  answer.gap = gap;
  answer.out_of_balance = balance;
  answer.inadmissible = inadmissible;
}

template <int Freedoms, int Width>
ConeProgramAnswer Embedding<Freedoms, Width>::solve() {
  Point at;
  at.x = Eigen::VectorXd::Zero(Width * count);
  for (int i = 0; i < count; ++i)
    part(at.x, i) = Algebra::identity();
  at.s = at.x;
  at.dual = {Eigen::VectorXd::Zero(program.right_side.size()), Eigen::VectorXd::Zero(count), 0};
  ConeProgramAnswer answer;
  int of_best = 0;
  for (; answer.iterations < most_steps; ++answer.iterations) {
    const Residuals of = residuals(at);
    const double before = answer.error();
    judge(at, of, answer);
    if (answer.error() < gain * before || answer.iterations == 0) of_best = answer.iterations;
    if (answer.error() <= wanted_error) break;
    if (answer.error() <= enough_digits && answer.iterations - of_best > steps_without_gain) break;
    if (at.tau < no_optimum * std::max(1.0, at.kappa)) {
      const double gained = (has_load ? at.dual.load : 0) - cost.dot(at.x), driven = right_of(at.dual);
      answer.status = gained > driven ? ConeStatus::unbounded : ConeStatus::infeasible;
      answer.x = at.x / std::max(gained, driven);
      answer.y = at.dual.y / std::max(gained, driven);
      return answer;
    }
    if (!factorise(at)) break;

    const double mean = (at.x.dot(at.s) + at.tau * at.kappa) / (Algebra::degree * count + 1);
    Eigen::VectorXd v(Width * count);
    for (int i = 0; i < count; ++i)
      part(v, i).noalias() = scaling[i].scale * part(at.s, i);
    const Point affine = direction(at, of, -v, -at.tau * at.kappa, 1);
    const double length = std::min(1.0, step(at, affine)),
                 left = ((at.x + length * affine.x).dot(at.s + length * affine.s) +
                         (at.tau + length * affine.tau) * (at.kappa + length * affine.kappa)) /
                        (Algebra::degree * count + 1),
                 ratio = std::clamp(left / mean, 0.0, 1.0), centring = std::max(ratio * ratio * ratio, 1e-8);
    Eigen::VectorXd q(Width * count);
    for (int i = 0; i < count; ++i) {
      const Numbers own = part(v, i), of_x = scaling[i].inverse * part(affine.x, i),
                    of_s = scaling[i].scale * part(affine.s, i);
      const Numbers aim =
          -Algebra::product(own, own) - Algebra::product(of_x, of_s) + centring * mean * Algebra::identity();
      part(q, i) = Algebra::quotient(aim, own);
    }
    const Point corrected =
        direction(at, of, q, -at.tau * at.kappa - affine.tau * affine.kappa + centring * mean, 1 - centring);
    double taken = std::min(1.0, to_the_boundary * step(at, corrected));
    const Eigen::VectorXd before_x = at.x, before_s = at.s;
    at.x += taken * corrected.x;
    at.s += taken * corrected.s;
    while (!inside(at) && taken > least_step) {
      taken *= 0.5;
      at.x = before_x + taken * corrected.x;
      at.s = before_s + taken * corrected.s;
    }
    if (!(taken > least_step)) break;
    at.dual.y += taken * corrected.dual.y;
    at.dual.heads += taken * corrected.dual.heads;
    at.dual.load += taken * corrected.dual.load;
    at.tau += taken * corrected.tau;
    at.kappa += taken * corrected.kappa;
  }
  answer.status = answer.error() <= enough_digits ? ConeStatus::optimal : ConeStatus::stalled;
  return answer;
}

}  // namespace

template <int Freedoms, int Width>
ConeProgramAnswer solve(const ConeProgram<Freedoms, Width>& program) {
  ConeProgramAnswer answer = Embedding<Freedoms, Width>(program, false).solve();
  if (answer.status == ConeStatus::stalled) answer = Embedding<Freedoms, Width>(program, true).solve();
  for (Eigen::Index i = 0; i < answer.x.size(); i += Width)
    answer.x.template segment<Width>(i) = ConeAlgebra<Width>::stated(answer.x.template segment<Width>(i)).eval();
  return answer;
}

template ConeProgramAnswer solve(const ConeProgram<3, 2>&);
template ConeProgramAnswer solve(const ConeProgram<6, 3>&);

}  // namespace voussoir
