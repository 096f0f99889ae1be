// Shared by the tests of the jointed beam: the scenes as input of the chain of reference/jointedbeam, runs in the
// quantities of the chain, and checks against it.
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "cases/case_tools.hpp"
#include "cases/recorded_run.hpp"
#include "reference/jointedbeam/jointedbeam.hpp"

namespace voussoir::cases {

using reference::BeamBlock;
using reference::BeamJoint;
using reference::BeamState;
using reference::CellClosure;
using reference::JointedBeam;
using reference::Point;
using verification::CaseReport;
using verification::Kind;

inline const std::string chain_source = "chain of rigid blocks, reference/jointedbeam";
inline const std::vector<double> judged{10, 20, 30, 40};  // g

// as scene.toml and half.toml state them
inline JointedBeam full_block() {
  return {};
}
inline JointedBeam half_block() {
  JointedBeam beam;
  beam.height = beam.abutment_height = 0.023;
  return beam;
}
// m, both abutments together, as the scenes move them in
inline constexpr double full_closure = 2 * 1.98494e-3 * 0.005, half_closure = 2 * 3.97018e-3 * 0.005;

inline JointedBeam with_cells(JointedBeam beam, int cells, CellClosure closure = CellClosure::mean) {
  beam.joint.cells = cells;
  beam.joint.closure = closure;
  return beam;
}

// ---- the run in the quantities of the chain
// ----------------------------------------------------------------------------

// of one joint: forces per metre of width are summed, the resultant acts at their pressure's centre
inline BeamJoint joint_of(const Model<2>& model, const State<2>& state, std::size_t place, double width) {
  const Contact<2>& c = state.contacts.list[place];
  const int a = model.parts[c.part_a].body;
  const Vector<2>& n = c.geometry.normal;
  Vector<2> at = c.geometry.point;
  if (c.cells > 0) {
    at.setZero();
    double pressure = 0;
    for (const SubContact<2>& s : subs_of(state.contacts, place)) {
      at += s.force.dot(n) * s.point;
      pressure += s.force.dot(n);
    }
    at /= pressure;
  }
  at += model.origin + model.bodies[a].reference + state.bodies.motions[a].displacement;
  BeamJoint joint;
  joint.point = {at[0], at[1]};
  joint.force = {c.force[0] * width, c.force[1] * width};
  joint.normal = c.force.dot(n) * width;
  joint.shear = c.force.dot(perpendicular(n)) * width;
  return joint;
}

// m, downwards, of the block's right (1) or left (-1) face at mid-height
inline double sunk(const BeamBlock& block, double length, int side) {
  return -block.displacement.y - 0.5 * length * side * std::sin(block.rotation);
}

inline BeamState describe(const JointedBeam& beam, const Model<2>& model, const State<2>& state) {
  BeamState s;
  s.gravity = state.schedule.gravity_factor;
  for (std::size_t b = 1; b + 1 < model.bodies.size(); ++b) {
    const Motion<2>& m = state.bodies.motions[b];
    s.blocks.push_back({{m.displacement[0], m.displacement[1]}, m.rotation.angle});
  }
  for (std::size_t i = 0; i < state.contacts.list.size(); ++i)
    if (state.contacts.list[i].touching()) s.joints.push_back(joint_of(model, state, i, beam.width));
  if (!s.joints.empty()) s.thrust = s.joints.front().force.x;
  s.deflection = 0.5 * (sunk(s.blocks[2], beam.length, 1) + sunk(s.blocks[3], beam.length, -1));
  return s;
}

struct BeamRun {
  std::vector<BeamState> held;  // at the ends of the stages that reached equilibrium
  double lost = 0;              // g: the stage that did not; 0: all did
  Results results;
};

inline BeamRun run_beam(const JointedBeam& beam, const std::string& scene,
                        const std::vector<std::string>& overrides = {}) {
  const RecordedRun<2> recorded = record<2>(scene, overrides, Demand::no_failure);
  std::vector<BeamState> states;
  for (const State<2>& state : recorded.frames)
    states.push_back(describe(beam, recorded.model(), state));
  BeamRun run{{}, 0, recorded.run.results};
  for (std::size_t i = 0; i < run.results.stages.size(); ++i) {
    if (run.results.stages[i].kind != "settle") continue;
    if (run.results.stages[i].ended == "equilibrium")
      run.held.push_back(states.at(i));
    else
      run.lost = states.at(i).gravity;
  }
  return run;
}

inline const BeamState& at_gravity(const std::vector<BeamState>& states, double gravity) {
  for (const BeamState& s : states)
    if (std::abs(s.gravity - gravity) < 1e-9) return s;
  throw std::out_of_range("no equilibrium at " + std::to_string(gravity) + " g");
}

inline verification::Cost cost(const BeamRun& run) {
  return {run.results.counters.contact_evaluations, run.results.seconds};
}

// ---- checks

inline void record_thrust(CaseReport& report, const std::string& name, const BeamState& expected,
                          const BeamState& found, double tolerance, const std::string& because,
                          verification::Cost cost = {}) {
  report.record({"thrust, " + name, "N", Kind::exact, chain_source, expected.thrust, {0, tolerance}, because},
                found.thrust, cost);
}
inline void record_deflection(CaseReport& report, const std::string& name, const BeamState& expected,
                              const BeamState& found, double tolerance, const std::string& because,
                              verification::Cost cost = {}) {
  report.record(
      {"mid-span deflection, " + name, "m", Kind::exact, chain_source, expected.deflection, {0, tolerance}, because},
      found.deflection, cost);
}

inline std::string in_g(double gravity) {
  return std::to_string(static_cast<int>(gravity)) + " g";
}

}  // namespace voussoir::cases
