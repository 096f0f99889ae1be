#include "core/implicit/step_system.hpp"

#include <algorithm>
#include <cmath>

#include "core/solvers/complete_factors.hpp"

namespace voussoir {
namespace {

constexpr int most_iterations = 40;

// Of the motion over the step and of the points' overlaps and slips in it: converged; and, where rounding stops it,
// if it is no longer halved and below the second.
constexpr double converged = 1e-13, stalled = 1e-9, hardly_falls = 0.5;
constexpr int least_iterations = 4;  // before it may have stalled

template <int Dim>
using PointMotion = FixedMatrix<Dim, freedoms<Dim>>;

// the velocity of a point at an arm by the motion of its body
template <int Dim>
PointMotion<Dim> velocity_by_motion(const Vector<Dim>& arm) {
  PointMotion<Dim> b;
  b.template leftCols<Dim>().setIdentity();
  for (int k = 0; k < spin_freedoms<Dim>; ++k)
    b.col(Dim + k) = cross(Spin<Dim>(Spin<Dim>::Unit(k)), arm);
  return b;
}

// Blocks for the unknown bodies of all pairs. The pattern is symmetric; the values are not where a column loads a side.
template <int Dim>
BlockMatrix<freedoms<Dim>> laid_out(const StepUnknowns<Dim>& unknowns, const auto& points,
                                    const std::vector<StepPlate<Dim>>& plates) {
  std::vector<std::vector<int>> columns(unknowns.bodies.size());
  const auto join = [&](int a, int b) {
    if (a < 0 || b < 0 || a == b) return;
    columns[a].push_back(b);
    columns[b].push_back(a);
  };
  for (const auto& p : points) {
    const int a = unknowns.moved[p.body_a], b = unknowns.moved[p.body_b];
    join(a, b);
    each_beside<Dim>(unknowns, p, {}, {}, [&](int beside, double, const Vector<Dim>&) {
      join(beside, a);
      join(beside, b);
    });
  }
  for (const StepPlate<Dim>& p : plates)
    if (p.face->column >= 0) join(unknowns.place[p.face->body], unknowns.place[p.face->column]);
  BlockMatrix<freedoms<Dim>> matrix;
  matrix.lay_out(std::move(columns));
  return matrix;
}

// restrained directions keep their velocity
template <int Dim>
void restrain(const StepUnknowns<Dim>& unknowns, BlockMatrix<freedoms<Dim>>& matrix, Eigen::VectorXd& rhs) {
  constexpr int F = freedoms<Dim>;
  for (int row = 0; row < matrix.rows(); ++row)
    for (int at = matrix.first[row]; at < matrix.first[row + 1]; ++at) {
      const int column = matrix.column[at];
      for (int i = 0; i < F; ++i)
        for (int j = 0; j < F; ++j)
          if (unknowns.free[F * row + i] == 0 || unknowns.free[F * column + j] == 0)
            matrix.blocks[at](i, j) = row == column && i == j ? 1 : 0;
    }
  rhs = rhs.cwiseProduct(unknowns.free);
}

// adds scale Bᵀ C B of a pair
template <int Dim>
void add_pair(const StepUnknowns<Dim>& unknowns, const auto& p, const Vector<Dim>& arm_a, const Vector<Dim>& arm_b,
              const Matrix<Dim>& c, double scale, BlockMatrix<freedoms<Dim>>& matrix) {
  const int a = unknowns.moved[p.body_a], b = unknowns.moved[p.body_b];
  const PointMotion<Dim> of_a = velocity_by_motion<Dim>(arm_a), of_b = velocity_by_motion<Dim>(arm_b);
  each_loaded(unknowns, p, arm_a, arm_b, [&](int row, double sign, const Vector<Dim>& arm) {
    const PointMotion<Dim> of = velocity_by_motion<Dim>(arm);
    if (a >= 0) matrix.at(row, a) -= sign * scale * (of.transpose() * c * of_a);
    if (b >= 0) matrix.at(row, b) += sign * scale * (of.transpose() * c * of_b);
  });
}

template <int Dim>
class StepEquations {
  static constexpr int F = freedoms<Dim>, S = spin_freedoms<Dim>;

 public:
  StepEquations(const Model<Dim>& m, const StepUnknowns<Dim>& u, double step, const std::vector<Motion<Dim>>& start,
                const std::vector<Load<Dim>>& l, const std::vector<StepPlate<Dim>>& q, std::vector<StepPoint<Dim>>& p,
                std::vector<MeanMotion<Dim>>& y)
      : model(m),
        unknowns(u),
        h(step),
        before(start),
        loads(l),
        plates(q),
        points(p),
        mean(y),
        matrix(laid_out<Dim>(u, p, q)),
        plan(neighbours_in(matrix)) {}

