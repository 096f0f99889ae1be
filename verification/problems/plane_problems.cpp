// Problems in the plane: prisms along y of 1 m.
#include <cmath>
#include <numbers>

#include "text/angle.hpp"
#include "verification/problems/common.hpp"
#include "verification/problems/problems.hpp"
#include "verification/problems/solid.hpp"

namespace voussoir::problems {
namespace {

constexpr double metre_deep = 1;  // m

Solid fixed_box(const std::string& name, double density, const Point& least, const Point& greatest) {
  Solid block = box(name, density, least, greatest);
  block.fixed = true;
  return block;
}

}  // namespace

Problem rocking() {
  Problem p;
  p.name = "rocking";
  p.title = "Slender block that rocks on its corners";
  p.dimension = 2;
  constexpr double breadth = 1, height = 4;
  const double lean = 0.5 * std::atan(breadth / height);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(lean, Point::UnitY()));
  Solid block = turned(box("block", 2500, {-breadth, -metre_deep / 2, 0}, {0, metre_deep / 2, height}), turn);
  p.blocks = {fixed_box("slab", 2500, {-6, -metre_deep / 2, -1}, {6, metre_deep / 2, 0}), block};
  p.joints = {one_joint(45, stiff_joint, {})};
  p.gravity = {{0, {0, 0, -standard_gravity}}};
  p.duration = 1.5;
  p.output = 0.005;
  p.asked = {
      {"time of the first impact", "s", "first time at which the block is upright, interpolated between output times"},
      {"ratio of turning speeds, first impact", "1",
       "turning speed after the impact over that before it, each carried to the upright position by the energy: "
       "(w2 + 2 g R (cos(alpha - |lean|) - cos alpha) m/I)^1/2"}};
  const std::string time_because =
      "a rigid block: 1 ms is two steps of 0.5 ms, one for the release and one for the reading";
  const std::string elastic_because =
      "a block on a joint of 100 GPa/m: the corner's sinking before the release, which the closed form has, may be "
      "left "
      "out and is then an error of 1.5 ms; 0.1 ms for the reading";
  const std::string ratio_because =
      "all of the impact is at the far corner; 0.002 of the ratio are 0.4 % of the energy after the impact, as much as "
      "steps of 1 to 2 ms lose";
  p.references = {{"time of the first impact", Reference{"rocking", "quarter period", {}, 1.6e-3, 0, elastic_because},
                   Reference{"rocking", "quarter period, rigid base", {}, 1e-3, 0, time_because}},
                  {"ratio of turning speeds, first impact",
                   {},
                   Reference{"rocking", "restitution of the first impact", {}, 2e-3, 0, ratio_because}}};
  p.dimensions = {{{0.2, 0, 0}, turn * Point(0.2, 0, height), "4 m"},
                  {{-6, 0, -1.4}, {6, 0, -1.4}, "12 m"},
                  {turn * Point(-1, 0, height + 0.3), turn * Point(0, 0, height + 0.3), "1 m"}};
  p.words.model =
      "A block of 1 x 4 m (1 m deep, 2500 kg/m3) leans to +x on its lower right corner, the origin, by half its "
      "slenderness: 7.018 deg, with tan alpha = 1/4. It is released at rest, rights itself, meets the slab with its "
      "whole "
      "face and rocks on over its other corner. The corners do not slip.";
  p.words.measured =
      "Lean and turning speed every 5 ms. The time of the first impact is that of lean zero. The ratio: with R half "
      "the "
      "diagonal and I = 4/3 m R2 about the corner, each speed is carried to the upright position, four output times "
      "before and twenty after the impact.";
  p.words.protocol = "No search: full gravity from the start, no damping, restitution 0. Friction angle 45 deg.";
  p.words.two_answers =
      "The time is asked of all codes. The ratio is asked of rigid codes alone: with joint stiffness the impact is an "
      "elastic bounce of the joint and the ratio another, so such codes write `cannot state`.";
  p.words.tolerance =
      "Time: " + time_because + ". With joint stiffness: " + elastic_because + ". Ratio: " + ratio_because + ".";
  return p;
}

