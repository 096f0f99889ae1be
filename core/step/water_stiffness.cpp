#include "core/step/water_stiffness.hpp"

#include "core/base/on_threads.hpp"
#include "core/model/water_surfaces.hpp"

namespace voussoir {
namespace {

// Of the radius: the cube root of the relative rounding of a load, at which truncation and rounding of a central
// difference are least.
constexpr double difference_step = 1e-5;

template <int Dim>
using Block = typename PairStiffness<Dim>::Block;

template <int Dim>
Block<Dim> stiffness_of(const Model<Dim>& model, const BodiesState<Dim>& bodies, const WaterSurfaces<Dim>& surfaces,
                        int b) {
  constexpr int S = spin_freedoms<Dim>;
  const double way = difference_step * model.bodies[b].radius;
  const Standing<Dim> at = standing(bodies.poses[b]);
  const auto moved = [&](int freedom, double sign) {
    Standing<Dim> there = at;
    if (freedom < Dim)
      there.centroid[freedom] += sign * way;
    else
      there.axes = matrix(
          turned(bodies.motions[b].rotation, Spin<Dim>(sign * difference_step * Spin<Dim>::Unit(freedom - Dim))));
    return water_load(model, surfaces, b, there);
  };
  Block<Dim> k = Block<Dim>::Zero();
  for (int f = 0; f < freedoms<Dim>; ++f) {
    const Load<Dim> ahead = moved(f, 1), behind = moved(f, -1);
    const double width = 2 * (f < Dim ? way : difference_step);
    k.template block<Dim, 1>(0, f) = (behind.force - ahead.force) / width;
    k.template block<S, 1>(Dim, f) = (behind.moment - ahead.moment) / width;
  }
  return k;
}

}  // namespace

template <int Dim>
void find_water_stiffness(const Model<Dim>& model, const Settings& settings, const Schedule& schedule,
                          const BodiesState<Dim>& bodies, std::vector<Block<Dim>>& blocks) {
  blocks.assign(model.waters.empty() ? 0 : model.bodies.size(), Block<Dim>::Zero());
  if (blocks.empty()) return;
  WaterSurfaces<Dim> surfaces;
  find_surfaces(model, schedule.water, schedule.gravity_factor, surfaces);
  each_on_threads(settings.threads, blocks.size(), [&](int b) {
    if (!model.bodies[b].fixed) blocks[b] = stiffness_of(model, bodies, surfaces, b);
  });
}

template void find_water_stiffness<2>(const Model<2>&, const Settings&, const Schedule&, const BodiesState<2>&,
                                      std::vector<Block<2>>&);
template void find_water_stiffness<3>(const Model<3>&, const Settings&, const Schedule&, const BodiesState<3>&,
                                      std::vector<Block<3>>&);

}  // namespace voussoir
