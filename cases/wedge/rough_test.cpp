// The wedge of examples/wedge.toml on joints after Barton and Bandis: limit equilibrium with the same envelope at the
// stress of each face, and with dilation by half of the roughness.
#include <gtest/gtest.h>

#include <cmath>

#include "cases/case_tools.hpp"
#include "cases/judged_scene.hpp"
#include "cases/wedge/wedge_scene.hpp"
#include "reference/small/rough_joint.hpp"
#include "reference/wedge/dilating_wedge.hpp"
#include "reference/wedge/wedge_path.hpp"

namespace voussoir::cases::wedge_rough_test {
namespace {

using verification::CaseReport;
using verification::Kind;

reference::DilatingSolution closed_form(double dilation_share) {
  reference::RoughJoint joint{9, 60e6, 28 * degree};
  joint = reference::of_block(joint, 0.1, 2);
  joint.peak_slip = 0;
  joint.dilation_share = dilation_share;
  reference::DilatingWedge of{wedge(48, 125, 55, 230)};
  const reference::WedgeFaces faces = reference::wedge_faces(of.wedge, 65 * degree, 180 * degree, 6);
  of.area_a = faces.area_a;
  of.area_b = faces.area_b;
  of.wedge.weight = 2600 * 9.81 * faces.volume;
  of.joint.tan_friction = [joint](double stress) { return std::tan(reference::friction_at(joint, 0, stress)); };
  of.joint.dilation = [joint](double stress) { return reference::dilation_at(joint, 0, stress); };
  return reference::solve_dilating_wedge(of);
}

TEST(WedgeRough, StandsByItsEnvelope) {
  CaseReport report("wedge");
  for (const double share : {0.0, 0.5})
    report.record(
        {share == 0 ? "factor of safety, Barton and Bandis without dilation"
                    : "factor of safety, Barton and Bandis, dilation of half the roughness",
         "1",
         Kind::exact,
         "equilibrium of the rigid wedge, each face at its own stress",
         closed_form(share).factor_of_safety,
         {0.002, 0},
         "bracket 0.001; shear across the line before it slides, 0.0001 at ks = kn/10 of 1e9 Pa/m"},
        value(run("rough.toml", {"joint_properties.rock.dilation_share=" + text(share)}), "factor_of_safety"));
  const Survey<3> survey = judged("rough.toml");
  report.record({"factor of safety by block theory, Barton and Bandis",
                 "1",
                 Kind::exact,
                 "equilibrium of the rigid wedge, each face at its own stress",
                 closed_form(0).factor_of_safety,
                 {0, 1e-9},
                 "rounding"},
                only_block(survey).bolted.factor.value());
}

}  // namespace
}  // namespace voussoir::cases::wedge_rough_test