Problem arch() {
  Problem p;
  p.name = "arch";
  p.title = "Least thickness of a semicircular arch of 15 flat voussoirs";
  p.dimension = 2;
  constexpr int count = 15;
  constexpr double radius = 5, thickness = 0.6;
  Search search;
  search.parameter = "thickness_m";
  search.lower = 0.25;
  search.upper = 1.5;
  search.tolerance = 0.0025;
  search.kind = SearchKind::vertices;
  search.nominal = thickness;
  const auto out = [](double angle) { return Point(-std::cos(angle), 0, std::sin(angle)); };
  for (int k = 0; k < count; ++k) {
    const double left = std::numbers::pi * k / count, right = std::numbers::pi * (k + 1) / count;
    const double inside = radius - thickness / 2, outside = radius + thickness / 2;
    const Point corners[] = {inside * out(left), inside * out(right), outside * out(right), outside * out(left)};
    std::vector<std::pair<double, double>> polygon;
    for (const Point& c : corners)
      polygon.emplace_back(c[0], c[2]);
    const std::string name = "voussoir_" + std::to_string(k + 1);
    p.blocks.push_back(prism(name, 2500, polygon, metre_deep));
    // both ends of the prism, in the order of its corners
    for (int end = 0; end < 2; ++end)
      for (const auto& [angle, sign] : {std::pair{left, -0.5}, {right, -0.5}, {right, 0.5}, {left, 0.5}})
        search.change[name].push_back(sign * out(angle));
  }
  p.blocks.push_back(fixed_box("left abutment", 2500, {-6.25, -metre_deep / 2, -1}, {-3.75, metre_deep / 2, 0}));
  p.blocks.push_back(fixed_box("right abutment", 2500, {3.75, -metre_deep / 2, -1}, {6.25, metre_deep / 2, 0}));
  p.joints = {one_joint(45, stiff_joint, {})};
  p.gravity = grown({0, 0, -standard_gravity});
  p.duration = 6;
  p.search = search;
  p.criterion = Criterion{"falls", "any block", {}, 0, 0.3};
  p.asked = {{"least thickness", "m", "middle of the last bracket of the search over thickness_m"}};
  const std::string rigid_because =
      "half the bracket of 2.5 mm; an arch 0.5 % too thin lacks some 5e-4 of its weight, and its fall grows with "
      "(g/R)^1/2 = 1.4 1/s: to 1 m in 5 s";
  const std::string elastic_because =
      "half the bracket of 2.5 mm; the reference is shown to 0.5 % by arches that stand above and come down below it; "
      "the time to fall as for rigid codes, 0.5 %";
  p.references = {
      {"least thickness",
       Reference{"arch", "arch of the problem files: least thickness, 100 GPa/m", {}, 0.0013, 0.01, elastic_because},
       Reference{"arch", "least thickness, limit analysis", {}, 0.0013, 0.005, rigid_because}}};
  p.dimensions = {
      {{0, 0, 0}, {radius * std::cos(std::numbers::pi / 3), 0, radius * std::sin(std::numbers::pi / 3)}, "R = 5 m"},
      {{-5.3, 0, 0.6}, {-4.7, 0, 0.6}, "t"}};
  p.words.model =
      "A semicircular arch of 15 equal voussoirs with flat faces, radius 5 m to the middle of the joints (which are "
      "radial), 1 m deep, 2500 kg/m3, between fixed abutments. Its thickness is sought; blocks.json lists it at 0.6 m "
      "and says by how much every corner moves with the thickness.";
  p.words.measured = "A trial fails if any block is more than 0.3 m from its place within 6 s.";
  p.words.protocol =
      "Gravity grows from nothing to 9.81 m/s2 within 1 s and is held until 6 s. Bisection of the thickness between "
      "0.25 "
      "and 1.5 m to 2.5 mm, each trial from the beginning. Friction angle 45 deg: no sliding.";
  p.words.two_answers =
      "One answer. With joint stiffness use the stiff joints (100 GPa/m): the hinges then turn about a pressed length, "
      "and the arch must be thicker.";
  p.words.tolerance = "Rigid: " + rigid_because + ". Elastic: " + elastic_because + ".";
  return p;
}

Problem bonded_beam() {
  Problem p;
  p.name = "bonded_beam";
  p.title = "Cantilever of one block, glued to a wall";
  p.dimension = 2;
  constexpr double length = 1, height = 0.5, density = 2500;
  p.blocks = {fixed_box("wall", density, {-1, -metre_deep / 2, -1}, {0, metre_deep / 2, 1}),
              box("beam", density, {0, -metre_deep / 2, -height / 2}, {length, metre_deep / 2, height / 2})};
  JointOf joint = one_joint(30, {1e9, 1e9}, Stiffness{1e9, 1e9});
  joint.cohesion = 1e6;
  joint.tension = 300e3;
  p.joints = {joint};
  p.gravity = grown({0, 0, -standard_gravity});
  p.duration = 3;
  Search search;
  search.parameter = "tension_Pa";
  search.lower = 50e3;
  search.upper = 300e3;
  search.tolerance = 500;
  search.kind = SearchKind::tension;
  p.search = search;
  p.criterion = Criterion{"falls", "beam", {}, 0, 0.1};
  p.asked = {
      {"least tensile strength, stated joints", "Pa", "middle of the last bracket of the search over tension_Pa"},
      {"rotation, stated joints", "rad",
       "rotation of the beam at rest under its weight, tension 300 kPa; "
       "positive where the free end sinks"},
      {"drop of the centre, stated joints", "m",
       "displacement of the beam's centre, down positive, at rest, tension 300 kPa"}};
  const std::string strength_because =
      "bracket of 500 Pa; where the joint is cut into n equal parts, the outermost of them has its stress at its own "
      "middle and is 1/n below the edge's: 5 % for 20 parts; the swing that gravity's growth leaves is below 1 %";
  const std::string small_because =
      "n equal parts of the joint have 1 - 1/n2 of its stiffness in bending: 1 % for 10 parts; equilibrium to 1e-3";
  const auto row = [](const std::string& name) { return "block glued to a wall: " + name; };
  p.references = {
      {"least tensile strength, stated joints",
       Reference{"jointedbeam", row("least tensile strength"), {}, 500, 0.06, strength_because},
       {}},
      {"rotation, stated joints", Reference{"jointedbeam", row("rotation"), {}, 0, 0.011, small_because}, {}},
      {"drop of the centre, stated joints",
       Reference{"jointedbeam", row("drop of the centre"), {}, 0, 0.011, small_because},
       {}}};
  p.dimensions = {{{0, 0, 0.4}, {1, 0, 0.4}, "1 m"}, {{1.15, 0, -0.25}, {1.15, 0, 0.25}, "0.5 m"}};
  p.words.model =
      "A block of 1 x 0.5 m (1 m deep, 2500 kg/m3) is glued to a vertical wall by its left face alone: cohesion 1 MPa, "
      "tensile strength T, stiffness 1 GPa/m normal and in shear, spread over the face. The bond is brittle: where the "
      "tension reaches T it is gone.";
  p.words.measured =
      "Rotation and displacement of the rigid block at rest, with T = 300 kPa. The least T: a trial fails if the "
      "beam's "
      "centre has fallen by 0.1 m within 3 s.";
  p.words.protocol =
      "Gravity grows from nothing to 9.81 m/s2 within 1 s, and is held. Bisection of T between 50 and 300 kPa to 500 "
      "Pa, "
      "each trial from the beginning with a whole bond. Damping of the code's own choice, stated.";
  p.words.two_answers =
      "Only the stated joints: rotation and displacement are those of the joint's springs. A code without stiffness "
      "per area "
      "or without a bond writes `cannot state`.";
  p.words.tolerance = "Strength: " + strength_because + ". Rotation and drop: " + small_because + ".";
  return p;
}