  StepSolution solve() {
    StepSolution found;
    double last = 0;
    CompleteFactors<F> factors(plan, false);
    for (; found.iterations < most_iterations && !found.solved; ++found.iterations) {
      Eigen::VectorXd rhs = assemble();
      if (!factors.factorise(matrix)) return found;
      const Eigen::VectorXd change = factors.solve(rhs);
      const double now = take(change);
      if (!std::isfinite(now)) return found;
      const bool stands_still = found.iterations >= least_iterations && now > hardly_falls * last && now < stalled;
      found.solved = now < converged || stands_still;
      last = now;
    }
    for (StepPoint<Dim>& p : points)
      if (!(p.force.normal > 0)) p.force = {};
    return found;
  }

 private:
  Eigen::VectorXd assemble() {
    Eigen::VectorXd rhs = Eigen::VectorXd::Zero(unknowns.free.size());
    for (auto& block : matrix.blocks)
      block.setZero();
    for (std::size_t i = 0; i < unknowns.bodies.size(); ++i) {
      const int b = unknowns.bodies[i];
      const Body<Dim>& body = model.bodies[b];
      const SpinChange<Dim> spin = spin_change<Dim>(body, before[b], mean[b].spin, h);
      auto&& block = matrix.at(static_cast<int>(i), static_cast<int>(i));
      block.template topLeftCorner<Dim, Dim>().diagonal().array() += 2 * body.mass;
      block.template bottomRightCorner<S, S>() += spin.by_spin;
      rhs.segment<Dim>(F * i) = h * loads[b].force - 2 * body.mass * (mean[b].velocity - before[b].velocity);
      rhs.segment<S>(F * i + Dim) = h * loads[b].moment - spin.change;
    }
    lines.resize(points.size());
    errors = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const StepPoint<Dim>& p = points[k];
      const Vector<Dim> motion = p.motion(mean);
      const LinearPoint<Dim>& line = lines[k] =
          linearise<Dim>(p.law, p.normal, p.from, p.overlap_after(motion), p.slip(motion), p.force);
      errors = std::max({errors, line.overlap_error, line.slip_error});
      const Vector<Dim> force = p.force.normal * p.normal + p.force.shear + line.change;
      each_loaded(unknowns, p, p.point, p.from_b, [&](int row, double sign, const Vector<Dim>& arm) {
        rhs.segment<F>(F * row) += sign * h * (velocity_by_motion<Dim>(arm).transpose() * force);
      });
      add_pair<Dim>(unknowns, p, p.point, p.from_b, line.slope, h * h, matrix);
    }
    for (const StepPlate<Dim>& p : plates)
      add_plate(p, rhs);
    restrain(unknowns, matrix, rhs);
    return rhs;
  }

  // it loads the side's body alone
  void add_plate(const StepPlate<Dim>& p, Eigen::VectorXd& rhs) {
    const int row = unknowns.place[p.face->body];
    if (row < 0) return;
    const PlateStep<Dim> step = p.step(mean, h);
    const PointMotion<Dim> of = velocity_by_motion<Dim>(p.arm);
    rhs.segment<F>(F * row) += h * (of.transpose() * step.mean_force);
    matrix.at(row, row) -= h * (of.transpose() * step.by_velocity * of);
    const int column = p.face->column >= 0 ? unknowns.place[p.face->column] : -1;
    if (column >= 0)
      matrix.at(row, column) += h * (of.transpose() * step.by_velocity * velocity_by_motion<Dim>(p.arm_of_column));
  }

  // m: the largest change of a body's motion over the step, and what was left of the points' equations, over the step's
  // own motions
  double take(const Eigen::VectorXd& change) {
    std::vector<MeanMotion<Dim>> more(mean.size());
    double moved = 0, changed = 0;
    for (std::size_t i = 0; i < unknowns.bodies.size(); ++i) {
      const int b = unknowns.bodies[i];
      const double radius = model.bodies[b].radius;
      more[b].velocity = change.segment<Dim>(F * i);
      more[b].spin = change.segment<S>(F * i + Dim);
      mean[b].velocity += more[b].velocity;
      mean[b].spin += more[b].spin;
      changed = std::max(changed, h * (more[b].velocity.norm() + radius * more[b].spin.norm()));
      moved = std::max(moved, h * (mean[b].velocity.norm() + radius * mean[b].spin.norm()));
    }
    repeat_images(model, more);
    repeat_images(model, mean);
    for (std::size_t k = 0; k < points.size(); ++k) {
      StepPoint<Dim>& p = points[k];
      const Vector<Dim> way = p.motion(more), df = lines[k].change - lines[k].slope * way;
      const double along = p.normal.dot(df);
      p.force.normal += along;
      p.force.shear += df - along * p.normal;
      moved = std::max(moved, std::abs(p.law.overlap));
    }
    return moved > 0 ? std::max(changed, errors) / moved : 0;
  }

