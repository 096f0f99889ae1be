// The slumping slope S0 by rigid-block limit analysis, by blocks that slip without opening and by the distinct element
// method: the angle at which it fails, and the blocks that move.
#include <gtest/gtest.h>

#include <cmath>

#include "app/limit/limit_analysis.hpp"
#include "cases/case_tools.hpp"
#include "cases/slump/collapse.hpp"
#include "reference/slump/elastoplastic.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::slump_test {
namespace {

using verification::CaseReport;
using verification::Kind;

// as scene.toml states it
const reference::LayeredSlope slope{60 * degree, 5 * degree, 4, 8, 50, 3, 2500, 9.81, 10e9, 10e9};
constexpr int blocks_of_a_layer = 7;
constexpr double drawn_motion = 4;  // m, of the fastest corner in the figure

reference::SlopeCollapse without_dilation() {
  return reference::elastoplastic_collapse(slope, 60 * degree, 5 * degree, 0.0005 * degree);
}

LimitAnalysis<2> by_limit_analysis() {
  return analyse_limit<2>(load_scene(std::filesystem::path(VOUSSOIR_CASE_DIR) / "scene.toml"), {.with_dilation = true});
}

double expected_deg(const reference::SlopeCollapse& collapse) {
  return 0.5 * (collapse.stands + collapse.collapses) / degree;
}

// per metre that the fastest corner moves, 1/m, counter-clockwise
double mean_turn_of_outer_layer(const reference::SlopeCollapse& collapse) {
  double turning = 0;
  for (const reference::SlopeBlockMotion& block : collapse.motion)
    if (block.layer == 0) turning += block.turn / blocks_of_a_layer;
  return turning;
}

bool in_outer_layer(const Vector<2>& place) {
  return place[0] * std::sin(slope.dip) - place[1] * std::cos(slope.dip) < slope.thickness;
}

// closed outlines, blocks separated by an empty line for gnuplot
class Outlines {
 public:
  explicit Outlines(const std::string& file) : out_(verification::case_output("slump") / file) { out_ << "x_m,y_m\n"; }

  // moved and rotated about its centroid
  void add(const Model<2>& model, const Body<2>& body, const Vector<2>& move, double turn) {
    const Polytope<2>& part = body.parts.front();
    for (const int vertex : closed_ring(part)) {
      const Vector<2> p = model.origin + body.reference + move + matrix(Rotation<2>{turn}) * part.vertices[vertex];
      out_ << p[0] << ',' << p[1] << '\n';
    }
    out_ << '\n';
  }

