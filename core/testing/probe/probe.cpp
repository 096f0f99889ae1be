// Prints the state hash of eight models every hundred steps. Built with different compilers and flags, run with
// different numbers of threads, it must print the same lines.
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "core/model/state_hash.hpp"
#include "core/step.hpp"
#include "core/testing/probe/models.hpp"

namespace {

using namespace voussoir;

struct Options {
  int steps = 1000;
  int every = 100;  // steps between two hashes
  int threads = 1;
  bool nudge = false;  // start every body one ulp faster: the lines must differ, or their comparison proves nothing
  bool flush = false;  // denormal numbers become zero, as operands and as results
};

[[noreturn]] void refuse(const char* argument) {
  std::fprintf(stderr, "probe: %s? usage: voussoir_probe [--steps n] [--every n] [--threads n] [--nudge] [--flush]\n",
               argument);
  std::exit(2);
}

int number(int argc, char** argv, int& at) {
  const int value = at + 1 < argc ? std::atoi(argv[at + 1]) : 0;
  if (value < 1) refuse(argv[at]);
  ++at;
  return value;
}

Options read(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    if (!std::strcmp(argv[i], "--steps"))
      options.steps = number(argc, argv, i);
    else if (!std::strcmp(argv[i], "--every"))
      options.every = number(argc, argv, i);
    else if (!std::strcmp(argv[i], "--threads"))
      options.threads = number(argc, argv, i);
    else if (!std::strcmp(argv[i], "--nudge"))
      options.nudge = true;
    else if (!std::strcmp(argv[i], "--flush"))
      options.flush = true;
    else
      refuse(argv[i]);
  }
  return options;
}

void flush_denormals() {
#if defined(__SSE2__)
  constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x0040;
  _mm_setcsr(_mm_getcsr() | flush_to_zero | denormals_are_zero);
#else
  refuse("--flush on this processor");
#endif
}

template <int Dim>
void run(probe::Scene<Dim> scene, const Options& options) {
  scene.settings.threads = options.threads;
  if (options.nudge)
    for (std::size_t b = 0; b < scene.state.bodies.motions.size(); ++b)
      if (double& speed = scene.state.bodies.motions[b].velocity[0]; !scene.model.bodies[b].fixed)
        speed = std::nextafter(speed, 1e300);
  for (int i = 1; i <= options.steps; ++i) {
    step(scene.model, scene.settings, scene.state);
    if (i % options.every == 0 || i == options.steps)
      std::printf("%s %d %s\n", scene.name, i, state_hash(scene.model, scene.state).c_str());
  }

  // motion and slip of the model, for the reader
  double farthest = 0, slip = 0;
  for (const Motion<Dim>& m : scene.state.bodies.motions)
    farthest = std::max(farthest, m.displacement.norm());
  int touching = 0;
  for (const Contact<Dim>& c : scene.state.contacts.list) {
    touching += c.touching();
    slip = std::max(slip, c.history.plastic_slip);
  }
  std::printf("%s: %zu bodies, %d contacts, %.3f s, moved %.3f m, slipped %.3f m, %lld without a result\n", scene.name,
              scene.model.bodies.size(), touching, scene.state.schedule.time, farthest, slip,
              scene.state.counters.unconverged);
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = read(argc, argv);
  if (options.flush) flush_denormals();
  run(probe::collapse(), options);
  run(probe::wall(), options);
  run(probe::tumble(), options);
  run(probe::smooth_tumble(), options);
  run(probe::flooded_tumble(), options);
  run(probe::flooded_wall(), options);
  run(probe::integrated_in(probe::tumble(), "whole_tumble"), options);
  run(probe::integrated_in(probe::wall(), "whole_wall"), options);
}
