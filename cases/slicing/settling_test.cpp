// A rock mass of some 2 500 sliced blocks, and a corner of one with a bench in it, settle under their weight until
// equilibrium.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cases/case_tools.hpp"
#include "cases/model_picture.hpp"
#include "cases/recorded_run.hpp"

namespace voussoir::cases::settling_test {
namespace {

using verification::Bound;
using verification::CaseReport;
using verification::Kind;

// the force on the fixed blocks, the mean force of a contact, and the largest overlap as a fraction of the smaller
// block
struct Contacts {
  Vector<3> on_fixed = Vector<3>::Zero();  // N
  double mean_force = 0;                   // N
  double largest_overlap = 0;              // of the smaller inscribed radius
};

Contacts contacts(const Model<3>& model, const State<3>& state) {
  Contacts sum;
  int count = 0;
  for (const Contact<3>& c : state.contacts.list) {
    if (!c.touching()) continue;
    const Body<3>&a = model.bodies[model.parts[c.part_a].body], &b = model.bodies[model.parts[c.part_b].body];
    if (a.fixed) sum.on_fixed -= c.force;
    if (b.fixed) sum.on_fixed += c.force;
    sum.mean_force += c.force.norm();
    ++count;
    sum.largest_overlap = std::max(sum.largest_overlap, c.geometry.overlap / std::min(a.size, b.size));
  }
  sum.mean_force /= count;
  return sum;
}

double kinetic(const Model<3>& model, const State<3>& state) {
  double sum = 0;  // J
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Motion<3>& m = state.bodies.motions[b];
    if (model.bodies[b].fixed) continue;
    sum += 0.5 * model.bodies[b].mass * m.velocity.squaredNorm();
    sum += 0.5 * m.angular_momentum.cwiseAbs2().cwiseQuotient(model.bodies[b].inertia).sum();
  }
  return sum;
}

void check(CaseReport& report, const std::string& which, const RecordedRun<3>& settled) {
  const Model<3>& model = settled.model();
  const State<3>& state = settled.last();
  const Results& results = settled.run.results;
  const auto record = [&](const std::string& quantity, const std::string& unit, Kind kind, const std::string& source,
                          double expected, const verification::Tolerance& tolerance, const std::string& because,
                          double computed) {
    report.record({"settling: " + quantity + which, unit, kind, source, expected, tolerance, because}, computed,
                  cost(settled.run));
  };

  int blocks = 0;
  double weight = 0, farthest = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].fixed) continue;
    ++blocks;
    weight -= model.bodies[b].mass * model.gravity[2];
    farthest = std::max(farthest, state.bodies.motions[b].displacement.norm());
  }
  record("contacts without an answer", "1", Kind::exact, "promise: a contact without a result fails the run", 0,
         {0.5, 0}, "a count", static_cast<double>(results.counters.unconverged));

  const double released = -state.ledger.energy.potential();
  record("kinetic energy at rest", "1", Kind::limit, "equilibrium: as a fraction of the work of gravity", 0,
         {1e-6, 0, Bound::at_most},
         "momentum times frequency is below u = 1e-4 of the mean contact force: such a block has some u² = 1e-8 of the "
         "energy of its springs, and a hundred times that if its springs are the softest",
         kinetic(model, state) / released);
  record("energy that the motion does not account for", "1", Kind::exact,
         "conservation of energy: work of all forces against kinetic energy", 0, {1e-10, 0},
         "leapfrog closes to the rounding of some ten thousand steps",
         std::abs(state.ledger.energy.motion_error) / released);
  record("energy that is not accounted for", "1", Kind::limit, "demanded: the drift beyond which a run is not trusted",
         0, {0.05, 0, Bound::at_most},
         "core/run/simulate.cpp: areas and normals of contacts change while blocks settle",
         state.ledger.energy.relative_error());

  const Contacts now = contacts(model, state);
  const double out_of_balance = blocks * settled.scene().settings.equilibrium.unbalanced * now.mean_force;
  const std::string balance = "every block may be out of balance by u of the mean contact force";
  record("weight on floor and walls", "N", Kind::exact, "equilibrium of the assembly", weight, {out_of_balance, 0},
         balance, -now.on_fixed[2]);
  record("thrust on the walls, eastward", "N", Kind::exact, "equilibrium of the assembly", 0, {out_of_balance, 0},
         balance, now.on_fixed[0]);
  record("thrust on the walls, northward", "N", Kind::exact, "equilibrium of the assembly", 0, {out_of_balance, 0},
         balance, now.on_fixed[1]);
  record("largest overlap", "1", Kind::limit, "geometry: a fraction of the smaller block's inscribed radius", 0,
         {settled.scene().settings.contact.potential_radius, 0, Bound::at_most},
         "beyond it the contact normal of the potential particle is no longer that of the faces", now.largest_overlap);

  report.report("settling: blocks" + which, "1", blocks, "that are free");
  report.report("settling: farthest way of a block" + which, "m", farthest, "of its centroid");
  report.report("settling: steps" + which, "1", static_cast<double>(results.counters.steps), "until rest",
                cost(settled.run));
}

// whether a face is visible from outside: some point at this distance in front of it is in no block
struct Exposure {
  static constexpr double in_front = 2e-3;  // m
  const Model<3>& model;
  const State<3>& state;