  const Model<Dim>& model;
  const StepUnknowns<Dim>& unknowns;
  const double h;
  const std::vector<Motion<Dim>>& before;
  const std::vector<Load<Dim>>& loads;
  const std::vector<StepPlate<Dim>>& plates;
  std::vector<StepPoint<Dim>>& points;
  std::vector<MeanMotion<Dim>>& mean;
  BlockMatrix<F> matrix;
  EliminationPlan plan;
  std::vector<LinearPoint<Dim>> lines;
  double errors = 0;
};

}  // namespace

template <int Dim>
StepUnknowns<Dim>::StepUnknowns(const Model<Dim>& model)
    : place(model.bodies.size(), -1), beside(model.bodies.size(), -1), outside(model.bodies.size(), false) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!model.bodies[b].fixed && model.bodies[b].present) {
      place[b] = static_cast<int>(bodies.size());
      bodies.push_back(static_cast<int>(b));
    }
  moved = place;
  for (const ColumnImage<Dim>& image : model.column_images) {
    moved[image.body] = place[image.of_column];
    outside[image.body] = image.outside;
  }
  for (const ColumnBody<Dim>& column : model.column_bodies)
    beside[column.body] = place[column.of_side];
  free.resize(freedoms<Dim> * static_cast<Eigen::Index>(bodies.size()));
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Body<Dim>& body = model.bodies[bodies[i]];
    for (int f = 0; f < freedoms<Dim>; ++f)
      free[freedoms<Dim> * i + f] = f < Dim ? body.free_translation[f] : body.free_rotation[f - Dim];
  }
}

template <int Dim>
void repeat_images(const Model<Dim>& model, std::vector<MeanMotion<Dim>>& mean) {
  for (const ColumnImage<Dim>& image : model.column_images)
    mean[image.body] = mean[image.of_column];
}

template <int Dim>
StepSolution solve_step(const Model<Dim>& model, const StepUnknowns<Dim>& unknowns, double h,
                        const std::vector<Motion<Dim>>& before, const std::vector<Load<Dim>>& loads,
                        const std::vector<StepPlate<Dim>>& plates, std::vector<StepPoint<Dim>>& points,
                        std::vector<MeanMotion<Dim>>& mean) {
  return StepEquations<Dim>(model, unknowns, h, before, loads, plates, points, mean).solve();
}

namespace {

template <int Dim>
Vector<Dim> velocity_of_point(const Model<Dim>& model, const std::vector<Motion<Dim>>& motions, int body,
                              const Vector<Dim>& arm) {
  return motions[body].velocity + cross(angular_velocity(model.bodies[body], motions[body]), arm);
}

// kg: h²/4 χ K of a closed point
template <int Dim>
Matrix<Dim> mass_of(const ClosedPoint<Dim>& c, double h) {
  const Matrix<Dim> along = c.direction * c.direction.transpose();
  return 0.25 * h * h * (c.normal * along + c.shear * (Matrix<Dim>::Identity() - along));
}

// N s: on the second body
template <int Dim>
Vector<Dim> impulse_of(const Model<Dim>& model, const std::vector<Motion<Dim>>& motions, const ClosedPoint<Dim>& c,
                       double h) {
  return mass_of(c, h) *
         (velocity_of_point(model, motions, c.body_a, c.arm_a) - velocity_of_point(model, motions, c.body_b, c.arm_b));
}

// J: of what holds the restrained directions of a body, which moves along them only if that is prescribed
template <int Dim>
double work_of_restraint(const Body<Dim>& body, const Motion<Dim>& motion, const Vector<Dim>& arm,
                         const Vector<Dim>& impulse) {
  const Spin<Dim> spin = angular_velocity(body, motion), turn = moment(arm, impulse);
  double work = 0;
  for (int k = 0; k < Dim; ++k)
    if (body.fixed || !body.free_translation[k]) work -= impulse[k] * motion.velocity[k];
  for (int k = 0; k < spin_freedoms<Dim>; ++k)
    if (body.fixed || !body.free_rotation[k]) work -= turn[k] * spin[k];
  return work;
}

}  // namespace

