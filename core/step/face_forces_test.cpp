// Integrated face contacts: compression, rocking, twist and sliding in closed form; stored and lost energy; identical
// bits for any threads, skin and interruptions; no memory allocation.
#include "core/step/face_forces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/model/state_hash.hpp"
#include "core/run/fields.hpp"
#include "core/step.hpp"
#include "core/step/time_step.hpp"
#include "core/testing/counted_allocations.hpp"
#include "core/testing/pressed_block.hpp"

namespace voussoir::face_forces_test {
namespace {

using pressed::height, pressed::width, pressed::Springs;

// required: elastic twist and rocking
constexpr double exact = 1e-9;

// with an integrated face contact
template <int Dim>
struct Pressed : pressed::Block<Dim> {
  using pressed::Block<Dim>::model, pressed::Block<Dim>::state, pressed::Block<Dim>::block;

  explicit Pressed(double depth, double angle = 0) {
    this->settings.contact.face = ContactFace::integrated;
    this->settings.damping.local = 0;
    this->press(depth, angle);
  }

  // as if the last step had moved the block like this, about the middle of its base
  void answer_after(const Vector<Dim>& way, const Spin<Dim>& turn) {
    constexpr double dt = 1e-3;
    state.time_step.length = dt;
    const Body<Dim>& body = model.bodies[block];
    Motion<Dim>& motion = state.bodies.motions[block];
    const Spin<Dim> spin = turn / dt;
    motion.velocity = way / dt + cross(spin, Vector<Dim>(height * Vector<Dim>::Unit(Dim - 1)));
    motion.angular_momentum = angular_momentum(body, motion.rotation, spin);
    this->answer();
    motion.velocity.setZero();
    motion.angular_momentum.setZero();
  }

