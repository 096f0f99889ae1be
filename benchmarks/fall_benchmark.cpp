// Twenty thousand polyhedra fall into a box (the case free_fall, a hundred times as many) and come to rest with closed
// books: what the case asserts of two hundred, and the time it takes on all processors. Prints what it found and writes
// build/reports/benchmarks/fall.csv. Fails when a promise is broken.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "app/commands/progress_line.hpp"
#include "core/scene/scene.hpp"
#include "core/simulate.hpp"
#include "core/testing/fall_scene.hpp"
#include "core/testing/fall_watch.hpp"

namespace voussoir::benchmarks {
namespace {

constexpr int layers = 5;  // of blocks, as the case has them, or a little more

struct Promise {
  const char* quantity;
  double value, limit;
  bool kept() const { return value <= limit; }
};

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
  Prepared<3> scene = prepare<3>(parse_scene(shapes::fall_scene(plan, "fall"), "fall", shapes::closed_books));
  scene.settings.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));

  fmt::print("{} polyhedra fall into a box {} wide, on {} threads\n", blocks, plan.side, scene.settings.threads);
  std::fflush(stdout);
  ProgressLine line(true);
  const shapes::FallFindings found = shapes::fall_until_still(scene, plan.side * plan.pitch, {},
                                                              [&](const ProgressReport& report) { line.show(report); });
  line.clear();
  const Promise promises[] = {
      {"kinetic energy at rest, of the drop's", found.kinetic, shapes::still},
      {"energy the contacts leave open before damping", found.before.contacts, shapes::books_closed},
      {"energy the contacts leave open at rest", found.end.contacts, shapes::books_closed},
      {"energy the motion leaves open before damping", found.before.motion, shapes::motion_closed},
      {"energy the motion leaves open at rest", found.end.motion, shapes::motion_closed},
      {"contacts without an answer", static_cast<double>(found.counters.unconverged), 0},
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
  return all_kept && csv ? 0 : 1;
}