  bool covered(const Vector<3>& x) const {
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      const Body<3>& other = model.bodies[b];
      if (other.fixed) continue;
      const Vector<3> there = x - model.origin - other.reference - state.bodies.motions[b].displacement;
      if (there.norm() > other.radius) continue;
      const Vector<3> local = matrix(state.bodies.motions[b].rotation).transpose() * there;
      for (const Polytope<3>& part : other.parts)
        if (std::all_of(part.faces.begin(), part.faces.end(),
                        [&](const HalfSpace<3>& f) { return signed_distance(f, local) <= 0; }))
          return true;
    }
    return false;
  }

  bool operator()(std::size_t, const std::vector<Vector<3>>& corners, const Vector<3>& normal) const {
    Vector<3> centre = Vector<3>::Zero();
    for (const Vector<3>& c : corners)
      centre += c / static_cast<double>(corners.size());
    const auto open = [&](const Vector<3>& x) { return !covered(x + in_front * normal); };
    return open(centre) || std::any_of(corners.begin(), corners.end(),
                                       [&](const Vector<3>& c) { return open(0.1 * centre + 0.9 * c); });
  }
};

// by the displacement of a block: to 0.1 mm, 0.3 mm, 1 mm, 10 mm, farther
std::uint32_t colour(double way) {
  return way < 1e-4 ? 0xdeebf7 : way < 3e-4 ? 0x9ecae1 : way < 1e-3 ? 0x3182bd : way < 1e-2 ? 0xe69f00 : 0xd55e00;
}

void draw(const RecordedRun<3>& settled) {
  const State<3>& state = settled.last();
  const Camera camera{-55,
                      32,
                      {"floor", "west", "east", "south", "north"},
                      [&](std::size_t body) { return colour(state.bodies.motions[body].displacement.norm()); },
                      Exposure{settled.model(), state}};
  write_objects("slicing", "settled.gp", picture(settled.model(), state, camera));
}

TEST(SlicingSettling, ACornerOfItComesToRest) {
  CaseReport report("slicing", {"settling: weight on floor and walls"});
  const RecordedRun<3> settled =
      record<3>("bench.toml",
                {"domain.box.max=[2.8, 2.2, 2.6]", "excavations.bench.box={ min = [1.4, -1, 1.3], max = [4, 4, 4] }",
                 "blocks.east.box={ min = [2.8, -1, 0], max = [4, 4, 4] }",
                 "blocks.north.box={ min = [0, 2.2, 0], max = [2.8, 4, 4] }"});
  check(report, "", settled);
  draw(settled);
}

TEST(SlicingSettling, ThreeHundredBlocksReachEquilibriumByRelaxation) {
  CaseReport report("slicing");
  check(report, ", 327 blocks by relaxation", record<3>("rock_mass.toml", {"statics=\"adaptive\""}));
}

// cost counts of reaching equilibrium, so that they grow with the rock no faster than core/step/NOTES.md states
void check_cost(CaseReport& report, const std::string& which, const RecordedRun<3>& settled, double most) {
  const State<3>& state = settled.last();
  const auto touching = std::count_if(state.contacts.list.begin(), state.contacts.list.end(),
                                      [](const Contact<3>& c) { return c.touching(); });
  const Counters& counters = settled.run.results.counters;
  report.record(
      {"settling: evaluations a touching pair" + which,
       "1",
       Kind::limit,
       "promise: core/step/NOTES.md",
       0,
       {most, 0, Bound::at_most},
       "those measured, and half as much again: the order of rounding decides which joints open and close in between"},
      static_cast<double>(counters.contact_evaluations) / static_cast<double>(touching), cost(settled.run));
  report.record(
      {"settling: left to relaxation" + which, "1", Kind::exact, "demanded: none need be", 0, {0.5, 0}, "a count"},
      static_cast<double>(counters.static_fallbacks), cost(settled.run));
}

TEST(SlicingSettling, ThreeHundredBlocksReachEquilibriumByNewtonsMethod) {
  CaseReport report("slicing");
  const RecordedRun<3> settled = record<3>("rock_mass.toml", {"statics=\"newton\""});
  check(report, ", 327 blocks by Newton's method", settled);
  check_cost(report, ", 327 blocks by Newton's method", settled, 62);
}

TEST(SlicingSettlingLong, TwentyFiveHundredBlocksReachEquilibriumByNewtonsMethod) {
  CaseReport report("slicing");
  const RecordedRun<3> settled = record<3>("settling.toml", {"statics=\"newton\""});
  check(report, ", 2500 blocks by Newton's method", settled);
  check_cost(report, ", 2500 blocks by Newton's method", settled, 114);
}

TEST(SlicingSettlingLong, TwentyFiveHundredBlocksComeToRest) {
  CaseReport report("slicing");
  const RecordedRun<3> settled = record<3>("settling.toml");
  check(report, ", 2500 blocks", settled);
  draw(settled);
}

// on four points a face: one point resists no twist, and a block that spins on it does not come to rest (README)
TEST(SlicingSettlingLong, TwentyFiveHundredBlocksReachEquilibriumByRelaxation) {
  CaseReport report("slicing");
  check(report, ", 2500 blocks by relaxation",
        record<3>("settling.toml", {"statics=\"adaptive\"", "joint_properties.rock.sub_contacts=2"}));
}

}  // namespace
}  // namespace voussoir::cases::settling_test
