// Valid scenes: reading, preparation, changes by --set, implausible values.
#include "core/scene/scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "core/scene/judge_values.hpp"
#include "text/angle.hpp"

namespace voussoir::scene_test {
namespace {

const std::string wedge = R"(title = "Sliding wedge"
dimension = 3
gravity = [0, 0, -9.81]
density = 2000
[domain]
box = { min = [-4, -4, -4], max = [4, 4, 0] }
[[domain.planes]]
name = "slope face"
dip = 70
dip_direction = 155
point = [1, -1, -1]
keep = "below"
[[joints]]
name = "A"
dip = 40
dip_direction = 130
point = [0, 0, -1]
[[joints]]
name = "B"
dip = 60
dip_direction = 220
point = [0, 0, -1]
[[joint_properties]]
name = "rock"
normal_stiffness = 10e6
shear_stiffness = 1e6
friction_deg = 60
[[fix]]
below = ["A"]
[[fix]]
name = "other side"
below = ["B"]
[[restrain]]
above = ["A", "B"]
rotation = true
[damping]
local = 0.5
[[stage]]
name = "settle"
kind = "settle"
[[stage]]
name = "reduce"
kind = "reduce"
from_deg = 60
to_deg = 5
tolerance_deg = 0.01
failure_displacement = 0.01
[[monitors]]
name = "wedge"
quantities = ["displacement", "velocity", "rotation"]
above = ["A", "B"]
[[monitors]]
name = "on A"
joint = "A"
quantities = ["contact_force"]
)";

Scene parse(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_scene(text, "scene.toml", overrides);
}

TEST(ReadScene, ConvertsStatedAnglesToRadians) {
  const Scene s = parse(wedge);
  EXPECT_EQ(s.title, "Sliding wedge");
  EXPECT_EQ(s.dimension, 3);
  ASSERT_EQ(s.joints.size(), 2u);
  EXPECT_DOUBLE_EQ(s.joints[0].plane.dip, 40 * degree);
  EXPECT_DOUBLE_EQ(s.joints[1].plane.dip_direction, 220 * degree);
  EXPECT_FALSE(s.joints[0].properties);
  EXPECT_TRUE(s.domain->planes.at(0).keep_below);
  EXPECT_EQ(s.settings.damping.local, 0.5);
  ASSERT_EQ(s.stages.size(), 2u);
  const auto& reduce = std::get<ReducePlan>(s.stages[1].plan.plan);
  EXPECT_DOUBLE_EQ(reduce.from, 60 * degree);
  EXPECT_DOUBLE_EQ(reduce.tolerance, 0.01 * degree);
  EXPECT_EQ(reduce.method, ReductionMethod::bisection);
  EXPECT_FALSE(s.stages[0].plan.damping);
  EXPECT_EQ(s.monitors.at(0).quantities.size(), 3u);
  EXPECT_EQ(s.fix.at(1).subject.path, "fix.other side");
}

TEST(ReadScene, DampingOfAStageIsCompletedFromTheScene) {
  const Scene s = parse(wedge, {"stage.settle.damping.viscous_ratio=0.1"});
  EXPECT_EQ(s.stages[0].plan.damping->local, 0.5);
  EXPECT_EQ(s.stages[0].plan.damping->viscous_ratio, 0.1);
}

TEST(ReadScene, GravityContinuesFromThePreviousStage) {
  const Scene scene = parse_scene(R"(dimension = 2
[[stage]]
name = "none"
kind = "run"
duration_s = 1
gravity_to = 0
[[stage]]
name = "to ten"
kind = "settle"
gravity_ramp_s = 2
gravity_to = 10
[[stage]]
name = "to twenty"
kind = "run"
duration_s = 2
gravity_ramp_s = 2
gravity_to = 20
[[stage]]
name = "on"
kind = "settle"
gravity_ramp_s = 2
gravity_to = 16
[[stage]]
name = "from none"
kind = "settle"
gravity_ramp_s = 2
)",
                                  "scene.toml");
  const double from[] = {0, 0, 10, 20, 0};
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    const auto& plan = scene.stages[i].plan.plan;
    const auto* settle = std::get_if<SettlePlan>(&plan);
    EXPECT_EQ(settle ? settle->gravity.from : std::get<RunPlan>(plan).gravity.from, from[i]) << i;
  }
}

