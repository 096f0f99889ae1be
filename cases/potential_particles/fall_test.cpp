// The five regular shapes, rounded, fall into a box and come to rest: no block is penetrated, and the energy is
// accounted for.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cases/potential_particles/trial.hpp"
#include "core/testing/fall_scene.hpp"
#include "core/testing/fall_watch.hpp"

namespace voussoir::cases::fall_test {
namespace {

using namespace shapes;
using verification::Bound;
using verification::CaseReport;
using verification::Kind;

constexpr double corner_radius = 0.2;  // of the smallest block's inscribed radius: 33 mm
constexpr double sphericity = 0.05;

enum class Overlap { bracketed, conservative };

const char* name_of(Overlap overlap) {
  return overlap == Overlap::bracketed ? ", bracketed overlap" : ", conservative overlap";
}

// Contacts so stiff that an impact at 7 m/s penetrates by v sqrt(m/K) = 13 mm, less than the 67 mm at which inner
// bodies would meet.
std::vector<std::string> settings_of(Overlap overlap, double fraction) {
  std::vector<std::string> settings{"joint_properties.rock.normal_stiffness=1e8",
                                    "joint_properties.rock.shear_stiffness=5e7",
                                    fmt::format("time.fraction={}", fraction)};
  if (overlap == Overlap::conservative)
    settings.insert(settings.end(), {"contact.normal=multipliers", "contact.point=central_path"});
  return settings;
}

struct RoundedScene {
  std::filesystem::path path;
  double size = 0;  // m, the smallest inscribed radius of the sharp blocks
};

// the scene of the case free_fall, its blocks, plate and walls made particles
RoundedScene rounded_fall(const FallPlan& plan) {
  const std::string sharp = fall_scene(plan, "Rounded regular polyhedra fall into a box");
  const LoadedScene loaded = load_scene(write_scene("fall_sharp", sharp));
  const auto& scene = std::get<Prepared<3>>(loaded.prepared);
  const double size = smallest_size(scene.model);
  const std::string particles = blocks_as_particles<3>(scene.model, scene.state, {corner_radius * size, sphericity});
  const std::size_t begin = sharp.find("blocks = ["), end = sharp.find("[[joint_properties]]");
  return {write_scene("fall", sharp.substr(0, begin) + particles + "\n" + sharp.substr(end)), size};
}

struct Fall {
  LoadedScene loaded;
  FallFindings found;
  double deepest = -INFINITY;  // m, over all frames: depth of the blocks' inscribed balls in plate or walls
  double room = 0;             // m: the deepest that an overlap may be

  const Prepared<3>& scene() const { return std::get<Prepared<3>>(loaded.prepared); }
};

// depth of the ball of the smallest inscribed radius about any centroid in plate or wall, m
double deepest_ball(const Model<3>& model, const State<3>& state, double radius, double width) {
  double deepest = -INFINITY;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].fixed) continue;
    const Vector<3> c = model.origin + model.bodies[b].reference + state.bodies.motions[b].displacement;
    deepest = std::max(deepest, radius - std::min({c[0], width - c[0], c[1], width - c[1], c[2]}));
  }
  return deepest;
}

Fall let_fall(const FallPlan& plan, const std::vector<std::string>& overrides) {
  const RoundedScene scene = rounded_fall(plan);
  Fall fall{load_scene(scene.path, overrides), {}, -INFINITY, 2 * corner_radius * scene.size};
  const double width = plan.side * plan.pitch;
  fall.found = fall_until_rest(fall.scene(), width, [&](const State<3>& state) {
    fall.deepest = std::max(fall.deepest, deepest_ball(fall.scene().model, state, scene.size, width));
  });
  return fall;
}

