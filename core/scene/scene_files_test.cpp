// Joint sets, tables of joints and files of blocks as scenes use them.
#include "core/scene/scene_files.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "core/exchange/tables.hpp"
#include "core/scene/bodies.hpp"
#include "core/scene/draw_joint_sets.hpp"
#include "core/scene/scene.hpp"

namespace voussoir::scene_files_test {
namespace {

namespace fs = std::filesystem;

const std::string base_3d = R"(dimension = 3
density = 2600
domain = { box = { min = [0, 0, 0], max = [10, 10, 10] } }
joint_properties = [{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 30 }]
fix = [{ inside = [0.01, 0.01, 0.01] }]
stage = [{ name = "settle", kind = "settle" }]
)";

const std::string three_sets = R"([[joint_sets]]
name = "bedding"
dip = 10
dip_direction = 120
spacing = 2.5
scatter = "fisher"
fisher_constant = 200
[[joint_sets]]
name = "cross"
dip = 80
dip_direction = 110
intensity = 0.3
[[joint_sets]]
name = "equal"
dip = 85
dip_direction = 10
spacing = 3
arrangement = "equal"
)";

class SceneFiles : public ::testing::Test {
 protected:
  SceneFiles() { fs::create_directories(folder_); }
  ~SceneFiles() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  Scene parse(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    return parse_scene(text, (folder_ / "scene.toml").string(), overrides);
  }
  void expect_refused(const std::string& text, const std::string& part,
                      const std::vector<std::string>& overrides = {}) const {
    SCOPED_TRACE(part);
    try {
      const Scene scene = parse(text, overrides);
      scene.dimension == 3 ? void(prepare<3>(scene)) : void(prepare<2>(scene));
      ADD_FAILURE() << "accepted";
    } catch (const SceneError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }

  void return_from_table(const std::string& text) const;

  const fs::path folder_ = fs::temp_directory_path() / fmt::format("voussoir_scene_files_{}", ::getpid());
};

template <int Dim>
void expect_equal(const Model<Dim>& a, const Model<Dim>& b) {
  ASSERT_EQ(a.bodies.size(), b.bodies.size());
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    EXPECT_EQ(a.bodies[i].mass, b.bodies[i].mass);
    EXPECT_EQ(a.bodies[i].reference, b.bodies[i].reference);
  }
}

TEST_F(SceneFiles, PersistentSetsCutTheDomain) {
  const Model<3> model = prepare<3>(parse(base_3d + three_sets)).model;
  EXPECT_GT(model.bodies.size(), 20u);
  double mass = 0;
  for (const Body<3>& body : model.bodies)
    mass += body.mass;
  EXPECT_NEAR(mass, 2600 * 1000, 2600 * 1000 * 1e-12);
  EXPECT_EQ(model.joints.front().name, "bedding-1");
  // one more set, or another order, changes no joint of the others; another seed changes all joints of its set
  const auto joints_of = [&](const std::string& text, const std::string& set,
                             const std::vector<std::string>& more = {}) {
    std::vector<double> offsets;
    for (const Joint<3>& joint : prepare<3>(parse(text, more)).model.joints)
      if (joint.name.starts_with(set)) offsets.push_back(joint.plane.offset);
    return offsets;
  };
  const std::string alone = base_3d + three_sets.substr(three_sets.find("[[joint_sets]]", 10));
  EXPECT_EQ(joints_of(alone, "cross"), joints_of(base_3d + three_sets, "cross"));
  EXPECT_NE(joints_of(alone, "cross", {"joint_sets.cross.seed=1"}), joints_of(alone, "cross"));
}

void SceneFiles::return_from_table(const std::string& text) const {
  const Scene scene = parse(text);
  const Prepared<3> drawn = prepare<3>(scene);
  std::vector<JointRow> rows;
  const Polytope<3> domain = make_domain<3>(scene, drawn.model.origin);
  for (const DrawnSet<3>& set : draw_joint_sets<3>(scene, domain, drawn.model.origin))
    for (std::size_t j = 0; j < set.joints.size(); ++j) {
      JointRow row;
      row.name = set.name_of(j);
      row.normal = {set.joints[j].normal[0], set.joints[j].normal[1], set.joints[j].normal[2]};
      row.point = {set.joints[j].point[0], set.joints[j].point[1], set.joints[j].point[2]};
      row.properties = "rock";
      row.set = set.spec->set.name;
      row.shape = set.joints[j].outline.shape;
      if (row.shape != OutlineForm::none)
        for (const double half : set.joints[j].outline.half_sizes)
          row.extents.push_back(2 * half);
      rows.push_back(row);
    }
  write("joints.csv", joint_table(rows, 3));
  const Prepared<3> read = prepare<3>(parse("joints_file = \"joints.csv\"\n" + base_3d));
  ASSERT_EQ(read.model.joints.size(), drawn.model.joints.size());
  EXPECT_GT(read.model.bodies.size(), 20u);
  for (std::size_t j = 0; j < read.model.joints.size(); ++j) {
    EXPECT_EQ(read.model.joints[j].name, drawn.model.joints[j].name);
    EXPECT_EQ(read.model.joints[j].plane.normal, drawn.model.joints[j].plane.normal);
    EXPECT_EQ(read.model.joints[j].plane.offset, drawn.model.joints[j].plane.offset);
  }
  expect_equal(read.model, drawn.model);
}

