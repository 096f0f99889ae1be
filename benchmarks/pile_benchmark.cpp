// Complete steps of piles of regular polyhedra that fall into a box (the case free_fall): time for each part of a step,
// per step and per contact, by shape, number of blocks and threads; allocations. Prints a table and writes
// build/reports/benchmarks/step.csv.
//
// Two hundred blocks fall and settle; larger numbers are such piles side by side, each in its box, so that all have the
// same contacts per block from the first step. Each part is timed within complete steps, alternately with one and two
// threads so that both run under the same conditions.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>

#include "core/scene/scene.hpp"
#include "core/step.hpp"
#include "core/step/contacts.hpp"
#include "core/step/joint_forces.hpp"
#include "core/step/loads.hpp"
#include "core/step/motion.hpp"
#include "core/step/neighbours.hpp"
#include "core/testing/counted_allocations.hpp"
#include "core/testing/fall_scene.hpp"

namespace voussoir::benchmarks {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int pile_blocks = 200;
constexpr double settling_time = 1.6;  // s: most blocks are at rest, some still roll
constexpr int warm_up_steps = 20;
constexpr int rounds = 5;  // of which the median counts

// steps in a round: enough for the timing, few enough for the duration
int steps_of(int blocks) {
  return std::clamp(20'000 / blocks, 3, 50);
}

const std::array<const char*, 5> stage_names{"neighbours", "contacts", "joint_laws", "loads", "motion"};
using Times = std::array<double, 5>;  // ns

struct Pile {
  Model<3> model;
  State<3> state;
  Settings settings;
};

// two hundred blocks that have fallen
Pile settled_pile(int kind) {
  shapes::FallPlan plan;
  plan.kinds = {kind};
  plan.blocks = pile_blocks;
  Prepared<3> scene = prepare<3>(parse_scene(shapes::fall_scene(plan, "pile"), "pile"));
  Pile pile{std::move(scene.model), std::move(scene.state), scene.settings};
  while (pile.state.schedule.time < settling_time)
    step(pile.model, pile.settings, pile.state);
  return pile;
}

// copies side by side, walls included; contacts start again
Pile side_by_side(const Pile& one, int copies) {
  const int columns = static_cast<int>(std::ceil(std::sqrt(copies)));
  double width = 0;
  for (const Body<3>& body : one.model.bodies)
    width = std::max(width, 2 * (body.reference.head<2>().cwiseAbs().maxCoeff() + body.radius));
  Pile many{one.model, {}, one.settings};
  many.model.bodies.clear();
  std::vector<Motion<3>> motions;
  for (int copy = 0; copy < copies; ++copy) {
    const Vector<3> shift(width * (copy % columns), width * (copy / columns), 0);
    for (std::size_t b = 0; b < one.model.bodies.size(); ++b) {
      many.model.bodies.push_back(one.model.bodies[b]);
      many.model.bodies.back().reference += shift;
      motions.push_back(one.state.bodies.motions[b]);
    }
  }
  list_parts(many.model);
  many.state = initial_state(many.model);
  many.state.bodies.motions = std::move(motions);
  for (int i = 0; i < warm_up_steps; ++i)
    step(many.model, many.settings, many.state);
  return many;
}

// the parts of `step`, timed
void timed_step(const Pile& pile, State<3>& state, Times& times) {
  const std::array<std::function<void()>, 5> stages{
      [&] { find_neighbours(pile.model, pile.settings, state.bodies, state.contacts, state.counters); },
      [&] { find_contacts(pile.model, pile.settings, 0, state.bodies, state.contacts, state.counters); },
      [&] {
        apply_joint_laws(pile.model, pile.settings, state.schedule,
                         joint_step(pile.settings, state.time_step, state.relaxation), state.bodies, state.contacts,
                         state.ledger, state.counters);
      },
      [&] {
        sum_loads(pile.model, pile.settings, state.schedule, state.bodies, state.contacts, state.supports, state.loads);
      },
      [&] {
        move_bodies(pile.model, pile.settings, state.counters, state.bodies, state.contacts, state.loads,
                    state.schedule, state.ledger, state.time_step, state.relaxation);
      }};
  for (std::size_t k = 0; k < stages.size(); ++k) {
    const auto begin = Clock::now();
    stages[k]();
    times[k] += std::chrono::duration<double, std::nano>(Clock::now() - begin).count();
  }
  ++state.counters.steps;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

int touching(const State<3>& state) {
  return static_cast<int>(std::count_if(state.contacts.list.begin(), state.contacts.list.end(),
                                        [](const Contact<3>& c) { return c.touching(); }));
}

// times of each part per step, for one and for two threads, each from the same state
std::array<Times, 2> time_pile(Pile& pile, int steps) {
  std::array<std::array<std::vector<double>, 5>, 2> seen;
  const State<3> begin = pile.state;
  for (int round = 0; round < rounds; ++round)
    for (int threads = 1; threads <= 2; ++threads) {
      pile.state = begin;
      pile.settings.threads = threads;
      Times times{};
      for (int i = 0; i < steps; ++i)
        timed_step(pile, pile.state, times);
      for (std::size_t k = 0; k < times.size(); ++k)
        seen[threads - 1][k].push_back(times[k] / steps);
    }
  std::array<Times, 2> result;
  for (std::size_t t = 0; t < 2; ++t)
    for (std::size_t k = 0; k < 5; ++k)
      result[t][k] = median(seen[t][k]);
  return result;
}

// allocations of steps that renew no neighbours, on one thread; -1: every step renewed them
long long allocations_of_a_step(Pile& pile) {
  pile.settings.threads = 1;
  for (int i = 0; i < 20; ++i) {
    const long long builds = pile.state.counters.neighbour_builds, before = allocations;
    step(pile.model, pile.settings, pile.state);
    const long long made = allocations - before;
    if (pile.state.counters.neighbour_builds == builds) return made;
  }
  return -1;
}

void run(const Pile& settled, int kind, int blocks, std::ofstream& csv) {
  Pile pile = side_by_side(settled, blocks / pile_blocks);
  const std::array<Times, 2> times = time_pile(pile, steps_of(blocks));
  const int contacts = touching(pile.state);
  const std::string& shape = shapes::regular_polyhedra[kind];
  std::array<double, 2> whole{};
  for (std::size_t t = 0; t < 2; ++t) {
    for (const double ns : times[t])
      whole[t] += ns;
    const auto row = [&](const char* stage, double ns) {
      csv << fmt::format("{},{},{},{},{:.0f},{:.1f},{}\n", shape, blocks, t + 1, stage, ns, ns / contacts, contacts);
    };
    for (std::size_t k = 0; k < 5; ++k)
      row(stage_names[k], times[t][k]);
    row("step", whole[t]);
  }
  csv.flush();
  std::string fractions;
  for (std::size_t k = 0; k < 5; ++k)
    fractions += fmt::format(" {:9.1f}%", 100 * times[0][k] / whole[0]);
  fmt::print("{:12} {:6} {:8} {:10.1f} {:10.1f}{} {:9.2f} {:6}\n", shape, blocks, contacts, whole[0] * 1e-3,
             whole[0] / contacts, fractions, whole[0] / whole[1], allocations_of_a_step(pile));
  std::fflush(stdout);
}

}  // namespace
}  // namespace voussoir::benchmarks

// step.csv's folder, then the numbers of blocks: multiples of two hundred
int main(int argc, char** argv) {
  using namespace voussoir;
  if (argc < 2) {
    fmt::print(stderr, "usage: {} <folder> [blocks …]\n", argv[0]);
    return 2;
  }
  std::vector<int> sizes;
  for (int i = 2; i < argc; ++i)
    sizes.push_back(std::atoi(argv[i]));
  if (sizes.empty()) sizes = {200, 2000, 20'000};
  std::ofstream csv(std::string(argv[1]) + "/step.csv");
  csv << "shape,blocks,threads,stage,ns_per_step,ns_per_contact,contacts\n";
  fmt::print("{:12} {:>6} {:>8} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10} {:>9} {:>6}\n", "shape", "blocks",
             "contacts", "us/step", "ns/contact", "neighbours", "contacts", "laws", "loads", "motion", "2 threads",
             "allocs");
  for (int kind = 0; kind < 5; ++kind) {
    const benchmarks::Pile settled = benchmarks::settled_pile(kind);
    for (const int blocks : sizes)
      benchmarks::run(settled, kind, blocks, csv);
  }
  return csv ? 0 : 1;
}
