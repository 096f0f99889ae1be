#include "core/model/water_surfaces.hpp"

#include <algorithm>
#include <cmath>

namespace voussoir {
namespace {

// the water on a face, or -1
template <int Dim>
int water_on(const Model<Dim>& model, int joint) {
  return joint == no_joint ? model.water_of_joint.back() : model.water_of_joint[joint];
}

template <int Dim>
bool is_dry(const typename WaterSurfaces<Dim>::Surface& surface, const Body<Dim>& body, const Standing<Dim>& standing) {
  return surface.stretches.empty() ? surface.pressure == 0
                                   : greatest_depth<Dim>(standing.centroid, body.radius, surface.stretches) <= 0;
}

template <int Dim>
Load<Dim> load_by_faces(const Model<Dim>& model, const WaterSurfaces<Dim>& surfaces, const Body<Dim>& body,
                        const Standing<Dim>& standing) {
  Load<Dim> sum;
  if (std::ranges::all_of(surfaces.of, [&](const auto& s) { return is_dry<Dim>(s, body, standing); })) return sum;
  for (const Polytope<Dim>& part : body.parts)
    for (std::size_t f = 0; f < part.faces.size(); ++f) {
      const int water = water_on(model, part.joints[f]);
      if (water < 0) continue;
      const auto& surface = surfaces.of[water];
      const bool uniform = surface.stretches.empty();
      const Load<Dim> load = uniform ? uniform_pressure_on_face<Dim>(part, f, standing.axes)
                                     : pressure_on_face<Dim>(part, f, standing, surface.stretches);
      const double weight = uniform ? surface.pressure : surface.weight;
      sum += {weight * load.force, weight * load.moment};
    }
  return sum;
}

}  // namespace

template <int Dim>
void find_surfaces(const Model<Dim>& model, const WaterValues& values, double factor, WaterSurfaces<Dim>& surfaces) {
  surfaces.of.resize(model.waters.size());
  surfaces.steepest = 0;
  for (std::size_t w = 0; w < model.waters.size(); ++w) {
    auto& surface = surfaces.of[w];
    surface.weight = factor * model.waters[w].unit_weight;
    if (model.waters[w].uniform) {
      surface.pressure = factor * values[w].front();
      surface.stretches.clear();  // of another model's water
      continue;
    }
    list_stretches<Dim>(values[w], surface.stretches);
    surfaces.steepest = std::max(surfaces.steepest, std::abs(surface.weight) * steepness<Dim>(surface.stretches));
  }
}

template <int Dim>
Load<Dim> water_load(const Model<Dim>& model, const WaterSurfaces<Dim>& surfaces, int body,
                     const Standing<Dim>& standing) {
  const Body<Dim>& b = model.bodies[body];
  if (!b.present) return {};
  if (!model.water_by_volume) return load_by_faces(model, surfaces, b, standing);
  const auto& surface = surfaces.of.front();
  const Load<Dim> load = submerged<Dim>(b.parts, b.radius, standing, surface.stretches).load;
  return {surface.weight * load.force, surface.weight * load.moment};
}

template <int Dim>
double water_potential(const Model<Dim>& model, const WaterSurfaces<Dim>& surfaces, int body,
                       const Standing<Dim>& standing) {
  const Body<Dim>& b = model.bodies[body];
  const auto& surface = surfaces.of.front();
  return surface.weight * submerged<Dim>(b.parts, b.radius, standing, surface.stretches).potential;
}

template <int Dim>
BodyStiffness water_stiffness(const Model<Dim>& model, const WaterSurfaces<Dim>& surfaces, int body,
                              const Standing<Dim>& standing) {
  const Body<Dim>& b = model.bodies[body];
  BodyStiffness bound = model.water_bounds[body];
  bound.translation *= surfaces.steepest;
  bound.rotation *= surfaces.steepest;
  if (model.water_by_volume) return bound;
  double pressure = 0;
  for (const auto& surface : surfaces.of)
    pressure =
        std::max(pressure, surface.stretches.empty()
                               ? surface.pressure
                               : surface.weight * greatest_depth<Dim>(standing.centroid, b.radius, surface.stretches));
  // Each face by itself: the full surface, twice the largest section. A pressure turns with its face, at the
  // radius at most: 2 |F| u θ <= |F| (u²/R + R θ²).
  const double area = 2 * model.water_bounds[body].translation;
  return {2 * bound.translation + pressure * area / b.radius, 2 * bound.rotation + 2 * pressure * area * b.radius};
}

template <int Dim>
int levels_of(const Water& water) {
  if (water.uniform) return 0;
  return Dim == 3 ? 1 : static_cast<int>(water.values.size() / 2);
}

template <int Dim>
WaterValues initial_water(const Model<Dim>& model) {
  WaterValues values;
  for (const Water& water : model.waters)
    values.push_back(water.values);
  return values;
}

template <int Dim>
std::vector<Load<Dim>> water_loads_at_reference(const Model<Dim>& model, const WaterValues& values) {
  std::vector<Load<Dim>> loads(model.bodies.size());
  if (model.waters.empty()) return loads;
  WaterSurfaces<Dim> surfaces;
  find_surfaces(model, values, 1, surfaces);
  for (std::size_t b = 0; b < loads.size(); ++b)
    loads[b] = water_load<Dim>(model, surfaces, static_cast<int>(b), {.centroid = model.bodies[b].reference});
  return loads;
}

template <int Dim>
std::vector<Load<Dim>> water_loads_at_reference(const Model<Dim>& model) {
  return water_loads_at_reference(model, initial_water(model));
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                                \
  template void find_surfaces<Dim>(const Model<Dim>&, const WaterValues&, double, WaterSurfaces<Dim>&);          \
  template Load<Dim> water_load<Dim>(const Model<Dim>&, const WaterSurfaces<Dim>&, int, const Standing<Dim>&);   \
  template double water_potential<Dim>(const Model<Dim>&, const WaterSurfaces<Dim>&, int, const Standing<Dim>&); \
  template BodyStiffness water_stiffness<Dim>(const Model<Dim>&, const WaterSurfaces<Dim>&, int,                 \
                                              const Standing<Dim>&);                                             \
  template int levels_of<Dim>(const Water&);                                                                     \
  template WaterValues initial_water<Dim>(const Model<Dim>&);                                                    \
  template std::vector<Load<Dim>> water_loads_at_reference<Dim>(const Model<Dim>&, const WaterValues&);          \
  template std::vector<Load<Dim>> water_loads_at_reference<Dim>(const Model<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
