// Stack over an edge: the largest overhang of equal blocks, in the plane and in space.
#include <gtest/gtest.h>

#include <cmath>

#include "cases/case_tools.hpp"
#include "cases/recorded_run.hpp"
#include "reference/small/overhang.hpp"
#include "text/angle.hpp"

namespace voussoir::cases {
namespace {

using reference::OverhangStack;
using verification::CaseReport;
using verification::Kind;

// as the scenes state it
constexpr double width = 0.5;  // m, in space
const OverhangStack stack{5, 1, 0.25, 2500 * 9.81 * 0.25, 1e10, 1e10};
constexpr double stated = 0.9648;  // fraction of the harmonic overhangs
constexpr double hard = 1e11;      // Pa/m

struct Variant {
  std::string scene, name, test;
  int dimension;
  double apart;                           // distance from the limit at which the stack is tried, as a fraction
  std::vector<std::string> carried = {};  // contact model of the faces: a scene's own points, or an override
};

void PrintTo(const Variant& v, std::ostream* out) {
  *out << v.name;
}

// overrides of a scene for a stack with this fraction of the overhang
std::vector<std::string> leaning(double fraction, int dimension) {
  const std::vector<double> overhangs = harmonic_overhangs(stack, fraction);
  std::vector<std::string> overrides;
  double right = 0;
  for (int j = stack.blocks; j >= 1; --j) {
    right += overhangs[j - 1];
    const double low = (stack.blocks - j) * stack.height;
    const auto corner = [&](double x, double y, double z) {
      return "[" + text(x) + (dimension == 3 ? ", " + text(y) : "") + ", " + text(z) + "]";
    };
    const std::string box = "blocks.block_" + std::to_string(j) + ".box.";
    overrides.push_back(box + "min=" + corner(right - stack.length, 0, low));
    overrides.push_back(box + "max=" + corner(right, width, low + stack.height));
  }
  return overrides;
}

SceneRun attempt(const Variant& v, double fraction, const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides = leaning(fraction, v.dimension);
  overrides.insert(overrides.end(), v.carried.begin(), v.carried.end());
  overrides.insert(overrides.end(), more.begin(), more.end());
  return run_scene(std::filesystem::path(VOUSSOIR_CASE_DIR) / v.scene, overrides);
}

// rad, outwards
double top_turn(const SceneRun& run, const Variant& v) {
  return (v.dimension == 3 ? value(run, "top_rotation_y") : -value(run, "top_rotation")) * degree;
}

bool stands(const SceneRun& run) {
  return run.results.outcome == Outcome::done;
}

// the top has rotated ten times as far as at the limit, and still rotates; beyond half a turn the sign of its rotation
// changes, and the run ends when the top has left the stack
bool falls(const SceneRun& run, const Variant& v) {
  return run.results.outcome == Outcome::incomplete &&
         std::abs(top_turn(run, v)) > 10 * elastic_overhang_limit(stack).turn;
}

class Overhang : public testing::TestWithParam<Variant> {};

TEST_P(Overhang, HasTheLimitOfElasticJoints) {
  const Variant& v = GetParam();
  const std::string above = "stands just below the limit, " + v.name, below = "falls just above the limit, " + v.name,
                    turned = "turn of the top block, " + v.name;
  CaseReport report("overhang", {above, below, turned});
  const reference::OverhangState limit = elastic_overhang_limit(stack);
  const std::string source = "rigid blocks on elastic joints, reference/small/overhang";

  const SceneRun standing = attempt(v, limit.fraction - v.apart), falling = attempt(v, limit.fraction + v.apart);
  const std::string because = text(v.apart) + " of the harmonic overhang from the limit, which is 0.0342 below it";
  report.record({above, "1", Kind::exact, source, 1, {0, 0}, because + "; it reaches equilibrium"}, stands(standing),
                cost(standing));
  report.record(
      {below, "1", Kind::exact, source, 1, {0, 0}, because + "; the top rotates ten times as far as at the limit"},
      falls(falling, v), cost(falling));

  // truncation of the reference: second order in the rotations, as a fraction of the effect of elasticity
  const SceneRun scene = run(v.scene, v.carried);
  const double expected = elastic_overhang(stack, stated).turn;
  const double left_out = limit.turn * limit.turn * (1 - limit.fraction);
  if (v.dimension == 3 && v.carried.empty()) report.reference("top_rotation_y", expected / degree, "deg");
  report.record({turned,
                 "rad",
                 Kind::exact,
                 source,
                 expected,
                 {elastic_overhang(stack, stated + left_out).turn - expected, 0},
                 "the reference's rotation if the fraction is larger by its truncation: the square of the rotation, "
                 "times the 0.0342 that elastic joints take away"},
                top_turn(scene, v), cost(scene));
}

INSTANTIATE_TEST_SUITE_P(
    All, Overhang,
    testing::Values(Variant{"plane.toml", "2-D", "Plane", 2, 0.0005}, Variant{"scene.toml", "3-D", "Space", 3, 0.001},
                    Variant{"plane.toml", "2-D, whole faces", "PlaneOnWholeFaces", 2, 0.0005, {whole_faces}},
                    Variant{"scene.toml", "3-D, whole faces", "SpaceOnWholeFaces", 3, 0.001, {whole_faces}}),
    [](const auto& chosen) { return chosen.param.test; });

// Stiff joints approach the rigid blocks of the closed form: L/2 (1 + 1/2 + … + 1/5).
TEST(OverhangOfHardBlocks, IsNearlyHarmonic) {
  CaseReport report("overhang", {"stands below the harmonic overhang", "falls above the harmonic overhang"});
  const Variant plane{"plane.toml", "2-D", "", 2, 0};
  const std::vector<std::string> joints{"joint_properties.dry.normal_stiffness=" + text(hard),
                                        "joint_properties.dry.shear_stiffness=" + text(hard)};
  OverhangStack harder = stack;
  harder.normal_stiffness = harder.shear_stiffness = hard;
  const double limit = elastic_overhang_limit(harder).fraction;
  constexpr double apart = 0.001;
  const SceneRun standing = attempt(plane, limit - apart, joints), falling = attempt(plane, 1 + apart, joints);
  const std::string source = "reference/small/overhang: harmonic overhangs, 1.1417 m together";
  report.record({"stands below the harmonic overhang",
                 "1",
                 Kind::limit,
                 source,
                 1,
                 {0, 0},
                 "joints of 100 GPa/m take away 1.6 % of it; 0.1 % less reaches equilibrium"},
                stands(standing), cost(standing));
  report.record({"falls above the harmonic overhang",
                 "1",
                 Kind::limit,
                 source,
                 1,
                 {0, 0},
                 "0.1 % above the limit of rigid blocks"},
                falls(falling, plane), cost(falling));
}

// closed outlines of the stack, and its forces, for the figure
void draw_stack() {
  const RecordedRun<2> run = record<2>("plane.toml");
  const State<2>& last = run.last();
  std::ofstream out(verification::case_output("overhang") / "stack.csv");
  out << "x_m,y_m\n";
  const Model<2>& model = run.model();
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].fixed) continue;
    for (const Vector<2>& corner :
         {Vector<2>(-1, -1), Vector<2>(1, -1), Vector<2>(1, 1), Vector<2>(-1, 1), Vector<2>(-1, -1)}) {
      const Vector<2> p = model.origin + model.bodies[b].reference + last.bodies.motions[b].displacement +
                          matrix(last.bodies.motions[b].rotation) *
                              Vector<2>(0.5 * corner[0] * stack.length, 0.5 * corner[1] * stack.height);
      out << p[0] << ',' << p[1] << '\n';
    }
    out << '\n';
  }
  std::vector<std::vector<double>> forces(3);
  for (std::size_t i = 0; i < last.contacts.list.size(); ++i) {
    const int a = model.parts[last.contacts.list[i].part_a].body;
    for (const SubContact<2>& sub : subs_of(last.contacts, i)) {
      if (!(sub.area > 0)) continue;
      const Vector<2> p = model.origin + model.bodies[a].reference + last.bodies.motions[a].displacement + sub.point;
      forces[0].push_back(p[0]);
      forces[1].push_back(p[1]);
      forces[2].push_back(sub.force.norm() / stack.weight);
    }
  }
  write_csv("overhang", "forces.csv", {"x_m", "y_m", "force_in_weights"}, forces);
}

TEST(OverhangFigure, IsDrawn) {
  const Variant plane{"plane.toml", "2-D", "", 2, 0};
  std::vector<double> fraction, turn, line, line_turn;
  for (const double s : {0.91, 0.93, 0.945, 0.955, 0.96, 0.963, stated}) {
    fraction.push_back(s);
    turn.push_back(to_degrees(top_turn(attempt(plane, s), plane)));
  }
  const double limit = elastic_overhang_limit(stack).fraction;
  for (int i = 0; i <= 100; ++i) {
    line.push_back(limit - 0.06 * std::pow(1 - i / 100.0, 3));
    line_turn.push_back(to_degrees(elastic_overhang(stack, line.back()).turn));
  }
  write_csv("overhang", "turn.csv", {"share", "turn_deg"}, {fraction, turn});
  write_csv("overhang", "theory.csv", {"share", "turn_deg"}, {line, line_turn});
  write_csv("overhang", "limit.csv", {"share", "turn_deg"}, {{limit, limit}, {0, 1}});
  draw_stack();
}

}  // namespace
}  // namespace voussoir::cases