// the joints.csv of a report gives the same blocks to the last bit
TEST_F(SceneFiles, DrawnJointsReturnFromTheirTableBitForBit) {
  return_from_table(base_3d + three_sets);
  return_from_table(base_3d +
                    "[[joint_sets]]\nname = \"A\"\ndip = 30\ndip_direction = 90\nsize = \"exponential\"\n"
                    "size_mean = 4\nintensity = 0.3\n"
                    "[[joint_sets]]\nname = \"B\"\ndip = 80\ndip_direction = 200\nsize = \"constant\"\n"
                    "size_mean = 5\nshape = \"rectangle\"\nelongation = 0.5\nintensity = 0.3\n");
}

TEST_F(SceneFiles, JointsOfATableAreJointsOfTheScene) {
  write("joints.csv", "name,dip_deg,dip_direction_deg,x_m,y_m,z_m\nA,0,,5,5,5\n,90,90,5,5,5\n");
  const std::string text = "joints_file = \"joints.csv\"\n" + base_3d;
  const Scene scene = parse(
      text + "[[joints]]\nname = \"A\"\npoint = [5, 5, 4]\n[[joints]]\nname = \"B\"\ndip = 0\npoint = [0, 0, 8]\n");
  const Model<3> model = prepare<3>(scene).model;
  ASSERT_EQ(model.joints.size(), 3u);
  EXPECT_EQ(model.joints[1].name, "joint-2");
  EXPECT_NEAR(model.joints[0].plane.offset, -1, 1e-15);
  EXPECT_EQ(model.bodies.size(), 6u);
  EXPECT_EQ(prepare<3>(parse(text, {"joints.A.point=[5, 5, 20]"})).model.bodies.size(), 2u);
  // the file's content is part of the scene's hash
  const std::string before = canonical_text(parse(text));
  write("joints.csv", "name,dip_deg,dip_direction_deg,x_m,y_m,z_m\nA,0,,5,5,5.5\n,90,90,5,5,5\n");
  EXPECT_NE(canonical_text(parse(text)), before);
}

TEST_F(SceneFiles, MistakesAreReportedWithTheirPlace) {
  const std::string text = "joints_file = \"joints.csv\"\n" + base_3d;
  const auto refused = [&](const std::string& csv, const std::string& part) {
    write("joints.csv", csv);
    expect_refused(text, part);
  };
  const std::string head = "name,dip_deg,dip_direction_deg,x_m,y_m,z_m,properties,shape,length_m,width_m\n";
  refused(head + "A,95,90,0,0,0,,,,\n", "joints.csv:2: joints.A.dip = 95: must lie between 0 and 90");
  refused(head + "A,40,90,0,0,0,,,,\nA,50,90,0,0,0,,,,\n", "joints.csv:3: joints.A.name = \"A\": must be unique");
  refused(head + "A,40,90,0,0,0,clay,,,\n", "no joint_properties of this name");
  refused(head + "A,40,90,0,zero,0,,,,\n", "joints.csv:2:11: y_m = 'zero'");
  refused(head + "A,40,90,0,0,0,,ellipse,2e13,1\n", "joints.csv:2: joints.A.length = 2e+13");
  refused("dip_deg,normal_x,normal_y,normal_z,x_m,y_m,z_m\n10,0,0,1,0,0,0\n", "dip_direction is missing");
  refused("dip_deg,dip_direction_deg,normal_x,normal_y,normal_z,x_m,y_m,z_m\n10,0,0,0,1,0,0,0\n",
          "does not agree with dip");
  expect_refused("joints_file = \"none.csv\"\n" + base_3d, "no such file");
  expect_refused("joints_file = \"../joints.csv\"\n" + base_3d, "own folder");
  expect_refused(base_3d, "cannot be set", {"joints_file=joints.csv"});
}

