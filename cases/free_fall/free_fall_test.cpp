// Two hundred regular polyhedra fall into a box and come to rest: no block is penetrated, and the energy is accounted
// for.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>

#include "cases/case_tools.hpp"
#include "cases/model_picture.hpp"
#include "cases/recorded_run.hpp"
#include "core/testing/fall_scene.hpp"
#include "core/testing/fall_watch.hpp"

namespace voussoir::cases {
namespace {

using namespace shapes;
using verification::Bound;
using verification::CaseReport;
using verification::Kind;

std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// a stiffness per area, at a point and integrated
const std::vector<std::string> per_area{"joint_properties.rock.constant_stiffness=false",
                                        "joint_properties.rock.normal_stiffness=2e9",
                                        "joint_properties.rock.shear_stiffness=1e9"};
std::vector<std::string> whole_contacts() {
  return {per_area[0], per_area[1], per_area[2], whole_faces};
}

std::filesystem::path write_scene(const std::string& file, const std::string& text) {
  const std::filesystem::path path = verification::case_output("free_fall") / file;
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

// a fall, its frames kept
struct Fall {
  LoadedScene loaded;
  std::vector<State<3>> frames;  // first and last included
  FallFindings found;

  const Prepared<3>& scene() const { return std::get<Prepared<3>>(loaded.prepared); }
};

Fall let_fall(const std::filesystem::path& path, const FallPlan& plan, const std::vector<std::string>& overrides = {}) {
  Fall fall{load_scene(path, overrides), {}, {}};
  fall.found = fall_until_rest(fall.scene(), plan.side * plan.pitch,
                               [&](const State<3>& state) { fall.frames.push_back(state); });
  return fall;
}

// whether the contacts' energy balance is judged, or only its error reported
enum class Balance { reported, checked };
enum class Rest { demanded, optional };

void check(CaseReport& report, const std::string& which, const Fall& fall, Balance balance,
           Rest rest = Rest::demanded) {
  const FallFindings& found = fall.found;
  const verification::Cost cost{found.counters.contact_evaluations, found.seconds};
  const auto at_most = [&](const std::string& quantity, const char* unit, const char* source, double value,
                           double limit, const char* reason) {
    report.record({quantity + which, unit, Kind::limit, source, 0, {limit, 0, Bound::at_most}, reason}, value, cost);
  };
  at_most("contacts without an answer", "1", "promise: every contact has a result",
          static_cast<double>(found.counters.unconverged), 0.5, "a count");
  at_most("overlaps beyond the potential particle's radius", "1", "demanded: stiff enough",
          static_cast<double>(found.counters.deep_overlaps), 0.5, "a count");
  at_most("deepest corner in the plate or a wall", "m", "promise: no block goes through", found.deepest,
          largest_potential_radius(fall.scene().model, fall.scene().settings.contact.potential_radius),
          "no overlap is beyond the radius of the bluntest block's potential particle");
  if (rest == Rest::demanded || found.kinetic < at_rest)
    at_most("kinetic energy at rest", "1", "equilibrium: as a fraction of the energy of the drop", found.kinetic,
            at_rest, "requirement on the case; the fall is ended there");
  else
    report.report("kinetic energy at the end, not at rest" + which, "1", found.kinetic,
                  "a block between two parallel faces keeps turning: contacts that act at points do not resist "
                  "(README.md)",
                  cost);
  for (const auto& [when, error] : {std::pair(", before the damping starts", found.before), {", at rest", found.end}}) {
    at_most(
        std::string("energy that the motion does not account for") + when, "1",
        "conservation of energy: work of all forces against kinetic energy, as a fraction of the energy of the drop",
        error.motion, motion_closed,
        "leapfrog closes to the rounding of some ten thousand steps of two hundred blocks");
    const std::string quantity = std::string("energy that the contacts do not account for") + when;
    if (balance == Balance::checked)
      at_most(quantity, "1",
              "conservation of energy: work of the contacts against springs, dashpots and friction, as a fraction of "
              "the energy of the drop",
              error.contacts, energy_balanced,
              "requirement on the case; the error of the time step falls with its square (README.md)");
    else
      report.report(quantity + which, "1", error.contacts,
                    "if edges cross, the published normal is not perpendicular to both: sliding along them works "
                    "against the spring without a change of the overlap (README.md)",
                    cost);
  }
}

void draw(const Fall& fall) {
  const Camera camera{-60, 24, {"west", "east", "south", "north"}};
  const Model<3>& model = fall.scene().model;
  const std::size_t impact = 4;  // 0.8 s: the lowest blocks have landed, the highest still fall
  write_picture("free_fall", "start.csv", model, fall.frames.front(), camera);
  write_picture("free_fall", "impact.csv", model, fall.frames[impact], camera);
  write_picture("free_fall", "rest.csv", model, fall.frames.back(), camera);
  std::vector<double> time, moving;
  for (const State<3>& state : fall.frames) {
    time.push_back(state.schedule.time);
    moving.push_back(kinetic_energy(model, state) / -fall.frames.back().ledger.energy.potential());
  }
  write_csv("free_fall", "kinetic.csv", {"time_s", "kinetic"}, {time, moving});
}

TEST(FreeFall, TheCommittedSceneIsTheGeneratorsOwn) {
  const std::string text = fall_scene({}, "Two hundred regular polyhedra fall into a box");
  const std::filesystem::path made = write_scene("scene.toml", text);
  EXPECT_TRUE(text == text_of(std::filesystem::path(VOUSSOIR_CASE_DIR) / "scene.toml"))
      << "copy " << made << " to the case's folder if the generator has changed on purpose";
}

TEST(FreeFall, AMixComesToRest) {
  CaseReport report("free_fall", {"contacts without an answer", "overlaps beyond the potential particle's radius",
                                  "deepest corner in the plate or a wall", "kinetic energy at rest"});
  const Fall fall = let_fall(std::filesystem::path(VOUSSOIR_CASE_DIR) / "scene.toml", {});
  check(report, "", fall, Balance::reported);
  draw(fall);
}

FallPlan forty_blocks() {
  FallPlan plan;
  plan.blocks = 40;
  plan.side = 3;
  return plan;
}

std::filesystem::path forty_scene() {
  return write_scene("forty.toml", fall_scene(forty_blocks(), "Forty falling blocks"));
}

TEST(FreeFall, ContactsThatHaveAPotentialKeepTheirEnergy) {
  CaseReport report("free_fall");
  check(report, ", forty blocks on the central path", let_fall(forty_scene(), forty_blocks(), conservative_contacts),
        Balance::checked);
}

TEST(FreeFallLong, ContactsThatHaveAPotentialKeepTheirEnergy) {
  CaseReport report("free_fall");
  const Fall fall = let_fall(std::filesystem::path(VOUSSOIR_CASE_DIR) / "scene.toml", {}, conservative_contacts);
  check(report, ", on the central path", fall, Balance::checked);
}

// Forty blocks until the damping would start, by four kinds of contact and three time steps. Whole contacts in the
// shortest steps take as long as all others together: only a long test has them.
void judge_balance_by_step(bool with_the_longest_run) {
  CaseReport report("free_fall");
  const std::filesystem::path scene = forty_scene();
  struct Limit {
    double value;
    const char *source, *because;
  };
  enum class When { end, worst };  // `worst` also counts errors that another part of the fall cancels
  const auto left_open = [&](const std::string& name, std::vector<std::string> overrides, double fraction,
                             const std::optional<Limit>& limit, When when = When::end) {
    overrides.push_back(fmt::format("time.fraction={}", fraction));
    overrides.push_back("stage.rest.time_limit_s=1e-3");
    const RecordedRun<3> fall = record<3>(scene, overrides, Demand::no_failure);
    const auto& energy = fall.last().ledger.energy;
    const bool at_worst = when == When::worst;
    const double open = at_worst ? energy.worst_error / -energy.potential() : energy_errors(fall.last()).contacts;
    const std::string quantity =
        fmt::format("energy that the contacts of forty blocks leave open{}, {}, at {} of the limit",
                    at_worst ? " at worst" : "", name, fraction);
    if (limit)
      report.record({quantity, "1", Kind::limit, limit->source, 0, {limit->value, 0, Bound::at_most}, limit->because},
                    open, cost(fall.run));
    else
      report.report(quantity, "1", open, "NOTES.md, What the contacts leave open", cost(fall.run));
    return open;
  };
  const std::vector<std::string> multipliers{"contact.normal=multipliers", "contact.point=chebyshev"},
      central_path{"contact.normal=multipliers", "contact.point=central_path",
                   fmt::format("contact.smoothing={}", smoothing)};

  std::vector<std::vector<double>> open(5);
  for (const double fraction : {1.0, 0.5, 0.2}) {
    open[0].push_back(fraction);
    open[1].push_back(left_open("published normal", {}, fraction, {}));
    open[2].push_back(left_open("multipliers", multipliers, fraction, {}));
    std::optional<Limit> of_path;  // measured: 4e-4 and 6e-5, a sixth more or less
    if (fraction < 1)
      of_path = {fraction == 0.2 ? 2e-4 : 1e-3, "convergence: a potential, second order in the step",
                 "four times the error of a step of second order"};
    open[3].push_back(left_open("central path", central_path, fraction, of_path));
    // required of integrated face contacts: one percent, a thousandth at a fifth, and a smaller error for a shorter
    // step
    double most = 0.01;
    if (fraction < 1) most = std::min(fraction == 0.2 ? energy_balanced : most, open[4].front());
    const Limit of_region{
        most, "conservation of energy: a potential, the depth of the overlap region, or the overlap of two faces",
        "requirement on the case; a shorter step has a smaller error than the limit"};
    open[4].push_back(fraction > 0.2 || with_the_longest_run
                          ? left_open("whole contacts", whole_contacts(), fraction, of_region, When::worst)
                          : std::nan(""));
  }
  left_open("a point with stiffness per area", per_area, 1, {});
  write_csv("free_fall", "balance.csv", {"fraction", "published", "multipliers", "central_path", "whole"}, open);
}
TEST(FreeFall, TheEnergyBalanceClosesWithTheSquareOfTheStep) {
  judge_balance_by_step(false);
}
TEST(FreeFallLong, TheEnergyBalanceClosesWithTheSquareOfTheStep) {
  judge_balance_by_step(true);
}

TEST(FreeFallLong, EveryShapeFalls) {
  CaseReport report("free_fall");
  for (int kind = 0; kind < 5; ++kind) {
    FallPlan plan;
    plan.kinds = {kind};
    const std::string& shape = regular_polyhedra[kind];
    const std::filesystem::path scene =
        write_scene(shape + ".toml", fall_scene(plan, "Two hundred of one shape: " + shape));
    check(report, ", " + shape, let_fall(scene, plan), Balance::reported, Rest::optional);
    check(report, ", " + shape + ", on the central path", let_fall(scene, plan, conservative_contacts),
          Balance::checked, Rest::optional);
  }
}

// the shape whose blocks rock on a point
TEST(FreeFallLong, DodecahedraComeToRestOnIntegratedContacts) {
  CaseReport report("free_fall");
  FallPlan plan;
  plan.kinds = {3};
  const std::filesystem::path scene =
      write_scene("dodecahedra_whole.toml", fall_scene(plan, "Two hundred dodecahedra on whole contacts"));
  check(report, ", dodecahedra on whole contacts", let_fall(scene, plan, whole_contacts()), Balance::checked);
}

}  // namespace
}  // namespace voussoir::cases
