// The contact kernel and its peers on the same pairs: shape/state/method/stage. An iteration resolves all pairs of a
// workload once; the data of a warm start are restored before it, outside the timing. Time is the thread's processor
// time, so that other work on the machine matters little; with two threads it is wall-clock time.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <mutex>

#include "benchmarks/peers/peers.hpp"
#include "core/base/version.hpp"

namespace voussoir::benchmarks {
namespace {

double seconds(int threads) {
  if (threads > 1) return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// The time between two consecutive calls of the clock: on a virtual machine up to a microsecond, a tenth of the
// shortest query. The median of many.
double clock_cost(int threads) {
  std::array<double, 1001> shown;
  for (double& s : shown) {
    const double start = seconds(threads);
    s = seconds(threads) - start;
  }
  std::nth_element(shown.begin(), shown.begin() + shown.size() / 2, shown.end());
  return shown[shown.size() / 2];
}

// one line of the benchmark; repetitions share its prepared data
struct Entry {
  Method method;
  Shape shape;
  PairState state;
  std::once_flag once;
  std::shared_ptr<Prepared> prepared;
  KernelCounters counters;  // of all pairs, once
  int wrong = 0;            // decisions that differ from the construction of the pairs

  Entry(Method m, Shape s, PairState p) : method(std::move(m)), shape(s), state(p) {}

  void prepare() {
    const Workload& work = workload(shape, state);
    prepared = method.prepare(work);
    prepared->restore(0, method.pairs);
    prepared->resolve(0, method.pairs);
    for (std::size_t i = 0; i < method.pairs; ++i)
      wrong += prepared->touching(i) != work.touching();
    if (prepared->counters) counters = *prepared->counters;
  }
};

void report(benchmark::State& state, const Entry& entry) {
  const double pairs = static_cast<double>(entry.method.pairs);
  const Workload& work = workload(entry.shape, entry.state);
  state.SetLabel(entry.method.delivers);
  // a zero is left out: its coefficient of variation would be a NaN, which is not JSON
  const auto put = [&](const char* name, double value) {
    if (value != 0) state.counters[name] = benchmark::Counter(value, benchmark::Counter::kAvgThreads);
  };
  put("pairs", pairs / entry.method.threads);  // of an iteration of one thread
  put("wrong", entry.wrong);
  put("planes", mean_planes(work));
  put("vertices", mean_vertices(work));
  put("newton", static_cast<double>(entry.counters.newton_iterations) / pairs);
  put("pivots", static_cast<double>(entry.counters.lp_pivots) / pairs);
  put("lp_solves", static_cast<double>(entry.counters.lp_solves) / pairs);
  put("areas", static_cast<double>(entry.counters.areas) / pairs);
}

void run(benchmark::State& state, const std::shared_ptr<Entry>& entry) {
  std::call_once(entry->once, [&] { entry->prepare(); });
  const int threads = entry->method.threads;
  const std::size_t count = entry->method.pairs / threads, first = count * state.thread_index();
  const double cost = clock_cost(threads);
  for (auto _ : state) {
    entry->prepared->restore(first, count);
    const double start = seconds(threads);
    entry->prepared->resolve(first, count);
    state.SetIterationTime(seconds(threads) - start - cost);
  }
  report(state, *entry);
}

std::vector<Method> all_methods() {
  std::vector<Method> list = own_methods();
  const auto add = [&](const std::vector<Method>& more) { list.insert(list.end(), more.begin(), more.end()); };
#ifdef VOUSSOIR_PEER_GLPK
  add(glpk_methods());
#endif
#ifdef VOUSSOIR_PEER_IPOPT
  add(ipopt_methods());
#endif
  add(library_methods());
  add(clip_methods());
  return list;
}

void register_all() {
  const std::vector<Method> methods = all_methods();
  for (int s = 0; s < shape_count; ++s)
    for (int p = 0; p < pair_state_count; ++p)
      for (const Method& method : methods) {
        const auto shape = static_cast<Shape>(s);
        const auto state = static_cast<PairState>(p);
        if (!method.applies(state) || !occurs(shape, state)) continue;
        const std::string name =
            std::string(name_of(shape)) + "/" + name_of(state) + "/" + method.name + "/" + method.stage;
        const auto entry = std::make_shared<Entry>(method, shape, state);
        benchmark::RegisterBenchmark(name.c_str(), [entry](benchmark::State& st) { run(st, entry); })
            ->UseManualTime()
            ->Threads(method.threads);
      }
}

}  // namespace
}  // namespace voussoir::benchmarks

int main(int argc, char** argv) {
  voussoir::benchmarks::register_all();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::AddCustomContext("commit", std::string(voussoir::commit()));
  benchmark::RunSpecifiedBenchmarks();
  benchmark::ClearRegisteredBenchmarks();  // GLPK's objects are freed before its environment
  benchmark::Shutdown();
}
