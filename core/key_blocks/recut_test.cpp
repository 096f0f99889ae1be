// Blocks cut again by planes that have turned, against the mass sliced by these planes.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <random>

#include "core/key_blocks/recut.hpp"
#include "core/key_blocks/survey.hpp"
#include "core/model/water_surfaces.hpp"
#include "core/scene/scene.hpp"

namespace voussoir::recut_test {
namespace {

struct StatedJoint {
  double dip, dip_direction;  // deg
  std::array<double, 3> point;
};

Assembly<3> sliced(const std::vector<StatedJoint>& joints, const std::string& more = "") {
  std::string list;
  for (std::size_t j = 0; j < joints.size(); ++j)
    list +=
        fmt::format("[[joints]]\nname = \"{}\"\ndip = {}\ndip_direction = {}\npoint = [{}, {}, {}]\n", j + 1,
                    joints[j].dip, joints[j].dip_direction, joints[j].point[0], joints[j].point[1], joints[j].point[2]);
  Model<3> model =
      prepare<3>(
          parse_scene(fmt::format("dimension = 3\ngravity = [0, 0, -10]\ndensity = 2600\n"
                                  "domain = {{ box = {{ min = [-5, -5, -5], max = [5, 5, 5] }} }}\n"
                                  "joint_properties = [{{ name = \"r\", normal_stiffness = 1e9, shear_stiffness = 1e8, "
                                  "friction_deg = 30, cohesion = 2e3 }}]\n"
                                  "stage = [{{ name = \"s\", kind = \"settle\" }}]\n{}{}",
                                  more, list),
                      "recut.toml"))
          .model;
  const WaterValues water = initial_water(model);
  return make_assembly(std::move(model), water, {});
}

std::vector<StatedJoint> random_joints(std::mt19937& random, int count) {
  const auto number = [&](double low, double high) { return low + (high - low) * (random() / 4294967296.0); };
  std::vector<StatedJoint> joints;
  for (int j = 0; j < count; ++j)
    joints.push_back({number(5, 85), number(0, 360), {number(-4, 4), number(-4, 4), number(-4, 4)}});
  return joints;
}

// the body with this centroid and volume, or -1
int find_body(const Model<3>& model, const Block<3>& block) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if ((model.bodies[b].reference - block.centroid).norm() < 1e-9 &&
        std::abs(volume(model.bodies[b]) - block.volume) < 1e-9)
      return static_cast<int>(b);
  return -1;
}

TEST(Recut, GivesTheVerdictsOfTheMassSlicedAnew) {
  int cut = 0, refused = 0, moving = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    std::mt19937 random(seed);
    std::vector<StatedJoint> joints = random_joints(random, 12);
    const Assembly<3> mass = sliced(joints);
    for (StatedJoint& joint : joints) {
      joint.dip += 1 - 2 * (random() / 4294967296.0);
      joint.dip_direction += 1 - 2 * (random() / 4294967296.0);
    }
    const Assembly<3> anew = sliced(joints);
    HalfSpaces<3> planes;
    for (const Joint<3>& joint : anew.model.joints)
      planes.push_back(joint.plane);
    Recutter<3> recutter(mass);
    Block<3> block, expected;
    for (int b = 0; b < static_cast<int>(mass.model.bodies.size()); ++b) {
      if (!recutter.recut(b, planes, block)) {
        ++refused;
        continue;
      }
      ++cut;
      const int same = find_body(anew.model, block);
      ASSERT_GE(same, 0) << "seed " << seed << ", block " << b;
      gather<3>(anew, std::array{same}, {}, expected);
      ASSERT_EQ(block.faces.size(), expected.faces.size());
      EXPECT_NEAR(block.contact_area, expected.contact_area, 1e-9);
      EXPECT_NEAR(block.surface, expected.surface, 1e-9);
      const BoltedVerdict<3> found = judge_bolted<3>(block, Vector<3>::Zero(), mass.model.gravity),
                             truth = judge_bolted<3>(expected, Vector<3>::Zero(), mass.model.gravity);
      ASSERT_EQ(found.verdict.kind, truth.verdict.kind);
      if (!moves(found.verdict.kind)) continue;
      ++moving;
      EXPECT_NEAR(*found.factor, *truth.factor, 1e-9 * (1 + *truth.factor));
      for (int k = 0; k < found.verdict.loaded; ++k)
        EXPECT_EQ(block.faces[found.verdict.faces[k]].joint, expected.faces[truth.verdict.faces[k]].joint);
    }
  }
  EXPECT_GT(cut, 500);
  EXPECT_GT(refused, 50);
  EXPECT_GT(moving, 100);
}

TEST(Recut, RefusesWhatItCannotKnow) {
  std::mt19937 random(1);
  const std::vector<StatedJoint> joints = random_joints(random, 1);
  const auto count = [&](const Assembly<3>& mass, const HalfSpaces<3>& planes) {
    Recutter<3> recutter(mass);
    Block<3> block;
    int cut = 0;
    for (int b = 0; b < static_cast<int>(mass.model.bodies.size()); ++b)
      cut += recutter.recut(b, planes, block);
    return cut;
  };
  const auto planes_of = [](const Assembly<3>& mass) {
    HalfSpaces<3> planes;
    for (const Joint<3>& joint : mass.model.joints)
      planes.push_back(joint.plane);
    return planes;
  };
  const Assembly<3> mass = sliced(joints);
  const HalfSpaces<3> same = planes_of(mass);
  EXPECT_EQ(count(mass, same), static_cast<int>(mass.model.bodies.size())) << "by its own planes every block is itself";
  HalfSpaces<3> away = same;
  away[0].offset += 20;  // out of the mass
  EXPECT_EQ(count(mass, away), 0);
  const Assembly<3> wet = sliced(joints, "water = [{ name = \"lake\", level = 10 }]\n");
  EXPECT_EQ(count(wet, same), 0);
}

}  // namespace
}  // namespace voussoir::recut_test
