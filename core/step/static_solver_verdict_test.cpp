// No wrong verdict: searches by the implicit static solver and by relaxation, both continued by true motion, agree on
// the stability of random slopes, stacks and wedges just above and just below their critical friction; and agree with
// the closed form, if the distance from it exceeds the effect of the loading path.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "core/run/reduction.hpp"
#include "core/testing/models.hpp"

namespace voussoir::static_solver_verdict_test {
namespace {

using shapes::body_of;
using shapes::box;
using shapes::integer;
using shapes::model_of;
using shapes::Random;
using shapes::uniform;

template <int Dim>
struct Example {
  Model<Dim> model;
  double critical = 0;  // tangent of the critical friction angle, closed form
};

constexpr double stands = 70 * degree;  // all examples are stable

// so stiff that joints close by less than 1e-4 of a block
void make_stiff(Random& random, JointProperties& joint) {
  joint.normal_stiffness = shapes::power_of_ten(random, 9.5, 11);
  joint.shear_stiffness = uniform(random, 0.1, 1) * joint.normal_stiffness;
  joint.friction = stands;
}

template <int Dim>
Matrix<Dim> tilt(double dip) {
  if constexpr (Dim == 3)
    return Eigen::AngleAxisd(dip, -Vector<3>::UnitY()).toRotationMatrix();
  else
    return matrix(Rotation<2>{dip});
}

// a box about the vertical centre line, from one height to another, rotated by the dip
template <int Dim>
HalfSpaces<Dim> layer(double half_width, double low, double high, double dip) {
  Vector<Dim> from = Vector<Dim>::Constant(-half_width), to = Vector<Dim>::Constant(half_width);
  from[Dim - 1] = low;
  to[Dim - 1] = high;
  return shapes::placed<Dim>(box<Dim>(from, to), tilt<Dim>(dip), Vector<Dim>::Zero());
}

// one block, free to rotate, on a plane
template <int Dim>
Example<Dim> slope(Random& random) {
  const double dip = uniform(random, 8, 45) * degree;
  Model<Dim> model = shapes::block_on_plate<Dim>(dip, stands);
  make_stiff(random, model.properties[0]);
  return {std::move(model), std::tan(dip)};
}

// blocks above each other on a plane; they cannot rotate, because the closed form has no moments
Example<2> stack(Random& random) {
  const double dip = uniform(random, 8, 45) * degree;
  std::vector<Body<2>> bodies{body_of<2>(layer<2>(3, -3, 0, dip), true)};
  double low = 0;
  for (int blocks = integer(random, 2, 6); blocks > 0; --blocks) {
    const double high = low + uniform(random, 0.2, 0.8);
    bodies.push_back(body_of<2>(layer<2>(0.5, low, high, dip)));
    bodies.back().free_rotation.fill(false);
    low = high;
  }
  Model<2> model = model_of<2>(std::move(bodies), stands);
  make_stiff(random, model.properties[0]);
  return {std::move(model), std::tan(dip)};
}

// A wedge on two joints that daylight in a slope's face a metre below its crest; it cannot rotate. The normal forces
// balance the weight's component across the line of intersection, friction that along it.
Example<3> wedge(Random& random) {
  while (true) {
    const Vector<3> a = upward_normal_3d(uniform(random, 40, 65) * degree, uniform(random, 110, 145) * degree);
    const Vector<3> b = upward_normal_3d(uniform(random, 40, 65) * degree, uniform(random, 215, 250) * degree);
    const Vector<3> face = upward_normal_3d(75 * degree, 180 * degree);
    Vector<3> line = a.cross(b).normalized();
    if (line[2] > 0) line = -line;
    const double plunge = std::asin(-line[2]);
    if (plunge < 15 * degree || plunge > 45 * degree || line.dot(face) < 0.1) continue;
    Matrix<3> sides;
    sides << a, b, line;
    const Vector<3> forces = sides.inverse() * -Vector<3>(0, 0, -1);  // of the joints, and along the line
    if (forces[0] < 0.1 || forces[1] < 0.1) continue;

    const Vector<3> toe(0, 0, -1);
    HalfSpaces<3> slope = box<3>(Vector<3>::Constant(-5), Vector<3>(5, 5, 0));
    slope.push_back({face, face.dot(toe)});
    const auto cut = [&](std::vector<Vector<3>> outward) {
      HalfSpaces<3> planes = slope;
      for (const Vector<3>& n : outward)
        planes.push_back({n, n.dot(toe)});
      return planes;
    };
    std::vector<Body<3>> bodies{body_of<3>(cut({a}), true), body_of<3>(cut({-a, b}), true),
                                body_of<3>(cut({-a, -b}), false, "wedge")};
    bodies.back().free_rotation.fill(false);
    Model<3> model = model_of<3>(std::move(bodies), stands);
    make_stiff(random, model.properties[0]);
    return {std::move(model), std::abs(forces[2]) / (forces[0] + forces[1])};
  }
}

struct Verdict {
  SearchTrial outcome = SearchTrial::broken;
  bool without_newton = false;  // it left the decision, or a part of it, to other methods
};

// as in a search, from equilibrium at a high friction angle
template <int Dim>
Verdict verdict(const Model<Dim>& model, double tangent, Statics statics) {
  Settings settings;
  settings.statics.method = statics;
  State<Dim> state = initial_state(model);
  RunGoal goal{.rest = true, .step_limit = 1'000'000};
  const RunReport settled = run<Dim>(model, settings, goal, {}, state);
  EXPECT_EQ(settled.reason, StopReason::equilibrium) << settled.detail;
  ReducePlan plan;
  plan.from = stands;
  plan.to = std::atan(tangent);
  plan.tolerance = plan.from;  // one trial
  ReductionProgress<Dim> progress;
  Verdict verdict;
  const TrialHook<Dim> on_trial = [&](const State<Dim>&, double friction, SearchTrial outcome) {
    if (friction == plan.to) verdict.outcome = outcome;
  };
  reduce<Dim>(model, settings, plan, state, progress, {}, on_trial);
  verdict.without_newton = state.counters.static_fallbacks > 0;
  return verdict;
}

struct Tally {
  int examples = 0, undecided_by_newton = 0;
};

template <int Dim>
void judge(const Example<Dim>& example, const std::string& what, Tally& tally) {
  ++tally.examples;
  for (const double margin : {-0.05, -0.01, 0.01, 0.05}) {
    const double tangent = (1 + margin) * example.critical;
    const Verdict by_newton = verdict(example.model, tangent, Statics::newton);
    tally.undecided_by_newton += by_newton.without_newton;
    const SearchTrial expected = std::abs(margin) < 0.02 ? verdict(example.model, tangent, Statics::adaptive).outcome
                                 : margin > 0            ? SearchTrial::stable
                                                         : SearchTrial::failed;
    EXPECT_EQ(by_newton.outcome, expected)
        << what << " " << tally.examples << " at " << 1 + margin << " of its friction";
    EXPECT_TRUE(by_newton.outcome == SearchTrial::stable || by_newton.outcome == SearchTrial::failed) << what;
  }
}

void judge_examples(int count, int seed) {
  Random random(seed);
  Tally slopes, stacks, wedges;
  for (int i = 0; i < count; ++i) {
    if (i % 4 == 0) judge(slope<2>(random), "slope in the plane", slopes);
    if (i % 4 == 1) judge(slope<3>(random), "slope", slopes);
    if (i % 4 == 2) judge(stack(random), "stack", stacks);
    if (i % 4 == 3) judge(wedge(random), "wedge", wedges);
  }
  EXPECT_EQ(slopes.examples + stacks.examples + wedges.examples, count);
  for (const auto& [name, tally] :
       {std::pair("slopes", slopes), std::pair("stacks", stacks), std::pair("wedges", wedges)})
    testing::Test::RecordProperty(std::string(name) + "_undecided_by_newton", tally.undecided_by_newton);
}

TEST(NewtonVerdict, IsThatOfRelaxationAndOfTheClosedForm) {
  judge_examples(12, 1);
}

TEST(NewtonVerdictLong, IsThatOfRelaxationAndOfTheClosedForm) {
  judge_examples(200, 2);
}

}  // namespace
}  // namespace voussoir::static_solver_verdict_test