void check(CaseReport& report, const std::string& which, const Fall& fall, Overlap overlap) {
  const FallFindings& found = fall.found;
  const verification::Cost cost{found.counters.contact_evaluations, found.seconds};
  const auto at_most = [&](const std::string& quantity, const char* unit, const char* source, double value,
                           double limit, const char* reason) {
    report.record(
        {which + quantity + name_of(overlap), unit, Kind::limit, source, 0, {limit, 0, Bound::at_most}, reason}, value,
        cost);
  };
  at_most(": contacts without an answer", "1", "promise: every contact has a result",
          static_cast<double>(found.counters.unconverged), 0.5, "a count");
  at_most(": deepest in the plate or a wall", "m", "promise: no block goes through", fall.deepest, fall.room,
          "the overlap at which the inner bodies of block and wall would meet: the sum of their radii");
  if (found.kinetic < at_rest)
    at_most(": kinetic energy at rest", "1", "equilibrium: as a fraction of the energy of the drop", found.kinetic,
            at_rest, "requirement on the case; the fall is ended there");
  else
    report.report(which + ": kinetic energy at the end, not at rest" + name_of(overlap), "1", found.kinetic,
                  "contacts that act at points do not resist a spin about their normal (README.md)", cost);
  for (const auto& [when, error] :
       {std::pair(", before the damping starts", found.before), {", at the end", found.end}}) {
    at_most(
        std::string(": energy that the motion does not account for") + when, "1",
        "conservation of energy: work of all forces against kinetic energy, as a fraction of the energy of the drop",
        error.motion, motion_closed, "leapfrog closes to the rounding of some ten thousand steps");
    const std::string quantity = std::string(": energy that the contacts do not account for") + when;
    if (overlap == Overlap::conservative)
      at_most(quantity, "1",
              "conservation of energy: work of the contacts against springs, dashpots and friction, as a fraction of "
              "the energy of the drop",
              error.contacts, energy_balanced, "requirement on the case (README.md)");
    else
      report.report(which + quantity + name_of(overlap), "1", error.contacts,
                    "the bracketed overlap changes with the point, which does not affect the force (README.md)", cost);
  }
}

constexpr double balanced_step = 0.12;  // of the limit: the energy error of the step is then 2e-4

FallPlan twenty() {
  FallPlan plan;
  plan.blocks = 20;
  plan.side = 3;
  return plan;
}

// the short sibling: two seconds of rest
TEST(PotentialParticles, TwentyFall) {
  CaseReport report("potential_particles");
  std::vector<std::string> settings = settings_of(Overlap::conservative, balanced_step);
  settings.push_back("stage.rest.time_limit_s=2");
  check(report, "twenty", let_fall(twenty(), settings), Overlap::conservative);
}

TEST(PotentialParticlesLong, TwoHundredFallAndComeToRest) {
  CaseReport report("potential_particles");
  for (const Overlap overlap : {Overlap::bracketed, Overlap::conservative})
    check(report, "two hundred", let_fall({}, settings_of(overlap, balanced_step)), overlap);
}

// Until the damping would start: the energy error of the contacts falls with the square of the step if the force has a
// potential; otherwise a part remains.
void follow_the_step(const std::string& which, const std::vector<double>& fractions) {
  CaseReport report("potential_particles");
  std::vector<std::vector<double>> open{fractions};
  for (const Overlap overlap : {Overlap::bracketed, Overlap::conservative}) {
    std::vector<double>& left_open = open.emplace_back();
    for (const double fraction : fractions) {
      std::vector<std::string> settings = settings_of(overlap, fraction);
      settings.push_back("stage.rest.time_limit_s=1e-3");
      left_open.push_back(let_fall(twenty(), settings).found.before.contacts);
      report.report(
          fmt::format("{}, {} of the limit: energy left open by the contacts{}", which, fraction, name_of(overlap)),
          "1", left_open.back(), "before the damping starts, as a fraction of the energy of the drop");
    }
  }
  report.record({"twenty: energy left open at the smallest step over that at the largest, conservative overlap",
                 "1",
                 Kind::limit,
                 "convergence: second order in the step",
                 0,
                 {10 * std::pow(fractions.back() / fractions.front(), 2), 0, Bound::at_most},
                 "the square of the steps' ratio; a fall is chaotic, and its error varies by a factor of some units "
                 "from one fall to the next"},
                open[2].back() / open[2].front());
  write_csv("potential_particles", "balance.csv", {"fraction", "bracketed", "conservative"}, open);
}

TEST(PotentialParticles, TheEnergyBalanceClosesWithTheSquareOfTheStep) {
  follow_the_step("twenty", {1, 0.5, 0.25});
}

TEST(PotentialParticlesLong, TheEnergyBalanceClosesWithTheSquareOfSmallSteps) {
  follow_the_step("twenty, down to small steps", {1, 0.5, 0.25, 0.12, 0.05, 0.02});
}

}  // namespace
}  // namespace voussoir::cases::fall_test
