// Sliced scenes: clusters, closed faces, eccentricity, against numbers computed from the table of planes by another
// program, and closed forms. Verdicts, rounds and pairs of masses: cases/key_blocks.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>

#include "core/key_blocks/block_forces.hpp"
#include "core/key_blocks/elastic_shear.hpp"
#include "core/key_blocks/pressure_eccentricity.hpp"
#include "core/key_blocks/survey.hpp"
#include "core/model/water_surfaces.hpp"
#include "core/scene/scene.hpp"
#include "text/angle.hpp"

namespace voussoir::masses_test {
namespace {

const std::filesystem::path root = VOUSSOIR_SOURCE_DIR;

template <int Dim>
Assembly<Dim> assembly_of(Model<Dim> model) {
  const std::vector<bool> bolts(model.bolts.size(), true);
  const WaterValues water = initial_water(model);
  return make_assembly(std::move(model), water, bolts);
}

Assembly<3> read_assembly(const std::string& file, const std::vector<std::string>& overrides = {}) {
  return assembly_of(prepare<3>(read_scene(root / file, overrides)).model);
}

// the tutorial's wedge is two blocks: together they have a lower factor than either
TEST(KeyBlocks, TheTutorialsWedgeIsTwoBlocks) {
  Model<3> model = prepare<3>(read_scene(root / "examples/tutorial/slope.toml")).model;
  for (JointProperties& joint : model.properties)
    joint.friction = (joint.name == "clay" ? 29 : 41) * degree;
  const Assembly<3> assembly = assembly_of(std::move(model));
  const std::vector<BoltedVerdict<3>> verdicts = judge_all<3>(assembly, {});
  ASSERT_EQ(verdicts[5].verdict.kind, BlockKind::slides);
  EXPECT_NEAR(*verdicts[5].factor, 1.079370836392, 1e-11);
  EXPECT_NEAR(*verdicts[2].factor, 23.147344855198, 1e-8);  // a slot: forces of nine times its weight
  const ClusterSearch<3> clusters = find_clusters<3>(assembly, verdicts, {});
  ASSERT_EQ(clusters.lower.size(), 1u);
  EXPECT_EQ(clusters.lower[0].bodies, (std::vector<int>{2, 5}));
  EXPECT_NEAR(*clusters.lower[0].verdict.factor, 1.069448089900, 1e-11);
  Block<3> pair;
  gather<3>(assembly, clusters.lower[0].bodies, {}, pair);
  EXPECT_NEAR(pair.volume, 29.524137164, 1e-8);
  EXPECT_NEAR(pair.weight, 767524.232, 1e-2);
  const Verdict<3>& verdict = clusters.lower[0].verdict.verdict;
  const bool first = assembly.model.joints[pair.faces[verdict.faces[0]].joint].name == "A1";
  EXPECT_NEAR(verdict.forces[first ? 0 : 1], 437688.447, 2e-3);
  EXPECT_NEAR(verdict.forces[first ? 1 : 0], 301735.136, 2e-3);
  EXPECT_NEAR(verdict.driving(), 472121.110, 2e-3);
  EXPECT_NEAR(pair.faces[verdict.faces[first ? 0 : 1]].area, 19.905413, 1e-6);
  const RequiredForce<3> force = *least_force(pair, clusters.lower[0].verdict, 1.3, assembly.model.gravity);
  EXPECT_NEAR(force.force.norm(), 68401.198, 1e-2);
  EXPECT_NEAR(least_force(pair, clusters.lower[0].verdict, 1.5, assembly.model.gravity)->force.norm(), 115594.568,
              1e-2);
  EXPECT_NEAR(*pressure_eccentricity(assembly, pair, clusters.lower[0].verdict), 0.16, 0.005);
  gather<3>(assembly, std::array{2}, {}, pair);
  EXPECT_NEAR(opening_angle(pair, verdicts[2].verdict).angle / degree, 20.2, 0.05);
}

TEST(KeyBlocks, MovingBlocksOfABench) {
  const Assembly<3> assembly = read_assembly("cases/slicing/bench.toml");
  const std::vector<BoltedVerdict<3>> verdicts = judge_all<3>(assembly, {});
  // faces of moving blocks that the elastic shear closes, at the scene's own stiffnesses; blocks that must turn
  int closed = 0, turning = 0;
  for (int b = 0; b < static_cast<int>(verdicts.size()); ++b) {
    if (!moves(verdicts[b].verdict.kind)) continue;
    Block<3> block;
    gather<3>(assembly, std::array{b}, {}, block);
    closed += !closed_by_elastic_shear(assembly, block, verdicts[b]).empty();
    turning += pressure_eccentricity(assembly, block, verdicts[b]).value_or(0) > 1;
    if (b == 1274) {
      EXPECT_NEAR(*verdicts[b].factor, 0.2353, 5e-5);
      EXPECT_NEAR(least_force(block, verdicts[b], 1.5, assembly.model.gravity)->force.norm(), 1856, 1);
      EXPECT_NEAR(*pressure_eccentricity(assembly, block, verdicts[b]), 0.80, 0.005);
    }
    if (b == 1278) EXPECT_NEAR(*pressure_eccentricity(assembly, block, verdicts[b]), 1.19, 0.005);
  }
  EXPECT_EQ(closed, 28);
  EXPECT_EQ(turning, 5);
}

// a pair that is lower than both its blocks grows by a third
TEST(KeyBlocks, AClusterOfThree) {
  const Assembly<3> mass =
      read_assembly("cases/key_blocks/scatter.toml",
                    {"joint_sets.bedding.seed=146", "joint_sets.steep.seed=246", "joint_sets.cross.seed=346"});
  const std::vector<BoltedVerdict<3>> verdicts = judge_all<3>(mass, {});
  const ClusterSearch<3> pairs = find_clusters<3>(mass, verdicts, {}, 2);
  ASSERT_FALSE(pairs.lower.empty());
  EXPECT_EQ(pairs.lower[0].bodies, (std::vector<int>{214, 226}));
  EXPECT_NEAR(*pairs.lower[0].verdict.factor, 2.372371, 1e-6);
  const ClusterSearch<3> clusters = find_clusters<3>(mass, verdicts, {});
  EXPECT_EQ(clusters.lower[0].bodies, (std::vector<int>{213, 214, 226}));
  EXPECT_NEAR(*clusters.lower[0].verdict.factor, 1.265298, 1e-6);
}

// a box of height h and length b on a plane that dips: κ = (h/b) tan β, friction whatever
template <int Dim>
double tilted_box(double dip, double length, double height) {
  const std::string joint = Dim == 3 ? "dip_direction = 90, point = [0, 0, 0]" : "dip_direction = 90, point = [0, 0]";
  Model<Dim> model =
      prepare<Dim>(
          parse_scene(fmt::format("dimension = {}\ngravity = {}\ndensity = 2500\n"
                                  "blocks = [{{ name = \"base\", box = {{ min = {}, max = {} }}, fixed = true }},\n"
                                  "          {{ name = \"box\", box = {{ min = {}, max = {} }} }}]\n"
                                  "joint_properties = [{{ name = \"r\", normal_stiffness = 1e9, shear_stiffness = 1e8, "
                                  "friction_deg = 35 }}]\n"
                                  "stage = [{{ name = \"s\", kind = \"settle\" }}]\n",
                                  Dim, Dim == 3 ? "[0, 0, -10]" : "[0, -10]", Dim == 3 ? "[-5, -5, -1]" : "[-5, -1]",
                                  Dim == 3 ? "[5, 5, 0]" : "[5, 0]", Dim == 3 ? "[0, 0, 0]" : "[0, 0]",
                                  Dim == 3 ? fmt::format("[{}, 1, {}]", length, height)
                                           : fmt::format("[{}, {}]", length, height)),
                      "box.toml"))
          .model;
  // gravity turns instead of the plane
  model.gravity.setZero();
  model.gravity[0] = 10 * std::sin(dip * degree);
  model.gravity[Dim - 1] = -10 * std::cos(dip * degree);
  const Assembly<Dim> assembly = assembly_of(std::move(model));
  const std::vector<BoltedVerdict<Dim>> verdicts = judge_all<Dim>(assembly, {});
  const int box = assembly.model.bodies[0].fixed ? 1 : 0;
  EXPECT_NEAR(*verdicts[box].factor, std::tan(35 * degree) / std::tan(dip * degree), 1e-12);
  Block<Dim> block;
  gather<Dim>(assembly, std::array{box}, {}, block);
  return *pressure_eccentricity(assembly, block, verdicts[box]);
}

TEST(KeyBlocks, EccentricityOfABoxOnAnIncline) {
  EXPECT_NEAR(tilted_box<3>(15, 1, 3), 0.8038475773, 1e-9);
  EXPECT_NEAR(tilted_box<3>(30, 0.8, 1.5), 1.0825317547, 1e-9);
  EXPECT_NEAR(tilted_box<2>(15, 1, 3), 0.8038475773, 1e-9);
  EXPECT_NEAR(tilted_box<2>(30, 0.8, 1.5), 1.0825317547, 1e-9);
}

// a brick wall in the plane without end: contacts of halves, verdicts of a section
TEST(KeyBlocks, ContactsInThePlane) {
  const Model<2> model =
      prepare<2>(parse_scene("dimension = 2\ngravity = [0, -10]\ndensity = 2000\n"
                             "blocks = [{ name = \"left\", box = { min = [0, 0], max = [2, 1] }, fixed = true },\n"
                             "          { name = \"right\", box = { min = [2, 0], max = [5, 1] }, fixed = true },\n"
                             "          { name = \"top\", box = { min = [1, 1], max = [3.5, 2] } }]\n"
                             "joint_properties = [{ name = \"r\", normal_stiffness = 1e9, shear_stiffness = 1e8, "
                             "friction_deg = 35, cohesion = 1e4, tension = 0 }]\n"
                             "stage = [{ name = \"s\", kind = \"settle\" }]\n",
                             "wall.toml"))
          .model;
  const Assembly<2> assembly = assembly_of(model);
  ASSERT_EQ(assembly.contacts.list.size(), 2u);  // two fixed bodies touch as well, which matters to none
  EXPECT_NEAR(assembly.contacts.list[0].area + assembly.contacts.list[1].area, 2.5, 1e-12);
  int top = 0;
  while (model.bodies[top].name != "top")
    ++top;
  Block<2> block;
  gather<2>(assembly, std::array{top}, {}, block);
  ASSERT_EQ(block.faces.size(), 1u);
  EXPECT_NEAR(block.faces[0].cohesion, 2.5e4, 1e-8);
  EXPECT_NEAR(block.surface, 7, 1e-12);
  const std::vector<BoltedVerdict<2>> verdicts = judge_all<2>(assembly, {});
  EXPECT_EQ(verdicts[top].verdict.kind, BlockKind::stable);
}

}  // namespace
}  // namespace voussoir::masses_test