template <int Dim>
Calmed calm_unresolved(const Model<Dim>& model, const StepUnknowns<Dim>& unknowns, double h,
                       const std::vector<ClosedPoint<Dim>>& closed, std::vector<Motion<Dim>>& after) {
  constexpr int F = freedoms<Dim>, S = spin_freedoms<Dim>;
  BlockMatrix<F> matrix = laid_out<Dim>(unknowns, closed, {});
  for (auto& block : matrix.blocks)
    block.setZero();
  // M (v' - v) + h²/4 Σ χ Bᵀ K B v' = 0
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero(unknowns.free.size());
  for (std::size_t i = 0; i < unknowns.bodies.size(); ++i) {
    const int b = unknowns.bodies[i];
    auto&& block = matrix.at(static_cast<int>(i), static_cast<int>(i));
    block.template topLeftCorner<Dim, Dim>().diagonal().array() += model.bodies[b].mass;
    block.template bottomRightCorner<S, S>() += world_inertia<Dim>(model.bodies[b], after[b].rotation);
  }
  for (const ClosedPoint<Dim>& c : closed) {
    const Vector<Dim> impulse = impulse_of(model, after, c, h);
    each_loaded(unknowns, c, c.arm_a, c.arm_b, [&](int row, double sign, const Vector<Dim>& arm) {
      rhs.segment<F>(F * row) += sign * (velocity_by_motion<Dim>(arm).transpose() * impulse);
    });
    add_pair<Dim>(unknowns, c, c.arm_a, c.arm_b, mass_of(c, h), 1, matrix);
  }
  restrain(unknowns, matrix, rhs);
  const EliminationPlan plan(neighbours_in(matrix));
  CompleteFactors<F> factors(plan, model.column_images.empty());
  if (!factors.factorise(matrix)) return {};
  const Eigen::VectorXd change = factors.solve(rhs);
  // (v·Mv - v'·Mv')/2 = (v - v')·M(v - v')/2 + v'·C v', C of the points
  Calmed calmed;
  for (std::size_t i = 0; i < unknowns.bodies.size(); ++i) {
    const int b = unknowns.bodies[i];
    Motion<Dim>& m = after[b];
    const Spin<Dim> turned = change.segment<S>(F * i + Dim);
    calmed.taken += 0.5 * (model.bodies[b].mass * change.segment<Dim>(F * i).squaredNorm() +
                           turned.dot(world_inertia<Dim>(model.bodies[b], m.rotation) * turned));
    const Spin<Dim> spin = angular_velocity(model.bodies[b], m) + turned;
    m.velocity += change.segment<Dim>(F * i);
    m.angular_momentum = angular_momentum(model.bodies[b], m.rotation, spin);
  }
  for (const ColumnImage<Dim>& image : model.column_images) {
    Motion<Dim>& m = after[image.body];
    m.velocity = after[image.of_column].velocity;
    m.angular_momentum = angular_momentum(model.bodies[image.body], m.rotation,
                                          angular_velocity(model.bodies[image.of_column], after[image.of_column]));
  }
  for (const ClosedPoint<Dim>& c : closed) {
    const Vector<Dim> impulse = impulse_of(model, after, c, h);
    each_beside(unknowns, c, c.arm_a, c.arm_b, [&](int unknown, double sign, const Vector<Dim>& arm) {
      calmed.beside += sign * impulse.dot(velocity_of_point(model, after, unknowns.bodies[unknown], arm));
    });
    calmed.taken += impulse.dot(velocity_of_point(model, after, c.body_a, c.arm_a) -
                                velocity_of_point(model, after, c.body_b, c.arm_b));
    calmed.driven += work_of_restraint<Dim>(model.bodies[c.body_b], after[c.body_b], c.arm_b, impulse) +
                     work_of_restraint<Dim>(model.bodies[c.body_a], after[c.body_a], c.arm_a, -impulse);
  }
  return calmed;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                         \
  template struct StepUnknowns<Dim>;                                                                      \
  template StepSolution solve_step<Dim>(const Model<Dim>&, const StepUnknowns<Dim>&, double,              \
                                        const std::vector<Motion<Dim>>&, const std::vector<Load<Dim>>&,   \
                                        const std::vector<StepPlate<Dim>>&, std::vector<StepPoint<Dim>>&, \
                                        std::vector<MeanMotion<Dim>>&);                                   \
  template void repeat_images<Dim>(const Model<Dim>&, std::vector<MeanMotion<Dim>>&);                     \
  template Calmed calm_unresolved<Dim>(const Model<Dim>&, const StepUnknowns<Dim>&, double,               \
                                       const std::vector<ClosedPoint<Dim>>&, std::vector<Motion<Dim>>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
