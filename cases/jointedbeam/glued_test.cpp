// A block glued to a wall: how far its joint lets it sink and turn, and the tensile strength that it needs.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cases/case_tools.hpp"
#include "reference/small/glued_block.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::glued_test {
namespace {

using verification::CaseReport;
using verification::Kind;

const reference::GluedBlock block;  // as glued.toml states it
constexpr int parts = 32;           // sub-contacts along the face, as there
constexpr double bracket = 200;     // Pa
const std::string quantity = "block glued to a wall: ";

TEST(GluedBlock, SinksAndTurnsOnItsJoint) {
  CaseReport report("jointedbeam", {quantity + "rotation", quantity + "drop of the centre"});
  const SceneRun run = cases::run("glued.toml");
  ASSERT_EQ(run.results.stages.size(), 2u);
  const std::string because =
      "32 parts of the face have 1 - 1/32^2 of its bending stiffness; the free end's lever arm shortens by rotation^2; "
      "what is left of the motion is below 1e-4";
  const std::string source = "equilibrium on a linear joint: M/(kn h3/12), reference/small";
  const double part = 1.0 / (parts * parts);
  report.record({quantity + "rotation", "rad", Kind::exact, source, glued_rotation(block), {0, 2 * part}, because},
                -column(run, "beam_rotation_deg").back() * degree, cost(run));
  report.record({quantity + "drop of the centre", "m", Kind::exact, source, glued_drop(block), {0, 2 * part}, because},
                -column(run, "beam_displacement_y_m").back(), cost(run));
}

TEST(GluedBlock, NeedsTheTensileStrengthOfItsEdge) {
  CaseReport report("jointedbeam", {quantity + "least tensile strength"});
  double falls = 50e3, stays = 300e3;
  while (stays - falls > bracket) {
    const double middle = 0.5 * (falls + stays);
    const SceneRun run =
        cases::run("glued.toml", {"stage.bend.kind=run", "stage.bend.duration_s=3", "stage.bend.damping.local=0.5",
                                  fmt::format("joint_properties.glue.tension={:.17g}", middle)});
    (column(run, "beam_displacement_y_m").back() < -0.1 ? falls : stays) = middle;
  }
  const double found = 0.5 * (falls + stays);
  // the joint's bending against the inertia about its middle
  const double mass = block.density * block.length * block.height;
  const double inertia = mass * (block.length * block.length / 3 + block.height * block.height / 12);
  const double bending = block.normal_stiffness * std::pow(block.height, 3) / 12;
  const double swing = std::sqrt(inertia / bending);  // over the second in which gravity grows
  report.record(
      {quantity + "least tensile strength",
       "Pa",
       Kind::exact,
       "stress at the edge of a linear joint: 6 M/h2, reference/small",
       glued_edge_tension(block),
       {bracket, 1.0 / parts + 2 * swing},
       "the outermost of 32 parts breaks at a stress between that of its middle, 1/32 below the edge's, and that "
       "of its end; gravity's growth within 1 s begins and ends with a swing of 1/(omega 1 s) = 0.7 %"},
      found);
}

}  // namespace
}  // namespace voussoir::cases::glued_test
