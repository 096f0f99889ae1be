// Twenty thousand polyhedra fall into a box (the case free_fall, a hundred times as many) and come to rest with a
// closed energy balance: the assertions of the case with two hundred, the time on all processors, and the gain by a
// second thread. Prints the results and writes build/reports/benchmarks/fall.csv. Fails if a promise is broken.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <thread>
#include <vector>

#include "app/base/progress_line.hpp"
#include "core/run/simulate.hpp"
#include "core/scene/scene.hpp"
#include "core/step.hpp"
#include "core/testing/fall_scene.hpp"
#include "core/testing/fall_watch.hpp"

namespace voussoir::benchmarks {
namespace {

constexpr int layers = 5;  // of blocks, as in the case, or a little more

struct Promise {
  const char* quantity;
  double value, limit;
  bool kept() const { return value <= limit; }
};

// speed-up of a step by a second thread, alternately from the same state; the median of some rounds
double gain_of_two_threads(Prepared<3>& scene, const State<3>& begin) {
  constexpr int rounds = 5, steps = 20;
  std::vector<double> gains;
  for (int round = 0; round < rounds; ++round) {
    double seconds[2];
    for (const int threads : {1, 2}) {
      State<3> state = begin;
      scene.settings.threads = threads;
      step(scene.model, scene.settings, state);  // lists allocate their memory
      const auto start = std::chrono::steady_clock::now();
      for (int i = 0; i < steps; ++i)
        step(scene.model, scene.settings, state);
      seconds[threads - 1] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    gains.push_back(seconds[0] / seconds[1]);
  }
  std::nth_element(gains.begin(), gains.begin() + rounds / 2, gains.end());
  return gains[rounds / 2];
}

}  // namespace
}  // namespace voussoir::benchmarks

// fall.csv's folder, then the number of blocks
int main(int argc, char** argv) {
  using namespace voussoir;
  using namespace voussoir::benchmarks;
  const int blocks = argc > 2 ? std::atoi(argv[2]) : 20'000;
  if (argc < 2 || blocks < 1) {
    fmt::print(stderr, "usage: {} <folder> [blocks]\n", argv[0]);
    return 2;
  }
  shapes::FallPlan plan;
  plan.blocks = blocks;
  plan.side = std::max(1, static_cast<int>(std::sqrt(blocks / layers)));
  Prepared<3> scene = prepare<3>(parse_scene(shapes::fall_scene(plan, "fall"), "fall", shapes::conservative_contacts));
  scene.settings.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));

  fmt::print("{} polyhedra fall into a box {} wide, on {} threads\n", blocks, plan.side, scene.settings.threads);
  std::fflush(stdout);
  ProgressLine line(true);
  State<3> last;
  const shapes::FallFindings found = shapes::fall_until_rest(
      scene, plan.side * plan.pitch, [&](const State<3>& state) { last = state; },
      [&](const ProgressReport& report) { line.show(report); });
  line.clear();
  const Promise promises[] = {
      {"kinetic energy at rest, of the drop's", found.kinetic, shapes::at_rest},
      {"unexplained energy of the contacts before damping", found.before.contacts, shapes::energy_balanced},
      {"unexplained energy of the contacts at rest", found.end.contacts, shapes::energy_balanced},
      {"unexplained energy of the motion before damping", found.before.motion, shapes::motion_closed},
      {"unexplained energy of the motion at rest", found.end.motion, shapes::motion_closed},
      {"contacts without a solution", static_cast<double>(found.counters.unconverged), 0},
      {"overlaps beyond the potential radius", static_cast<double>(found.counters.deep_overlaps), 0},
      {"deepest corner in plate or walls, m", found.deepest,
       shapes::largest_potential_radius(scene.model, scene.settings.contact.potential_radius)},
  };
  std::ofstream csv(std::string(argv[1]) + "/fall.csv");
  csv << "quantity,value,limit\n";
  bool all_kept = true;
  for (const Promise& p : promises) {
    fmt::print("  {:48} {:10.2e}  {} {:.2g}\n", p.quantity, p.value, p.kept() ? "<=" : "NOT <=", p.limit);
    csv << fmt::format("\"{}\",{},{}\n", p.quantity, p.value, p.limit);
    all_kept = all_kept && p.kept();
  }
  const double evaluations = static_cast<double>(found.counters.contact_evaluations);
  fmt::print("  {:.2f} s of the fall, {} steps, {:.3g} contact evaluations in {}: {:.2f} us of the clock each\n",
             found.time, found.counters.steps, evaluations, duration_text(found.seconds),
             1e6 * found.seconds / evaluations);
  csv << fmt::format("\"wall clock, s\",{},\n", found.seconds);
  const double gain = gain_of_two_threads(scene, last);
  fmt::print("  at rest two threads take a step {:.2f} times as fast as one\n", gain);
  csv << fmt::format("\"two threads against one\",{},\n", gain);
  return all_kept && csv ? 0 : 1;
}
