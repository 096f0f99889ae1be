// Problems of one block on a slab, in a groove, or alone.
#include <cmath>

#include "text/angle.hpp"
#include "verification/problems/common.hpp"
#include "verification/problems/problems.hpp"
#include "verification/problems/solid.hpp"

namespace voussoir::problems {
namespace {

// a slab whose top is the plane z = 0
Solid slab() {
  Solid block = box("slab", 2000, {-6, -3, -1}, {6, 3, 0});
  block.fixed = true;
  return block;
}

Criterion accelerates(const std::string& block) {
  return {"accelerates", block, {1.5, 2.5, 3.5}, 5e-4, 0.3};
}

constexpr double slab_angle = 20, cube_friction = 30, cube_speed = 1;  // deg, deg, m/s

}  // namespace

Problem sliding_cube() {
  Problem p;
  p.name = "sliding_cube";
  p.title = "Cube that slides down a slab, the whole problem turned";
  Solid cube = box("cube", 2000, {-0.5, -0.5, 0}, {0.5, 0.5, 1});
  cube.velocity = {cube_speed, 0, 0};
  p.blocks = {slab(), cube};
  p.joints = {one_joint(cube_friction, stiff_joint, {})};
  p.gravity = {{0, inclined_gravity(slab_angle)}};
  p.duration = 0.5;
  p.output = 0.05;
  p.positions.push_back({"as drawn", Eigen::Quaterniond::Identity()});
  for (int axis = 0; axis < 3; ++axis)
    for (const double angle : {15.0, 30.0, 45.0, 60.0, 90.0}) {
      const std::string name = std::string(1, "xyz"[axis]) + " " + std::to_string(static_cast<int>(angle));
      p.positions.push_back({name, Eigen::Quaterniond(Eigen::AngleAxisd(angle * degree, Point::Unit(axis)))});
    }
  const std::string how = "distance of the cube's centre at 0.5 s from its place at the start";
  p.asked = {{"path, as drawn", "m", how + ", in the position 'as drawn'"},
             {"path, least of the turned positions", "m", how + "; the least of the 15 turned positions"},
             {"path, greatest of the turned positions", "m", how + "; the greatest of the 15 turned positions"}};
  const std::string because =
      "a step of 2 ms of first order moves the place by half a step times 1 m/s: 1 mm; the joint's overlap under the "
      "weight and its growth while it slides stay below 1e-5 m";
  for (const Asked& asked : p.asked) {
    const Reference reference{"incline", "cube sent off at 1 m/s: " + asked.quantity, {}, 1.1e-3, 0, because};
    p.references.push_back({asked.quantity, reference, reference});
  }
  p.dimensions = {{{-0.5, -0.5, 1.2}, {0.5, -0.5, 1.2}, "1 m"},
                  {{0.7, -0.5, 0}, {0.7, -0.5, 1}, "1 m"},
                  {{-6, -3, -1.4}, {6, -3, -1.4}, "12 m"},
                  {{6.3, -3, -1}, {6.3, -3, 0}, "1 m"}};
  p.words.model =
      "A cube of 1 m slides on a fixed slab. Gravity is inclined by 20 deg to the slab's normal and acts in full from "
      "the start; the cube starts at 1 m/s down the slab. The friction angle of 30 deg is the same at rest and in "
      "motion. Then the whole problem (blocks, velocity, gravity) is turned about the origin by each quaternion of "
      "`positions`: the path must not change, because no direction of space is special.";
  p.words.measured = "The straight distance between the places of the cube's centre of mass at 0 s and at 0.5 s.";
  p.words.protocol = "No search. Full gravity from 0 s, no damping, restitution 0.";
  p.words.two_answers =
      "One answer. With joint stiffness use the stiff joints; the cube may first be let down on the slab, at a "
      "standstill "
      "across it.";
  p.words.tolerance = because + ".";
  return p;
}

Problem incline() {
  Problem p;
  p.name = "incline";
  p.title = "Cube on a slab under gravity that is inclined more and more";
  p.blocks = {slab(), box("cube", 2000, {-0.5, -0.5, 0}, {0.5, 0.5, 1})};
  p.joints = {one_joint(30, stiff_joint, {})};
  p.gravity = grown({0, 0, -standard_gravity});
  p.duration = 3.5;
  p.search = tilt_search(20, 40);
  p.criterion = accelerates("cube");
  p.asked = {{"critical tilt", "deg", "middle of the last bracket of the search over tilt_deg"}};
  const Reference reference{"incline",
                            "critical friction, 3-D",
                            {},
                            0.01,
                            0,
                            "half the bracket of 0.005 deg; the criterion, 0.5 mm more in 1 s, is 5e-4 m/s2, which "
                            "0.0025 deg give; twice the sum"};
  p.references = {{"critical tilt", reference, reference}};
  p.dimensions = {{{-0.5, -0.5, 1.2}, {0.5, -0.5, 1.2}, "1 m"}, {{-6, -3, -1.4}, {6, -3, -1.4}, "12 m"}};
  p.words.model =
      "A cube of 1 m on a fixed slab. The direction of gravity is inclined to the slab's normal by the tilt that is "
      "sought; the blocks are not moved. Friction angle 30 deg.";
  p.words.measured =
      "A trial fails if the cube moves by 0.5 mm more from 2.5 s to 3.5 s than from 1.5 s to 2.5 s, or if it is more "
      "than 0.3 m from its place at 3.5 s. A steady creep is therefore no failure; report it.";
  p.words.protocol = tilt_protocol;
  p.words.two_answers = "One answer: the tilt does not depend on the joint's stiffness.";
  p.words.tolerance = reference.because + ".";
  return p;
}

Problem toppling_block() {
  Problem p;
  p.name = "toppling_block";
  p.title = "Slender block that topples over its lower edge";
  p.blocks = {slab(), box("block", 2000, {-0.25, -0.25, 0}, {0.25, 0.25, 1})};
  p.joints = {one_joint(45, stiff_joint, Stiffness{1e9, 1e9})};
  p.gravity = grown({0, 0, -standard_gravity});
  p.duration = 3.5;
  p.search = tilt_search(15, 40);
  p.criterion = accelerates("block");
  p.asked = {{"critical tilt, stiff joints", "deg", "middle of the last bracket of the search over tilt_deg"},
             {"critical tilt, stated joints", "deg", "the same with the stated stiffness of the joint"}};
  const std::string rigid_because =
      "half the bracket of 0.005 deg, and an edge that is rounded or has a skin by r = 0.4 mm: 2 r/h cos2 = 0.037 deg; "
      "a larger one lowers the angle by 0.09 deg a mm and has to be stated";
  const std::string elastic_because =
      "the bracket of 0.005 deg, and a tenth of what the joint takes from the slope of a rigid block: gravity that "
      "grows within 1 s leaves a lean that swings about its balance";
  p.references = {
      {"critical tilt, stiff joints",
       Reference{
           "toppling", "block of the problem files: slope that overturns it, 100 GPa/m", {}, 0.05, 0, elastic_because},
       Reference{"toppling", "block of the problem files: slope that overturns it, rigid", {}, 0.04, 0, rigid_because}},
      {"critical tilt, stated joints",
       Reference{
           "toppling", "block of the problem files: slope that overturns it, 1 GPa/m", {}, 0.2, 0, elastic_because},
       {}}};
  p.dimensions = {{{-0.25, -0.25, 1.15}, {0.25, -0.25, 1.15}, "0.5 m"}, {{0.45, -0.25, 0}, {0.45, -0.25, 1}, "1 m"}};
  p.words.model =
      "A block of 0.5 x 0.5 x 1 m on a fixed slab, friction angle 45 deg, so that it topples and does not slide. "
      "Gravity "
      "is inclined by the tilt that is sought.";
  p.words.measured = "As for the incline: 0.5 mm more in the last second than in the one before, or 0.3 m off.";
  p.words.protocol = tilt_protocol;
  p.words.two_answers =
      "Two answers: with stiff joints (100 GPa/m), which a rigid code gives too, and with the stated joints (1 GPa/m, "
      "spread over the face, no tension), on which the edge sinks in and the block topples earlier. A rigid code "
      "writes "
      "`cannot state` for the second.";
  p.words.tolerance = "Rigid: " + rigid_because + ". Elastic: " + elastic_because + ".";
  return p;
}

Problem wedge() {
  Problem p;
  p.name = "wedge";
  p.title = "Wedge in a groove: friction along the line of intersection";
  constexpr double h = 0.5, top = 3, psi = 38, cut = 0.1;
  Solid left = prism_along_x("left", 2000, {{0, 0}, {-top, top}, {-top, -1}, {0, -1}}, 16);
  Solid right = prism_along_x("right", 2000, {{0, 0}, {0, -1}, {top, -1}, {top, top}}, 16);
  left.fixed = right.fixed = true;
  // its lowest edge is cut off: it would lie on the edges of both fixed blocks, where a normal is any
  Solid wedge = prism_along_x("wedge", 2000, {{-cut, cut}, {cut, cut}, {h, h}, {-h, h}}, 2);
  wedge.velocity = {1, 0, 0};
  p.blocks = {left, right, wedge};
  p.joints = {one_joint(30, stiff_joint, {})};
  const Point g = inclined_gravity(psi);
  p.gravity = {{0, g}};
  p.duration = 1.5;
  Search search;
  search.parameter = "friction_deg";
  search.lower = 15;
  search.upper = 40;
  search.tolerance = 0.005;
  p.search = search;
  p.criterion = Criterion{"gets faster", "wedge", {0.5, 1, 1.5}, 0, 0, 0.05};
  Variant rest;
  rest.name = "at rest";
  rest.velocities["wedge"] = Point::Zero();
  rest.gravity = grown(g);
  rest.duration = 3.5;
  rest.search = search;
  rest.criterion = accelerates("wedge");
  rest.quantities = {"critical friction, at rest"};
  p.variants = {rest};
  p.asked = {{"critical friction, kinetic", "deg",
              "the wedge starts at 1 m/s along the groove; middle of the last bracket between faster and slower"},
             {"critical friction, at rest", "deg", "the variant 'at rest'; middle of the last bracket"}};
  const std::string kinetic_because =
      "half the bracket of 0.005 deg, and 0.0175 deg, which are 4.4e-3 m/s2: a difference of 1.1 mm between two paths "
      "of 0.5 m, as steps, contacts that come and go and single precision leave";
  const std::string rest_because =
      "half the bracket of 0.005 deg; the criterion of 5e-4 m/s2 is 0.002 deg; on elastic joints the shear across the "
      "groove dies out while the wedge creeps, by 2 mm at 0.02 deg above the angle";
  const std::string upper = "groove 45/38: critical friction, kinetic";
  p.references = {
      {"critical friction, kinetic", Reference{"wedge", upper, {}, 0.02, 0, kinetic_because},
       Reference{"wedge", upper, {}, 0.02, 0, kinetic_because}},
      {"critical friction, at rest",
       Reference{"wedge", "groove 45/38: critical friction, at rest", {}, 0.03, 0, rest_because},
       Reference{"wedge", upper, "groove 45/38: least friction of any equilibrium", 0.03, 0,
                 rest_because +
                     "; any friction between the ends has an equilibrium of rigid blocks, so the load's path "
                     "and the solver decide"}}};
  p.dimensions = {{{-8, -3, 3.3}, {8, -3, 3.3}, "16 m"},
                  {{1, -0.5, 0.7}, {1, 0.5, 0.7}, "1 m"},
                  {{-1, 0.5, 0.7}, {1, 0.5, 0.7}, "2 m"}};
  p.words.model =
      "A wedge 2 m long lies in a groove between two fixed blocks; each plane of the groove is 45 deg from the "
      "vertical. "
      "Gravity is inclined by 38 deg along the groove. The friction angle is sought, the same on both planes.";
  p.words.measured =
      "Kinetic: the wedge starts at 1 m/s along the groove; the trial fails if its path from 1.0 s to 1.5 s is longer "
      "than that from 0.5 s to 1.0 s and than 0.05 m; a wedge whose path is shorter than that has stopped, and its two "
      "paths are rounding. At rest: fails if it moves by 0.5 mm more from 2.5 s to 3.5 s than from 1.5 s to 2.5 s, or "
      "is "
      "0.3 m off.";
  p.words.protocol =
      "Kinetic: full gravity from the start. At rest: gravity grows in its own direction from nothing to full within 1 "
      "s "
      "and is held. Bisection of the friction angle between 15 and 40 deg to 0.005 deg; each trial starts from the "
      "beginning at one "
      "friction angle. Stiff joints, no damping in the kinetic trial.";
  p.words.two_answers =
      "Kinetic and at rest. Rigid blocks at rest have an equilibrium at every friction angle between two closed forms: "
      "any answer there is right. On joints with stiffness gravity that grows in one direction leaves one answer, the "
      "kinetic one: the shear across the groove that sinking causes hinders nothing in the end.";
  p.words.tolerance = "Kinetic: " + kinetic_because + ". At rest: " + rest_because + ".";
  return p;
}

Problem free_rotation() {
  Problem p;
  p.name = "free_rotation";
  p.title = "Box in free rotation near its middle axis";
  Solid body = box("box", 2000, {-1.5, -1, -0.5}, {1.5, 1, 0.5});
  body.spin = {0.1, 2, 0.1};
  p.blocks = {body};
  p.gravity = {{0, Point::Zero()}};
  p.duration = 45;
  p.output = 0.05;
  const std::string own = "component of the angular velocity at 45 s along the axis of the box that was the world's ";
  p.asked = {{"angular velocity along the long axis, 45 s", "rad/s", own + "x at the start"},
             {"angular velocity along the middle axis, 45 s", "rad/s", own + "y at the start"},
             {"angular velocity along the short axis, 45 s", "rad/s", own + "z at the start"},
             {"angular momentum, largest change", "1",
              "largest length of L(t) - L(0) over the output times, in world axes, over the length of L(0)"},
             {"kinetic energy, largest change", "1", "largest |E(t) - E(0)| over the output times, over E(0)"}};
  const std::string spin_because =
      "a step of second order of 5 ms turns at a rate that is wrong by (omega dt)2/12 = 8.3e-6; over 45 s that shifts "
      "a curve whose slope is 2 rad/s2 at most by 7.5e-4 rad/s; four times that, the error of a step of 10 ms";
  const std::string kept_because =
      "no moment acts: (omega dt)2/12 = 3.3e-5 of a step of 10 ms of second order, and 4500 such steps each rounded to "
      "6e-8 in single precision, at worst in one direction";
  for (std::size_t k = 0; k < 3; ++k) {
    const Reference reference{"free_rotation", p.asked[k].quantity, {}, 3e-3, 0, spin_because};
    p.references.push_back({p.asked[k].quantity, reference, reference});
  }
  for (std::size_t k = 3; k < 5; ++k) {
    const Reference reference{"free_rotation", p.asked[k].quantity, {}, 3e-4, 0, kept_because};
    p.references.push_back({p.asked[k].quantity, reference, reference});
  }
  p.dimensions = {{{-1.5, -1, -0.8}, {1.5, -1, -0.8}, "3 m"},
                  {{1.8, -1, -0.5}, {1.8, 1, -0.5}, "2 m"},
                  {{1.7, -1, -0.5}, {1.7, -1, 0.5}, "1 m"}};
  p.words.model =
      "A box of 3 x 2 x 1 m in space, without gravity or any contact, starts with an angular velocity of (0.1, 2, 0.1) "
      "rad/s and tumbles about its middle axis.";
  p.words.measured = "Every 0.05 s up to 45 s; components along the axes of the box, which turn with it.";
  p.words.protocol = "No search, no damping, no sleeping.";
  p.words.two_answers = "One answer; no joint takes part.";
  p.words.tolerance = "Angular velocity: " + spin_because + ". Momentum and energy: " + kept_because + ".";
  return p;
}

}  // namespace voussoir::problems
