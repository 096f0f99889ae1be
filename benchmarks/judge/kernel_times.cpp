#include "benchmarks/judge/kernel_times.hpp"

#include <algorithm>
#include <ctime>

namespace voussoir::benchmarks {
namespace {

// the first pairs tell how many a repetition has time for
constexpr std::size_t pairs_on_trial = 10;

double processor_seconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double seconds_of(const Prepared& prepared, std::size_t count) {
  prepared.restore(0, count);
  const double start = processor_seconds();
  prepared.resolve(0, count);
  return processor_seconds() - start;
}

struct Racer {
  const Method* method;
  std::shared_ptr<Prepared> prepared;
  std::size_t count;
  std::vector<double> seconds;
};

Racer racer_of(const Method& method, const Workload& work, const TimingPlan& plan) {
  Racer racer{&method, method.prepare(work), 0, {}};
  const std::size_t trial = std::min(pairs_on_trial, method.pairs);
  seconds_of(*racer.prepared, trial);  // the first call finds nothing in the cache
  const double each = std::max(seconds_of(*racer.prepared, trial) / static_cast<double>(trial), 1e-9);
  racer.count = std::clamp(static_cast<std::size_t>(plan.seconds / each), trial, method.pairs);
  return racer;
}

KernelTime result_of(Racer& racer, const Workload& work) {
  std::nth_element(racer.seconds.begin(), racer.seconds.begin() + racer.seconds.size() / 2, racer.seconds.end());
  KernelTime time{name_of(work.shape),          name_of(work.state), racer.method->name, "", 0, 0,
                  static_cast<int>(racer.count)};
  time.delivers = racer.method->stage == "decision" ? "decision" : "contact";
  time.median_ns = 1e9 * racer.seconds[racer.seconds.size() / 2] / static_cast<double>(racer.count);
  for (std::size_t i = 0; i < racer.count; ++i)
    time.wrong += racer.prepared->touching(i) != work.touching();
  return time;
}

// a workload's blocks and poses as the kernel gets them
struct KernelPairs {
  std::vector<PreparedBlock> blocks;
  std::vector<const void*> first, second;
  std::vector<voussoir_pose> poses;

  KernelPairs(const Kernel& kernel, const Workload& work) {
    for (const Polytope<3>& part : *work.parts)
      blocks.emplace_back(kernel, part.faces, part.vertices);
    for (const Pair<3>& pair : work.pairs) {
      first.push_back(blocks[static_cast<std::size_t>(pair.a - work.parts->data())].handle());
      second.push_back(blocks[static_cast<std::size_t>(pair.b - work.parts->data())].handle());
      poses.push_back(pose_of(pair.rotation, pair.offset));
    }
  }
};

}  // namespace

Method method_of(const Kernel& kernel, std::int32_t asked) {
  Method method;
  method.name = kernel.name;
  method.stage = asked == VOUSSOIR_DECISION ? "decision" : "overlap";
  method.delivers = asked == VOUSSOIR_DECISION ? "decision" : "decision point normal overlap";
  method.applies = asked == VOUSSOIR_DECISION ? any_pair : overlapping;
  method.prepare = [kernel, asked](const Workload& work) {
    const auto pairs = std::make_shared<const KernelPairs>(kernel, work);
    return prepared_query(work.pairs.size(), [kernel, asked, pairs](std::size_t i) {
      voussoir_answer answer{};
      const std::int32_t failed = kernel.contact(pairs->first[i], pairs->second[i], &pairs->poses[i], asked, &answer);
      return failed == 0 && answer.touch == 1;
    });
  };
  return method;
}

TimingPlan all_pairs_timed() {
  TimingPlan plan;
  for (int s = 0; s < shape_count; ++s)
    plan.shapes.push_back(static_cast<Shape>(s));
  plan.states = {PairState::separated, PairState::near, PairState::touch, PairState::face, PairState::deep};
  return plan;
}

std::vector<KernelTime> time_kernel(const Kernel& kernel, const std::vector<Method>& others, const TimingPlan& plan) {
  std::vector<Method> methods{method_of(kernel, VOUSSOIR_DECISION), method_of(kernel, VOUSSOIR_CONTACT)};
  methods.insert(methods.end(), others.begin(), others.end());
  std::vector<KernelTime> times;
  for (const Shape shape : plan.shapes)
    for (const PairState state : plan.states) {
      const Workload& work = workload(shape, state);
      std::vector<Racer> racers;
      for (const Method& method : methods)
        if (method.applies(state)) racers.push_back(racer_of(method, work, plan));
      // our methods share their data, so each lays out its own before it runs
      for (int repetition = 0; repetition < plan.repetitions; ++repetition)
        for (Racer& racer : racers)
          racer.seconds.push_back(seconds_of(*racer.prepared, racer.count));
      for (Racer& racer : racers) {
        seconds_of(*racer.prepared, racer.count);
        times.push_back(result_of(racer, work));
      }
    }
  return times;
}

}  // namespace voussoir::benchmarks
