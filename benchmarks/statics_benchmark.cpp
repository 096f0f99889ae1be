// Newton's method for statics (core/step/static_solver.hpp) on sliced rock: seconds to equilibrium by number of blocks,
// on points and on whole faces, for softer and stiffer joints, after a small change, of an excavation, and of a trial
// of a search; of walls and columns; what each part takes. Prints a table and writes
// build/reports/benchmarks/statics.csv. Processor seconds of one thread; the gain of a second thread is of the clock,
// and told only if the machine is quiet.
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/run/run.hpp"
#include "core/run/simulate.hpp"
#include "core/scene/scene.hpp"
#include "core/solvers/incomplete_factors.hpp"
#include "core/step/joint_forces.hpp"
#include "core/step/pair_stiffness.hpp"
#include "core/step/relaxation.hpp"
#include "core/step/static_solver_base.hpp"
#include "core/step/tangent.hpp"
#include "core/testing/stacks.hpp"

namespace voussoir::benchmarks {
namespace {

constexpr int repetitions = 5;      // of which the median counts
constexpr int many_blocks = 5'000;  // with more, one run
constexpr double quiet_load = 1.0;  // of other programs, in the mean of a minute

double processor_seconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double clock_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

struct Box {
  int length, width, height;  // m
};

// the rock mass of cases/slicing between walls; open to the west if that wall lies below the floor
std::string rock_mass(const Box& box, const std::string& stages, bool open_to_west = false) {
  const int x = box.length, y = box.width, z = box.height;
  const auto block = [](const char* name, int x0, int y0, int z0, int x1, int y1, int z1) {
    return fmt::format("{{ name = \"{}\", box = {{ min = [{}, {}, {}], max = [{}, {}, {}] }}, fixed = true }},\n", name,
                       x0, y0, z0, x1, y1, z1);
  };
  const std::string blocks =
      block("floor", -1, -1, -1, x + 1, y + 1, 0) +
      (open_to_west ? block("west", -1, -1, -3, 0, 0, -2) : block("west", -1, -1, 0, 0, y + 1, z)) +
      block("south", 0, -1, 0, x, 0, z) + block("north", 0, y, 0, x, y + 1, z) +
      block("east", x, -1, 0, x + 1, y + 1, z);
  return fmt::format(
      "base = \"rock_mass.toml\"\nstatics = \"newton\"\nblocks = [\n{}]\n[domain]\nbox = {{ min = [0, 0, 0], max = "
      "[{}, {}, {}] }}\n{}",
      blocks, x, y, z, stages);
}

constexpr const char* settles = "[[stage]]\nname = \"settle\"\nkind = \"settle\"\n";

struct Subject {
  std::string name, text;
  std::vector<std::string> overrides{};
  int from_stage = 0;  // the first of those that are timed
  bool once = false;   // for it takes minutes
};

Prepared<3> prepared(const Subject& subject) {
  return prepare<3>(
      parse_scene(subject.text, VOUSSOIR_SOURCE_DIR "/cases/slicing/statics_benchmark.toml", subject.overrides));
}

struct Measured {
  double seconds = 0, clock = 0;
  Counters counters;  // of the timed stages
  std::string outcome;
};

Counters difference(Counters after, const Counters& before) {
  for (const CounterRow& row : counter_table)
    after.*row.value -= before.*row.value;
  return after;
}

Measured run_once(Prepared<3> scene, const Subject& subject, int threads, Progress<3>& progress) {
  scene.settings.threads = threads;
  progress = initial_progress(scene);
  if (subject.from_stage > 0) {
    const int last = static_cast<int>(scene.stages.size()) - 1;
    scene.last_stage = subject.from_stage - 1;
    simulate(scene, progress, {});
    scene.last_stage = last;
  }
  const Counters before = progress.state.counters;
  const double begin = processor_seconds(), clock = clock_seconds();
  simulate(scene, progress, {});
  Measured m{processor_seconds() - begin, clock_seconds() - clock, difference(progress.state.counters, before), {}};
  const auto& stages = progress.results.stages;
  m.outcome = stages.empty() ? "" : stages.back().ended;
  return m;
}

// seconds that one call takes
double seconds_of(const std::function<void()>& call) {
  call();
  std::vector<double> times;
  for (int i = 0; i < repetitions; ++i) {
    const double begin = processor_seconds();
    call();
    times.push_back(processor_seconds() - begin);
  }
  return median(times);
}

struct Share {
  const char* part;
  double seconds;
};

// How often each part was carried out, times what it takes at the end.
std::vector<Share> shares_of(const Prepared<3>& scene, const Progress<3>& done, const Counters& c) {
  State<3> state = done.state;
  Settings settings = settings_of(scene.stages[0], scene.settings);
  settings.threads = 1;
  const Model<3> model = apply(scene.model, scene.stages[0].change);
  const Unknowns<3> unknowns(model);
  const StaticBase<3> base = base_of(state);
  const JointStep law_step = joint_step(settings, state.time_step, state.relaxation);
  std::vector<PairStiffness<3>> pairs;
  find_pair_stiffness(model, settings, state.schedule, law_step, state.bodies, state.contacts, base.histories,
                      unknowns.place, state.counters, pairs);
  std::vector<const PairStiffness<3>*> all;
  for (const PairStiffness<3>& pair : pairs)
    all.push_back(&pair);
  BlockMatrix<6> k, again;
  find_tangent<3>(1, all, {}, unknowns.place, unknowns.free, k);
  k.add_diagonal(1e-6 * unknowns.scale);
  IncompleteFactors<6> factors;
  factors.factorise(k, unknowns.upwards);
  Eigen::VectorXd x, y;
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(unknowns.free.size());
  const auto times = [](long long count, double seconds) { return static_cast<double>(count) * seconds; };
  return {{"contacts and joint laws", times(c.steps, seconds_of([&] {
                                              State<3> copy = state;
                                              find_joint_forces(model, settings, copy.schedule, law_step, copy.bodies,
                                                                copy.contacts, copy.ledger, copy.counters);
                                            }))},
          {"stiffness of pairs", times(c.static_iterations, seconds_of([&] {
                                         find_pair_stiffness(model, settings, state.schedule, law_step, state.bodies,
                                                             state.contacts, base.histories, unknowns.place,
                                                             state.counters, pairs);
                                       }))},
          {"matrix", times(c.linear_systems,
                           seconds_of([&] { find_tangent<3>(1, all, {}, unknowns.place, unknowns.free, again); }))},
          {"factors", times(c.linear_systems, seconds_of([&] { factors.factorise(k, unknowns.upwards); }))},
          {"products and solutions", times(c.linear_iterations, seconds_of([&] {
                                             factors.solve(b, x);
                                             k.times(1, x, y);
                                           }))}};
}

double load_average() {
  double load = 0;
  return getloadavg(&load, 1) == 1 ? load : quiet_load + 1;
}

template <int Dim>
void print_row(const std::string& name, const Model<Dim>& model, const State<Dim>& state, double took,
               const Counters& c, const std::string& outcome, std::ofstream& csv) {
  const auto blocks = std::ranges::count_if(model.bodies, [](const Body<Dim>& b) { return !b.fixed; });
  const auto touching = std::ranges::count_if(state.contacts.list, &Contact<Dim>::touching);
  const double products =
      static_cast<double>(c.linear_iterations) / static_cast<double>(std::max(c.linear_systems, 1LL));
  fmt::print(
      "{:34} {:6} blocks, {:6} pairs touch: {:8.3f} s; {} steps and {} of few bodies, {} systems, {:.0f} products "
      "each, {} contact evaluations; {}\n",
      name, blocks, touching, took, c.static_iterations, c.static_iterations_of_few, c.linear_systems, products,
      c.contact_evaluations, outcome);
  csv << fmt::format("\"{}\",{},{},{},{},{},{},{},{}\n", name, blocks, touching, took, c.static_iterations,
                     c.linear_systems, c.linear_iterations, c.contact_evaluations, c.static_fallbacks);
  std::fflush(stdout);
}

// a model in the plane from where it was laid to rest
void time_stack(const std::string& name, const Model<2>& model, std::ofstream& csv) {
  std::vector<double> seconds;
  State<2> state;
  RunReport report;
  for (int i = 0; i < repetitions; ++i) {
    Settings settings;
    settings.statics.method = Statics::newton;
    settings.statics.increments = 1;
    settings.threads = 1;
    state = initial_state(model);
    const double begin = processor_seconds();
    report = run<2>(model, settings, {.rest = true, .step_limit = 1'000'000}, {}, state);
    seconds.push_back(processor_seconds() - begin);
  }
  print_row(name, model, state, median(seconds), state.counters,
            report.reason == StopReason::equilibrium ? "equilibrium" : "no equilibrium", csv);
}

void time_subject(const Subject& subject, std::ofstream& csv) {
  const Prepared<3> scene = prepared(subject);
  const auto blocks = std::ranges::count_if(scene.model.bodies, [](const Body<3>& b) { return !b.fixed; });
  std::vector<double> seconds;
  Progress<3> progress;
  Measured m;
  for (int i = 0; i < (subject.once || blocks > many_blocks ? 1 : repetitions); ++i) {
    m = run_once(scene, subject, 1, progress);
    seconds.push_back(m.seconds);
  }
  const double took = median(seconds);
  const Counters& c = m.counters;
  print_row(subject.name, scene.model, progress.state, took, c, m.outcome, csv);
  if (subject.overrides.empty() && subject.from_stage == 0 && scene.stages.size() == 1) {
    double rest = took;
    for (const Share& share : shares_of(scene, progress, c)) {
      fmt::print("    {:30} {:5.1f} %\n", share.part, 100 * share.seconds / took);
      rest -= share.seconds;
    }
    fmt::print("    {:30} {:5.1f} %\n", "the rest, certificate included", 100 * rest / took);
    if (load_average() > quiet_load + 1)
      fmt::print("    a second thread: not shown, since the machine is not quiet\n");
    else
      fmt::print("    a second thread: {:.2f} times as fast by the clock\n",
                 m.clock / run_once(scene, subject, 2, progress).clock);
  }
  std::fflush(stdout);
}

std::vector<Subject> subjects() {
  const Box of_327{5, 4, 4}, of_2488{11, 9, 6}, of_10640{17, 14, 10}, of_22170{22, 18, 12};
  const std::string settled = rock_mass(of_2488, settles);
  const std::string weaker =
      std::string(settles) +
      "[[stage]]\nname = \"weaker\"\nkind = \"settle\"\nfriction = [{ name = \"rock\", friction_deg = 34 }]\n";
  const std::string dug = std::string(R"([[excavations]]
name = "top"
box = { min = [0, 0, 5.2], max = [11, 9, 7] }
[[bolts]]
name = "wall"
from = [3.9, 4.5, 5.2]
to = [1.9, 4.5, 4.9]
stiffness = 1e8
yield = 150e3
)") + settles + R"([[stage]]
name = "dig"
kind = "settle"
excavate = ["top"]
excavation_forces = { remaining = 0.5, duration_s = 1 }
[[stage]]
name = "bolt"
kind = "settle"
install = ["wall"]
excavation_forces = { remaining = 0, duration_s = 1 }
[[stage]]
name = "wait"
kind = "settle"
)";
  const auto search = [](double to_factor, double tolerance) {
    return fmt::format(
        "{}[[stage]]\nname = \"search\"\nkind = \"reduce\"\nsearch = \"factor\"\nfrom_factor = 0.5\n"
        "to_factor = {}\ntolerance_factor = {}\n",
        settles, to_factor, tolerance);
  };
  std::vector<Subject> list{{"small rock mass", rock_mass(of_327, settles)}};
  list.push_back({"rock mass", settled});
  list.push_back({"whole faces", settled, {"contact.face=integrated"}});
  list.push_back({"joints ten times softer",
                  settled,
                  {"joint_properties.rock.normal_stiffness=1e8", "joint_properties.rock.shear_stiffness=0.5e8"}});
  list.push_back({"joints ten times stiffer",
                  settled,
                  {"joint_properties.rock.normal_stiffness=1e10", "joint_properties.rock.shear_stiffness=0.5e10"}});
  list.push_back({"ks = kn", settled, {"joint_properties.rock.shear_stiffness=1e9"}});
  list.push_back({"friction 20 deg", settled, {"joint_properties.rock.friction_deg=20"}});
  list.push_back({"friction 45 deg", settled, {"joint_properties.rock.friction_deg=45"}});
  list.push_back({"then one degree of friction less", rock_mass(of_2488, weaker), {}, 1});
  list.push_back({"excavation in three stages", rock_mass(of_2488, dug), {}, 1});
  // the first stands: its search ends without a bracket
  list.push_back({"a trial that stands, factor 3", rock_mass(of_2488, search(3, 0.05)), {}, 1});
  list.push_back({"factor of safety, ten trials", rock_mass(of_2488, search(4, 0.02), true), {}, 1, true});
  list.push_back({"rock mass", rock_mass(of_10640, settles)});
  list.push_back({"rock mass", rock_mass(of_22170, settles)});
  return list;
}

}  // namespace
}  // namespace voussoir::benchmarks

// the folder of statics.csv, then part of the names of the subjects that are timed: all without it
int main(int argc, char** argv) {
  using namespace voussoir::benchmarks;
  if (argc < 2) {
    fmt::print(stderr, "usage: {} <folder> [part of a name]\n", argv[0]);
    return 2;
  }
  std::ofstream csv(std::string(argv[1]) + "/statics.csv");
  csv << "subject,blocks,touching_pairs,processor_s,steps,systems,products,contact_evaluations,fallbacks\n";
  const std::string part = argc > 2 ? argv[2] : "";
  const auto wanted = [&](const std::string& name) { return name.find(part) != std::string::npos; };
  for (const Subject& subject : subjects())
    if (wanted(subject.name)) time_subject(subject, csv);
  if (wanted("column of squares")) {
    voussoir::Model<2> column = voussoir::shapes::column_of_squares(20'000);
    column.properties[0].normal_stiffness = 1e3 * column.bodies.back().mass * column.gravity.norm() * 20'000;
    time_stack("column of squares", column, csv);
  }
  if (wanted("wall of bricks")) time_stack("wall of bricks", voussoir::shapes::brick_wall(141), csv);
  return csv ? 0 : 1;
}
