// The cost of the joint laws: plain Coulomb in the core, every other law, and a hand-written loop for plain Coulomb
// only. With `--count <way> <calls>` it only executes the calls, for price_of_laws.sh, which counts instructions; there
// are complete steps, too, at rest and with all joints sliding.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <string>

#include "core/joint_laws/barton_bandis.hpp"
#include "core/joint_laws/elastic_coulomb.hpp"
#include "core/step.hpp"
#include "core/step/joint_forces.hpp"
#include "core/testing/models.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

struct Scene {
  Model<3> model;
  Settings settings;
  State<3> state;
};

// a jointed box that has settled for a while under its own weight
Scene settled(const JointProperties& properties) {
  Scene scene;
  scene.model = shapes::model_of<3>(shapes::jointed_box());
  scene.model.properties = {properties};
  scene.state = initial_state(scene.model);
  for (int i = 0; i < 400; ++i)
    step(scene.model, scene.settings, scene.state);
  return scene;
}

JointProperties plain() {
  return {"joint", 1e9, 5e8, 35 * degree, false};
}

std::map<std::string, JointProperties> ways() {
  std::map<std::string, JointProperties> all;
  all["plain"] = plain();
  JointProperties p = plain();
  p.sub_contacts = 2;
  all["sub_contacts_2x2"] = p;
  p = plain();
  p.laws.normal = p.laws.shear = StiffnessLaw::linear;
  p.normal_growth = p.shear_growth = 1e4;
  all["linear_stiffness"] = p;
  p = plain();
  p.laws.normal = p.laws.shear = StiffnessLaw::power;
  p.normal_stiffness = 2e6;
  p.shear_stiffness = 2e6;
  p.normal_exponent = 0.5;
  p.shear_exponent = 0.5;
  all["power_stiffness"] = p;
  p = plain();
  p.laws.friction = FrictionLaw::hardening;
  p.hardening_slip = 1e-6;
  p.hardening_exponent = 0.2;
  all["hardening"] = p;
  p = plain();
  p.laws.friction = FrictionLaw::softening;
  p.softening_drop = 0.3;
  p.softening_slip = 1e-3;
  all["softening"] = p;
  p = plain();
  p.laws.bond = true;
  p.tension = 1e5;
  p.cohesion = 1e6;
  all["bonds"] = p;
  p = plain();
  p.laws.normal = StiffnessLaw::hyperbolic;
  p.maximum_closure = 1e-3;
  all["hyperbolic_closure"] = p;
  p = plain();
  p.laws.dilation = DilationLaw::constant;
  p.dilation = 8 * degree;
  p.dilation_until = 0.05;
  all["dilation"] = p;
  p = plain();
  p.friction = 28 * degree;
  p.laws.friction = FrictionLaw::barton_bandis;
  p.barton_bandis = {.sample_jrc = 8, .sample_jcs = 50e6, .sample_length = 0.1, .block_length = 1};
  scale_to_blocks(p.barton_bandis);
  all["barton_bandis"] = p;
  p.barton_bandis.mobilisation = Mobilisation::table;
  all["mobilised_roughness"] = p;
  return all;
}

