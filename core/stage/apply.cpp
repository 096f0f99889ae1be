// Changes of the model by a stage, before it begins.
#include <algorithm>
#include <cassert>

#include "core/model/model.hpp"
#include "core/stage/excavation.hpp"
#include "core/stage/open_side.hpp"
#include "core/stage/support_table.hpp"

namespace voussoir {
namespace {

template <int Dim>
void end_prescribed(Model<Dim>& model) {
  for (const PrescribedMotion<Dim>& p : model.prescribed) {
    Body<Dim>& body = model.bodies[p.body];
    body.prescribed = false;
    body.free_translation = p.free_translation;
    body.free_rotation = p.free_rotation;
  }
  model.prescribed.clear();
}

template <int Dim>
void prescribe(Model<Dim>& model, const MovePlan& plan) {
  for (const int b : select(model, plan.bodies)) {
    Body<Dim>& body = model.bodies[b];
    assert(!body.prescribed);
    PrescribedMotion<Dim> p;
    p.body = b;
    p.factor = plan.factor;
    p.free_translation = body.free_translation;
    p.free_rotation = body.free_rotation;
    for (int k = 0; k < Dim && !plan.velocity.empty(); ++k) {
      p.translation[k] = plan.translation[k];
      p.velocity[k] = plan.velocity[k];
      if (p.translation[k]) body.free_translation[k] = false;
    }
    for (const RecordedMotion& record : plan.records)
      p.records.push_back({Eigen::Map<const Vector<Dim>>(record.direction.data()), record.motion});
    p.rotation = !plan.angular_velocity.empty();
    if (p.rotation) {
      p.angular_velocity = Eigen::Map<const Spin<Dim>>(plan.angular_velocity.data());
      body.free_rotation.fill(false);
    }
    body.prescribed = true;
    model.prescribed.push_back(std::move(p));
  }
}

// those of earlier stages keep their last values
template <int Dim>
void hold_forces(Model<Dim>& model) {
  for (AppliedForce<Dim>& f : model.applied) {
    f.force *= f.last_factor;
    f.last_factor = 1;
    f.factor = {};
  }
}

template <int Dim>
void apply_forces(Model<Dim>& model, const std::vector<ForcePlan>& plans) {
  for (const ForcePlan& plan : plans)
    std::erase_if(model.applied, [&](const AppliedForce<Dim>& f) { return f.name == plan.name; });
  for (const ForcePlan& plan : plans)
    for (const int b : select(model, plan.bodies)) {
      AppliedForce<Dim> force;
      force.name = plan.name;
      force.body = b;
      force.turns_with_body = plan.turns_with_body;
      force.factor = plan.factor;
      force.last_factor = plan.last_factor;
      force.force = Eigen::Map<const Vector<Dim>>(plan.force.data());
      if (!plan.point.empty())
        force.place = Eigen::Map<const Vector<Dim>>(plan.point.data()) - model.origin - model.bodies[b].reference;
      model.applied.push_back(std::move(force));
    }
  std::erase_if(model.applied,
                [&](const AppliedForce<Dim>& f) { return f.force.isZero(0) || !model.bodies[f.body].present; });
  std::ranges::stable_sort(model.applied, {}, &AppliedForce<Dim>::body);
}

template <int Dim>
DepthStress<Dim> depth_stress_of(const BoundaryPlan& plan, double origin) {
  DepthStress<Dim> stress{stress_tensor<Dim>(plan.stress), Matrix<Dim>::Zero(), 0};
  if (!plan.in_situ) return stress;
  const InSituPlan& in_situ = *plan.in_situ;
  stress.surface = in_situ.surface - origin;
  Vector<Dim> ratios = Vector<Dim>::Constant(in_situ.k0);
  if constexpr (Dim == 3) ratios[1] = in_situ.k0_y.value_or(in_situ.k0);
  ratios[Dim - 1] = 1;
  stress.per_depth = (in_situ.unit_weight.value() * ratios).asDiagonal();
  return stress;
}

}  // namespace

template <int Dim>
void load_boundary(Model<Dim>& model, int body, const DepthStress<Dim>& stress) {
  BoundaryForces<Dim> loaded{body, {}, stress};
  DepthStress<Dim> seen = stress;  // in the body's frame
  seen.surface -= model.bodies[body].reference[Dim - 1];
  for (const Polytope<Dim>& part : model.bodies[body].parts)
    for (const DeadLoad<Dim>& load : boundary_loads<Dim>(part, seen))
      loaded.forces.push_back(load);
  std::erase_if(model.boundary, [&](const BoundaryForces<Dim>& b) { return b.body == body; });
  if (loaded.forces.empty()) return;
  const auto after = std::ranges::upper_bound(model.boundary, body, {}, &BoundaryForces<Dim>::body);
  model.boundary.insert(after, std::move(loaded));
}

void set_friction(const Change& change, std::vector<JointProperties>& properties) {
  const auto set = [](JointProperties& p, const FrictionPlan& plan) {
    const bool rough = p.states_barton_bandis();
    p.friction = plan.as_stated ? p.stated_friction : plan.friction;
    if (!rough) return;
    p.laws.set_aside = !plan.as_stated;
    p.laws.friction = plan.as_stated ? FrictionLaw::barton_bandis : FrictionLaw::constant;
  };
  for (JointProperties& p : properties) {
    if (change.friction || change.friction_as_stated)
      set(p, {p.name, change.friction.value_or(0), change.friction_as_stated});
    for (const FrictionPlan& plan : change.friction_of)
      if (plan.properties == p.name) set(p, plan);
  }
}

template <int Dim>
Model<Dim> apply(Model<Dim> model, const Change& change) {
  end_prescribed(model);
  hold_forces(model);
  excavate(model, change.excavate);
  for (const Selector& s : change.fix)
    for (int b : select(model, s))
      model.bodies[b].fixed = true;
  for (const Selector& s : change.release)
    for (int b : select(model, s))
      model.bodies[b].fixed = false;
  for (const Selector& s : change.remove)
    for (int b : select(model, s)) {
      model.bodies[b].present = false;
      model.bodies[b].fixed = true;
    }
  for (const BoundaryPlan& plan : change.boundary) {
    if (plan.lets_waves_leave()) continue;
    for (int b : select(model, plan.bodies))
      load_boundary(model, b, depth_stress_of<Dim>(plan, model.origin[Dim - 1]));
  }
  apply_forces(model, change.force);
  set_friction(change, model.properties);
  for (const StageSupport<Dim>& row : stage_supports<Dim>)
    if (row.add_bodies) row.add_bodies(model, change.install);
  for (const MovePlan& plan : change.move)
    prescribe(model, plan);
  open_sides(model, change.boundary);
  prescribe_columns(model);
  std::sort(model.prescribed.begin(), model.prescribed.end(),
            [](const PrescribedMotion<Dim>& a, const PrescribedMotion<Dim>& b) { return a.body < b.body; });
  return model;
}

template Model<2> apply<2>(Model<2>, const Change&);
template Model<3> apply<3>(Model<3>, const Change&);
template void load_boundary<2>(Model<2>&, int, const DepthStress<2>&);
template void load_boundary<3>(Model<3>&, int, const DepthStress<3>&);

}  // namespace voussoir
