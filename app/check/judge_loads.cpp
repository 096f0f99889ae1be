#include "app/check/judge_loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/check/blocks.hpp"
#include "core/model/water_surfaces.hpp"
#include "core/run/reduction.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

// The largest change of a free block's water force, over its weight, as it moves by a distance along a horizontal axis.
struct WaterLeft {
  double most = 0;
  int body = 0;
};

template <int Dim>
WaterLeft find_water_left(const Model<Dim>& model, const WaterValues& values, double distance) {
  WaterLeft left;
  WaterSurfaces<Dim> surfaces;
  find_surfaces(model, values, 1, surfaces);
  for (int b = 0; b < static_cast<int>(model.bodies.size()); ++b) {
    const Body<Dim>& body = model.bodies[b];
    const double weight = body.mass * model.gravity.norm();
    if (!is_free(body) || !(weight > 0)) continue;
    const Vector<Dim> here = water_load<Dim>(model, surfaces, b, {.centroid = body.reference}).force;
    for (int axis = 0; axis < Dim - 1; ++axis)
      for (const double by : {distance, -distance}) {
        const Standing<Dim> moved{.centroid = body.reference + by * Vector<Dim>::Unit(axis)};
        const double change = (water_load<Dim>(model, surfaces, b, moved).force - here).norm() / weight;
        if (change > left.most) left = {change, b};
      }
  }
  return left;
}

// A water table stays in place while blocks move: in a search they may leave their water before they count as failed.
template <int Dim>
void judge_searches_in_water(const Prepared<Dim>& prepared, std::vector<std::string>& warnings) {
  constexpr double may_leave = 5e-4;  // of the weight: about 0.03 degrees of friction
  const Model<Dim>& model = prepared.model;
  if (model.waters.empty()) return;
  WaterValues values = initial_water(model);
  for (const StagePlan& stage : prepared.stages) {
    for (const WaterPlan& change : stage.water)
      values[change.water] = change.to;
    const auto* search = std::get_if<ReducePlan>(&stage.plan);
    if (!search) continue;
    // its result is that at no displacement
    if (search->criterion == FailureCriterion::required_strength &&
        not_watched(model, *search, SupportsState<Dim>{}).empty())
      continue;
    const double distance = failure_displacement_of(model, *search);
    const WaterLeft left = find_water_left(model, values, distance);
    if (left.most <= may_leave) continue;
    warnings.push_back(
        fmt::format("stage.{}: before block {} has moved by {:.3g} m and counts as failed, the force of its water "
                    "changes by {:.2g} % of its weight, since a table stays in place; that may be {:.2g} degrees of "
                    "friction: state failure_displacement = {:.1g} or less",
                    stage.name, name_of(model, left.body), distance, 100 * left.most, to_degrees(left.most),
                    distance * may_leave / left.most));
  }
}

// A stress that grows with depth below a surface: below all blocks the surface gives no stress, high above them it is
// hardly intended.
template <int Dim>
void judge_in_situ(const Prepared<Dim>& prepared, std::vector<std::string>& warnings) {
  constexpr double deep = 3000;  // m
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Body<Dim>& body : prepared.model.bodies)
    for (const Polytope<Dim>& part : body.parts)
      for (const Vector<Dim>& v : part.vertices) {
        const double height = prepared.model.origin[Dim - 1] + body.reference[Dim - 1] + v[Dim - 1];
        low = std::min(low, height);
        high = std::max(high, height);
      }
  for (const StagePlan& stage : prepared.stages)
    for (const BoundaryPlan& plan : stage.change.boundary) {
      if (!plan.in_situ) continue;
      const double surface = plan.in_situ->surface;
      const std::string begins = fmt::format("stage.{}.boundary: in_situ.surface = {:g} m is ", stage.name, surface);
      if (surface <= low) warnings.push_back(begins + "below every block: there is no stress; elevations are in m");
      if (surface > high + deep)
        warnings.push_back(
            begins + fmt::format("{:.3g} m above every block; elevations are in m, is it right?", surface - high));
    }
}

// rad: the friction below which a joint slips under horizontal stresses of these ratios to the vertical one
template <int Dim>
double least_friction(const Vector<Dim>& normal, const InSituPlan& in_situ) {
  Vector<Dim> ratios = Vector<Dim>::Constant(in_situ.k0);
  if constexpr (Dim == 3) ratios[1] = in_situ.k0_y.value_or(in_situ.k0);
  ratios[Dim - 1] = 1;
  const Vector<Dim> traction = ratios.cwiseProduct(normal);
  const double across = traction.dot(normal);
  return std::atan2((traction - across * normal).norm(), across);
}

// Joints that slip as the stresses are applied, so that the stated stresses are not reached (Boon 2013, 5.4.1).
template <int Dim>
void judge_generation(const Prepared<Dim>& prepared, std::vector<std::string>& warnings) {
  Model<Dim> model = prepared.model;
  for (const StagePlan& stage : prepared.stages) {
    model = apply(std::move(model), stage.change);
    double needed = 0, stated = 0;
    std::string name;
    for (const BoundaryPlan& plan : stage.change.boundary)
      for (const Joint<Dim>& joint : model.joints) {
        if (!plan.in_situ || joint.holds) continue;
        const JointProperties& properties = model.properties[joint.properties];
        const double least = least_friction<Dim>(joint.plane.normal, *plan.in_situ);
        if (least <= properties.friction + 1e-9 || least <= needed) continue;
        needed = least;
        stated = properties.friction;
        name = joint.name;
      }
    if (needed > 0)
      warnings.push_back(fmt::format(
          "stage.{}: joint '{}' slips while in-situ stresses are applied: it needs a friction of {:.1f} deg "
          "but has {:.1f}; state a higher friction_deg in this stage, and the true one in the "
          "next",
          stage.name, name, to_degrees(needed), to_degrees(stated)));
  }
}

}  // namespace

template <int Dim>
void judge_loads(const Prepared<Dim>& prepared, std::vector<std::string>& warnings) {
  judge_in_situ(prepared, warnings);
  judge_generation(prepared, warnings);
  judge_searches_in_water(prepared, warnings);
}

template void judge_loads<2>(const Prepared<2>&, std::vector<std::string>&);
template void judge_loads<3>(const Prepared<3>&, std::vector<std::string>&);

}  // namespace voussoir
