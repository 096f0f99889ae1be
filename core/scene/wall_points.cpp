#include "core/scene/wall_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/excavation.hpp"
#include "core/scene/bodies.hpp"
#include "core/scene/region.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

// of a part's radius: a ray that cuts less off a corner does not meet the part
constexpr double grazing = 1e-9;

const ExcavationSpec& opening_of(const Scene& scene, const MonitorSpec& spec) {
  std::vector<std::string> names;
  for (const ExcavationSpec& e : scene.excavations) {
    if (e.name == spec.excavation) return e;
    names.push_back(e.name);
  }
  refuse(spec.body.subject, "excavation", "no excavation of this name; " + suggestion(spec.excavation, names));
}

// of its circle or box, in model coordinates
Vector<2> centre_of(const ExcavationSpec& opening, const Vector<2>& origin, const MonitorSpec& spec) {
  const RegionSpec& region = opening.region;
  if (!region.cylinder && !region.box)
    refuse(
        spec.body.subject, "excavation",
        "is stated by planes alone and has no centre to look from; state it by a cylinder or a box, and planes beside "
        "that");
  const Vector<2> centre = region.cylinder
                               ? to_vector<2>(region.cylinder->from)
                               : Vector<2>(0.5 * (to_vector<2>(region.box->min) + to_vector<2>(region.box->max)));
  if (!lies_inside<2>(region_planes<2>(region, origin), centre - origin))
    refuse(spec.body.subject, "excavation",
           "does not hold the centre of its own cylinder or box, from which its wall is seen; state the region about "
           "its centre");
  return centre - origin;
}

// how far along a ray a part begins; infinite where the ray misses it
double begins_at(const Polytope<2>& part, const Vector<2>& from, const Vector<2>& along) {
  double first = 0, last = std::numeric_limits<double>::infinity();
  for (const HalfSpace<2>& face : part.faces) {
    const double gap = -signed_distance<2>(face, from), speed = face.normal.dot(along);
    if (speed > 0)
      last = std::min(last, gap / speed);
    else if (speed < 0)
      first = std::max(first, gap / speed);
    else if (gap < 0)
      last = first;
  }
  return last - first > grazing * part.radius ? first : std::numeric_limits<double>::infinity();
}

WallPoint wall_at(const Model<2>& model, const Vector<2>& centre, double angle, const Subject& monitor) {
  const Vector<2> along(std::cos(angle), std::sin(angle));
  double nearest = std::numeric_limits<double>::infinity();
  WallPoint wall;
  for (const Body<2>& body : model.bodies) {
    if (!body.present) continue;
    for (const Polytope<2>& part : body.parts) {
      const double distance = begins_at(part, centre - body.reference, along);
      if (distance >= nearest) continue;
      nearest = distance;
      const Vector<2> rock = body.reference + part.mass.centroid;
      wall.rock = {rock[0], rock[1]};
    }
  }
  if (!std::isfinite(nearest))
    refuse(monitor, "angles_deg",
           fmt::format("the ray at {:g} deg meets no rock; choose another angle", to_degrees(angle)));
  const Vector<2> point = centre + nearest * along;
  wall.point = {point[0], point[1]};
  wall.inwards = {-along[0], -along[1]};
  return wall;
}

// a stage after the one that takes the opening out may take out the rock that is followed
void require_rock(const Model<2>& model, const std::vector<WallPoint>& walls, const std::vector<double>& angles,
                  const std::string& stage, const Subject& monitor) {
  for (std::size_t k = 0; k < walls.size(); ++k)
    if (body_around<2>(model, {walls[k].rock[0], walls[k].rock[1]}) < 0)
      refuse(monitor, "angles_deg",
             fmt::format("the rock at {:g} deg is taken out by stage '{}'; choose another angle, or follow the wall of "
                         "what that stage takes out",
                         angles[k], stage));
}

}  // namespace

template <>
std::vector<WallPoint> wall_points<3>(const Scene&, const Prepared<3>&, const MonitorSpec& spec) {
  refuse(
      spec.body.subject, "excavation",
      "convergence is followed in the plane only; in space follow the displacement of the wall's blocks, for example "
      "by inside = a point in one");
}

template <>
std::vector<WallPoint> wall_points<2>(const Scene& scene, const Prepared<2>& prepared, const MonitorSpec& spec) {
  const Subject& monitor = spec.body.subject;
  const Vector<2> centre = centre_of(opening_of(scene, spec), prepared.model.origin, spec);
  const auto digs = [&](const StagePlan& s) { return std::ranges::count(s.change.excavate, spec.excavation) > 0; };
  const bool from_start = std::ranges::none_of(prepared.stages, digs);
  Model<2> model = prepared.model;
  std::vector<WallPoint> walls;
  const auto look = [&] {
    for (const double angle : spec.angles)
      walls.push_back(wall_at(model, centre, angle * degree, monitor));
  };
  if (from_start) look();
  for (const StagePlan& stage : prepared.stages) {
    model = apply(std::move(model), stage.change);
    if (walls.empty() && digs(stage)) look();
    require_rock(model, walls, spec.angles, stage.name, monitor);
  }
  return walls;
}

}  // namespace voussoir