TEST_F(SceneFiles, BlocksComeFromPlanesObjAndStl) {
  const std::string scene = R"(dimension = 3
density = 2600
joint_properties = [{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 30 }]
stage = [{ name = "settle", kind = "settle" }]
)";
  write("blocks.csv",
        "block,part,normal_x,normal_y,normal_z,offset_m\n"
        "cube,0,1,0,0,1\ncube,0,-1,0,0,0\ncube,0,0,1,0,1\ncube,0,0,-1,0,0\ncube,0,0,0,1,1\ncube,0,0,0,-1,0\n"
        "cube,1,1,0,0,2\ncube,1,-1,0,0,-1\ncube,1,0,1,0,1\ncube,1,0,-1,0,0\ncube,1,0,0,1,1\ncube,1,0,0,-1,0\n");
  const Model<3> planes = prepare<3>(parse("blocks_file = \"blocks.csv\"\n" + scene)).model;
  ASSERT_EQ(planes.bodies.size(), 1u);
  EXPECT_EQ(planes.bodies[0].parts.size(), 2u);
  EXPECT_NEAR(planes.bodies[0].mass, 2600 * 2, 1e-9);

  // parts that overlap, and parts that are numbered from 1
  const std::string cube = "block,part,normal_x,normal_y,normal_z,offset_m\n";
  const auto part = [](int number, double from) {
    std::string rows;
    for (const std::string& plane :
         {fmt::format("1,0,0,{}", from + 1), fmt::format("-1,0,0,{}", -from), std::string("0,1,0,1"),
          std::string("0,-1,0,0"), std::string("0,0,1,1"), std::string("0,0,-1,0")})
      rows += fmt::format("cube,{},{}\n", number, plane);
    return rows;
  };
  write("blocks.csv", cube + part(0, 0) + part(1, 0.75));
  expect_refused(
      "blocks_file = \"blocks.csv\"\n" + scene,
      "blocks.csv:8: blocks.cube-part-1.part_of = \"cube\": overlaps part 'cube' of the same body by 0.25 m³");
  write("blocks.csv", cube + part(1, 0) + part(2, 1));
  expect_refused("blocks_file = \"blocks.csv\"\n" + scene,
                 "part = '1': block 'cube' has no part 0; parts are numbered from 0");
  write("blocks.csv", cube + part(1, 0) + part(0, 1));
  EXPECT_EQ(prepare<3>(parse("blocks_file = \"blocks.csv\"\n" + scene)).model.bodies.size(), 1u);

  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 5 5 5\nv 6 5 5\nv 5 6 5\nv 5 5 6\n";
  write("blocks.obj",
        points + "o first\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\no second\nf 5 7 6\nf 5 6 8\nf 5 8 7\nf 6 7 8\n");
  const Model<3> obj =
      prepare<3>(parse("blocks_file = \"blocks.obj\"\n" + scene + "[[blocks]]\nname = \"first\"\nfixed = true\n"))
          .model;
  ASSERT_EQ(obj.bodies.size(), 2u);
  EXPECT_TRUE(obj.bodies[0].fixed);
  EXPECT_EQ(obj.bodies[1].name, "second");
  EXPECT_NEAR(obj.bodies[1].mass, 2600 / 6.0, 1e-9);

  write("blocks.stl",
        "solid a b\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
        "0\nendloop\nendfacet\nendsolid\n");
  expect_refused("blocks_file = \"blocks.stl\"\n" + scene, "blocks.stl:1: has 1 facets");
  write("blocks.obj", points + "f 1 3 2\nf 1 2 4\nf 1 4 3\n\nf 2 3 5\n");
  expect_refused("blocks_file = \"blocks.obj\"\n" + scene, "blocks.obj:13: the surface is open");
  write("blocks.txt", "");
  expect_refused("blocks_file = \"blocks.txt\"\n" + scene, "must end in .csv");
  expect_refused("blocks_file = \"blocks.obj\"\ndimension = 2\n", "dimension = 2");
}

TEST_F(SceneFiles, JointSetsAreChecked) {
  const auto refused = [&](const std::string& keys, const std::string& part) {
    expect_refused(base_3d + "[[joint_sets]]\nname = \"A\"\ndip = 30\ndip_direction = 90\n" + keys, part);
  };
  refused("", "needs spacing or intensity");
  refused("spacing = 1\nintensity = 1\n", "is stated together with spacing");
  refused("intensity = 1\nsize = \"constant\"\nsize_mean = 1\npersistence = 0.5\n", "applies to spacing only");
  refused("spacing = 1e-7\n", "more than 1e+06");
  refused("spacing = 1\nsize = \"lognormal\"\nsize_mean = 1\n", "size_deviation is missing");
  refused("spacing = 1\nsize_mean = 1\n", "applies only if size");
  refused("spacing = 1\nscatter = \"fisher\"\n", "fisher_constant is missing");
  refused("spacing = 1\nproperties = \"clay\"\n", "no joint_properties of this name");
  refused("spacing = 1\n[[joints]]\nname = \"A-2\"\ndip = 0\npoint = [0, 0, 1]\n", "rename the set");
  std::string no_domain = base_3d + three_sets;
  no_domain.erase(no_domain.find("domain"), no_domain.find("joint_prop") - no_domain.find("domain"));
  expect_refused(no_domain, "joint sets fill a region");
}

}  // namespace
}  // namespace voussoir::scene_files_test