 private:
  std::ofstream out_;
};

double largest_corner_speed(const LimitAnalysis<2>& analysis) {
  double largest = 0;
  for (const BlockMotion<2>& moving : analysis.mechanism.moving) {
    const BodyVelocity<2>& v = analysis.state.velocities[moving.body];
    for (const Vector<2>& corner : analysis.model.bodies[moving.body].parts.front().vertices)
      largest = std::max(largest, (v.velocity + cross(v.spin, corner)).norm());
  }
  return largest;
}

void draw(const LimitAnalysis<2>& analysis, const reference::SlopeCollapse& collapse) {
  Outlines fixed("fixed.csv"), free("free.csv"), mechanism("mechanism.csv"), plastic("plastic.csv");
  const Model<2>& model = analysis.model;
  const double far = drawn_motion / largest_corner_speed(analysis);
  for (const Body<2>& body : model.bodies)
    (body.fixed ? fixed : free).add(model, body, {0, 0}, 0);
  std::vector<const Body<2>*> outer;  // from the base upwards
  for (const BlockMotion<2>& moving : analysis.mechanism.moving) {
    const Body<2>& body = model.bodies[moving.body];
    const BodyVelocity<2>& v = analysis.state.velocities[moving.body];
    mechanism.add(model, body, far * v.velocity, far * v.spin[0]);
    outer.push_back(&body);
  }
  std::sort(outer.begin(), outer.end(), [](const auto* a, const auto* b) { return a->reference[1] < b->reference[1]; });
  for (const reference::SlopeBlockMotion& block : collapse.motion)
    if (block.layer == 0)
      plastic.add(model, *outer.at(block.row), drawn_motion * Vector<2>(block.x, block.y), drawn_motion * block.turn);
}

TEST(Slump, FailsAtTheAngleOfBlocksThatDoNotDilate) {
  CaseReport report("slump", {"critical friction, limit analysis", "blocks that move, limit analysis"});
  const LimitAnalysis<2> analysis = by_limit_analysis();
  ASSERT_EQ(analysis.status, LimitStatus::found);
  const reference::SlopeCollapse collapse = without_dilation();
  const double expected = expected_deg(collapse);
  report.reference("critical_friction", expected, "deg");
  report.record({"critical friction, limit analysis",
                 "deg",
                 Kind::limit,
                 "elastic, perfectly plastic blocks without dilation, reference/slump",
                 expected,
                 {0.0003, 0},
                 "half the reference's bracket, 0.00025; its trials leave up to 1e-7 of a block's weight at each of 63 "
                 "freedoms, with 0.3 weights per degree: 0.00002; limit analysis is bracketed to 1e-6"},
                analysis.values.front().second.value);

  report.report("duality gap, limit analysis", "1", analysis.evidence.gap,
                "of the force that is missing at the lower end of the bracket, in weights of a block; summed from the "
                "program's own numbers");
  EXPECT_LT(analysis.evidence.gap, 1e-3 * analysis.values.back().second.value) << "or the lower end is not proven";

  // only the outer layer moves, and its blocks rotate alike
  int outer = 0;
  double least = 1e300, most = -1e300;
  for (const BlockMotion<2>& moving : analysis.mechanism.moving) {
    const Vector<2> place = analysis.model.origin + analysis.model.bodies[moving.body].reference;
    EXPECT_TRUE(in_outer_layer(place)) << "block " << moving.body;
    ++outer;
    least = std::min(least, analysis.state.velocities[moving.body].spin[0]);
    most = std::max(most, analysis.state.velocities[moving.body].spin[0]);
  }
  report.record({"blocks that move, limit analysis",
                 "1",
                 Kind::limit,
                 "geometry: the outer layer: seven blocks",
                 blocks_of_a_layer,
                 {0, 0},
                 "a count"},
                outer);
  EXPECT_LT(most - least, 1e-6 * std::abs(least)) << "the layer's blocks rotate alike";
  for (const reference::SlopeBlockMotion& block : collapse.motion)
    EXPECT_EQ(block.layer == 0, block.largest > 0.1) << "layer " << block.layer << ", row " << block.row;

  // their rates of rotation differ: dilation lifts every block off the one below
  const std::string note = "per metre that the fastest corner moves; mean of the outer layer's blocks";
  report.report("turn of the outer layer, limit analysis", "1/m", least / largest_corner_speed(analysis), note);
  report.report("turn of the outer layer, without dilation", "1/m", mean_turn_of_outer_layer(collapse), note);
  report.report("fraction of rotation in the kinetic energy, limit analysis", "1", analysis.mechanism.rotation_fraction,
                "each block about its own centroid; the rest is translation of the centroids");
  draw(analysis, collapse);
}

// checks that the slope fails at the angle and by the mechanism of the reference; returns the blocks' motions
template <int Dim>
std::vector<CollapsedBlock> judge_collapse(CaseReport& report, const std::string& name, const Collapse<Dim>& collapse) {
  const reference::SlopeCollapse sought = without_dilation();
  report.record({"critical friction, " + name,
                 "deg",
                 Kind::limit,
                 "elastic, perfectly plastic blocks without dilation, reference/slump",
                 expected_deg(sought),
                 {0.2, 0},
                 "half the short search's bracket is 0.175; its last trials are 0.14 below and 0.21 above the "
                 "reference, farther than the 0.1 by which elastic corners raise the angle (README)"},
                value(collapse.run, "critical_friction"), cost(collapse.run));
  const std::vector<CollapsedBlock> moved = motions_at_collapse(collapse);
  double most = 0;
  for (const CollapsedBlock& block : moved)
    most = std::max(most, block.largest);
  int outer = 0, backwards = 0;
  double turning = 0;
  for (const CollapsedBlock& block : moved) {
    const bool moves = block.largest > 0.1 * most;  // as the reference's blocks are distinguished
    EXPECT_EQ(moves, in_outer_layer(block.place)) << "block " << block.body << " moved by " << block.largest << " m";
    if (!moves) continue;
    ++outer;
    if (block.turn < 0) ++backwards;
    turning += block.turn / (blocks_of_a_layer * most);
  }
  const std::string source = "geometry: the outer layer: seven blocks";
  report.record({"blocks that move, " + name, "1", Kind::limit, source, blocks_of_a_layer, {0, 0}, "a count"}, outer);
  report.record({"blocks that turn backwards, " + name, "1", Kind::limit, source, blocks_of_a_layer, {0, 0}, "a count"},
                backwards);
  report.record(
      {"turn of the outer layer, " + name,
       "1/m",
       Kind::limit,
       "elastic, perfectly plastic blocks without dilation, reference/slump",
       mean_turn_of_outer_layer(sought),
       {0, most / slope.thickness},
       "per metre that the fastest corner moves, mean of the layer's blocks: a mechanism of one freedom, whose "
       "geometry changes by as much as it has moved, in thicknesses of the layer"},
      turning);
  return moved;
}

void draw_collapse(const Collapse<2>& collapse, const std::vector<CollapsedBlock>& moved) {
  Outlines fixed("dem_fixed.csv"), before("dem_before.csv"), after("dem_after.csv");
  const Model<2>& model = collapse.model();
  for (const Body<2>& body : model.bodies)
    if (body.fixed) fixed.add(model, body, {0, 0}, 0);
  double most = 0;
  for (const CollapsedBlock& block : moved)
    most = std::max(most, block.largest);
  const double magnified = drawn_motion / most;
  for (const CollapsedBlock& block : moved) {
    const Body<2>& body = model.bodies[block.body];
    before.add(model, body, {0, 0}, 0);
    after.add(model, body,
              magnified * (collapse.failed.bodies.motions[block.body].displacement -
                           collapse.settled.bodies.motions[block.body].displacement),
              magnified * block.turn);
  }
}

// a short search, so that every build can afford it
TEST(Slump, FailsByDistinctElements) {
  CaseReport report("slump", {"critical friction, DEM", "blocks that move, DEM", "blocks that turn backwards, DEM",
                              "turn of the outer layer, DEM"});
  const Collapse<2> collapse =
      run_to_collapse<2>("scene.toml", {"stage.critical.to_deg=15.2", "stage.critical.tolerance_deg=0.4"});
  draw_collapse(collapse, judge_collapse(report, "DEM", collapse));
}

TEST(Slump, FailsByDistinctElementsOnIntegratedFaces) {
  CaseReport report("slump", {"critical friction, DEM, whole faces"});
  judge_collapse(report, "DEM, whole faces",
                 run_to_collapse<2>("scene.toml",
                                    {"stage.critical.to_deg=15.2", "stage.critical.tolerance_deg=0.4", whole_faces}));
}

// Cases that relaxation alone cannot decide: the slide moves far before equilibrium, or flutters. The angles are 0.37
// degrees above the reference, with a slope known to be stable, and 0.23 below it, with one known to fail.
void judge_hard_search(const std::string& name, const std::vector<std::string>& overrides) {
  CaseReport report("slump");
  const SceneRun done = run("scene.toml", overrides);
  const double bar = *done.results.find("critical_friction")->error_bar;
  report.record({"critical friction, " + name,
                 "deg",
                 Kind::limit,
                 "elastic, perfectly plastic blocks without dilation, reference/slump",
                 expected_deg(without_dilation()),
                 {bar + 0.13, 0},
                 "half the bracket, and the effect of the failure displacement: 15.22 at 0.2 m and 10 GPa/m (README)"},
                value(done, "critical_friction"), cost(done));
  EXPECT_LE(bar, 0.301);
}

const std::vector<std::string> stiff{"joint_properties.rock.normal_stiffness=100e9",
                                     "joint_properties.rock.shear_stiffness=100e9"},
    default_displacement{"stage.critical.failure_displacement=0"};

std::vector<std::string> in_a_short_search(std::vector<std::string> overrides) {
  for (const char* also :
       {"stage.critical.from_deg=15.7", "stage.critical.to_deg=15.1", "stage.critical.tolerance_deg=0.601"})
    overrides.emplace_back(also);
  return overrides;
}

TEST(Slump, FailsAtTenTimesTheStiffness) {
  judge_hard_search("ten times the stiffness", in_a_short_search(stiff));
}

TEST(Slump, FailsByTheDefaultFailureDisplacement) {
  judge_hard_search("default failure displacement", in_a_short_search(default_displacement));
}

TEST(SlumpLong, FailsAtTenTimesTheStiffnessByTheWholeSearch) {
  std::vector<std::string> overrides = stiff;
  overrides.emplace_back("stage.critical.tolerance_deg=0.2");
  judge_hard_search("ten times the stiffness, whole search", overrides);
}

TEST(SlumpLong, FailsByTheDefaultFailureDisplacementByTheWholeSearch) {
  judge_hard_search("default failure displacement, whole search", default_displacement);
}

// the scenes as committed
TEST(SlumpLong, FailsByTheWholeSearch) {
  CaseReport report("slump");
  judge_collapse(report, "DEM, whole search", run_to_collapse<2>("scene.toml"));
}

TEST(SlumpLong, FailsAsASliceInSpace) {
  CaseReport report("slump");
  judge_collapse(report, "DEM, slice in space", run_to_collapse<3>("slice.toml"));
}

}  // namespace
}  // namespace voussoir::cases::slump_test
