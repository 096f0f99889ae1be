// Joints that dilate, lose cohesion or follow Barton and Bandis under whole blocks: between springs, tilted, on an
// incline.
#include <gtest/gtest.h>

#include <cmath>

#include "cases/case_tools.hpp"
#include "core/joint_laws/joint_path.hpp"
#include "core/scene/scene.hpp"
#include "reference/small/rough_joint.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::rough_joints_test {
namespace {

using verification::CaseReport;
using verification::Kind;

constexpr double springs = 1 / (1 / 10e9 + 1 / 2e9);  // Pa/m: of the joint and of its surroundings

std::vector<std::string> rock(const std::vector<std::string>& keys) {
  std::vector<std::string> all;
  for (const std::string& key : keys)
    all.push_back("joint_properties.rock." + key);
  return all;
}

const reference::RoughJoint sample{10, 30e6, 26 * degree};
const std::vector<std::string> rough{"friction_law=barton_bandis", "friction_deg=26", "jrc=10", "jcs=30e6",
                                     "shear_stiffness=8e9"};

// stresses of the block at rest at the end of a stage; its joint has 1 m², its upper face springs of 2 GPa/m
struct AtRest {
  double normal = 0, shear = 0;
};
AtRest at_end(const SceneRun& run, int stage) {
  const double pressed = column(run, "block_displacement_y_m", 2).back();
  const double lifted = column(run, "block_displacement_y_m", stage).back() - pressed;
  return {1e6 + 2e9 * lifted, -column(run, "block_contact_load_x_N", stage).back()};
}

void record_between_springs(CaseReport& report, const std::string& law, const SceneRun& run, int stage,
                            const AtRest& expected, double tolerance) {
  const std::string slip = stage == 4 ? " at 3 mm" : " at 6 mm";
  const char* const because =
      "its springs swing as slip begins, by as much as the speed of 0.5 mm/s gives; four times the speed, 5e-4";
  const AtRest found = at_end(run, stage);
  report.record({"normal stress between springs, " + law + slip,
                 "Pa",
                 Kind::exact,
                 "closed form of the law, integrated along the slip",
                 expected.normal,
                 {0, tolerance},
                 because},
                found.normal);
  report.record({"shear stress between springs, " + law + slip,
                 "Pa",
                 Kind::exact,
                 "closed form of the law, integrated along the slip",
                 expected.shear,
                 {0, tolerance},
                 because},
                found.shear);
}

TEST(RoughJoints, ABlockBetweenSpringsThatDilates) {
  CaseReport report("jointlaws");
  const SceneRun done =
      run("springs.toml", rock({"dilation_law=constant", "dilation_deg=8", "dilation_until_m=0.004"}));
  const double coefficient = std::tan(30 * degree), slope = std::tan(8 * degree), shear_stiffness = 4e9;
  for (const int stage : {4, 6}) {
    const double slip = stage == 4 ? 3e-3 : 6e-3;
    const double plastic =
        (slip - coefficient * 1e6 / shear_stiffness) / (1 + coefficient * springs * slope / shear_stiffness);
    const double normal = 1e6 + springs * slope * std::min(plastic, 4e-3);
    record_between_springs(report, "constant dilation", done, stage, {normal, coefficient * normal}, 2e-4);
  }
}

TEST(RoughJoints, ABlockBetweenSpringsAfterBartonAndBandis) {
  CaseReport report("jointlaws");
  for (const bool mobilises : {false, true}) {
    std::vector<std::string> keys = rough;
    keys.insert(keys.end(), {"block_length_m=0.1", mobilises ? "mobilisation=table" : "mobilisation=none"});
    const SceneRun done = run("springs.toml", rock(keys));
    const reference::RoughJoint joint = mobilises ? reference::of_block(sample, 0.1, 0.1) : sample;
    for (const int stage : {4, 6}) {
      const reference::ShearedJoint expected =
          reference::shear_between_springs(joint, 1e6, springs, 8e9, stage == 4 ? 3e-3 : 6e-3);
      record_between_springs(report, mobilises ? "mobilised roughness" : "peak envelope", done, stage,
                             {expected.normal_stress, expected.shear_stress}, 4e-4);
    }
  }
}

JointProperties properties_of(const std::vector<std::string>& keys) {
  return read_scene(std::filesystem::path(VOUSSOIR_CASE_DIR) / "springs.toml", rock(keys))
      .properties.front()
      .properties;
}

// the law alone between springs, in more and more steps
TEST(RoughJoints, AreOfTheSecondOrderInTheStep) {
  CaseReport report("jointlaws");
  std::vector<std::vector<double>> errors(3), paths(9);
  for (const bool mobilises : {false, true}) {
    std::vector<std::string> keys = rough;
    keys.insert(keys.end(), {"block_length_m=0.1", mobilises ? "mobilisation=table" : "mobilisation=none"});
    const JointProperties p = properties_of(keys);
    const reference::RoughJoint joint = mobilises ? reference::of_block(sample, 0.1, 0.1) : sample;
    JointPath path;
    path.normal_stress = 1e6;
    path.surroundings = 2e9;
    path.slip = 6e-3;
    const auto expected_at = [&](double slip) {
      return reference::shear_between_springs(joint, path.normal_stress, springs, p.shear_stiffness, slip);
    };
    const double expected = expected_at(path.slip).normal_stress;
    std::vector<double> error;
    for (path.steps = 25; path.steps <= 1600; path.steps *= 2) {
      error.push_back(std::abs(follow(p, path).back().normal_stress / expected - 1));
      if (!mobilises) errors[0].push_back(path.steps);
      errors[mobilises ? 2 : 1].push_back(error.back());
    }
    path.steps = 120;
    for (const JointPathPoint& at : follow(p, path)) {
      if (at.slip == 0) continue;
      const reference::ShearedJoint closed = expected_at(at.slip);
      const double row[] = {1e3 * at.slip, 1e-6 * at.shear_stress, 1e-6 * closed.shear_stress, 1e-6 * at.normal_stress,
                            1e-6 * closed.normal_stress};
      for (int k = mobilises ? 1 : 0; k < 5; ++k)
        paths[k + (mobilises ? 4 : 0)].push_back(row[k]);
    }
    report.record(
        {std::string("order of the step, ") + (mobilises ? "mobilised roughness" : "peak envelope"),
         "1",
         Kind::exact,
         "convergence",
         2,
         {mobilises ? 1.0 : 0.2, 0},
         mobilises ? "mean of six halvings; where a kink of the table lies within a step differs from one to the next"
                   : "mean of six halvings"},
        std::log2(error.front() / error.back()) / 6);
  }
  write_csv("jointlaws", "order.csv", {"steps", "envelope", "mobilised"}, errors);
  write_csv("jointlaws", "rough.csv",
            {"slip_mm", "envelope_shear", "envelope_shear_exact", "envelope_normal", "envelope_normal_exact",
             "mobilised_shear", "mobilised_shear_exact", "mobilised_normal", "mobilised_normal_exact"},
            paths);
}

// The slip s along the plate grows with the cube of the time since its begin: the angle of that, from two slips since
// 32 degrees, when the jolt by which the plate slowed down has died away.
double angle_of_slip(const SceneRun& run, double size) {
  const std::vector<double> turned = column(run, "plate_rotation_deg", 3), x = column(run, "block_displacement_x_m", 3),
                            y = column(run, "block_displacement_y_m", 3);
  const double height = 0.055 * size;  // of the block's centre over the plate's, about which both turn
  const auto slip = [&](std::size_t i) {
    const double c = std::cos(turned[i] * degree), s = std::sin(turned[i] * degree);
    return -(x[i] * c + (height + y[i]) * s);
  };
  const auto first =
      static_cast<std::size_t>(std::ranges::find_if(turned, [](double angle) { return angle > 32; }) - turned.begin());
  const auto angle_at = [&](double least) {
    for (std::size_t i = first; i < turned.size(); ++i)
      if (slip(i) - slip(first) > least) return turned[i];
    return 0.0;
  };
  return 2 * angle_at(2e-4) - angle_at(1.6e-3);
}

TEST(RoughJoints, ALargeBlockTiltsSoonerThanASlab) {
  CaseReport report("jointlaws");
  const reference::RoughJoint of_slab{4, 30e6, 26 * degree};
  const std::vector<std::string> large = [] {
    std::vector<std::string> keys{"blocks.plate.box.min=[-2,-1]", "blocks.plate.box.max=[2,0]",
                                  "blocks.block.box.min=[-0.5,0]", "blocks.block.box.max=[0.5,0.1]"};
    for (const std::string& key : rock({"block_length_m=1", "normal_stiffness=1e8", "shear_stiffness=1e8"}))
      keys.push_back(key);
    return keys;
  }();
  for (const bool slab : {true, false}) {
    const double size = slab ? 1 : 10;
    const SceneRun done = run("tilt.toml", slab ? std::vector<std::string>{} : large);
    report.record(
        {slab ? "tilt of a slab of 1 cm" : "tilt of a block of 1 m of the same joint",
         "deg",
         Kind::exact,
         "closed form: equilibrium at the friction angle of its own stress",
         reference::tilt_angle(reference::of_block(of_slab, 0.1, 0.1 * size), 2600 * 9.81 * 0.01 * size) / degree,
         {0.1, 0},
         "turned by half a degree a second, found from two slips; the pressure varies along the face by a fifth, "
         "which a concave envelope counts as 0.02 degrees"},
        angle_of_slip(done, size));
  }
}

// The displacement that fails a trial covers the slip at the peak, 3.7 mm; a tenth of the radius is 1 mm.
TEST(RoughJoints, ASearchLetsASlipMobiliseTheRoughness) {
  CaseReport report("jointlaws");
  const reference::RoughJoint joint = reference::of_block(sample, 0.1, 1);
  const double stress = 2600 * 9.81 * 0.02 * std::cos(35 * degree);
  const double expected = std::tan(reference::friction_at(joint, joint.peak_slip, stress)) / std::tan(35 * degree);
  report.reference("factor_of_safety", expected, "1");
  const SceneRun done = run("mobilised.toml");
  report.record({"factor of safety of a slab that mobilises its roughness",
                 "1",
                 Kind::exact,
                 "equilibrium at the peak of Barton's strength",
                 expected,
                 {0.002, 0},
                 "bracket 0.0005"},
                value(done, "factor_of_safety"));
}

// L12: a cube of 2 m on 40 degrees, friction 30, cohesion of 15 kPa of which slip leaves 5 kPa
TEST(RoughJoints, CohesionThatSlipLeaves) {
  CaseReport report("jointlaws");
  const double weight = 2600 * 8 * 9.81, area = 4, along = weight * std::sin(40 * degree),
               across = weight * std::cos(40 * degree);
  for (const double cohesion : {15e3, 5e3})
    report.record({"factor of safety with cohesion of " + text(cohesion / 1000) + " kPa",
                   "1",
                   Kind::exact,
                   "Coulomb (1785), cohesion and friction",
                   (cohesion * area + across * std::tan(30 * degree)) / along,
                   {1e-3, 0},
                   "bracket of 0.0005"},
                  value(run("cohesion.toml", rock({"cohesion=" + text(cohesion)})), "factor_of_safety"));
  // with less than 10.23 kPa it slips at once, and what is left lets it go
  const SceneRun done = run("dilation.toml", [] {
    std::vector<std::string> keys = rock({"dilation_deg=0", "cohesion=10e3", "cohesion_law=softening",
                                          "residual_cohesion=5e3", "cohesion_slip_m=0", "bonds=by_stage"});
    keys.push_back("stage.settle.bond=true");
    return keys;
  }());
  const std::vector<double> moved = column(done, "block_displacement_x_m", 2);
  const double acceleration = (along - across * std::tan(30 * degree) - 5e3 * area) / (2600 * 8), seconds = 0.5;
  report.record({"slide after the loss of cohesion",
                 "m",
                 Kind::exact,
                 "Newton's second law for a rigid block with what is left",
                 0.5 * acceleration * seconds * seconds,
                 {0, 1e-4},
                 "springs of 1e11 Pa/m, which swing by 1e-6 m as the cohesion is lost"},
                moved.back() - moved.front());
}

}  // namespace
}  // namespace voussoir::cases::rough_joints_test
