// The medium that joints make of rigid blocks, against closed forms.
#include "core/stage/medium.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/slicing/slice.hpp"
#include "core/testing/shapes.hpp"
#include "core/testing/whole_runs.hpp"

namespace voussoir::medium_test {
namespace {

constexpr double kn = 1e10, ks = 4e9, density = 2500;

const std::string head = R"(density = 2500
gravity = [0, 0]
[[joint_properties]]
name = "rock"
normal_stiffness = 1e10
shear_stiffness = 4e9
friction_deg = 40
[[stage]]
name = "run"
kind = "run"
duration_s = 1
)";

template <int Dim>
Vector<Dim> modulus_at(const std::string& scene, const std::string& side) {
  const Model<Dim> model = scene_of<Dim>(scene).model;
  return wave_stiffness(model, faces_of_side(model, side).front()).modulus;
}

const std::string layers =
    "dimension = 2\ndomain = { box = { min = [0, 0], max = [4, 6] } }\n" + head +
    "[[joints]]\nname = \"bed\"\ndip = 0\npoint = [0, 0.5]\n[[repeat]]\nname = \"beds\"\njoints = "
    "[\"bed\"]\ncount = 11\nshift = [0, 0.5]\n";
const std::string grid = layers +
                         "[[joints]]\nname = \"cross\"\ndip = 90\ndip_direction = 90\npoint = [0.5, 0]\n[[repeat]]\nname = "
                         "\"crosses\"\njoints = [\"cross\"]\ncount = 7\nshift = [0.5, 0]\n";

TEST(Medium, LayersShearAlongOneFamily) {
  const Vector<2> found = modulus_at<2>(layers, "bottom");
  EXPECT_NEAR(found[1], kn * 0.5, 1e-9 * kn);
  EXPECT_NEAR(found[0], ks * 0.5, 1e-9 * ks);
}

TEST(Medium, SquareGridShearsAlongBoth) {
  for (const char* side : {"bottom", "top"}) {
    const Vector<2> found = modulus_at<2>(grid, side);
    EXPECT_NEAR(found[1], kn * 0.5, 1e-9 * kn);
    EXPECT_NEAR(found[0], ks * 0.5 / 2, 1e-9 * ks);
  }
  const Vector<2> found = modulus_at<2>(grid, "left");
  EXPECT_NEAR(found[0], kn * 0.5, 1e-9 * kn);
  EXPECT_NEAR(found[1], ks * 0.5 / 2, 1e-9 * ks);
}

// along a diagonal of the grid: C11/2 + G and C11/2
TEST(Medium, ObliqueFamiliesAreTurned) {
  const std::string turned =
      "dimension = 2\ndomain = { box = { min = [0, 0], max = [8, 8] } }\n" + head +
      "[[joints]]\nname = \"a\"\ndip = 45\ndip_direction = 90\npoint = [0.3, 0]\n[[joints]]\nname = "
      "\"b\"\ndip = 45\ndip_direction = 270\npoint = [0.1, 0]\n";
  Model<2> model = scene_of<2>(turned).model;
  // a square on its corner, whose faces the joints made; the side is one that the test gives it
  const double a = 1;
  HalfSpaces<2> planes;
  for (const double x : {1.0, -1.0})
    for (const double y : {1.0, -1.0})
      planes.push_back({Vector<2>(x, y) / std::sqrt(2.0), 0.5 * a});
  Body<2> body = make_body<2>({shapes::block<2>(planes)}, density);
  for (std::size_t f = 0; f < 4; ++f)
    body.parts[0].joints[f] = 0;
  body.parts[0].faces.push_back({Vector<2>(1, 0), a});  // touches nothing
  body.parts[0].joints.push_back(no_joint);
  body.parts[0].loops.emplace_back();
  model.bodies = {body};
  list_parts(model);
  const WaveStiffness<2> found = wave_stiffness(model, {0, 0, 4});
  EXPECT_NEAR(found.modulus[0], kn * a / 2 + ks * a / 2, 1e-9 * kn);
  EXPECT_NEAR(found.modulus[1], kn * a / 2, 1e-9 * kn);
}

TEST(Medium, CubesInSpace) {
  const std::string cubes =
      "dimension = 3\ndomain = { box = { min = [0, 0, 0], max = [2, 2, 2] } }\n" + head.substr(0, 15) +
      head.substr(head.find("[[joint_properties]]")) +
      "[[joints]]\nname = \"x\"\ndip = 90\ndip_direction = 90\npoint = [1, 0, 0]\n[[joints]]\nname = \"y\"\ndip = "
      "90\ndip_direction = 0\npoint = [0, 1, 0]\n[[joints]]\nname = \"z\"\ndip = 0\ndip_direction = 0\npoint = [0, 0, "
      "1]\n";
  const Vector<3> found = modulus_at<3>(cubes, "west");
  EXPECT_NEAR(found[0], kn, 1e-9 * kn);
  EXPECT_NEAR(found[1], ks / 2, 1e-9 * ks);
  EXPECT_NEAR(found[2], ks / 2, 1e-9 * ks);
}

TEST(Medium, WavesThatMeetNoJointAreRefusedByName) {
  const Model<2> model = scene_of<2>(layers).model;
  try {
    wave_stiffness(model, faces_of_side(model, "left").front());
    ADD_FAILURE() << "found";
  } catch (const ClosedSide& closed) {
    EXPECT_EQ(closed.key, "normal_impedance");
    EXPECT_NE(std::string(closed.what()).find("no joint"), std::string::npos) << closed.what();
  }
}

TEST(Medium, PlatesHaveHalfAJointAndTheImpedance) {
  const Model<2> model = scene_of<2>(grid).model;
  const std::vector<SideFace> faces = faces_of_side(model, "bottom");
  ASSERT_EQ(faces.size(), 8u);
  const SideMedium<2> found = medium_of(model, "bottom", faces, {});
  EXPECT_TRUE(found.medium.regular);
  EXPECT_NEAR(found.medium.normal_speed, std::sqrt(kn * 0.5 / density), 1e-6);
  EXPECT_NEAR(found.medium.shear_speed, std::sqrt(ks * 0.5 / 2 / density), 1e-6);
  for (const QuietPlate<2>& plate : found.plates) {
    EXPECT_NEAR(plate.stiffness[0], 2 * ks * 0.5, 1e-9 * ks);
    EXPECT_NEAR(plate.stiffness[1], 2 * kn * 0.5, 1e-9 * kn);
    EXPECT_NEAR(plate.impedance[1], 0.5 * density * found.medium.normal_speed, 1);
    EXPECT_NEAR(plate.impedance[0], 0.5 * density * found.medium.shear_speed, 1);
  }
  MediumPlan stated;
  stated.normal_impedance = 7e6;
  stated.shear_impedance = 3e6;
  EXPECT_NEAR(medium_of(model, "bottom", faces, stated).plates[0].impedance[1], 3.5e6, 1e-3);
}

}  // namespace
}  // namespace voussoir::medium_test