Problem bolted_block() {
  Problem p;
  p.name = "bolted_block";
  p.title = "Block on a plane of 40 deg under a bolt that has yielded";
  p.dimension = 2;
  // the scene of cases/support: a square cut by a plane of 40 deg through its middle
  constexpr double density = 5096.839959, dip = 40, half = 1;
  const double drop = std::tan(dip * degree);
  p.blocks = {prism("block", density, {{-half, drop}, {half, -drop}, {half, half}, {-half, half}}, metre_deep),
              prism("base", density, {{-half, -half}, {half, -half}, {half, -drop}, {-half, drop}}, metre_deep)};
  p.blocks.back().fixed = true;
  p.joints = {one_joint(35, Stiffness{1e9, 5e8}, {})};
  p.gravity = grown({0, 0, -standard_gravity});
  p.duration = 3.5;
  const Point in_block(0.6893654, 0, -0.1215537), in_base(-0.6893654, 0, 0.1215537);
  const double yield_force = 20e3;
  p.bolts = {{"bolt", "block", "base", in_block, in_base, 1e9, yield_force}};
  p.forces = {{"block", yield_force * (in_base - in_block).normalized(), in_block, {0, 1}, {0, 1}}};
  Search search;
  search.parameter = "friction_deg";
  search.lower = 20;
  search.upper = 40;
  search.tolerance = 0.01;
  p.search = search;
  p.criterion = Criterion{"accelerates", "block", {1.5, 2.5, 3.5}, 5e-4, 0.3};
  p.asked = {{"critical friction", "deg", "middle of the last bracket of the search over friction_deg"}};
  const std::string because =
      "bracket of 0.01 deg; the criterion of 5e-4 m/s2 is 0.003 deg; the bolt's spring stretches by 0.02 mm until it "
      "yields; slip by 10 mm turns the bolt by 0.4 deg, 0.02 deg of friction";
  const Reference reference{"support", "critical friction of the bolted block", {}, 0.04, 0, because};
  p.references = {{"critical friction", reference, reference}};
  p.dimensions = {
      {{-1, 0, 1.2}, {1, 0, 1.2}, "2 m"}, {{1.2, 0, -1}, {1.2, 0, 1}, "2 m"}, {in_block, in_base, "bolt, 20 kN"}};
  p.words.model =
      "A square of 2 x 2 m (1 m deep) is cut by a plane of 40 deg through its middle; the part below is fixed, the "
      "block "
      "above weighs 100 kN. A bolt at 30 deg to the plane pulls the block down and into the slope. It yields at 20 kN "
      "within 0.03 mm of slip: `bolts` states it as a spring, `loads` as the force that it has once it yields. Use one "
      "of the two, never both.";
  p.words.measured = "As for the incline: 0.5 mm more in the last second than in the one before, or 0.3 m off.";
  p.words.protocol =
      "Gravity grows from nothing to 9.81 m/s2 within 1 s and is held until 3.5 s; the bolt's force as given load "
      "grows "
      "with it. Bisection of the friction angle between 20 and 40 deg to 0.01 deg, each trial from the beginning.";
  p.words.two_answers = "One answer: force balance of a block that slides does not know the joint's stiffness.";
  p.words.tolerance = because + ".";
  return p;
}

}  // namespace voussoir::problems
