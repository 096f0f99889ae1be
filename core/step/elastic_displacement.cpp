#include "core/step/elastic_displacement.hpp"

#include "core/solvers/block_solver.hpp"
#include "core/step/integrate.hpp"
#include "core/step/joint_forces.hpp"
#include "core/step/loads.hpp"
#include "core/step/pair_stiffness.hpp"
#include "core/step/static_solver_base.hpp"
#include "core/step/support_table.hpp"
#include "core/step/tangent.hpp"

namespace voussoir {
namespace {

// rad: tan φ of some 10⁴, so that no joint slips
constexpr double friction_without_slip = 1.5707;

// Of the stiffest joint: what a body that nothing ties is held by.
constexpr double tie_of_loose_bodies = 1e-9;

constexpr double elastic_tolerance = 1e-6;
constexpr int elastic_iterations = 1000;

// what acts on the free bodies but for joints and supports
template <int Dim>
Eigen::VectorXd loads_without_joints(const LoadsState<Dim>& loads, const Unknowns<Dim>& unknowns) {
  constexpr int F = freedoms<Dim>, S = spin_freedoms<Dim>;
  Eigen::VectorXd f(unknowns.free.size());
  for (std::size_t i = 0; i < unknowns.count(); ++i) {
    Load<Dim> load = loads.total[unknowns.bodies[i]];
    for (const Source of_joints : {Source::contacts, Source::bolts, Source::lining})
      if (const std::vector<Load<Dim>>& own = loads.by_source[of_joints]; !own.empty()) {
        load.force -= own[unknowns.bodies[i]].force;
        load.moment -= own[unknowns.bodies[i]].moment;
      }
    f.template segment<Dim>(F * i) = load.force;
    f.template segment<S>(F * i + Dim) = load.moment;
  }
  return f.cwiseProduct(unknowns.free);
}

// The tangent at the state, whose bodies stand still. Pairs in the order of the contacts, then those of supports.
template <int Dim>
void find_elastic_tangent(const Model<Dim>& model, const Settings& settings, const Unknowns<Dim>& unknowns,
                          const StaticBase<Dim>& base, State<Dim>& state, BlockMatrix<freedoms<Dim>>& k) {
  std::vector<PairStiffness<Dim>> pairs;
  find_pair_stiffness(model, settings, state.schedule, joint_step(settings, state.time_step, state.relaxation),
                      state.bodies, state.contacts, base.histories, unknowns.place, state.counters, pairs);
  for (const StepSupport<Dim>& row : step_supports<Dim>)
    row.add_pairs(model, settings, state, pairs);
  std::vector<const PairStiffness<Dim>*> all;
  for (const PairStiffness<Dim>& pair : pairs)
    all.push_back(&pair);
  find_tangent<Dim>(settings.threads, all, {}, unknowns.place, unknowns.free, k);
  const Eigen::VectorXd held = Eigen::VectorXd::Ones(unknowns.free.size()) - unknowns.free;
  k.add_diagonal(tie_of_loose_bodies * unknowns.scale.cwiseProduct(unknowns.free) + unknowns.scale.cwiseProduct(held));
}

}  // namespace

template <int Dim>
std::vector<double> elastic_displacements(const Model<Dim>& model, const Settings& settings, State<Dim> state) {
  std::vector<double> displacements(model.bodies.size(), 0);
  const Unknowns<Dim> unknowns(model);
  if (unknowns.count() == 0) return displacements;
  stop(state.bodies.motions);
  cache_poses(model, settings.threads, state.bodies);
  state.schedule.friction.assign(state.schedule.friction.size(), friction_without_slip);
  const StaticBase<Dim> base = base_of(state);
  set_trial(model, unknowns, base, Eigen::VectorXd(Eigen::VectorXd::Zero(unknowns.free.size())), state.bodies,
            state.contacts, state.supports, state.ledger, state.time_step);
  LinearWork<freedoms<Dim>> work;
  find_elastic_tangent(model, settings, unknowns, base, state, work.matrix);
  const LinearAnswer solved = solve_blocks(work, unknowns.upwards, loads_without_joints(state.loads, unknowns),
                                           elastic_tolerance, elastic_iterations, settings.threads);
  for (std::size_t i = 0; i < unknowns.count(); ++i)
    displacements[unknowns.bodies[i]] = solved.x.template segment<Dim>(freedoms<Dim> * i).norm();
  return displacements;
}

template std::vector<double> elastic_displacements<2>(const Model<2>&, const Settings&, State<2>);
template std::vector<double> elastic_displacements<3>(const Model<3>&, const Settings&, State<3>);

}  // namespace voussoir
