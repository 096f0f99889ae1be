// Messages about a scene before and after a run: names, the cost of linings and bolts, repairs that fit.
#include <random>
#include <regex>

#include "app/testing/checked_scene.hpp"
#include "core/model/body_title.hpp"
#include "core/output/bolt_output.hpp"
#include "core/scene/scene.hpp"
#include "core/stage/install_bolts.hpp"
#include "core/testing/lined_opening.hpp"

namespace voussoir {
namespace {

using namespace program;

std::string plane() {
  return head_in_plane +
         "joint_properties = [{ name = \"rock\", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 30 }]\n";
}
std::string halves() {
  return plane() +
         "domain = { box = { min = [0, 0], max = [40, 40] } }\n"
         "joints = [{ name = \"bed\", dip = 0, point = [0, 20] }]\nfix = [{ below = [\"bed\"] }]\n";
}
class Messages : public CheckedScene {};

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// ---- commands and repairs -------------------------------------------------------------------------------------------

TEST_F(Messages, BlocksAreCutWithoutAStage) {
  write("scene.toml", halves());
  EXPECT_EQ(run("slice scene.toml --out blocks").code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "blocks" / "blocks.csv"));
  for (const char* command : {"check scene.toml", "run scene.toml --out r"})
    expect_one_line(run(command), 2, "stage is missing");
}

// the help text of an option that takes one value each time must not suggest that it takes several
TEST_F(Messages, HelpShowsNoListIfEachValueNeedsItsOption) {
  for (const char* command :
       {"run", "check", "slice", "blocks", "limit", "export", "joint-test", "study run", "resume", "report"}) {
    const Ended help = run(std::string(command) + " --help");
    EXPECT_EQ(help.code, 0);
    for (const std::string& line : lines_of(help.out))
      EXPECT_FALSE(line.starts_with("  --") && holds(line, "...")) << command << ": " << line;
  }
  write("scene.toml", halves() + settle_stage);
  EXPECT_TRUE(holds(run("check scene.toml --set density=2500 --set title='\"two\"'").out, "two (2-D)"));
  EXPECT_EQ(run("check scene.toml --set density=2500 title=two").code, 2);
}

TEST_F(Messages, LimitAnalysisIsQuietWhenAsked) {
  write("scene.toml", halves() + settle_stage);
  const std::string dipping =
      "limit scene.toml --set joints.bed.dip=20 --set joints.bed.dip_direction=90 --out l --overwrite";
  EXPECT_FALSE(run(dipping).out.empty());
  const Ended quiet = run(dipping + " --quiet");
  EXPECT_EQ(quiet.code, 0);
  EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST_F(Messages, ListsThatAreTooLongGetTheirOwnRepair) {
  std::string points;
  for (int k = 0; k < 1000; ++k)
    points += fmt::format("[{}, 30], ", k);
  const std::string water = "[[water]]\nname = \"lake\"\ntable = [" + points + "]\n";
  write("scene.toml", halves() + settle_stage + water);
  const Ended ended = run("check scene.toml");
  expect_one_line(ended, 2, "water.lake.table");
  EXPECT_FALSE(holds(ended.err, "block")) << ended.err;
  EXPECT_TRUE(holds(ended.err, "leave out points")) << ended.err;
  refused(plane() + settle_stage + "[[blocks]]\nname = \"a\"\nvertices = [" + points + "]\n",
          "divide the block into parts");
}

TEST_F(Messages, MissingGravityIsNoWrongDensity) {
  const std::string water = "[[water]]\nname = \"lake\"\nlevel = 39\nunit_weight = 9810\n";
  const std::string out = check(halves().substr(0, halves().find("gravity")) +
                                halves().substr(halves().find("density")) + settle_stage + water);
  EXPECT_TRUE(holds(out, "water lifts it by")) << out;
  EXPECT_TRUE(holds(out, "state gravity")) << out;
  EXPECT_FALSE(holds(out, "is the density")) << out;
  EXPECT_TRUE(holds(check(halves() + settle_stage + water, "--set density=500"), "is the density"));
}

TEST_F(Messages, TimeStepsAreStatedOnce) {
  refused(halves() + settle_stage + "[time]\nstep_s = 1e-4\nfraction = 0.1\n", "time.fraction");
  refused(halves() + settle_stage + "[time]\nstep_s = 1e-4\nfraction = 0.1\n", "is stated together with step_s");
  check(halves() + settle_stage + "[time]\nstep_s = 1e-4\n");
  check(halves() + settle_stage + "[time]\nfraction = 0.1\n");
}

// a tolerance below the resolution of a double is refused, in any unit; the search would not end
TEST_F(Messages, TolerancesBelowTheResolutionOfADoubleAreRefused) {
  std::mt19937 random(20);
  std::uniform_real_distribution<double> below(10.1, 99), above(3, 9.9);
  const std::string angle = "[[stage]]\nname = \"c\"\nkind = \"reduce\"\nfrom_deg = 40\nto_deg = 10\n",
                    factor =
                        "[[stage]]\nname = \"c\"\nkind = \"reduce\"\nsearch = \"factor\"\nfrom_factor = 0.5\n"
                        "to_factor = 3\n";
  struct Key {
    std::string scene, name, text;
  };
  const std::vector<Key> keys = {
      {angle, "tolerance_deg", "tolerance_deg = {:.3e}\n"},
      {angle + "method = \"steps\"\n", "step_deg", "step_deg = {:.3e}\n"},
      {factor, "tolerance_factor", "tolerance_factor = {:.3e}\n"},
      {factor + "method = \"steps\"\n", "step_factor", "step_factor = {:.3e}\n"},
      {angle + "tolerance_deg = 0.1\n", "accuracy.error", "[accuracy]\nerror = \"{:.3e} deg\"\n"},
      {angle + "tolerance_deg = 0.1\n", "accuracy.error", "[accuracy]\nerror = \"{:.3e} %\"\n"}};
  for (const Key& key : keys) {
    refused(halves() + key.scene + fmt::format(fmt::runtime(key.text), std::pow(10, -below(random))), key.name);
    check(halves() + key.scene + fmt::format(fmt::runtime(key.text), std::pow(10, -above(random))));
  }
}

// blocks centred at the origin, cut by joints at any angle
TEST_F(Messages, CoordinatesThatAreZeroToRoundingAreZero) {
  std::mt19937 random(21);
  std::uniform_real_distribution<double> angle(1, 89), half(0.5, 50);
  for (int trial = 0; trial < 10; ++trial) {
    const double dip = angle(random), size = half(random);
    const auto joint = [&](const char* name, double side) {
      return fmt::format("[[joints]]\nname = \"{}\"\ndip = {}\ndip_direction = 90\npoint = [{}, 0]\n", name, dip,
                         0.3 * side * size);
    };
    write("scene.toml", plane() +
                            fmt::format("domain = {{ box = {{ min = [-{0}, -{0}], max = [{0}, {0}] }} }}\n", size) +
                            joint("left", -1) + joint("right", 1));
    ASSERT_EQ(run("slice scene.toml --out blocks --overwrite").code, 0);
    const std::vector<std::string> rows = lines_of(read(folder_ / "blocks/blocks.csv"));
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(std::ranges::count_if(rows, [](const std::string& row) { return row.ends_with(",0,0"); }), 1)
        << rows[1] << "\n"
        << rows[2] << "\n"
        << rows[3];
  }
}

// ---- bolts and linings ----------------------------------------------------------------------------------------------

// random bolts, some of which overlap another or are in the plane of the joint
TEST_F(Messages, BoltsThatOverlapAreCounted) {
  std::mt19937 random(19);
  std::uniform_real_distribution<double> at(1, 39), share(0.1, 0.9);
  for (int trial = 0; trial < 6; ++trial) {
    const int apart = 4 + trial, again = trial % 3, in_joint = (trial + 1) % 3;
    std::vector<std::array<double, 4>> lines;
    for (int k = 0; k < apart; ++k)
      lines.push_back({at(random), at(random) / 2, at(random), 20 + at(random) / 2});
    for (int k = 0; k < again; ++k) {  // from within the first ones, backwards or on beyond their ends
      const auto [x, y, u, v] = lines[k];
      const double from = share(random), to = trial % 2 ? from + 1 : from - 1;
      lines.push_back({x + from * (u - x), y + from * (v - y), x + to * (u - x), y + to * (v - y)});
    }
    for (int k = 0; k < in_joint; ++k)
      lines.push_back({10.0 * k + 1, 20, 10.0 * k + 8, 20});
    std::string bolts, install;
    for (std::size_t k = 0; k < lines.size(); ++k) {
      const auto [x, y, u, v] = lines[k];
      bolts +=
          fmt::format("[[bolts]]\nname = \"b{}\"\nstiffness = 1e8\nfrom = [{}, {}]\nto = [{}, {}]\n", k, x, y, u, v);
      install += fmt::format("{}\"b{}\"", k ? ", " : "", k);
    }
    const std::string out = check(halves() + settle_stage + "install = [" + install + "]\n" + bolts);
    const auto count = [&](const std::string& what) {
      int found = 0;
      for (const std::string& line : lines_of(out))
        found += holds(line, what);
      return found;
    };
    EXPECT_EQ(count("1 of 1 overlap another bolt"), again) << out;
    EXPECT_EQ(count("1 of 1 are in the plane of a joint ('bed')"), in_joint) << out;
  }
}

TEST_F(Messages, FansOfMoreThanAWholeTurnAreRefused) {
  const auto fan = [](double from, double to) {
    return fmt::format(
        "[[bolts]]\nname = \"roof\"\nstiffness = 1e8\nfan = {{ centre = [20, 18], start = 1, length = 5, "
        "from_deg = {}, to_deg = {}, spacing_deg = 30 }}\n",
        from, to);
  };
  const std::string scene = halves() + settle_stage + "install = [\"roof\"]\n";
  refused(scene + fan(-10, 360), "to_deg");
  refused(scene + fan(-360, 360), "more than 360 degrees beyond from_deg");
  EXPECT_FALSE(holds(check(scene + fan(-180, 150)), "overlap another"));
  EXPECT_TRUE(holds(check(scene + fan(0, 360)), "1 of 13 overlap another bolt"));
}

// the steps that `check` forecasts for a stage
double steps_of(const std::string& out, const std::string& stage) {
  std::smatch found;
  const std::regex line(stage + R"(: steps of \S+ s, \w+ \w+ (\S+) of them|)" + stage +
                        R"(: steps of \S+ s, about (\S+) of them)");
  if (!std::regex_search(out, found, line)) return -1;
  return std::stod(found[1].matched ? found[1] : found[2]);
}

TEST_F(Messages, LiningsCostTheSquareOfTheirNodes) {
  using namespace lined_opening;
  const std::string scene = rock + held + shell + lined_opening::stage("weight", "gravity_ramp_s = 0.01") +
                            lined_opening::stage("line", "excavate = [\"tunnel\"]\ninstall = [\"shell\"]");
  for (const int nodes : {48, 200, 600}) {
    const std::string out = check(scene, fmt::format("--set statics=adaptive --set linings.shell.nodes={}", nodes));
    // printed with one digit: 1.5 as 1
    EXPECT_GE(1.5 * steps_of(out, "line"), nodes * nodes) << out;
  }
  // the stiffest mode does not limit Newton's method
  EXPECT_LT(steps_of(check(scene, "--set linings.shell.nodes=600 --set statics='\"newton\"'"), "line"), 1e5);
  // 60 beams of 0.31 m
  const std::string shorter = "are much shorter than the lining is thick";
  EXPECT_TRUE(holds(check(scene, "--set linings.shell.nodes=60 --set linings.shell.thickness=1"), shorter));
  EXPECT_FALSE(holds(check(scene, "--set linings.shell.nodes=60 --set linings.shell.thickness=0.9"), shorter));
}

// random bolts of every kind through random joints, as they are installed and after each block has moved by itself
TEST(BoltLines, RunFromCollarToToe) {
  std::mt19937 random(22);
  std::uniform_real_distribution<double> at(2, 38), share(0, 1);
  const char* const kinds[] = {"stiffness = 1e8\n", "kind = \"end_anchored\"\naxial_stiffness = 1e8\n",
                               "kind = \"grouted\"\naxial_stiffness = 1e8\nbond_stiffness = 5e8\n"};
  int drawn = 0;
  for (int trial = 0; trial < 30; ++trial) {
    std::string scene = plane() + "domain = { box = { min = [0, 0], max = [40, 40] } }\n";
    for (int k = 0; k < 1 + trial % 4; ++k)
      scene += fmt::format("[[joints]]\nname = \"j{}\"\ndip = {}\ndip_direction = 90\npoint = [20, {}]\n", k,
                           40 * share(random), 5 + 9 * k);
    const Vector<2> collar(at(random), 1), toe(at(random), 39);
    scene += fmt::format("[[bolts]]\nname = \"b\"\nfrom = [{}, {}]\nto = [{}, {}]\n{}", collar[0], collar[1], toe[0],
                         toe[1], kinds[trial % 3]);
    scene += settle_stage + "install = [\"b\"]\n";
    const Prepared<2> prepared = prepare<2>(parse_scene(scene, "scene.toml", {}));
    State<2> state = prepared.state;
    install_bolts(prepared.model, {"b"}, state);
    if (state.supports.bolt_springs.empty()) continue;
    const auto moved = [&](const Vector<2>& point, int body) {
      const Motion<2>& m = state.bodies.motions[body];
      const Vector<2> centroid = prepared.model.origin + prepared.model.bodies[body].reference;
      return Vector<2>(centroid + m.displacement + matrix(m.rotation) * (point - centroid));
    };
    const int first = state.supports.bolt_springs.front().body_a, last = state.supports.bolt_springs.back().body_b;
    for (int step = 0; step < 2; ++step) {
      const PolyData lines = bolt_lines(prepared.model, state, 0);
      const auto end = [&](std::size_t cell, int which) {
        const auto& p = lines.points[lines.cells[cell][which]];
        return Vector<2>(p[0], p[1]);
      };
      ASSERT_FALSE(lines.cells.empty());
      EXPECT_LT((end(0, 0) - moved(collar, first)).norm(), 1e-9) << scene;
      EXPECT_LT((end(lines.cells.size() - 1, 1) - moved(toe, last)).norm(), 1e-9) << scene;
      double length = 0;
      for (std::size_t c = 0; c < lines.cells.size(); ++c) {
        length += (end(c, 1) - end(c, 0)).norm();
        if (c > 0) {
          EXPECT_LT((end(c, 0) - end(c - 1, 1)).norm(), 1e-9) << scene;
        }
      }
      if (step == 0) {
        EXPECT_NEAR(length, (toe - collar).norm(), 1e-9) << scene;
      }
      ++drawn;
      for (Motion<2>& m : state.bodies.motions) {
        m.displacement += Vector<2>(share(random), share(random));
        m.rotation.angle += 0.1 * share(random);
      }
    }
  }
  EXPECT_GT(drawn, 40);
}

// ---- names ----------------------------------------------------------------------------------------------------------

TEST(BodyTitle, UsesTheNamesOfTheScene) {
  const lined_opening::Cast cast;
  EXPECT_EQ(title_of(cast.model, cast.body(1)), "node 2 of lining 'shell'");
  for (std::size_t b = 0; b < cast.scene.model.bodies.size(); ++b) {
    const std::string title = title_of(cast.model, static_cast<int>(b));
    EXPECT_TRUE(title.starts_with("of joint left, tunnel face") || title.starts_with("of joints ")) << title;
  }
  Model<2> model = cast.model;
  model.bodies[0].name = "key";
  EXPECT_EQ(title_of(model, 0), "key");
  model.bodies[0].name.clear();
  for (Polytope<2>& part : model.bodies[0].parts)
    std::ranges::fill(part.joints, no_joint);
  EXPECT_TRUE(title_of(model, 0).starts_with("at (")) << title_of(model, 0);
}

TEST_F(Messages, NumbersOfBlocksHaveTitles) {
  const std::string out = check(halves() + settle_stage);
  EXPECT_TRUE(holds(out, "block 0 (of joint bed)")) << out;
  const std::string falls = check(plane() + "domain = { box = { min = [0, 0], max = [1, 1] } }\n" + settle_stage);
  EXPECT_TRUE(std::regex_search(falls, std::regex(R"(block 0 \(at \(0\.5, 0\.5\) m\) has no neighbour)"))) << falls;
}

TEST_F(Messages, AStudysWarningsNameTheirRows) {
  write("scene.toml",
        halves() + settle_stage + "[[monitors]]\nname = \"top\"\nquantities = [\"displacement\"]\nabove = [\"bed\"]\n");
  write("study.toml",
        "scene = \"scene.toml\"\nquantity = \"top_displacement_y\"\n[[sweep]]\nname = \"density\"\nkey = \"density\"\n"
        "values = [2000, 20000, 30000]\n");
  const Ended ended = run("study study.toml --out s --jobs 1");
  EXPECT_TRUE(holds(ended.err, "voussoir: warning: rows 3-4: (of row 3, the others alike) ")) << ended.err << ended.out;
  EXPECT_TRUE(holds(ended.err, "density = 20000: is unusual")) << ended.err;
  EXPECT_FALSE(holds(ended.err, "rows 1")) << ended.err;
}

TEST_F(Messages, AUnitOfOneIsNotPrinted) {
  write("scene.toml", halves() + settle_stage +
                          "[[stage]]\nname = \"c\"\nkind = \"reduce\"\nsearch = \"factor\"\nfrom_factor = 0.2\n"
                          "to_factor = 3\ntolerance_factor = 0.1\n");
  write("study.toml",
        "scene = \"scene.toml\"\nquantity = \"factor_of_safety\"\n[[sample]]\nname = \"all\"\nrows = 3\nseed = 1\nset "
        "= [\"joints.bed.dip_direction=90\"]\n"
        "keys = [{ key = \"joints.bed.dip\", law = \"uniform\", least = 20, most = 30 }]\n");
  const Ended ended = run("study study.toml --out s --jobs 1");
  EXPECT_TRUE(holds(ended.out, "deviation ")) << ended.out << ended.err;
  EXPECT_FALSE(std::regex_search(ended.out, std::regex(R"(deviation \S+ 1\b)"))) << ended.out;
}

}  // namespace
}  // namespace voussoir
