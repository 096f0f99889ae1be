// Sub-contacts have the forces of a distributed joint: normal force and rocking moment exactly, twist with an error of
// order 1/n².
#include <gtest/gtest.h>

#include <cmath>

#include "core/contact/sub_contacts.hpp"
#include "core/joint_laws/joint_law.hpp"
#include "core/step.hpp"
#include "core/step/joint_forces.hpp"
#include "core/step/time_step.hpp"
#include "core/testing/pressed_block.hpp"

namespace voussoir::joint_forces_test {
namespace {

using shapes::block_on_plate;
using shapes::index_of;

using pressed::height, pressed::width, pressed::Springs;

constexpr double tilt = 1e-6;  // rad

// the contact's normal lies between the two faces', half the tilt from each
constexpr double tilt_tolerance = 3e-6;

// its joint has `along` points along each direction of the face
template <int Dim>
struct Pressed : pressed::Block<Dim> {
  Pressed(int along, double depth, double angle) {
    this->model.properties[0].sub_contacts = along;
    this->press(depth, angle);
  }
  double force() const { return this->load()[Dim - 1]; }
  double moment() const { return -this->moment_of_base()[Dim == 2 ? 0 : 1]; }  // against the tilt
};

template <int Dim>
void expect_distributed_load() {
  for (const double depth : {4 * tilt, 0.5 * tilt, 0.1 * tilt, -0.3 * tilt})
    for (const int along : {2, 3, 8}) {
      const Pressed<Dim> pressed(along, depth, tilt);
      const Springs springs(pressed.model.properties[0].normal_stiffness, depth, tilt);
      EXPECT_NEAR(pressed.force(), springs.force, tilt_tolerance * springs.force) << depth << " " << along;
      EXPECT_NEAR(pressed.moment(), springs.moment, tilt_tolerance * springs.moment) << depth << " " << along;
    }
}

TEST(SubContacts, HaveTheDistributedJointsForceAndMoment) {
  expect_distributed_load<2>();
  expect_distributed_load<3>();
}

TEST(SubContacts, WithoutThemRockingIsSeveralTimesTooStiff) {
  const Pressed<2> one(1, 4 * tilt, tilt);
  const Springs springs(one.model.properties[0].normal_stiffness, 4 * tilt, tilt);
  // the analytic centre moves towards the deeper side by more than the pressure does: 2.88 at this depth
  EXPECT_GT(one.moment() / springs.moment, 2);
  EXPECT_LT(one.moment() / springs.moment, 4);
}

TEST(SubContacts, TwistStiffnessConvergesWithTheSquareOfTheirNumber) {
  constexpr double depth = 1e-4, speed = 1e-3, time_step = 1e-3;
  for (const int along : {1, 2, 4, 8}) {
    Pressed<3> pressed(along, depth, 0);
    const Body<3>& body = pressed.model.bodies[pressed.block];
    State<3>& state = pressed.state;
    state.bodies.motions[pressed.block].angular_momentum =
        angular_momentum(body, state.bodies.motions[pressed.block].rotation, Spin<3>(0, 0, speed));
    state.time_step.length = time_step;
    pressed.answer();
    const double polar = width * width * (width * width + width * width) / 12;
    const double stiffness = pressed.model.properties[0].shear_stiffness * polar;
    const double expected = stiffness * (1 - 1.0 / (along * along));
    EXPECT_NEAR(-state.loads.total[pressed.block].moment[2] / (speed * time_step), expected, 1e-9 * stiffness) << along;
  }
}

// A block descends obliquely: whenever it meets the plate within a step, the shear is that of the slip since then.
TEST(NewContacts, CountTheSlipOfTheirFirstStep) {
  constexpr double down = 2e-2, along = 1e-2, time_step = 1e-3;
  const auto sheared = [&](double gap, int steps) {
    Model<2> model = block_on_plate<2>(0, 40 * degree);
    model.gravity.setZero();
    const int block = index_of(model, "block");
    model.bodies[block].free_rotation.fill(false);
    MovePlan move;
    move.bodies.names = {"block"};
    move.velocity = {along, -down};
    move.translation.fill(true);
    Change change;
    change.move = {move};
    model = apply(std::move(model), change);
    State<2> state = initial_state(model);
    state.bodies.motions[block].displacement[1] = gap;
    Settings settings;
    settings.time.step = time_step;
    for (int i = 0; i <= steps; ++i)  // the forces of a step are those at its start
      step(model, settings, state);
    return -state.loads.total[block].force[0] / model.properties[0].shear_stiffness;
  };
  // along the displacement of the first step, 20 µm: from the start, after a quarter, just before its end; then the
  // next
  for (const double gap : {0.0, 5e-6, 19e-6})
    for (const int steps : {1, 2, 7})
      EXPECT_NEAR(sheared(gap, steps), along * (steps * time_step - gap / down), 1e-8 * along) << gap << " " << steps;
}

// The energy of a linear stress distribution is counted completely, so that a rocking block conserves energy; with one
// point the contact has no potential. At a fiftieth of the stable step the elastic energy is known to about 1e-7.
constexpr double conserved = 1e-6, not_conserved = 1e-3;

template <int Dim>
double energy_error_of_rocking(int along) {
  Pressed<Dim> pressed(along, 1e-4, 0);
  Settings& settings = pressed.settings;
  settings.damping.local = 0;
  settings.time.fraction = 0.02;
  State<Dim>& state = pressed.state;
  Motion<Dim>& motion = state.bodies.motions[pressed.block];
  const Body<Dim>& body = pressed.model.bodies[pressed.block];
  Spin<Dim> spin = Spin<Dim>::Zero();
  spin[Dim == 2 ? 0 : 1] = 0.01;
  motion.angular_momentum = angular_momentum(body, motion.rotation, spin);
  // held down by the force of the overlap: the full face touches all the time
  pressed.model.gravity[Dim - 1] = -pressed.force() / body.mass;
  for (int i = 0; i < 2000; ++i)
    step(pressed.model, settings, state);
  EXPECT_EQ(state.counters.unconverged, 0);
  return state.ledger.energy.relative_error();
}

TEST(SubContacts, RockingConservesEnergy) {
  EXPECT_GT(energy_error_of_rocking<2>(1), not_conserved);
  for (const int along : {2, 8}) {
    EXPECT_LT(energy_error_of_rocking<2>(along), conserved) << along;
    EXPECT_LT(energy_error_of_rocking<3>(along), conserved) << along;
  }
}

// ---- laws under a block ---------------------------------------------------------------------------------------------

// the force of a block with overlap `depth` through one point or several
template <int Dim>
double force_at(Pressed<Dim>& pressed, double depth) {
  pressed.state.bodies.motions[pressed.block].displacement[Dim - 1] = -depth;
  pressed.answer();
  return pressed.force();
}

TEST(Bonds, AreMadeWhereAClosedJointPressesAndHoldUntilTheyBreak) {
  for (const int along : {1, 4}) {
    Pressed<2> pressed(along, 1e-4, 0);
    JointProperties& joint = pressed.model.properties[0];
    joint.laws.bond = true;
    joint.tension = 2e4;  // an offset of 20 µm
    joint.cohesion = 1e5;
    EXPECT_NEAR(force_at(pressed, 1e-5), 0, 1e-6);  // never bonded: no force below the offset
    make_bonds(pressed.model, pressed.settings, pressed.state.bodies, pressed.state.contacts,
               pressed.state.ledger.bonds, pressed.state.counters);
    EXPECT_NEAR(force_at(pressed, 5e-6), 0, 1e-6) << "no point is compressed";
    EXPECT_EQ(count_bonds(pressed.state.contacts, pressed.state.ledger.bonds).made, 0);
    EXPECT_EQ(count_bonds(pressed.state.contacts, pressed.state.ledger.bonds).due, 1);

    EXPECT_NEAR(force_at(pressed, 1e-4), 8e4, 1);
    EXPECT_EQ(count_bonds(pressed.state.contacts, pressed.state.ledger.bonds).whole, along);
    make_bonds(pressed.model, pressed.settings, pressed.state.bodies, pressed.state.contacts,
               pressed.state.ledger.bonds, pressed.state.counters);
    EXPECT_EQ(count_bonds(pressed.state.contacts, pressed.state.ledger.bonds).made, along) << "none is made twice";
    EXPECT_NEAR(force_at(pressed, 1e-4), 8e4, 1) << "a bond changes no force";
    EXPECT_NEAR(force_at(pressed, 5e-6), -1.5e4, 1);
    force_at(pressed, -1e-6);  // apart: the bond is lost with the contact
    EXPECT_NEAR(force_at(pressed, 5e-6), 0, 1e-6);
    EXPECT_NEAR(force_at(pressed, 1e-4), 8e4, 1) << "the offset stays";
    EXPECT_NEAR(force_at(pressed, 5e-6), 0, 1e-6) << "a broken bond stays broken";
    EXPECT_EQ(count_bonds(pressed.state.contacts, pressed.state.ledger.bonds).broken, along);
  }
}

// Blocks that only touch have no contact yet; they may part by a thousandth of their size before they are compressed.
TEST(Bonds, WaitForAClosedJointToPressUnlessItOpens) {
  for (const int along : {1, 4})
    for (const double gap : {0.0, 1e-12, 2e-4, 3e-4}) {
      Pressed<2> pressed(along, 0, 0);
      JointProperties& joint = pressed.model.properties[0];
      joint.laws.bond = true;
      joint.cohesion = 1e5;
      pressed.state = initial_state(pressed.model);
      make_bonds(pressed.model, pressed.settings, pressed.state.bodies, pressed.state.contacts,
                 pressed.state.ledger.bonds, pressed.state.counters);
      EXPECT_EQ(count_bonds(pressed.state.contacts, pressed.state.ledger.bonds).due, 1);
      force_at(pressed, -gap);
      const bool open = gap > 2.5e-4;  // the block's inscribed radius is a quarter of a metre
      EXPECT_EQ(count_bonds(pressed.state.contacts, pressed.state.ledger.bonds).due, open ? 0 : 1) << gap;
      force_at(pressed, 1e-5);
      EXPECT_EQ(count_bonds(pressed.state.contacts, pressed.state.ledger.bonds).whole, open ? 0 : along) << gap;
      pressed.model.bodies[pressed.block].present = false;
      remove_bonds(pressed.model, pressed.state.contacts, pressed.state.ledger.bonds);
      EXPECT_EQ(count_bonds(pressed.state.contacts, pressed.state.ledger.bonds).broken, 0);
      EXPECT_EQ(count_bonds(pressed.state.contacts, pressed.state.ledger.bonds).whole, 0);
    }
}

TEST(StressDependentStiffness, IsTheSameThroughAnyNumberOfPointsAndShortensTheStep) {
  double limit = 0;
  for (const int along : {1, 2, 8}) {
    Pressed<3> pressed(along, 1e-4, 0);
    JointProperties& joint = pressed.model.properties[0];
    const double plain = estimate_time_step(pressed.model, pressed.settings, {}, pressed.state.bodies,
                                            pressed.state.loads, pressed.state.contacts, pressed.state.time_step)
                             .limit;
    joint.laws.normal = joint.laws.shear = StiffnessLaw::linear;
    joint.normal_growth = 2e4;  // stress at 0.1 mm: k/c (e² - 1)
    joint.shear_growth = 2e4;
    EXPECT_NEAR(force_at(pressed, 1e-4), joint.normal_stiffness / 2e4 * std::expm1(2), 1e-6 * 3e5);
    const auto renewed = renew_time_step(pressed.model, pressed.settings, {}, pressed.state.bodies, pressed.state.loads,
                                         pressed.state.contacts, pressed.state.time_step);
    ASSERT_TRUE(renewed);
    const double stiffened = renewed->limit;
    EXPECT_FALSE(renew_time_step(pressed.model, pressed.settings, {}, pressed.state.bodies, pressed.state.loads,
                                 pressed.state.contacts, pressed.state.time_step));
    EXPECT_LT(stiffened, plain * std::exp(-0.9));
    EXPECT_GT(stiffened, plain * std::exp(-1.5));
    if (along == 1) limit = stiffened;
    EXPECT_LE(stiffened, 1.01 * limit);
  }
}

}  // namespace
}  // namespace voussoir::joint_forces_test