TEST(ReadScene, RefusesARampThatOutlastsItsStage) {
  const std::string run = "dimension = 2\n[[stage]]\nname = \"load\"\nkind = \"run\"\nduration_s = 0.1\n";
  EXPECT_NO_THROW(parse_scene(run + "gravity_ramp_s = 0.1\n", "scene.toml"));
  try {
    parse_scene(run + "gravity_ramp_s = 2\n", "scene.toml");
    FAIL() << "5 % of gravity would act";
  } catch (const SceneError& error) {
    const std::string message = error.what();
    for (const char* part : {"scene.toml:6", "stage.load.gravity_ramp_s = 2", "at most duration_s (0.1)", "gravity_to"})
      EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

TEST(Prepare, CutsTheWedgeAndResolvesSelectors) {
  const Prepared<3> p = prepare<3>(parse(wedge));
  ASSERT_EQ(p.model.bodies.size(), 4u);
  EXPECT_EQ(p.state.bodies.motions.size(), 4u);
  EXPECT_EQ(p.model.gravity, Vector<3>(0, 0, -9.81));
  int free = -1, free_count = 0;
  for (int b = 0; b < 4; ++b)
    if (!p.model.bodies[b].fixed) free = b, ++free_count;
  ASSERT_EQ(free_count, 1);
  EXPECT_FALSE(p.model.bodies[free].free_rotation[0]);
  EXPECT_TRUE(p.model.bodies[free].free_translation[0]);
  ASSERT_EQ(p.monitors.size(), 4u);
  EXPECT_EQ(p.monitors[0].subject, free);
  EXPECT_EQ(p.monitors[3].subject, 0);
  EXPECT_EQ(p.monitors[3].followed.quantity, Quantity::contact_force);
  double mass = 0;
  for (const Body<3>& b : p.model.bodies)
    mass += b.mass;
  EXPECT_LT(mass, 2000 * 8 * 8 * 4.0);
}

// Eq. 3.6
TEST(Prepare, DoesNotDependOnThePositionOfTheScene) {
  // 2^20 m: the coordinates of the moved scene are exact
  std::string moved = wedge;
  const auto replace = [&](const std::string& from, const std::string& to) {
    for (std::size_t at; (at = moved.find(from)) != std::string::npos;)
      moved.replace(at, from.size(), to);
  };
  replace("min = [-4, -4, -4], max = [4, 4, 0]", "min = [1048572, -4, -1048580], max = [1048580, 4, -1048576]");
  replace("point = [1, -1, -1]", "point = [1048577, -1, -1048577]");
  replace("point = [0, 0, -1]", "point = [1048576, 0, -1048577]");
  const Prepared<3> here = prepare<3>(parse(wedge)), there = prepare<3>(parse(moved));
  EXPECT_LT((there.model.origin - here.model.origin - Vector<3>(1048576, 0, -1048576)).norm(), 1e-9);
  ASSERT_EQ(here.model.bodies.size(), there.model.bodies.size());
  for (std::size_t b = 0; b < here.model.bodies.size(); ++b) {
    EXPECT_LT((here.model.bodies[b].reference - there.model.bodies[b].reference).norm(), 1e-9);
    EXPECT_NEAR(there.model.bodies[b].mass / here.model.bodies[b].mass, 1, 1e-9);
    EXPECT_EQ(here.model.bodies[b].fixed, there.model.bodies[b].fixed);
  }
}

TEST(Prepare, RunsInThePlane) {
  const Scene s = parse(R"(dimension = 2
gravity = [0, -9.81]
density = 2500
[domain]
box = { min = [0, 0], max = [2, 2] }
[[joints]]
name = "A"
dip = 45
dip_direction = 270
point = [1, 1]
[[joint_properties]]
name = "rock"
normal_stiffness = 1e9
shear_stiffness = 1e9
friction_deg = 30
[[blocks]]
name = "top"
vertices = [[0, 3], [1, 3], [0, 4]]
angular_velocity = 2
[[fix]]
below = ["A"]
[[restrain]]
above = ["A"]
bodies = ["top"]
translation = ["x"]
[[stage]]
name = "run"
kind = "run"
duration_s = 1
)");
  const Prepared<2> p = prepare<2>(s);
  ASSERT_EQ(p.model.bodies.size(), 3u);
  // dips to the left: above it is the upper left half
  EXPECT_LT(p.model.joints[0].plane.normal[0], 0);
  EXPECT_GT(p.model.joints[0].plane.normal[1], 0);
  for (std::size_t b = 0; b < 3; ++b) {
    const Body<2>& body = p.model.bodies[b];
    const bool top = body.name == "top";
    EXPECT_EQ(body.fixed, body.reference[0] + p.model.origin[0] > 1);
    EXPECT_EQ(body.free_translation[0], !top);
    EXPECT_NEAR(angular_velocity<2>(body, p.state.bodies.motions[b])[0], top ? 2 : 0, 1e-12);
  }
}

TEST(Select, TakesConditionsTogether) {
  const Prepared<3> p = prepare<3>(parse(wedge));
  Selector none;
  EXPECT_TRUE(select<3>(p.model, none).empty());
  Selector all;
  all.all = true;
  EXPECT_EQ(select<3>(p.model, all).size(), 4u);
  Selector corner;
  corner.above = {"A"};
  corner.inside = {{0.0, -1.0, -0.9}};
  EXPECT_LE(select<3>(p.model, corner).size(), 1u);
  corner.above = {"C"};
  EXPECT_THROW(select<3>(p.model, corner), std::out_of_range);
}

TEST(Set, ReachesTablesByNameNumberAndValuesNotInTheFile) {
  const auto set = [](const std::string& text) { return parse(wedge, {text}); };
  EXPECT_DOUBLE_EQ(set("joints.A.dip=65").joints[0].plane.dip, 65 * degree);
  EXPECT_DOUBLE_EQ(set("joints.2.dip = 65").joints[1].plane.dip, 65 * degree);
  EXPECT_DOUBLE_EQ(set("domain.planes.slope face.dip=60").domain->planes[0].plane.dip, 60 * degree);
  EXPECT_DOUBLE_EQ(std::get<ReducePlan>(set("stage.reduce.tolerance_deg=0.1").stages[1].plan.plan).tolerance,
                   0.1 * degree);
  EXPECT_EQ(*set("gravity=[0,0,-5]").gravity, (std::vector<double>{0, 0, -5}));
  EXPECT_EQ(set("domain.box.max=[5, 4, 0]").domain->box->max[0], 5);
  EXPECT_EQ(set("contact.skin=0.3").settings.contact.skin, 0.3);
  EXPECT_EQ(set("contact.point=chebyshev").settings.contact.point, ContactPoint::chebyshev);
  EXPECT_EQ(set("contact.point=central_path").settings.contact.point, ContactPoint::central_path);
  EXPECT_EQ(set("contact.smoothing=1e-3").settings.contact.smoothing, 1e-3);
  EXPECT_EQ(set("contact.point=centroid").settings.contact.point, ContactPoint::centroid);
  EXPECT_EQ(set("contact.overlap=bracketing").settings.contact.overlap, OverlapSearch::bracketing);
  EXPECT_EQ(set("contact.normal=multipliers").settings.contact.normal, ContactNormal::multipliers);
  EXPECT_EQ(set("title=two words").title, "two words");
  EXPECT_EQ(set("title=\"a = b\"").title, "a = b");
  EXPECT_EQ(set("fix.2.below=[\"A\"]").fix[1].selector.below, std::vector<std::string>{"A"});
  EXPECT_EQ(set("fix.other side.all=true").fix[1].selector.all, true);
  EXPECT_EQ(set("damping={ local = 0.1 }").settings.damping.local, 0.1);
  EXPECT_EQ(set("output.frames=false").output.frames, false);
  // in order: a later one sees the earlier
  EXPECT_DOUBLE_EQ(parse(wedge, {"joints.A.name=C", "joints.C.dip=1", "joints.C.dip=2"}).joints[0].plane.dip,
                   2 * degree);
}

TEST(CanonicalText, IgnoresLayoutAndKeepsMeaning) {
  const std::string base = canonical_text(parse(wedge));
  EXPECT_EQ(canonical_text(parse("# a comment\n" + wedge)), base);
  EXPECT_EQ(canonical_text(parse(wedge, {"joints.A.dip=40.0"})), base);
  EXPECT_NE(canonical_text(parse(wedge, {"joints.A.dip=40.000001"})), base);
  const std::string stated = wedge + "[time]\nfraction = 0.1\n";
  EXPECT_EQ(canonical_text(parse(stated)), canonical_text(parse(wedge, {"time.fraction=0.1"})));
}

// the warnings of a scene, in one text
std::string warnings(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const Scene scene = parse(text, overrides);
  std::string all;
  for (const std::string& warning : judge_values<3>(scene, prepare<3>(scene)))
    all += warning + "\n";
  return all;
}

TEST(Plausibility, KnowsTheSignsOfWrongUnits) {
  EXPECT_EQ(warnings(wedge), "");
  const std::vector<std::pair<std::string, std::string>> all = {
      {"gravity=[0,0,9.81]", "gravity = [0, 0, 9.81]: points upwards"},
      {"gravity=[0,9.81,-0.1]", "gravity = [0, 9.81, -0.1]: points more sideways than down"},
      {"gravity=[0,0,-9810]", "on earth it is 9.81"},
      {"density=2.6", "density = 2.6: is unusual, 500 to 8000 kg/m³ is usual; was it given in g/cm³"},
      {"joint_properties.rock.friction_deg=0.6", "friction_deg = 0.6: is unusual, 0 or 1.6 to 89.9 deg is usual"},
      {"joints.A.dip=0.7", "joints.A.dip = 0.7: is unusual, 0 or 1.6 to 90 deg is usual; was it given in radians?"},
      {"joint_properties.rock.shear_stiffness=1e8", "exceeds normal_stiffness"},
      {"joint_properties.rock.shear_stiffness=10", "was it given in MPa/m"},
      {"joint_properties.rock.normal_stiffness=1e10", "is very small compared with normal_stiffness"},
      {"joint_properties.rock.normal_stiffness=1e14", "1e+06 to 1e+12 Pa/m is usual"},
      {"domain.planes.slope face.point=[0,0,-0.001]", "close to zero in a scene of"},
      {"domain.box.min=[-4e5,-4,-4]", "is a coordinate of one in the wrong unit"}};
  for (const auto& [text, phrase] : all)
    EXPECT_NE(warnings(wedge, {text}).find(phrase), std::string::npos) << text << "\n" << warnings(wedge, {text});
  const std::string shake =
      "[[stage]]\nname = \"shake\"\nkind = \"run\"\nduration_s = 2\n[[stage.move]]\nbelow = [\"A\"]\n"
      "velocity = [0.1, 0, 0]\nfactors = [0, 1]\ntimes_s = ";
  EXPECT_EQ(warnings(wedge + shake + "[0, 2]\n"), "");
  EXPECT_NE(warnings(wedge + shake + "[0, 2000]\n").find("continues beyond duration_s (2)"), std::string::npos);
}

TEST(Plausibility, ReportsAJointThatCutsNothing) {
  const std::string text = warnings(wedge + "[[joints]]\nname = \"far\"\ndip = 0\npoint = [0, 0, 50]\n");
  EXPECT_NE(text.find("joints.far"), std::string::npos);
  EXPECT_NE(text.find("cuts no block"), std::string::npos);
}

TEST(Plausibility, ReportsThePropertiesOfFacesThatNoJointMade) {
  const auto soil = [](const std::string& name) {
    return wedge + "[[joint_properties]]\nname = \"" + name +
           "\"\nnormal_stiffness = 1e7\nshear_stiffness = 1e6\nfriction_deg = 20\n";
  };
  const std::vector<std::string> named = {"joints.A.properties=rock", "joints.B.properties=rock"};
  EXPECT_EQ(warnings(soil("default"), named), "");
  EXPECT_EQ(warnings(soil("soil"), named), "") << "the outer faces of one domain meet nothing";
  const std::string wall = "[[blocks]]\nname = \"wall\"\nbox = { min = [4, -4, -4], max = [6, 4, 0] }\nfixed = true\n";
  EXPECT_EQ(warnings(soil("default") + wall, named), "");
  EXPECT_NE(
      warnings(soil("soil") + wall, named).find("name = \"rock\": applies to contacts of faces that no joint made"),
      std::string::npos)
      << warnings(soil("soil") + wall, named);
}

// two convex parts form an L-shaped body, in either order
TEST(Prepare, JoinsPartsToOneBody) {
  const std::string two_parts =
      "dimension = 2\ndensity = 1000\n[[blocks]]\nname = \"foot\"\nbox = { min = [0, 0], max = [2, 1] }\n"
      "[[blocks]]\nname = \"leg\"\npart_of = \"foot\"\nbox = { min = [0, 1], max = [1, 3] }\n"
      "[time]\nstep_s = 0.1\n[[stage]]\nname = \"go\"\nkind = \"run\"\nduration_s = 1\n";
  const Prepared<2> prepared = prepare<2>(parse(two_parts));
  ASSERT_EQ(prepared.model.bodies.size(), 1u);
  const Body<2>& body = prepared.model.bodies[0];
  EXPECT_EQ(body.parts.size(), 2u);
  EXPECT_NEAR(body.mass, 4000, 1e-9);
  const Vector<2> centroid = body.reference + prepared.model.origin;
  EXPECT_NEAR(centroid[0], 0.75, 1e-12);
  EXPECT_NEAR(centroid[1], 1.25, 1e-12);
  std::string wrong = two_parts;
  wrong.replace(wrong.find("part_of = \"foot\""), 16, "part_of = \"foto\"");
  EXPECT_THROW(prepare<2>(parse(wrong)), SceneError);
}

// a scene over its base: tables merged, tables of a list by name, a stage of another method replaced
TEST(BaseScene, StatesOnlyTheDifferences) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "voussoir_base_scene_test";
  std::filesystem::create_directories(folder);
  const auto write = [&](const std::string& name, const std::string& text) { std::ofstream(folder / name) << text; };
  write("scene.toml", wedge);
  write("variant.toml", "base = \"scene.toml\"\ntitle = \"variant\"\n[[joints]]\nname = \"A\"\ndip = 45\n");
  const Scene scene = read_scene(folder / "variant.toml", {});
  EXPECT_EQ(scene.title, "variant");
  ASSERT_EQ(scene.joints.size(), 2u);
  EXPECT_NEAR(scene.joints[0].plane.dip, std::numbers::pi / 4, 1e-15);
  EXPECT_NEAR(scene.joints[1].plane.dip, std::numbers::pi / 3, 1e-15);

  for (const char* bad : {"../scene.toml", "/scene.toml", "none.toml", "circle.toml"}) {
    write("circle.toml", std::string("base = \"") + bad + "\"\n");
    EXPECT_THROW(read_scene(folder / "circle.toml", {}), SceneError) << bad;
  }
  std::filesystem::remove_all(folder);
}

// One name means a list of one, in every kind of table: the scenes differ only in notation.
TEST(Scene, OneNameMeansAListOfOne) {
  const auto replaced = [](std::string text, const std::string& list, const std::string& one) {
    const std::size_t at = text.find(list);
    EXPECT_NE(at, std::string::npos) << list;
    return at == std::string::npos ? text : text.replace(at, list.size(), one);
  };
  const std::string lists = wedge +
                            "[[monitors]]\nname = \"base\"\nover = \"sum\"\nside = [\"bottom\"]\nquantities = "
                            "[\"displacement\"]\n[[restrain]]\nbodies = [\"stone\"]\ntranslation = [\"x\"]\n"
                            "[[blocks]]\nname = \"stone\"\nbox = { min = [0, 0, -12], max = [1, 1, -11] }\n"
                            "[[monitors]]\nname = \"stone\"\nbodies = [\"stone\"]\nquantities = [\"velocity\"]\n";
  for (const auto& [list, one] : std::vector<std::pair<std::string, std::string>>{
           {"below = [\"B\"]", "below = \"B\""},
           {"side = [\"bottom\"]", "side = \"bottom\""},
           {"bodies = [\"stone\"]\ntranslation", "bodies = \"stone\"\ntranslation"},
           {"translation = [\"x\"]", "translation = \"x\""},
           {"quantities = [\"velocity\"]", "quantities = \"velocity\""}}) {
    const Prepared<3> of_list = prepare<3>(parse_scene(lists, "scene.toml")),
                      of_name = prepare<3>(parse_scene(replaced(lists, list, one), "scene.toml"));
    ASSERT_EQ(of_name.model.bodies.size(), of_list.model.bodies.size());
    for (std::size_t b = 0; b < of_list.model.bodies.size(); ++b) {
      EXPECT_EQ(of_name.model.bodies[b].fixed, of_list.model.bodies[b].fixed) << one;
      EXPECT_EQ(of_name.model.bodies[b].free_translation, of_list.model.bodies[b].free_translation) << one;
    }
    ASSERT_EQ(of_name.monitors.size(), of_list.monitors.size()) << one;
    for (std::size_t k = 0; k < of_list.monitors.size(); ++k) {
      EXPECT_EQ(of_name.monitors[k].followed, of_list.monitors[k].followed) << one;
      EXPECT_EQ(of_name.monitors[k].group, of_list.monitors[k].group) << one;
      EXPECT_EQ(of_name.monitors[k].subject, of_list.monitors[k].subject) << one;
    }
    const std::string wrong =
        replaced(lists, list, one.substr(0, one.find('"')) + "\"no such\"" + one.substr(one.rfind('"') + 1));
    EXPECT_THROW(prepare<3>(parse_scene(wrong, "scene.toml")), SceneError) << wrong;
  }
}

}  // namespace
}  // namespace voussoir::scene_test
