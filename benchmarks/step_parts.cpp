// The cost of a step compared with its kernel: for a rock mass in equilibrium and for two hundred falling polyhedra,
// each part of a step in ns per touching pair, and the kernel's time for 64 of the same pairs repeatedly, which are
// then in the nearest cache. Parts and kernel alternate, in processor time of one thread, so that the quotients are
// valid on a shared machine, too.
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <functional>

#include "core/contact/narrow_phase.hpp"
#include "core/run/simulate.hpp"
#include "core/scene/scene.hpp"
#include "core/step.hpp"
#include "core/step/integrate.hpp"
#include "core/step/joint_forces.hpp"
#include "core/step/loads.hpp"
#include "core/step/motion.hpp"
#include "core/step/neighbours.hpp"
#include "core/step/relaxation.hpp"
#include "core/step/time_step.hpp"
#include "core/testing/fall_scene.hpp"

namespace voussoir::benchmarks {
namespace {

constexpr int rounds = 31;  // of which the median counts

struct Subject {
  Model<3> model;
  State<3> state;
  Settings settings;
  bool seeks_rest = false;
};

double processor_ns() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

// the scene at the end of settling, and a few steps of relaxation from there
Subject rock_mass(const char* file) {
  const Prepared<3> scene = prepare<3>(read_scene(file, {"statics=newton"}));
  Progress<3> progress = initial_progress(scene);
  simulate(scene, progress, {});
  Subject s{apply(scene.model, scene.stages[0].change), progress.state, scene.settings, true};
  begin_relaxation(s.state);
  return s;
}

Subject falling_polyhedra(double time) {
  Prepared<3> scene = prepare<3>(parse_scene(shapes::fall_scene({}, "fall"), "fall"));
  Subject s{std::move(scene.model), std::move(scene.state), scene.settings};
  while (s.state.schedule.time < time)
    step(s.model, s.settings, s.state);
  return s;
}

// 64 touching pairs from the entire scene, resolved repeatedly
struct KernelAlone {
  std::vector<Pair<3>> pairs;
  std::vector<Contact<3>> contacts;
  std::vector<Contact<3>*> places;

  explicit KernelAlone(const Subject& s) {
    const bool wide = std::ranges::any_of(s.model.properties, [](const auto& p) { return !p.constant_stiffness; });
    std::vector<const Contact<3>*> touching;
    for (const Contact<3>& c : s.state.contacts.list)
      if (c.touching()) touching.push_back(&c);
    const std::size_t count = std::min<std::size_t>(64, touching.size());
    for (std::size_t i = 0; i < count; ++i) {
      const Contact<3>& c = *touching[i * touching.size() / count];
      pairs.push_back(
          pair_of(s.model, s.state.bodies, c.part_a, c.part_b, wide ? QueryLevel::area : QueryLevel::overlap));
      contacts.push_back(c);
    }
    for (Contact<3>& c : contacts)
      places.push_back(&c);
  }

  double ns_per_pair(const Subject& s) {
    constexpr int times = 20;
    KernelCounters counters;
    narrow_phase<3>(pairs, s.settings.contact, s.model.solvers, places, counters);
    const double begin = processor_ns();
    for (int i = 0; i < times; ++i)
      narrow_phase<3>(pairs, s.settings.contact, s.model.solvers, places, counters);
    return (processor_ns() - begin) / times / static_cast<double>(pairs.size());
  }
};

void time_parts(const char* name, Subject s) {
  s.settings.threads = 1;
  KernelAlone kernel(s);
  const std::vector<std::pair<const char*, std::function<void()>>> parts{
      {"neighbours", [&] { find_neighbours(s.model, s.settings, s.state.bodies, s.state.contacts, s.state.counters); }},
      {"contacts, joint forces",
       [&] {
         find_joint_forces(s.model, s.settings, s.state.schedule,
                           joint_step(s.settings, s.state.time_step, s.state.relaxation), s.state.bodies,
                           s.state.contacts, s.state.ledger, s.state.counters);
       }},
      {"loads",
       [&] {
         sum_loads(s.model, s.settings, s.state.schedule, s.state.bodies, s.state.contacts, s.state.supports,
                   s.state.loads);
       }},
      {"motion",
       [&] {
         move_bodies(s.model, s.settings, s.state.counters, s.state.bodies, s.state.contacts, s.state.loads,
                     s.state.schedule, s.state.ledger, s.state.time_step, s.state.relaxation);
       }},
      {"rest",
       [&] {
         if (s.seeks_rest) unbalanced_ratio(s.model, 1, s.state);
       }},
  };
  const auto one_step = [&](std::vector<std::vector<double>>* times) {
    double whole = 0;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const double begin = processor_ns();
      parts[k].second();
      const double took = processor_ns() - begin;
      whole += took;
      if (times) (*times)[k].push_back(took);
    }
    ++s.state.counters.steps;
    return whole;
  };
  for (int i = 0; i < 20; ++i)
    one_step(nullptr);
  const Counters before = s.state.counters;
  std::vector<std::vector<double>> times(parts.size());
  std::vector<double> alone, whole, quotients, estimates;
  for (int i = 0; i < rounds; ++i) {
    alone.push_back(kernel.ns_per_pair(s));
    whole.push_back(one_step(&times));
    State<3> copy = s.state;
    const double begin = processor_ns();
    estimate_time_step(s.model, s.settings, s.settings.damping, copy.bodies, copy.loads, copy.contacts, copy.time_step);
    estimates.push_back(processor_ns() - begin);
  }
  const double touching = static_cast<double>(std::count_if(s.state.contacts.list.begin(), s.state.contacts.list.end(),
                                                            [](const Contact<3>& c) { return c.touching(); }));
  for (std::size_t i = 0; i < whole.size(); ++i)
    quotients.push_back(whole[i] / touching / alone[i]);
  const auto per_step = [&](long long Counters::*counter) {
    return static_cast<double>(s.state.counters.*counter - before.*counter) / rounds;
  };
  fmt::print("{}: {} bodies, {} candidates, {} touch; a step examines {:.0f}, {:.1f} of them without a warm start\n",
             name, s.model.bodies.size(), s.state.contacts.list.size(), touching,
             per_step(&Counters::contact_evaluations), per_step(&Counters::cold_starts));
  fmt::print("  {:26} {:8.1f} ns per pair, {:.2f} iterations\n", "kernel, 64 pairs in cache", median(alone),
             per_step(&Counters::newton_iterations) / per_step(&Counters::contact_evaluations));
  for (std::size_t k = 0; k < parts.size(); ++k)
    fmt::print("  {:26} {:8.1f} ns per touching pair\n", parts[k].first, median(times[k]) / touching);
  fmt::print("  {:26} {:8.1f} ns per touching pair: {:.2f} times the kernel\n", "step", median(whole) / touching,
             median(quotients));
  fmt::print("  {:26} {:8.1f} ns per touching pair, of every body, if one is due\n", "estimate of stiffness",
             median(estimates) / touching);
  std::fflush(stdout);
}

}  // namespace
}  // namespace voussoir::benchmarks

// a 3-D scene that settles
int main(int argc, char** argv) {
  using namespace voussoir::benchmarks;
  if (argc != 2) {
    fmt::print(stderr, "usage: {} <scene.toml>, a 3-D scene that settles\n", argv[0]);
    return 2;
  }
  time_parts("two hundred polyhedra fall", falling_polyhedra(1.0));
  time_parts("two hundred polyhedra at rest", falling_polyhedra(1.6));
  time_parts("rock mass in equilibrium", rock_mass(argv[1]));
}
