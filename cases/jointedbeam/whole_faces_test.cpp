// Jointed beam with integrated face contacts, against the chain of distributed joints.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "cases/jointedbeam/beam_run.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::whole_faces_test {
namespace {

// Integrated face contacts are the distributed joint until parts of it slip. At 89 degrees cells of the chain still
// slip at the edge of the pressure, by 5e-4 of the deflection; at 89.99 none does.
TEST(JointedBeam, OnIntegratedFacesIsTheChainOfDistributedJointsThatDoNotSlip) {
  CaseReport report("jointedbeam");
  JointedBeam beam = full_block();
  beam.joint.friction.angle = 89.99 * degree;
  const std::vector<BeamState> chain = raise_gravity(beam, judged, full_closure);
  const std::string no_slip = "joint_properties.rock.friction_deg=89";
  const BeamRun whole = run_beam(beam, "scene.toml", {no_slip, whole_faces}),
                one_point = run_beam(beam, "scene.toml", {no_slip, "joint_properties.rock.sub_contacts=1"});
  ASSERT_EQ(whole.lost, 0) << whole.results.message;
  for (const double gravity : judged) {
    const std::string name = "whole faces, no slip, " + in_g(gravity);
    const std::string because =
        "both integrate the same pressure, 1e-5 by the chain's cells and steps, equilibrium to 1e-6; the shear stress "
        "of the integrated contact is uniform, that of the chain is not if a joint opens";
    record_thrust(report, name, at_gravity(chain, gravity), at_gravity(whole.held, gravity), 5e-5, because,
                  cost(whole));
    record_deflection(report, name, at_gravity(chain, gravity), at_gravity(whole.held, gravity), 5e-4, because);
  }
  const auto evaluations = [](const BeamRun& run) {
    return static_cast<double>(run.results.counters.contact_evaluations);
  };
  report.record({"contact evaluations, whole faces over one point a face",
                 "1",
                 Kind::limit,
                 "demanded: a bound on the cost",
                 0,
                 {2.5, 0, verification::Bound::at_most},
                 "a count: cases/sub_contacts measures the cost of a contact"},
                evaluations(whole) / evaluations(one_point), cost(whole));
  for (const auto& [name, run] : {std::pair("whole faces", &whole), {"one point a face", &one_point}})
    report.report(std::string("steps, no slip, ") + name, "1", static_cast<double>(run->results.counters.steps),
                  "from the closing of the abutments to 40 g", cost(*run));

  // with the scene's 40 degrees the chain's joints slip locally, integrated face contacts do not
  const BeamState slipping = at_gravity(raise_gravity(full_block(), judged, full_closure), 40),
                  found = at_gravity(run_beam(full_block(), "scene.toml", {whole_faces}).held, 40);
  const std::string note =
      "against distributed joints, parts of which slip; an integrated face contact slips everywhere or nowhere";
  report.report("error of thrust, whole faces, 40 degrees, 40 g", "1", found.thrust / slipping.thrust - 1, note);
  report.report("error of deflection, whole faces, 40 degrees, 40 g", "1", found.deflection / slipping.deflection - 1,
                note);
}

}  // namespace
}  // namespace voussoir::cases::whole_faces_test