  const JointProperties& properties() const { return model.properties[0]; }
  Vector<Dim> force() const { return this->load(); }
  Spin<Dim> moment() const { return this->moment_of_base(); }
};

template <int Dim>
void expect_pressed_and_rocked() {
  constexpr double tilt = 1e-6;
  for (const double depth : {4 * tilt, 0.5 * tilt, 0.1 * tilt, -0.3 * tilt}) {
    const Pressed<Dim> pressed(depth, tilt);
    const Springs springs(pressed.properties().normal_stiffness, depth, tilt);
    // positions of 0.25 m are rounded to 3e-17 m
    EXPECT_NEAR(pressed.force()[Dim - 1], springs.force, exact * springs.force) << depth;
    EXPECT_NEAR(-pressed.moment()[Dim == 2 ? 0 : 1], springs.moment, exact * springs.moment) << depth;
  }
}

TEST(IntegratedFaces, CompressAndRockInClosedForm) {
  expect_pressed_and_rocked<2>();
  expect_pressed_and_rocked<3>();
}

TEST(IntegratedFaces, TwistInClosedForm) {
  constexpr double depth = 1e-4, angle = 1e-9;
  Pressed<3> p(depth);
  const double stiffness = p.properties().shear_stiffness * width * width * (width * width + width * width) / 12;
  for (int i = 1; i <= 3; ++i) {
    p.answer_after(Vector<3>::Zero(), {0, 0, angle});
    EXPECT_NEAR(-p.moment()[2], i * stiffness * angle, exact * stiffness * angle) << i;
    EXPECT_LT(p.force().head<2>().norm(), exact * stiffness * angle);
  }
}

// µ k u ∫ r dA of a square, and beyond it; the frictional work is the moment times the plastic rotation
TEST(IntegratedFaces, StickAndSlipInTwist) {
  constexpr double depth = 1e-4;
  Pressed<3> p(depth);
  const double pressure = p.properties().normal_stiffness * depth, mu = std::tan(40 * degree);
  const double limit = mu * pressure * (2 * std::numbers::sqrt2 + 2 * std::asinh(1.0)) / 12 * width * width * width;
  const double stiffness = p.properties().shear_stiffness / 6, turn = 3 * limit / stiffness;
  p.answer_after(Vector<3>::Zero(), {0, 0, turn});
  EXPECT_NEAR(-p.moment()[2], limit, 1e-6 * limit);
  // from zero to the limit: the mean is half the limit, over the plastic rotation
  const double slipped = turn - limit / stiffness;
  EXPECT_NEAR(p.state.ledger.energy.flows[Source::friction], 0.5 * limit * slipped, 1e-6 * limit * slipped);
  p.answer_after(Vector<3>::Zero(), {0, 0, turn});
  EXPECT_NEAR(p.state.ledger.energy.flows[Source::friction], 0.5 * limit * slipped + limit * turn, 1e-6 * limit * turn);
}

template <int Dim>
void expect_slide() {
  constexpr double depth = 1e-4;
  Pressed<Dim> p(depth);
  const double limit = std::tan(40 * degree) * p.properties().normal_stiffness * depth,
               stiffness = p.properties().shear_stiffness;
  const Vector<Dim> along = Vector<Dim>::Unit(0);
  p.answer_after(0.5 * limit / stiffness * along, Spin<Dim>::Zero());
  EXPECT_NEAR(-p.force()[0], 0.5 * limit, exact * limit);
  EXPECT_EQ(p.state.ledger.energy.flows[Source::friction], 0);
  p.answer_after(2 * limit / stiffness * along, Spin<Dim>::Zero());
  EXPECT_NEAR(-p.force()[0], limit, exact * limit);
  // slip over 1.5 times the elastic displacement at the limit, from half the limit to the limit
  EXPECT_NEAR(p.state.ledger.energy.flows[Source::friction], 0.75 * limit * 1.5 * limit / stiffness,
              exact * limit * limit / stiffness);
  EXPECT_NEAR(p.state.ledger.energy.elastic,
              0.5 * p.properties().normal_stiffness * depth * depth + 0.5 * limit * limit / stiffness,
              exact * limit * depth);
}

TEST(IntegratedFaces, SlideInClosedForm) {
  expect_slide<2>();
  expect_slide<3>();
}

// Sheared, then tilted until part of it opens, then laid flat: the remaining shear is that of the area that stayed
// closed, and the energy balance has the rest.
template <int Dim>
void expect_lost_area() {
  constexpr double depth = 1e-4, shear = 1e-6, tilt = 4e-4;
  Pressed<Dim> p(depth);
  p.answer_after(shear * Vector<Dim>::Unit(0), Spin<Dim>::Zero());
  const double stiffness = p.properties().shear_stiffness;
  const double held = 0.5 * stiffness * shear * shear;
  Pressed<Dim> tilted(depth, tilt);  // closed where depth + tilt x > 0: three quarters
  p.state.bodies.motions = tilted.state.bodies.motions;
  p.state.time_step.length = 0;
  p.answer();
  const double left = 0.5 + depth / tilt;
  // the component of the normal force along x is half the tilt times it
  const JointState<Dim>& h = p.state.contacts.list[0].history;
  EXPECT_NEAR(h.shear_force.norm(), left * stiffness * shear, 1e-3 * stiffness * shear);
  EXPECT_NEAR(h.area, left, 1e-3);
  EXPECT_NEAR(p.state.ledger.energy.flows[Source::lost_area], (1 - left) * held, 1e-3 * held);
  EXPECT_EQ(p.state.ledger.energy.flows[Source::friction], 0);
}

TEST(IntegratedFaces, LoseTheShearOfTheAreaTheyLose) {
  expect_lost_area<2>();
  expect_lost_area<3>();
}

// If displaced without rotation, the shear of a face that has lost one side acts at the centre of the remaining area,
// and so does the shear from a twist.
TEST(IntegratedFaces, KeepTheirStressWhenTheyLoseASide) {
  JointState<3> h;
  h.normal = {0, 0, 1};
  h.area = 2;  // 2 along x, 1 along y
  h.polar = 2 * (4 + 1) / 12.0;
  h.shear_force = {0, 3, 0};
  h.twist = 0.7;
  // the half beyond x = 0 remains: 1 by 1 about (0.5, 0)
  JointProperties properties{"joint", 1e9, 1e9, 60 * degree, false};
  IntegratedContact<3> face;
  face.flat = true;
  face.normal = {0, 0, 1};
  face.centre = {0.5, 0, 0};
  face.force = {0, 0, 1};
  face.polar = 1 / 6.0;
  face.polygon.corners = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
  face.polygon.axes << 1, 0, 0, 1, 0, 0;
  face.polygon.overlap = 1;
  ContactGeometry<3> geometry;
  geometry.normal = face.normal;
  geometry.point = face.centre;
  geometry.area = 1;
  geometry.overlap = 1;
  const Spin<3> still = Spin<3>::Zero();
  const PairMotion<3> motion{{0, 0, 1}, Vector<3>::Zero(), still, still, 1};
  const double turn = h.twist / h.polar;
  const FaceForce<3> f = face_force<3>(properties, std::tan(60 * degree), 0, 1e-3, motion, geometry, face, h);
  // stress 3/2 along y and rotation times the arm, over the square
  EXPECT_NEAR(h.shear_force[1], 1.5 + turn * 0.5, 1e-14);
  EXPECT_NEAR(h.shear_force[0], 0, 1e-14);
  EXPECT_NEAR(h.twist, turn / 6, 1e-14);
  const double before = 0.5 * (9 / 2.0 + 0.49 / (10 / 12.0)) / 1e9;
  const double after = 0.5 * (h.shear_force.squaredNorm() + 6 * h.twist * h.twist) / 1e9;
  EXPECT_NEAR(f.lost_area, before - after, 1e-12 * before);
  EXPECT_GT(f.lost_area, 0);
}

// ---- over many steps ----------------------------------------------------------------------------------------------

// the error of the energy balance as a block rocks and twists on its face
template <int Dim>
double energy_error_of_rocking(const Spin<Dim>& spin, double fraction) {
  Pressed<Dim> p(1e-4);
  p.settings.time.fraction = fraction;
  Motion<Dim>& motion = p.state.bodies.motions[p.block];
  const Body<Dim>& body = p.model.bodies[p.block];
  motion.angular_momentum = angular_momentum(body, motion.rotation, spin);
  p.model.gravity[Dim - 1] = -p.force()[Dim - 1] / body.mass;
  for (int i = 0; i < 2000; ++i)
    step(p.model, p.settings, p.state);
  EXPECT_EQ(p.state.counters.unconverged, 0);
  return p.state.ledger.energy.relative_error();
}

TEST(IntegratedFaces, ConserveEnergyAsTheyRockAndTwist) {
  EXPECT_LT(energy_error_of_rocking<2>(Spin<2>(0.01), 0.02), 1e-6);
  EXPECT_LT(energy_error_of_rocking<3>(Spin<3>(0, 0.01, 0), 0.02), 1e-6);
  EXPECT_LT(energy_error_of_rocking<3>(Spin<3>(0.005, 0.01, 0.02), 0.02), 1e-5);
}

// a block that comes to equilibrium on a face does not keep rotating on it
TEST(IntegratedFaces, StopARotationAboutTheirNormal) {
  Pressed<3> p(1e-4);
  const Body<3>& body = p.model.bodies[p.block];
  p.model.gravity[2] = -p.force()[2] / body.mass;
  p.state.bodies.motions[p.block].angular_momentum =
      angular_momentum(body, p.state.bodies.motions[p.block].rotation, Spin<3>(0, 0, 5));
  p.settings.damping.local = 0.3;
  for (int i = 0; i < 4000; ++i)
    step(p.model, p.settings, p.state);
  EXPECT_LT(p.state.bodies.motions[p.block].angular_momentum.norm(), 1e-6 * 5 * body.mass);
}

State<3> pile(int threads, double skin, int steps, bool interrupted) {
  const Model<3> model = shapes::model_of<3>(shapes::jointed_box());
  Settings settings;
  settings.contact.face = ContactFace::integrated;
  settings.contact.skin = skin;
  settings.threads = threads;
  State<3> state = initial_state(model);
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!model.bodies[b].fixed) state.bodies.motions[b].velocity = {2, 1.0 * static_cast<double>(b % 3), 3};
  for (int i = 0; i < steps; ++i) {
    step(model, settings, state);
    if (interrupted && i % 37 == 5) {
      std::stringstream bytes;
      cereal::BinaryOutputArchive{bytes}(state);
      State<3> read;
      cereal::BinaryInputArchive{bytes}(read);
      state = std::move(read);
    }
  }
  EXPECT_EQ(state.counters.unconverged, 0);
  return state;
}

TEST(IntegratedFaces, AreTheSameForAnyThreadsSkinAndInterruption) {
  const Model<3> model = shapes::model_of<3>(shapes::jointed_box());
  const std::string hash = state_hash(model, pile(1, 0.1, 400, false));
  EXPECT_EQ(state_hash(model, pile(3, 0.1, 400, false)), hash);
  EXPECT_EQ(state_hash(model, pile(1, 1, 400, false)), hash);
  EXPECT_EQ(state_hash(model, pile(2, 0.1, 400, true)), hash);
}

// Together with joints that can be bonded: the faces at a corner determine the joint of a contact, therefore also
// whether it is integrated, and such a contact is computed in the same step.
TEST(IntegratedFaces, AreThoseOfTheirJointBesideOthers) {
  Model<3> model = shapes::model_of<3>(shapes::jointed_box());
  model.properties.push_back({"tied", 1e9, 5e8, 35 * degree, false});
  model.properties[1].laws.bond = true;
  model.joints.push_back({"tied", model.joints[0].plane, 1});
  for (Body<3>& body : model.bodies)
    for (Polytope<3>& part : body.parts)
      for (std::size_t f = 0; f < part.joints.size(); ++f)
        part.joints[f] = static_cast<int>(f % 2);
  Settings settings;
  settings.contact.face = ContactFace::integrated;
  State<3> state = initial_state(model);
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!model.bodies[b].fixed) state.bodies.motions[b].velocity = {2, 1.0 * static_cast<double>(b % 3), 3};
  int whole = 0, tied = 0;
  for (int i = 0; i < 400; ++i) {
    step(model, settings, state);
    for (std::size_t k = 0; k < state.contacts.list.size(); ++k) {
      const Contact<3>& c = state.contacts.list[k];
      if (!c.touching()) continue;
      (c.properties == 0 ? whole : tied) += 1;
      EXPECT_EQ(c.properties, c.joint == no_joint ? 0 : model.joints[c.joint].properties);
      if (c.properties == 0) {
        EXPECT_NEAR(state.contacts.faces[k].force.norm(), c.geometry.overlap * c.geometry.area, 1e-9 * c.geometry.area)
            << i;
      }
    }
  }
  EXPECT_GT(whole, 1000);
  EXPECT_GT(tied, 1000);
}

TEST(IntegratedFaces, AllocateNoMemory) {
  const Model<3> model = shapes::model_of<3>(shapes::jointed_box());
  Settings settings;
  settings.contact.face = ContactFace::integrated;
  settings.contact.skin = 3;
  State<3> state = initial_state(model);
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!model.bodies[b].fixed) state.bodies.motions[b].velocity = {2, 1.0 * static_cast<double>(b % 3), 3};
  for (int i = 0; i < 100; ++i)
    step(model, settings, state);
  const long long made = allocations;
  for (int i = 0; i < 200; ++i)
    step(model, settings, state);
  if (!allocations_are_counted) GTEST_SKIP() << "this build counts no allocations";
  EXPECT_EQ(allocations - made, 0);
}

}  // namespace
}  // namespace voussoir::face_forces_test