// Plain Coulomb only, one point per contact: the same sums as core/step/joint_forces.cpp for this case, with the same
// energy balance.
void by_hand(const Model<3>& model, State<3>& state) {
  state.ledger.energy.elastic = 0;
  const double dt = state.time_step.length;
  for (Contact<3>& c : state.contacts.list) {
    if (!c.touching()) continue;
    const JointProperties& p = model.properties[c.properties];
    const int a = model.parts[c.part_a].body, b = model.parts[c.part_b].body;
    const CachedPose<3>&at_a = state.bodies.poses[a], &at_b = state.bodies.poses[b];
    const Vector<3>& n = c.geometry.normal;
    const Vector<3> apart = between(at_a, at_b), drift = at_b.velocity - at_a.velocity;
    const Vector<3> velocity = drift + at_b.spin.cross(c.geometry.point - apart) - at_a.spin.cross(c.geometry.point);
    JointKinematics<3> k;
    k.normal = n;
    k.overlap = c.geometry.overlap;
    k.area = c.geometry.area;
    k.closing_speed = -velocity.dot(n);
    k.slip.setZero();
    if (!c.history.normal.isZero(0)) {
      const Vector<3> before =
          drift + at_b.spin.cross(c.history.point - apart + dt * drift) - at_a.spin.cross(c.history.point);
      const Vector<3> twice = velocity + before - before.dot(c.history.normal) * c.history.normal;
      k.slip = 0.5 * dt * (twice - twice.dot(n) * n);
      k.turn = 0.5 * n.dot(at_a.spin + at_b.spin) * dt;
      if (k.area < c.history.area) {
        const double left = k.area / c.history.area, stiffness = p.shear_stiffness * c.history.area;
        if (stiffness > 0)
          state.ledger.energy.flows[Source::lost_area] +=
              0.5 * c.history.shear_force.squaredNorm() / stiffness * (1 - left);
        c.history.shear_force *= left;
      }
      c.history.shear_force = carried(c.history.shear_force, c.history.normal, n, k.turn);
    }
    const JointForce<3> answer =
        elastic_coulomb<3>(p, std::tan(state.schedule.friction[c.properties]), 0, k, c.history.shear_force);
    state.ledger.energy.elastic += answer.elastic;
    state.ledger.energy.flows[Source::friction] += answer.friction;
    c.history.plastic_slip += answer.plastic_slip;
    c.history.normal = n;
    c.history.point = c.geometry.point;
    c.history.area = k.area;
    c.force = answer.force;
  }
}

void run(const std::string& way, benchmark::State& bench) {
  const bool hand = way == "by_hand";
  Scene scene = settled(hand ? plain() : ways().at(way));
  for (auto _ : bench)
    hand ? by_hand(scene.model, scene.state)
         : apply_joint_laws(scene.model, scene.settings, scene.state.schedule,
                            joint_step(scene.settings, scene.state.time_step, scene.state.relaxation),
                            scene.state.bodies, scene.state.contacts, scene.state.ledger, scene.state.counters);
  int touching = 0;
  for (const Contact<3>& c : scene.state.contacts.list)
    touching += c.touching();
  bench.counters["contacts"] = touching;
  bench.counters["ns_per_contact"] =
      benchmark::Counter(touching, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

int count(const std::string& way, int calls) {
  const std::string step_of = "step_of_", slide_of = "slide_of_";
  const bool hand = way == "by_hand", slides = way.starts_with(slide_of), whole = slides || way.starts_with(step_of);
  const std::string law = hand     ? "plain"
                          : slides ? way.substr(slide_of.size())
                          : whole  ? way.substr(step_of.size())
                                   : way;
  if (!ways().contains(law)) return 2;
  Scene scene = settled(ways().at(law));
  if (slides) {  // downhill at 80 degrees
    const double weight = scene.model.gravity.norm();
    scene.model.gravity = weight * Vector<3>(std::sin(80 * degree), 0, -std::cos(80 * degree));
    for (int i = 0; i < 100; ++i)
      step(scene.model, scene.settings, scene.state);
  }
  for (int i = 0; i < calls; ++i)
    if (whole)
      step(scene.model, scene.settings, scene.state);
    else if (hand)
      by_hand(scene.model, scene.state);
    else
      apply_joint_laws(scene.model, scene.settings, scene.state.schedule,
                       joint_step(scene.settings, scene.state.time_step, scene.state.relaxation), scene.state.bodies,
                       scene.state.contacts, scene.state.ledger, scene.state.counters);
  return 0;
}

}  // namespace
}  // namespace voussoir

int main(int argument_count, char** arguments) {
  using namespace voussoir;
  if (argument_count == 4 && std::string(arguments[1]) == "--count")
    return count(arguments[2], std::atoi(arguments[3]));
  benchmark::RegisterBenchmark("joint_laws/by_hand", [](benchmark::State& s) { run("by_hand", s); });
  for (const auto& [way, properties] : ways())
    benchmark::RegisterBenchmark(("joint_laws/" + way).c_str(), [way = way](benchmark::State& s) { run(way, s); });
  benchmark::Initialize(&argument_count, arguments);
  benchmark::RunSpecifiedBenchmarks();
}
