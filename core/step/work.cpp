#include "core/step/work.hpp"

#include "core/base/on_threads.hpp"

namespace voussoir {
namespace {

// the work of some bodies' loads, J
struct Work {
  double kinetic = 0;
  std::array<double, load_count> before{}, after{};  // the halves at the velocities before and after the kick
};

}  // namespace

template <int Dim>
void add_work(const Model<Dim>& model, int threads, const std::vector<Kick<Dim>>& kicks, const LoadsState<Dim>& loads,
              const Relaxation<Dim>& relaxation, EnergyBalance& energy) {
  const auto work = [&](int b, Work& sum) {
    if (model.bodies[b].immobile()) return;
    const Kick<Dim>& kick = kicks[b];
    sum.kinetic += kick.kinetic;
    for (std::size_t i = 0; i < load_count; ++i) {
      const std::vector<Load<Dim>>& acting = loads.by_source.values[i];
      if (acting.empty()) continue;
      sum.before[i] += acting[b].force.dot(kick.path_before) + acting[b].moment.dot(kick.turn_before);
      sum.after[i] += acting[b].force.dot(kick.path_after) + acting[b].moment.dot(kick.turn_after);
    }
  };
  Work all;
  for (const Work& some : sums_in_groups<Work>(threads, kicks.size(), work)) {
    all.kinetic += some.kinetic;
    for (std::size_t i = 0; i < load_count; ++i) {
      all.before[i] += some.before[i];
      all.after[i] += some.after[i];
    }
  }
  const auto add = [&](const std::array<double, load_count>& halves) {
    for (std::size_t i = 0; i < load_count; ++i)
      energy.flows.values[i] += source_table[i].motion * halves[i];
  };
  energy.kinetic = relaxation.under_way ? 0 : all.kinetic;
  add(all.before);
  balance(energy);
  add(all.after);
}

template void add_work<2>(const Model<2>&, int, const std::vector<Kick<2>>&, const LoadsState<2>&, const Relaxation<2>&,
                          EnergyBalance&);
template void add_work<3>(const Model<3>&, int, const std::vector<Kick<3>>&, const LoadsState<3>&, const Relaxation<3>&,
                          EnergyBalance&);

}  // namespace voussoir
